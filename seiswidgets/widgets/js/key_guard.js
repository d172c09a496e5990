// A hidden view that keeps key presses inside its parent element.

import { keepKeys } from "./shared/keep_keys.js";

/** @type {import("@anywidget/types").Render} */
function render({ el }) {
  return keepKeys(() => el.parentElement);
}

export default { render };
