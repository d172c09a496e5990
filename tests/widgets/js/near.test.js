import assert from "node:assert/strict";
import { test } from "node:test";
import { nearestHandle } from "../../../seiswidgets/widgets/js/pointer_layer/handles.js";
import { splitNear } from "../../../seiswidgets/widgets/js/pointer_layer/near.js";
import { thinned } from "../../../seiswidgets/widgets/js/pointer_layer/strokes.js";

/** @param {...([number, number] | null)} points */
const line = (...points) => points.map((point) => point && { x: point[0], y: point[1] });

test("a line is split where it enters and leaves circles, also overlapping ones", () => {
  const across = line([0, 0], [100, 0]);
  assert.deepEqual(splitNear(across, [], 10), { near: [], far: across });
  const { near, far } = splitNear(
    across,
    [
      { x: 50, y: 0 },
      { x: 55, y: 0 },
    ],
    10,
  );
  assert.deepEqual([near[0], near.at(-1)], [line([40, 0])[0], null]);
  assert.deepEqual(far.filter(Boolean), line([0, 0], [40, 0], [65, 0], [100, 0]));
  assert.deepEqual(
    near.filter((point) => point && (point.x < 40 || point.x > 65)),
    [],
  );
});

test("a short stretch between two circles is near, but not one that begins or ends the line", () => {
  const centres = [30, 60].map((x) => ({ x, y: 0 }));
  const { near, far } = splitNear(line([15, 0], [200, 0]), centres, 10);
  assert.deepEqual(far.filter(Boolean), line([15, 0], [20, 0], [70, 0], [200, 0]));
  assert.deepEqual(near.filter(Boolean).slice(-2), line([40, 0], [50, 0]));
});

test("the parts keep the vertices and the gaps of a line", () => {
  const { near, far } = splitNear(line([0, 0], [3, 4], null, [50, 0], [60, 0]), [{ x: 0, y: 0 }], 100);
  assert.deepEqual(far.filter(Boolean), []);
  assert.deepEqual(near.filter(Boolean), line([0, 0], [3, 4], [50, 0], [60, 0]));
});

test("dots keep apart, but for the chosen one", () => {
  const dense = /** @type {any} */ (
    line(...Array.from({ length: 21 }, (_, i) => /** @type {[number, number]} */ ([i, 0])))
  );
  assert.deepEqual(
    thinned(dense, 7, 10).map(({ x }) => x),
    [0, 7, 17],
  );
  assert.deepEqual(
    thinned(dense, -1, 10).map(({ x }) => x),
    [0, 10, 20],
  );
});

test("a handle grows under the pointer only if it is the nearest", () => {
  const handles = [3, 8].map((x) => ({ x, y: 0, colour: "red" }));
  assert.equal(nearestHandle(handles, { x: 6, y: 0 }), handles[1]);
  assert.equal(nearestHandle(handles, { x: 30, y: 0 }), undefined);
  assert.equal(nearestHandle(handles, null), undefined);
});
