import assert from "node:assert/strict";
import { test } from "node:test";
import { Navigation } from "../../../seiswidgets/widgets/js/handout/navigation.js";
import { roundTicks, Viewport } from "../../../seiswidgets/widgets/js/handout/viewport.js";

/** @type {import("../../../seiswidgets/widgets/js/handout/viewport.js").Limits} */
const LIMITS = { whole: [0, 4000, 0, 1000], sample: [25, 5], metres: [25, 10] };
const SIZE = { width: 400, height: 200 };

/**
 * @param {Viewport} view
 * @param {{ x: number, y: number }} pixel
 */
function pointAt({ window: [left, right, top, bottom] }, { x, y }) {
  return [left + (x / SIZE.width) * (right - left), top + (y / SIZE.height) * (bottom - top)];
}

test("zooming keeps the point under the pointer and the exaggeration", () => {
  const view = new Viewport(LIMITS, SIZE);
  const at = { x: 100, y: 150 };
  const zoomed = view.zoomed(3, at);
  assert.deepEqual(
    pointAt(zoomed, at).map((value) => Math.round(value * 1e6)),
    pointAt(view, at).map((value) => Math.round(value * 1e6)),
  );
  assert.ok(Math.abs(zoomed.exaggeration - view.exaggeration) < 1e-9);
  assert.equal(view.exaggeration, 1); // 4,000 m by 2,000 m of rock in 400 by 200 pixels
  assert.ok(zoomed.fitted().isFitted && !zoomed.isFitted);
});

test("the window keeps a few samples and does not reach far beyond the whole", () => {
  const view = new Viewport(LIMITS, SIZE);
  const [left, right, top, bottom] = view.zoomed(1e9).window;
  assert.deepEqual([right - left >= 100 - 1e-9, bottom - top >= 20 - 1e-9], [true, true]);
  const [west, east] = view.zoomed(1e-9).window;
  assert.ok(Math.abs(east - west - 8000) < 1e-6);
  const [from, to] = view.zoomed(4).panned(1e6, 0).window;
  assert.ok(Math.abs((from + to) / 2) < 1e-9); // its middle stays on the section
});

test("ticks are round, inside, and far enough apart", () => {
  for (const [low, high] of [
    [0, 4012.5],
    [-37.2, 0.4],
    [1e6, 1e6 + 3],
    [0.001, 0.0042],
  ]) {
    for (const share of [0.1, 0.25, 0.7]) {
      const { ticks, decimals } = roundTicks(low, high, share * (high - low));
      assert.ok(ticks.length >= 1, `${low} to ${high}`);
      assert.ok(ticks.every((tick) => tick >= low - 1e-9 && tick <= high + 1e-9));
      const steps = ticks.slice(1).map((tick, i) => Number((tick - ticks[i]).toPrecision(3)));
      assert.ok(new Set(steps.map((step) => step.toFixed(decimals))).size <= 1);
      for (const step of steps) assert.match(step.toExponential(), /^[125]e/);
    }
  }
});

test("a drag moves the picture with the pointer, and a cancelled one stops", () => {
  const navigation = new Navigation();
  const view = new Viewport(LIMITS, SIZE).zoomed(4);
  const send = (/** @type {object} */ message) => navigation.navigate(view, /** @type {any} */ (message));
  assert.equal(send({ kind: "drag", x: 5, y: 5 }), view); // nothing is held
  navigation.navigate(view, /** @type {any} */ ({ kind: "press", x: 10, y: 10 }));
  const moved = send({ kind: "drag", x: 30, y: 10 });
  assert.ok(Math.abs(moved.window[0] - (view.window[0] - 50)) < 1e-9); // 20 of 400 pixels of 1,000 m
  assert.equal(send({ kind: "release", x: 90, y: 90, cancelled: true }), view);
  assert.equal(navigation.grip, null);
});
