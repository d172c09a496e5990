// Keys that have one meaning wherever the focus is inside a box, such as Ctrl+Z.

/** @typedef {HTMLInputElement | HTMLTextAreaElement} Field */

const TEXT = "input:not([type=checkbox], [type=radio], [type=range], [type=color], [type=button]), textarea";
const OWN_KEYS = ".seiswidgets-layer .plot"; // sends its keys itself

/**
 * Call a function when one of some keys is pressed inside a box. A field that is being typed in keeps its own undo, and
 * every plain character.
 *
 * @param {HTMLElement} box
 * @param {() => string[]} getNames such as "Ctrl+z" and "?"
 * @param {(name: string) => void} act
 * @returns {() => void} stops it
 */
export function takeHotkeys(box, getNames, act) {
  const controller = new AbortController();
  const { signal } = controller;
  /** @type {WeakMap<EventTarget, string>} */
  const committed = new WeakMap(); // values of fields that hold nothing half typed
  const remember = (/** @type {Event} */ { target }) => {
    if (target instanceof HTMLElement && target.matches(TEXT))
      committed.set(target, /** @type {Field} */ (target).value);
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
        const isTyped = /** @type {Field} */ (target).value !== committed.get(target);
        if (!withCtrl || isTyped) return;
      }
      event.preventDefault();
      act(name);
    },
    { capture: true, signal },
  );
  return () => controller.abort();
}
