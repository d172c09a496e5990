import assert from "node:assert/strict";
import { test } from "node:test";
import { firstVisible, labelPosition } from "../../../seiswidgets/widgets/js/pointer_layer/strokes.js";

const [WIDTH, HEIGHT] = [600, 400];
const plotArea = /** @type {any} */ ({
  width: WIDTH,
  height: HEIGHT,
  contains: (/** @type {any} */ { x, y }) => x >= 0 && x <= WIDTH && y >= 0 && y <= HEIGHT,
});

/** @param {([number, number] | null)[]} points */
const visible = (...points) =>
  firstVisible(
    points.map((point) => point && { x: point[0], y: point[1] }),
    plotArea,
  );

test("a label belongs to the first vertex in the plot area", () => {
  assert.deepEqual(visible([-10, 5], null, [30, 40], [50, 60]), { x: 30, y: 40 });
});

test("a line without visible vertices has its label where it enters", () => {
  assert.deepEqual(visible([-100, 200], [700, 200]), { x: 0, y: 200 });
  assert.deepEqual(visible([300, 500], [300, -100]), { x: 300, y: 400 });
  assert.deepEqual(visible([-100, -100], [700, 700]), { x: 0, y: 0 });
  assert.deepEqual(visible([-50, -50], [-50, 300], [700, 300]), { x: 0, y: 300 }); // its second segment
});

test("a line that passes by, or is interrupted, has no label", () => {
  assert.equal(visible([-100, 50], [50, -101]), null);
  assert.equal(visible([-5, 0], [-5, 400]), null);
  assert.equal(visible([-100, 200], null, [700, 200]), null);
  assert.equal(visible(), null);
});

test("a label is up and to the right of its point, but inside the plot area", () => {
  assert.deepEqual(labelPosition({ x: 100, y: 100 }, 50, plotArea), { x: 109, y: 91 });
  for (const x of [0, WIDTH])
    for (const y of [0, HEIGHT]) {
      const label = labelPosition({ x, y }, 50, plotArea);
      assert.ok(label.x > 0 && label.x + 50 < WIDTH && label.y > 10 && label.y < HEIGHT, JSON.stringify(label));
    }
});

test("a label longer than the plot area starts at its left side", () => {
  assert.equal(labelPosition({ x: 300, y: 100 }, 900, plotArea).x, 4);
});
