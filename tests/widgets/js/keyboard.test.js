import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Keyboard } from "../../../seiswidgets/widgets/js/pointer_layer/keyboard.js";

/** @type {string[]} */
let hotkeys;
/** @type {string[]} */
let sent;
/** @type {boolean[]} */
let bare;
/** @type {any} */
let keyboard;

beforeEach(() => {
  [hotkeys, sent, bare] = [["Enter", "Ctrl+z", " "], [], []];
  const plot = { classList: { toggle: () => true, remove() {} } };
  const model = /** @type {any} */ ({ get: () => hotkeys });
  keyboard = new Keyboard(
    plot,
    model,
    (_kind, _event, more) => sent.push(/** @type {any} */ (more).key),
    (isBare) => bare.push(isBare),
  );
});

/**
 * Whether the key was taken, so that the browser does nothing else with it.
 *
 * @param {"press" | "release"} method
 * @param {string} key
 * @param {object} [more]
 */
function act(method, key, more = {}) {
  let isTaken = false;
  const preventDefault = () => {
    isTaken = true;
  };
  keyboard[method]({ key, preventDefault, ...more });
  return isTaken;
}

test("only hotkeys are taken", () => {
  assert.ok(act("press", "Enter"));
  assert.ok(act("press", "z", { ctrlKey: true }));
  assert.ok(act("press", "z", { metaKey: true }));
  assert.ok(!act("press", "z"));
  assert.ok(!act("press", "Enter", { ctrlKey: true }));
  assert.ok(!act("press", "Tab"));
  assert.deepEqual(sent, ["Enter", "z", "z"]);
});

test("Space is a hotkey when it is released without a drag", () => {
  act("press", " ");
  act("press", " ", { repeat: true });
  assert.ok(keyboard.isSpaceDown);
  act("release", " ");
  assert.deepEqual(sent, [" "]);
  act("press", " ");
  assert.ok(keyboard.startDrag());
  act("release", " ");
  assert.deepEqual(sent, [" "]);
  assert.ok(!keyboard.startDrag());
});

test("Space is never sent unless it is a hotkey", () => {
  hotkeys = [];
  assert.ok(act("press", " "));
  act("release", " ");
  assert.deepEqual(sent, []);
});

test("V is never sent: the section is bare while it is held", () => {
  hotkeys.push("v");
  assert.ok(act("press", "v"));
  act("release", "v");
  assert.ok(!act("press", "v", { ctrlKey: true }));
  assert.deepEqual([bare, sent], [[true, false], []]);
});
