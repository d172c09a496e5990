// Key presses in a widget stay in it. JupyterLab and Notebook 7 would take them as shortcuts of the notebook: x cuts the
// cell that holds the widget, "d d" deletes it, m makes it Markdown, Shift+Enter runs it.
//
// VS Code forwards what reaches the window of an output's page to its notebook, where the same keys have such meanings.
//
// These listeners must not see the event:
// - Lumino's, on the document, in the capture phase. It compares the selectors of all shortcuts with the event's target,
//   then with its ancestors, up to the first element that has the attribute below. Most selectors end in ":focus", so the
//   attribute works on the target only, not on an element around it. It is set in the capture phase of the window, which
//   comes before the document's, so every element that can receive a key is covered, however late it was created.
// - the notebook's, on its own element, in the bubble phase, which moves the focus to the active cell;
// - VS Code's, on the window, in the bubble phase.

const SUPPRESS = "data-lm-suppress-shortcuts";

/** @param {Event} event */
const stopPropagation = (event) => event.stopPropagation();

/**
 * Keep key presses inside a box from the page around it; default actions of the browser are left alone.
 *
 * A click on a part that cannot have the focus gives it to the box, where the notebook would give it to the cell.
 *
 * @param {() => HTMLElement | null} findBox called at each event, since a view may be moved to another box
 * @returns {() => void} stops it
 */
export function keepKeys(findBox) {
  const controller = new AbortController();
  const { signal } = controller;
  /**
   * @param {"keydown" | "keypress" | "keyup" | "pointerdown"} type
   * @param {(event: Event, box: HTMLElement) => void} handle
   */
  const listen = (type, handle) => {
    /** @param {Event} event */
    const handleInside = (event) => {
      const box = findBox();
      if (box && event.composedPath().includes(box)) handle(event, box);
    };
    window.addEventListener(type, handleInside, { capture: true, signal });
  };
  /**
   * @param {Event} event
   * @param {HTMLElement} box
   */
  const keep = (event, box) => {
    if (event.target instanceof Element) event.target.setAttribute(SUPPRESS, "true");
    box.addEventListener(event.type, stopPropagation, { signal }); // registered once, however often it is added
  };
  for (const type of /** @type {const} */ (["keydown", "keypress", "keyup"])) listen(type, keep);
  listen("pointerdown", (_, box) => {
    if (!box.hasAttribute("tabindex")) box.tabIndex = -1;
  });
  return () => controller.abort();
}
