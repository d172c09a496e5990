import assert from "node:assert/strict";
import { test } from "node:test";
import { drawAxes } from "../../../seiswidgets/widgets/js/pointer_layer/axes.js";
import { PlotArea } from "../../../seiswidgets/widgets/js/pointer_layer/plot_area.js";
import { fakeGroup } from "./browser.js";

const AXES = {
  x: { title: "Distance (m)", pixels: [0, 150, 300], labels: ["0", "1", "2"] },
  z: { title: "Depth (m)", pixels: [200], labels: ["5"] },
  left: 64,
  note: "",
};

/**
 * @param {object} traits
 * @param {number} [scale] of the page
 */
function plotArea(traits, scale = 1) {
  const values = { window: [0, 300, 0, 100], size: [300, 200], ...traits };
  const box = { left: 10, top: 20, width: scale * 600, height: scale * 400 };
  /** @type {any} */ (globalThis).getComputedStyle = () => ({ width: "600px", height: "400px" });
  const area = new PlotArea(
    /** @type {any} */ ({ get: (/** @type {keyof typeof values} */ name) => values[name] }),
    /** @type {any} */ ({ getBoundingClientRect: () => box }),
  );
  area.measure();
  return area;
}

test("ticks and labels are placed in the view's own pixels", () => {
  const group = fakeGroup();
  drawAxes(/** @type {any} */ (group), AXES, plotArea({}));
  const ticks = group.all("tick").map(({ attributes }) => [attributes.x1, attributes.y1]);
  assert.deepEqual(ticks, [
    ["0", "400"],
    ["300", "400"],
    ["600", "400"],
    ["-5", "400"],
  ]);
  assert.deepEqual(
    group.all("label middle").map(({ textContent }) => textContent),
    ["0", "1", "2"],
  );
  assert.deepEqual(
    group.all("label end").map(({ textContent }) => textContent),
    ["5"],
  );
  const titles = group.all("title middle").map(({ textContent }) => textContent);
  assert.deepEqual(titles, ["Distance (m)", "Depth (m)"]);
});

test("drawing again replaces the axes, and without axes there is nothing", () => {
  const group = fakeGroup();
  drawAxes(/** @type {any} */ (group), AXES, plotArea({}));
  const count = group.children.length;
  drawAxes(/** @type {any} */ (group), AXES, plotArea({}));
  assert.equal(group.children.length, count);
  drawAxes(/** @type {any} */ (group), {}, plotArea({}));
  assert.equal(group.children.length, 0);
});

test("positions convert between section, view and kernel", () => {
  const area = plotArea({});
  assert.deepEqual(area.toPixels(150, 25), { x: 300, y: 100 });
  assert.deepEqual(area.toSection({ x: 300, y: 100 }), { x: 150, z: 25 });
  assert.deepEqual(area.toKernel({ x: 300, y: 100 }), { x: 150, y: 50 });
  assert.deepEqual(area.pointerPosition(/** @type {any} */ ({ clientX: 110, clientY: 50 })), { x: 100, y: 30 });
});

test("before the kernel knows a size, its pixels are the view's", () => {
  assert.deepEqual(plotArea({ size: [] }).toKernel({ x: 3, y: 4 }), { x: 3, y: 4 });
  assert.equal(plotArea({ window: [] }).isReady, false);
});

test("in a scaled page a click is where it is seen", () => {
  for (const scale of [1, 0.8, 1.25]) {
    const area = plotArea({}, scale);
    const position = area.pointerPosition(
      /** @type {any} */ ({ clientX: 10 + scale * 150, clientY: 20 + scale * 300 }),
    );
    assert.deepEqual(
      Object.values(area.toSection(position)).map((value) => Number(value.toFixed(9))),
      [75, 75],
    );
  }
});
