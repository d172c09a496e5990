// ipywidgets leaves some controls without an accessible name: slider handles, the buttons of Play, colour pickers, and
// fields with a tooltip but no label. This gives each control in a box the name that a sighted user sees.

const CONTROLS = ".noUi-handle, .widget-play button, input, select";
const CONCERNED = `${CONTROLS}, .widget-label, .widget-tab-contents, [title]`;

/** @type {Record<string, string>} */
const PLAY_BUTTONS = { "fa-play": "Play", "fa-pause": "Pause", "fa-stop": "Stop", "fa-retweet": "Repeat" };

/** @typedef {HTMLElement & { type?: string, labels?: NodeListOf<HTMLLabelElement> | null }} Control */

/** @param {Control} control */
function accessibleName(control) {
  if (control.type === "color") return "Colour"; // a colour picker cannot have a tooltip
  const icon = [...(control.querySelector(".fa")?.classList ?? [])].find((name) => name in PLAY_BUTTONS);
  const label = control.closest(".widget-inline-hbox")?.querySelector(".widget-label");
  /** @type {HTMLElement | null} */
  const withTooltip = control.closest("[title]");
  return (icon && PLAY_BUTTONS[icon]) || label?.textContent?.trim() || withTooltip?.title;
}

/**
 * ipywidgets writes "null" as the tooltip of a label that has none.
 *
 * @param {HTMLElement} box
 */
function dropEmptyTooltips(box) {
  for (const label of box.querySelectorAll("[title=null]")) label.removeAttribute("title");
}

/** @param {HTMLElement} box */
function nameControls(box) {
  dropEmptyTooltips(box);
  for (const panel of /** @type {NodeListOf<HTMLElement>} */ (box.querySelectorAll(".widget-tab-contents")))
    panel.tabIndex = 0; // so that the arrows can scroll it
  for (const control of /** @type {NodeListOf<Control>} */ (box.querySelectorAll(CONTROLS))) {
    const name = accessibleName(control);
    const isLabelled = [...(control.labels ?? [])].some((label) => label.textContent?.trim());
    if (name && !isLabelled) control.setAttribute("aria-label", name);
  }
}

/**
 * Return whether a change may concern a name: lines and readouts change with every frame of a drag, and hold no controls.
 *
 * @param {MutationRecord} change
 */
function mayNeedNames({ type, target, attributeName, addedNodes }) {
  if (!(target instanceof HTMLElement)) return false;
  if (type === "attributes") return attributeName === "title" || target.closest(".widget-play") !== null;
  const isNamed = (/** @type {Node} */ node) =>
    node instanceof HTMLElement && (node.matches(CONCERNED) || node.querySelector(CONCERNED) !== null);
  return target.matches(".widget-label") || [...addedNodes].some(isNamed);
}

/** @type {import("@anywidget/types").Render} */
function render({ el }) {
  /** @type {HTMLElement | null} */
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
      frame = requestAnimationFrame(start); // el is not in the page yet
    }
  }
  let frame = requestAnimationFrame(start);
  return () => {
    cancelAnimationFrame(frame);
    observer.disconnect();
  };
}

export default { render };
