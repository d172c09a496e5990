/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// shared/hotkeys.js
var TEXT = "input:not([type=checkbox], [type=radio], [type=range], [type=color], [type=button]), textarea";
var OWN_KEYS = ".seiswidgets-layer .plot";
function takeHotkeys(box, getNames, act) {
  const controller = new AbortController();
  const { signal } = controller;
  const committed = /* @__PURE__ */ new WeakMap();
  const remember = ({ target }) => {
    if (target instanceof HTMLElement && target.matches(TEXT))
      committed.set(
        target,
        /** @type {Field} */
        target.value
      );
  };
  for (const type of ["focusin", "change"]) box.addEventListener(type, remember, { signal });
  box.addEventListener(
    "keydown",
    (event) => {
      const { target, key } = event;
      const withCtrl = event.ctrlKey || event.metaKey;
      const name = (withCtrl ? "Ctrl+" : "") + key;
      if (event.altKey || !(target instanceof Element) || !getNames().includes(name)) return;
      if (withCtrl && target.closest(OWN_KEYS)) return;
      if (target.matches(TEXT)) {
        const isTyped = (
          /** @type {Field} */
          target.value !== committed.get(target)
        );
        if (!withCtrl || isTyped) return;
      }
      event.preventDefault();
      act(name);
    },
    { capture: true, signal }
  );
  return () => controller.abort();
}

// shared/keep_focus.js
function keepFocus(box) {
  const controller = new AbortController();
  const { signal } = controller;
  let path = [];
  const isUsable = (one) => one.isConnected && !/** @type {any} */
  one.disabled;
  function rescue() {
    if (!path.length || isUsable(path[0]) || box.contains(document.activeElement)) return;
    const target = path.slice(1).find((one) => one.isConnected) ?? box;
    if (!target.hasAttribute("tabindex")) target.tabIndex = -1;
    target.focus({ preventScroll: true });
  }
  box.addEventListener(
    "focusin",
    (event) => {
      const all = (
        /** @type {HTMLElement[]} */
        event.composedPath()
      );
      path = all.slice(0, all.indexOf(box) + 1);
    },
    { signal }
  );
  box.addEventListener(
    "focusout",
    (event) => {
      const left = path;
      if (event.relatedTarget) path = [];
      else
        setTimeout(() => {
          if (path === left && isUsable(left[0])) path = [];
          else rescue();
        });
    },
    { signal }
  );
  const observer = new MutationObserver(rescue);
  observer.observe(box, { subtree: true, childList: true, attributeFilter: ["disabled"] });
  return () => {
    controller.abort();
    observer.disconnect();
  };
}

// shared/keep_keys.js
var SUPPRESS = "data-lm-suppress-shortcuts";
var stopPropagation = (event) => event.stopPropagation();
function keepKeys(findBox) {
  const controller = new AbortController();
  const { signal } = controller;
  const listen = (type, handle) => {
    const handleInside = (event) => {
      const box = findBox();
      if (box && event.composedPath().includes(box)) handle(event, box);
    };
    window.addEventListener(type, handleInside, { capture: true, signal });
  };
  const keep = (event, box) => {
    if (event.target instanceof Element) event.target.setAttribute(SUPPRESS, "true");
    box.addEventListener(event.type, stopPropagation, { signal });
  };
  for (
    const type of
    /** @type {const} */
    ["keydown", "keypress", "keyup"]
  ) listen(type, keep);
  listen("pointerdown", (_, box) => {
    if (!box.hasAttribute("tabindex")) box.tabIndex = -1;
  });
  return () => controller.abort();
}

// key_guard.js
function render({ model, el }) {
  const stops = [keepKeys(() => el.parentElement)];
  function start() {
    const box = el.parentElement;
    if (!box) {
      frame = requestAnimationFrame(start);
      return;
    }
    stops.push(
      keepFocus(box),
      takeHotkeys(
        box,
        () => model.get("names"),
        (name) => model.send({ kind: "key", name })
      )
    );
  }
  let frame = requestAnimationFrame(start);
  return () => {
    cancelAnimationFrame(frame);
    for (const stop of stops) stop();
  };
}
var key_guard_default = { render };
export {
  key_guard_default as default
};
