// Key presses in a widget stay in it. JupyterLab and Notebook 7 would take them as shortcuts of the notebook: x cuts the
// cell that holds the widget, "d d" deletes it, m makes it Markdown, Shift+Enter runs it.
//
// Two listeners of theirs must be kept out:
// - Lumino's, on the document, in the capture phase. It compares the selectors of all shortcuts with the event's target,
//   then with its parents, up to the first element that has the attribute below. Most selectors end in ":focus", so the
//   attribute is of use on the target only, not on an element around it. It is set there in the capture phase of the
//   window, which comes before the document's, so any element that can take a key is covered, whenever it was made.
// - the notebook's, on its own element, in the bubble phase, which moves the focus to the active cell.

const SUPPRESS = "data-lm-suppress-shortcuts";
const stopPropagation = (event) => event.stopPropagation();

/**
 * Keep key presses inside a box from the page around it; default actions of the browser are left alone.
 *
 * A click on a part that takes no focus gives it to the box, where the notebook would give it to the cell.
 *
 * @param {() => Element | null} findBox called at each event, as a view may be moved to another box
 * @returns {() => void} ends it
 */
export function keepKeys(findBox) {
  const ended = new AbortController();
  const { signal } = ended;
  const listen = (type, act) => {
    const actInside = (event) => {
      const box = findBox();
      if (box && event.composedPath().includes(box)) act(event, box);
    };
    window.addEventListener(type, actInside, { capture: true, signal });
  };
  const keep = (event, box) => {
    event.target.setAttribute(SUPPRESS, "true");
    box.addEventListener(event.type, stopPropagation, { signal }); // once, however often it is added
  };
  listen("keydown", keep);
  listen("keypress", keep);
  listen("pointerdown", (_, box) => {
    if (!box.hasAttribute("tabindex")) box.tabIndex = -1;
  });
  return () => ended.abort();
}
