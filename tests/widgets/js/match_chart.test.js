import assert from "node:assert/strict";
import { test } from "node:test";
import { Scale, ticks } from "../../../seiswidgets/widgets/js/match_chart/scale.js";

const PEAKS = [
  { slip: 50, correlation: 0.9, weight: 0.8 },
  { slip: -30, correlation: 0.4, weight: 0.2 },
];
const CURVE = { slip: [-100, 0, 100], correlation: [0, 0.5, 1], peaks: PEAKS, deformation: [], chance: 0.4, step: 5 };
const scale = new Scale(/** @type {any} */ (CURVE), { width: 200, height: 100 });

test("slips and correlations have their places", () => {
  assert.deepEqual(
    [-100, 0, 100].map((slip) => scale.x(slip)),
    [0, 100, 200],
  );
  assert.deepEqual(
    [0, 0.5, 1].map((correlation) => scale.y(correlation)),
    [100, 50, 0],
  );
  assert.equal(scale.correlationAt(50), 0.75);
  assert.equal(scale.correlationAt(900), 1);
});

test("a peak nearby attracts the slip, unless it is free", () => {
  assert.equal(scale.slipAt(155, false), 50);
  assert.equal(scale.slipAt(155, true), 55);
  assert.equal(scale.slipAt(180, false), 80);
  assert.equal(scale.slipAt(-50, false), -100);
});

test("keys step, go to the next peak, and stay inside", () => {
  assert.equal(scale.slipByKey("ArrowRight", false, 10), 15);
  assert.equal(scale.slipByKey("ArrowLeft", true, 10), -40);
  assert.equal(scale.slipByKey("ArrowLeft", true, -90), -100);
  assert.equal(scale.slipByKey("PageUp", false, -30), 50);
  assert.equal(scale.slipByKey("PageDown", false, 50), -30);
  assert.equal(scale.slipByKey("PageDown", false, -30), null);
  assert.equal(scale.slipByKey("Enter", false, -90), 50);
  assert.equal(scale.slipByKey("x", false, 0), null);
});

test("ticks are round numbers", () => {
  assert.deepEqual(ticks(-100, 100, 4), [-100, -50, 0, 50, 100]);
  assert.deepEqual(ticks(0, 1.1, 3), [0, 0.5, 1]);
});
