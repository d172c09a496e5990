// The focus stays in a box. When the control that has it is disabled or removed, the browser gives it to the page, and
// JupyterLab would take the next key as a shortcut of the notebook.

/**
 * Keep the focus in a box: it goes to the nearest element that is left around a control that cannot have it any more.
 * That is no control itself, so that a key pressed twice does not act on a neighbour.
 *
 * @param {HTMLElement} box
 * @returns {() => void} stops it
 */
export function keepFocus(box) {
  const controller = new AbortController();
  const { signal } = controller;
  /** @type {HTMLElement[]} */
  let path = []; // from the control that has the focus out to the box; empty while the focus is elsewhere
  const isUsable = (/** @type {HTMLElement} */ one) => one.isConnected && !(/** @type {any} */ (one).disabled);
  function rescue() {
    if (!path.length || isUsable(path[0]) || box.contains(document.activeElement)) return;
    const target = path.slice(1).find((one) => one.isConnected) ?? box;
    if (!target.hasAttribute("tabindex")) target.tabIndex = -1;
    target.focus({ preventScroll: true });
  }
  box.addEventListener(
    "focusin",
    (event) => {
      const all = /** @type {HTMLElement[]} */ (event.composedPath());
      path = all.slice(0, all.indexOf(box) + 1);
    },
    { signal },
  );
  box.addEventListener(
    "focusout",
    (event) => {
      const left = path;
      if (event.relatedTarget) path = [];
      else
        setTimeout(() => {
          if (path === left && isUsable(left[0])) path = [];
          else rescue(); // it is being removed
        });
    },
    { signal },
  );
  const observer = new MutationObserver(rescue);
  observer.observe(box, { subtree: true, childList: true, attributeFilter: ["disabled"] });
  return () => {
    controller.abort();
    observer.disconnect();
  };
}
