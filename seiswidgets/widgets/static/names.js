/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// names.js
var CONTROLS = ".noUi-handle, .widget-play button, input, select";
var CONCERNED = `${CONTROLS}, .widget-label, .widget-tab-contents, [title]`;
var PLAY_BUTTONS = { "fa-play": "Play", "fa-pause": "Pause", "fa-stop": "Stop", "fa-retweet": "Repeat" };
function accessibleName(control) {
  if (control.type === "color") return "Colour";
  const icon = [...control.querySelector(".fa")?.classList ?? []].find((name) => name in PLAY_BUTTONS);
  const label = control.closest(".widget-inline-hbox")?.querySelector(".widget-label");
  const withTooltip = control.closest("[title]");
  return icon && PLAY_BUTTONS[icon] || label?.textContent?.trim() || withTooltip?.title;
}
function dropEmptyTooltips(box) {
  for (const label of box.querySelectorAll("[title=null]")) label.removeAttribute("title");
}
function nameControls(box) {
  dropEmptyTooltips(box);
  for (
    const panel of
    /** @type {NodeListOf<HTMLElement>} */
    box.querySelectorAll(".widget-tab-contents")
  )
    panel.tabIndex = 0;
  for (
    const control of
    /** @type {NodeListOf<Control>} */
    box.querySelectorAll(CONTROLS)
  ) {
    const name = accessibleName(control);
    const isLabelled = [...control.labels ?? []].some((label) => label.textContent?.trim());
    if (name && !isLabelled) control.setAttribute("aria-label", name);
  }
}
function mayNeedNames({ type, target, attributeName, addedNodes }) {
  if (!(target instanceof HTMLElement)) return false;
  if (type === "attributes") return attributeName === "title" || target.closest(".widget-play") !== null;
  const isNamed = (node) => node instanceof HTMLElement && (node.matches(CONCERNED) || node.querySelector(CONCERNED) !== null);
  return target.matches(".widget-label") || [...addedNodes].some(isNamed);
}
function render({ el }) {
  let box = null;
  const observer = new MutationObserver((changes) => {
    if (box && changes.some(mayNeedNames)) nameControls(box);
  });
  function start() {
    box = el.parentElement;
    if (box) {
      nameControls(box);
      observer.observe(box, { subtree: true, childList: true, attributeFilter: ["class", "title"] });
    } else {
      frame = requestAnimationFrame(start);
    }
  }
  let frame = requestAnimationFrame(start);
  return () => {
    cancelAnimationFrame(frame);
    observer.disconnect();
  };
}
var names_default = { render };
export {
  names_default as default
};
