/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// divider/share.js
var LEAST = { upper: 200, lower: 110 };
var STEP = 0.05;
function nearestShare(share, total) {
  const [low, high] = [LEAST.upper / total, 1 - LEAST.lower / total];
  return low < high ? Math.min(high, Math.max(low, share)) : 0.5;
}
function keyedShare(key, share, total) {
  if (key === "Enter") return null;
  const wanted = { ArrowUp: share - STEP, ArrowDown: share + STEP, Home: 0, End: 1 }[key];
  return wanted === void 0 ? void 0 : nearestShare(wanted, total);
}

// divider.js
var LABEL = "Height of the panes";
var TOOLTIP = "Drag to give the panes more or less height; a double click undoes it";
var NARROW = { app: 760, window: 1e3 };
function describe(el) {
  el.classList.add("seiswidgets-divider");
  el.tabIndex = 0;
  el.title = TOOLTIP;
  el.role = "separator";
  el.ariaOrientation = "horizontal";
  [el.ariaLabel, el.ariaValueMin, el.ariaValueMax] = [LABEL, "0", "100"];
}
var Sharing = class {
  /**
   * @param {HTMLElement} box the one around both
   * @param {HTMLElement} upper
   * @param {HTMLElement} lower
   */
  constructor(box, upper, lower) {
    this.box = box;
    this.upper = upper;
    this.lower = lower;
  }
  get heights() {
    return [this.upper, this.lower].map((box) => box.getBoundingClientRect().height);
  }
  /** Share of the upper box at present. */
  get share() {
    const [upper, lower] = this.heights;
    return upper / (upper + lower);
  }
  /** @param {number | null} share */
  apply(share) {
    const { box } = this;
    const set = (name, value) => box.style.setProperty(`--seiswidgets-${name}`, value);
    if (share !== null && !box.classList.contains("seiswidgets-fills")) {
      set("height", `${box.offsetHeight}px`);
      box.classList.add("seiswidgets-fills");
    }
    set("upper", share === null ? "" : `${share} 1 0`);
    set("lower", share === null ? "" : `${1 - share} 1 0`);
  }
};
function listenToPointer(el, sharing, set, signal) {
  let start = { y: 0, share: 0, total: 1 };
  el.addEventListener(
    "pointerdown",
    (event) => {
      const [upper, lower] = sharing.heights;
      start = { y: event.clientY, share: sharing.share, total: upper + lower };
      el.setPointerCapture(event.pointerId);
    },
    { signal }
  );
  let share = null;
  el.addEventListener(
    "pointermove",
    (event) => {
      if (!el.hasPointerCapture(event.pointerId)) return;
      share = nearestShare(start.share + (event.clientY - start.y) / start.total, start.total);
      set(share, false);
    },
    { signal }
  );
  el.addEventListener(
    "lostpointercapture",
    () => {
      if (share !== null) set(share, true);
      share = null;
    },
    { signal }
  );
  el.addEventListener("dblclick", () => set(null, true), { signal });
}
function render({ model, el }) {
  const controller = new AbortController();
  const { signal } = controller;
  const observer = new ResizeObserver(() => observed());
  let observed = () => {
  };
  let sharing;
  const apply = () => sharing?.apply(model.get("share"));
  function start() {
    const [box, upper, lower] = [el.parentElement, el.previousElementSibling, el.nextElementSibling];
    if (!box || !(upper instanceof HTMLElement) || !(lower instanceof HTMLElement)) {
      frame = requestAnimationFrame(start);
      return;
    }
    const own = new Sharing(box, upper, lower);
    sharing = own;
    const set = (share, isFinal) => {
      own.apply(share);
      if (!isFinal) return;
      model.set("share", share);
      model.save_changes();
    };
    listenToPointer(el, own, set, signal);
    el.addEventListener(
      "keydown",
      (event) => {
        const share = keyedShare(event.key, own.share, own.heights[0] + own.heights[1]);
        if (share === void 0) return;
        event.preventDefault();
        set(share, true);
      },
      { signal }
    );
    observed = () => {
      box.classList.toggle(
        "seiswidgets-narrow",
        box.offsetWidth < NARROW.app || document.documentElement.clientWidth < NARROW.window
      );
      el.ariaValueNow = String(Math.round(100 * own.share));
    };
    for (const one of [box, upper]) observer.observe(one);
    apply();
  }
  describe(el);
  let frame = requestAnimationFrame(start);
  model.on("change:share", apply);
  return () => {
    cancelAnimationFrame(frame);
    controller.abort();
    observer.disconnect();
    model.off("change:share", apply);
  };
}
var divider_default = { render };
export {
  divider_default as default
};
