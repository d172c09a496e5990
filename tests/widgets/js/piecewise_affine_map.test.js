// tests/widgets/test_carried_points.py compares these maps with the kernel's.

import assert from "node:assert/strict";
import { test } from "node:test";
import { carry, PiecewiseAffineMap } from "../../../seiswidgets/widgets/js/maps/piecewise_affine_map.js";

const SQUARE = [0, 0, 8, 0, 8, 8, 0, 8]; // powers of two are carried without rounding
const TOLERANCE = 1e-3;

/**
 * Bytes at an odd offset, as in a message.
 *
 * @param {Float64Array | Uint32Array} numbers
 */
function message(numbers) {
  const bytes = new Uint8Array(numbers.byteLength + 1);
  bytes.set(new Uint8Array(numbers.buffer), 1);
  return new DataView(bytes.buffer, 1);
}

/** @param {number[]} target */
function mapTo(target) {
  return PiecewiseAffineMap.fromState({
    source: message(new Float64Array(SQUARE)),
    target: message(new Float64Array(target)),
    triangles: message(new Uint32Array([0, 1, 2, 0, 2, 3])),
    tolerance: TOLERANCE,
  });
}

const shift = mapTo(SQUARE.map((value, i) => value + [4, -2][i % 2]));
const stretch = mapTo(SQUARE.map((value, i) => value * [2, 3][i % 2]));

test("a point is carried with its triangle", () => {
  assert.deepEqual(shift.forward({ x: 2, z: 5 }), { x: 6, z: 3 });
  assert.deepEqual(stretch.forward({ x: 5, z: 1 }), { x: 10, z: 3 });
});

test("maps apply one after another, until the point is outside one", () => {
  assert.deepEqual(carry([shift, stretch], { x: 2, z: 5 }), { x: 12, z: 9 });
  assert.equal(carry([shift, stretch], { x: 7, z: 5 }), null);
  assert.deepEqual(carry([], { x: 7, z: 5 }), { x: 7, z: 5 });
});

test("the tolerance that comes with the map decides how far outside is inside", () => {
  assert.ok(shift.forward({ x: 8 + 7 * TOLERANCE, z: 5 }));
  assert.equal(shift.forward({ x: 8 + 9 * TOLERANCE, z: 5 }), null);
});

test("a point without coordinates is in no triangle", () => {
  assert.equal(shift.forward({ x: Number.NaN, z: 5 }), null);
});
