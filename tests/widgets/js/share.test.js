import assert from "node:assert/strict";
import { test } from "node:test";
import { keyedShare, nearestShare } from "../../../seiswidgets/widgets/js/divider/share.js";

test("a share leaves room for both boxes, whatever is wanted", () => {
  assert.equal(nearestShare(0.6, 1000), 0.6);
  assert.equal(nearestShare(0, 1000), 0.2);
  assert.equal(nearestShare(1, 1000), 0.89);
  assert.equal(nearestShare(0.9, 100), 0.5); // there is room for neither
});

test("keys move the handle by steps, to its ends and back to the usual share", () => {
  assert.ok(Math.abs(/** @type {number} */ (keyedShare("ArrowUp", 0.6, 1000)) - 0.55) < 1e-9);
  assert.ok(Math.abs(/** @type {number} */ (keyedShare("ArrowDown", 0.6, 1000)) - 0.65) < 1e-9);
  assert.equal(keyedShare("Home", 0.6, 1000), 0.2);
  assert.equal(keyedShare("End", 0.6, 1000), 0.89);
  assert.equal(keyedShare("Enter", 0.6, 1000), null);
  assert.equal(keyedShare("x", 0.6, 1000), undefined);
});
