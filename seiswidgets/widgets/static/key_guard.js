/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

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
  listen("keydown", keep);
  listen("keypress", keep);
  listen("pointerdown", (_, box) => {
    if (!box.hasAttribute("tabindex")) box.tabIndex = -1;
  });
  return () => controller.abort();
}

// key_guard.js
function render({ el }) {
  return keepKeys(() => el.parentElement);
}
var key_guard_default = { render };
export {
  key_guard_default as default
};
