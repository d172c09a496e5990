// A hidden view that keeps key presses and the focus inside its parent element, and takes the keys that mean the same
// everywhere in it.

import { takeHotkeys } from "./shared/hotkeys.js";
import { keepFocus } from "./shared/keep_focus.js";
import { keepKeys } from "./shared/keep_keys.js";

/** @type {import("@anywidget/types").Render<{ names: string[] }>} */
function render({ model, el }) {
  const stops = [keepKeys(() => el.parentElement)];
  function start() {
    const box = el.parentElement;
    if (!box) {
      frame = requestAnimationFrame(start); // el is not in the page yet
      return;
    }
    stops.push(
      keepFocus(box),
      takeHotkeys(
        box,
        () => model.get("names"),
        (name) => model.send({ kind: "key", name }),
      ),
    );
  }
  let frame = requestAnimationFrame(start);
  return () => {
    cancelAnimationFrame(frame);
    for (const stop of stops) stop();
  };
}

export default { render };
