import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { GestureRecogniser } from "../../../seiswidgets/widgets/js/pointer_layer/gestures.js";

const MIDDLE = 1;

/** @type {any[]} */
let sent; // by actions and throttles, in order
/** @type {any[]} */
let pointer;
let isSpaceDown = false;
/** @type {any} */
let gestures;

/** @param {string} kind */
const throttle = (kind) => ({
  add: (/** @type {object} */ message) => sent.push({ kind, ...message }),
  drop() {},
});

beforeEach(() => {
  [sent, pointer, isSpaceDown] = [[], [], false];
  const classList = { add() {}, remove() {}, toggle() {} };
  const plotArea = {
    height: 400,
    pointerPosition: (/** @type {any} */ event) => ({ x: event.x, y: event.y }),
    toKernel: (/** @type {any} */ { x, y }) => ({ x: 2 * x, y: 2 * y }),
  };
  const actions = {
    send: (/** @type {string} */ kind, /** @type {any} */ event, more = {}) =>
      sent.push({ kind, at: event.x, ...more }),
    movePointer: (/** @type {any} */ position) => pointer.push(position),
    scheduleRest() {},
  };
  gestures = new GestureRecogniser(
    /** @type {any} */ ({ classList, focus() {}, setPointerCapture() {} }),
    /** @type {any} */ (plotArea),
    { startDrag: () => isSpaceDown },
    { drag: throttle("drag"), hover: throttle("hover"), wheel: throttle("wheel"), pinch: throttle("pinch") },
    /** @type {any} */ (actions),
  );
});

/**
 * @param {"press" | "move" | "lift" | "leave" | "doubleClick" | "scroll"} method
 * @param {object} [event]
 */
function act(method, event = {}) {
  const type = { press: "pointerdown", move: "pointermove", lift: "pointerup" }[String(method)] ?? method;
  const plain = { type, pointerId: 1, pointerType: "mouse", button: 0, timeStamp: 0, x: 0, y: 0, preventDefault() {} };
  gestures[method]({ ...plain, ...event });
}

/** @param {object} [event] */
function tap(event = {}) {
  act("press", { pointerType: "touch", ...event });
  act("lift", { pointerType: "touch", ...event });
}

const kinds = () => sent.map(({ kind }) => kind);

test("a press, a drag and a release", () => {
  act("move", { x: 5 });
  act("press", { x: 10 });
  act("move", { x: 20 });
  act("lift", { x: 30 });
  assert.deepEqual(kinds(), ["hover", "press", "drag", "release"]);
  assert.deepEqual([sent[2].x, sent[3].x, sent[3].cancelled], [40, 60, false]); // in the kernel's pixels
  assert.equal("pan" in sent[1], false);
});

test("Space and the middle button pan, from press to release", () => {
  for (const [space, button] of [
    [true, 0],
    [false, MIDDLE],
  ]) {
    sent = [];
    isSpaceDown = Boolean(space);
    act("press", { button });
    isSpaceDown = false; // let go in the middle of the drag
    act("move", { button });
    act("lift", { button });
    assert.deepEqual(
      sent.map(({ pan }) => pan),
      [true, true, true],
    );
  }
});

test("a second button or pointer does not interrupt a drag", () => {
  act("press", { x: 10 });
  act("press", { pointerId: 2, x: 99 });
  act("move", { pointerId: 2, x: 98 });
  act("lift", { pointerId: 2, x: 97 });
  act("lift", { x: 20 });
  assert.deepEqual(kinds(), ["press", "release"]);
});

test("the pointer leaves only when nothing is held", () => {
  act("press");
  act("leave");
  act("lift");
  act("leave");
  assert.deepEqual(kinds(), ["press", "release", "leave"]);
  assert.equal(pointer.at(-1), null);
});

test("a cancelled pointer cancels its drag", () => {
  act("press");
  act("lift", { type: "pointercancel" });
  assert.equal(sent[1].cancelled, true);
});

test("two quick taps are a double click, a third tap is none", () => {
  const doubles = () => kinds().filter((kind) => kind === "double").length;
  for (const timeStamp of [0, 200]) tap({ timeStamp });
  assert.equal(doubles(), 1);
  act("doubleClick", { timeStamp: 250 }); // the browser's own, of the same taps
  assert.equal(doubles(), 1);
  tap({ timeStamp: 400 });
  assert.equal(doubles(), 1);
  act("doubleClick", { timeStamp: 5000 }); // of a mouse
  assert.equal(doubles(), 2);
});

for (const [reason, second] of /** @type {[string, object][]} */ ([
  ["too late", { timeStamp: 401 }],
  ["too far", { timeStamp: 100, x: 31 }],
]))
  test(`two taps are no double click if the second is ${reason}`, () => {
    tap();
    tap(second);
    assert.equal(kinds().includes("double"), false);
  });

test("a finger held too long or moved too far has not tapped", () => {
  for (const end of [
    { timeStamp: 300, x: 0 },
    { timeStamp: 50, x: 12 },
  ]) {
    act("press", { pointerType: "touch" });
    act("lift", { pointerType: "touch", ...end });
    assert.equal(gestures.lastTap, null);
  }
});

test("two fingers zoom by their distance and pan by their midpoint, and cancel the first one's drag", () => {
  const touch = { pointerType: "touch" };
  act("press", { ...touch, x: 100 });
  act("move", { ...touch, x: 110 });
  act("press", { ...touch, pointerId: 2, x: 200 });
  act("move", { ...touch, pointerId: 2, x: 290 });
  act("lift", { ...touch, pointerId: 2, x: 290 });
  act("move", { ...touch, x: 0 }); // the finger that is left does nothing
  act("lift", { ...touch, x: 0 });
  assert.deepEqual(kinds(), ["press", "drag", "release", "pinch"]);
  const [, , release, pinch] = sent;
  assert.deepEqual([release.cancelled, release.x], [true, 220]);
  assert.deepEqual([pinch.factor, pinch.dx, pinch.dz, pinch.x], [2, 90, 0, 400]);
});

test("a wheel may count pixels, lines or pages", () => {
  for (const [deltaMode, deltaY] of [
    [0, -100],
    [1, -6.25],
    [2, 0.25],
  ])
    act("scroll", { deltaMode, deltaY });
  assert.deepEqual(
    sent.map(({ steps }) => steps),
    [1, 1, -1],
  );
});

test("modifier keys are reported", () => {
  act("move", { shiftKey: true, ctrlKey: true });
  assert.deepEqual(sent[0].modifiers, ["ctrl", "shift"]);
});
