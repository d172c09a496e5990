import assert from "node:assert/strict";
import { afterEach, beforeEach, test } from "node:test";
import { createThrottles } from "../../../seiswidgets/widgets/js/pointer_layer/throttle.js";
import { fakeClock } from "./browser.js";

/** @type {ReturnType<typeof fakeClock>} */
let clock;
/** @type {any[]} */
let sent;
/** @type {ReturnType<typeof createThrottles>} */
let throttles;

beforeEach(() => {
  clock = fakeClock();
  sent = [];
  throttles = createThrottles({ send: (message) => sent.push(message) });
});
afterEach(() => clock.restore());

test("the first message leaves in the next frame, and a drag at once", () => {
  throttles.wheel.add({ steps: 1 });
  assert.deepEqual(sent, []);
  clock.tick(20);
  throttles.drag.add({ x: 1 });
  assert.deepEqual(sent, [
    { kind: "wheel", steps: 1 },
    { kind: "drag", x: 1 },
  ]);
});

test("two messages are on their way if the link takes longer than the kernel", () => {
  throttles.drag.add({ x: 1 });
  clock.tick(200);
  throttles.drag.answer(50); // of 200 ms
  for (const x of [2, 3, 4]) {
    throttles.drag.add({ x });
    clock.tick(60);
  }
  assert.deepEqual(
    sent.map(({ x }) => x),
    [1, 2, 3],
  );
  throttles.drag.answer(170); // of 180 ms
  throttles.drag.add({ x: 5 });
  clock.tick(60);
  assert.equal(sent.length, 3);
});

test("the next waits for the answer, and only the newest is sent", () => {
  throttles.drag.add({ x: 1 });
  clock.tick(20);
  throttles.drag.add({ x: 2 });
  throttles.drag.add({ x: 3 });
  clock.tick(1000);
  assert.equal(sent.length, 1);
  throttles.drag.answer();
  assert.deepEqual(sent.slice(1), [{ kind: "drag", x: 3 }]);
});

test("an early answer does not shorten the pause", () => {
  throttles.drag.add({ x: 1 });
  clock.tick(20);
  throttles.drag.answer();
  throttles.drag.add({ x: 2 });
  clock.tick(25);
  assert.equal(sent.length, 1);
  clock.tick(15);
  assert.equal(sent.length, 2);
});

test("a message without an answer counts as lost after five seconds", () => {
  throttles.wheel.add({ steps: 1 });
  clock.tick(4900);
  throttles.wheel.add({ steps: 1 });
  clock.tick(50);
  assert.equal(sent.length, 1);
  clock.tick(200);
  throttles.wheel.add({ steps: 1 });
  clock.tick(20);
  assert.deepEqual(sent, [
    { kind: "wheel", steps: 1 },
    { kind: "wheel", steps: 2 },
  ]);
});

test("steps of the wheel add up, and pinches multiply", () => {
  for (const steps of [1, 2, -0.5]) throttles.wheel.add({ steps, x: steps });
  for (const factor of [2, 3]) throttles.pinch.add({ factor, dx: 1, dz: factor });
  clock.tick(20);
  assert.deepEqual(sent, [
    { kind: "wheel", steps: 2.5, x: -0.5 },
    { kind: "pinch", factor: 6, dx: 2, dz: 5 },
  ]);
});

test("a dropped message is not sent", () => {
  throttles.wheel.add({ steps: 1 });
  throttles.wheel.drop();
  clock.tick(1000);
  assert.deepEqual(sent, []);
});

test("hovering sends one message in 18 moves, and the last position once the pointer stops", () => {
  for (let x = 1; x <= 40; x++) {
    throttles.hover.add({ x });
    clock.tick(30);
    throttles.hover.answer();
  }
  clock.tick(300);
  const positions = sent.map(({ x }) => x);
  assert.equal(positions.length, 3);
  assert.ok(positions[0] >= 18 && positions[1] - positions[0] >= 18, String(positions));
  assert.equal(positions[2], 40);
});
