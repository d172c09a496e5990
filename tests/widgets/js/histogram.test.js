import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Brush } from "../../../seiswidgets/widgets/js/histogram/brush.js";
import { Scale } from "../../../seiswidgets/widgets/js/histogram/scale.js";

const COUNT = 5;
const EDGES = Array.from({ length: COUNT + 1 }, (_, i) => 2 ** (i - COUNT / 2));
const BARS = { edges: EDGES, shares: [0.1, 0.2, 0.4, 0.2, 0.1], colours: [], x: [], y: [], decimals: 2, floor: 0 };
const scale = new Scale(/** @type {any} */ (BARS), { width: 500, height: 100 });

/** @type {number[]} */
let brushed;
/** @type {Brush} */
let brush;

beforeEach(() => {
  brushed = [];
  const read = () => ({ brush: brushed, edges: EDGES });
  brush = new Brush(
    () => scale,
    read,
    (value) => {
      brushed = value;
    },
  );
});

/** The indices of the first and last bar that are brushed. */
const bars = () => [EDGES.indexOf(brushed[0]), EDGES.indexOf(brushed[1]) - 1];

test("bars are equally wide in the logarithm", () => {
  EDGES.forEach((edge, i) => {
    assert.ok(Math.abs(scale.x(edge) - 100 * i) < 1e-9);
  });
  assert.equal(scale.barOf(1), 2);
  assert.deepEqual([scale.barOf(1e-9), scale.barOf(1e9)], [0, COUNT - 1]);
  assert.deepEqual([scale.barAt(-5), scale.barAt(250), scale.barAt(505)], [0, 2, COUNT - 1]);
});

test("the highest bar leaves room for the mark", () => {
  assert.ok(scale.y(0.4) > 5);
  assert.equal(scale.y(0), 100);
});

test("a brush covers the bars whose centres it holds, or the nearest bar", () => {
  assert.deepEqual(scale.brushedBars([EDGES[1], EDGES[3]]), [1, 2]);
  assert.deepEqual(scale.brushedBars([0.99, 1.01]), [2, 2]);
  assert.deepEqual(scale.brushedBars([1e-9, 1e9]), [0, COUNT - 1]);
});

test("the first arrow key brushes the middle bar, the next moves on", () => {
  brush.press("ArrowRight", false);
  assert.deepEqual(bars(), [2, 2]);
  brush.press("ArrowRight", false);
  assert.deepEqual(bars(), [3, 3]);
  brush.press("Home", true);
  assert.deepEqual(bars(), [0, 3]);
  brush.press("ArrowLeft", true); // there is no bar further left
  assert.deepEqual(bars(), [0, 3]);
  assert.ok(brush.press("Escape", false));
  assert.deepEqual(brushed, []);
  assert.ok(!brush.press("Escape", false));
});

test("keys without a meaning are left to the page", () => {
  assert.ok(!brush.press("Tab", false));
  assert.ok(!brush.press("ArrowUp", false));
});

test("a brush set elsewhere is extended from there", () => {
  brush.press("Home", false);
  brushed = [EDGES[1], EDGES[3]];
  brush.press("ArrowRight", true);
  assert.deepEqual(bars(), [1, 3]);
});

test("a logarithmic axis gives each decade the same height", () => {
  const shares = [0.001, 0.01, 0.1, 0, 1e-9];
  const log = new Scale(/** @type {any} */ ({ ...BARS, shares, floor: 1e-4 }), { width: 500, height: 100 });
  const heights = shares.map((share) => log.height - log.y(share));
  assert.ok(Math.abs(heights[2] - 3 * heights[0]) < 1e-9 && Math.abs(heights[1] - 2 * heights[0]) < 1e-9);
  assert.ok(heights[2] < log.height && heights[3] === 0 && heights[4] === 0);
});
