// A handle that shares the height of two boxes, the ones before and after it, between them.

import { keyedShare, nearestShare } from "./divider/share.js";

const LABEL = "Height of the panes";
const TOOLTIP = "Drag to give the panes more or less height; a double click undoes it";
const NARROW = { app: 760, window: 1000 }; // css pixels below which the panes are stacked

/** @typedef {{ share: number | null }} Traits */

/** @param {HTMLElement} el */
function describe(el) {
  el.classList.add("seiswidgets-divider");
  el.tabIndex = 0;
  el.title = TOOLTIP;
  el.role = "separator";
  el.ariaOrientation = "horizontal";
  [el.ariaLabel, el.ariaValueMin, el.ariaValueMax] = [LABEL, "0", "100"];
}

/** Shares the height of two boxes between them. */
class Sharing {
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
    const set = (/** @type {string} */ name, /** @type {string} */ value) =>
      box.style.setProperty(`--seiswidgets-${name}`, value);
    if (share !== null && !box.classList.contains("seiswidgets-fills")) {
      set("height", `${box.offsetHeight}px`); // as it is now: what one box wins, the other loses
      box.classList.add("seiswidgets-fills");
    }
    set("upper", share === null ? "" : `${share} 1 0`);
    set("lower", share === null ? "" : `${1 - share} 1 0`);
  }
}

/**
 * Let a mouse or a finger drag the handle.
 *
 * @param {HTMLElement} el
 * @param {Sharing} sharing
 * @param {(share: number | null, isFinal: boolean) => void} set
 * @param {AbortSignal} signal
 */
function listenToPointer(el, sharing, set, signal) {
  let start = { y: 0, share: 0, total: 1 };
  el.addEventListener(
    "pointerdown",
    (event) => {
      const [upper, lower] = sharing.heights;
      start = { y: event.clientY, share: sharing.share, total: upper + lower };
      el.setPointerCapture(event.pointerId);
    },
    { signal },
  );
  /** @type {number | null} */
  let share = null; // null until the handle is moved
  el.addEventListener(
    "pointermove",
    (event) => {
      if (!el.hasPointerCapture(event.pointerId)) return;
      share = nearestShare(start.share + (event.clientY - start.y) / start.total, start.total);
      set(share, false);
    },
    { signal },
  );
  el.addEventListener(
    "lostpointercapture",
    () => {
      if (share !== null) set(share, true);
      share = null;
    },
    { signal },
  );
  el.addEventListener("dblclick", () => set(null, true), { signal });
}

/** @type {import("@anywidget/types").Render<Traits>} */
function render({ model, el }) {
  const controller = new AbortController();
  const { signal } = controller;
  const observer = new ResizeObserver(() => observed());
  let observed = () => {};
  /** @type {Sharing | undefined} */
  let sharing;
  const apply = () => sharing?.apply(model.get("share"));

  function start() {
    const [box, upper, lower] = [el.parentElement, el.previousElementSibling, el.nextElementSibling];
    if (!box || !(upper instanceof HTMLElement) || !(lower instanceof HTMLElement)) {
      frame = requestAnimationFrame(start); // not all of it is in the page yet
      return;
    }
    const own = new Sharing(box, upper, lower);
    sharing = own;
    /** @type {(share: number | null, isFinal: boolean) => void} */
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
        if (share === undefined) return;
        event.preventDefault();
        set(share, true);
      },
      { signal },
    );
    observed = () => {
      box.classList.toggle(
        "seiswidgets-narrow",
        box.offsetWidth < NARROW.app || document.documentElement.clientWidth < NARROW.window,
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

export default { render };
