import assert from "node:assert/strict";
import { test } from "node:test";
import { barsOf, brushText, summaryOf, tint } from "../../../seiswidgets/widgets/js/handout/ratios.js";

const SPAN = 1.1;
const EDGES = [-3, -1, 1, 3].map((third) => SPAN ** (third / 3));
/** @type {import("../../../seiswidgets/widgets/js/handout/ratios.js").Axis} */
const AXIS = { edges: EDGES, colours: ["#00f", "#fff", "#f00"], x: [[1, "1"]], decimals: 2 };
const PARTS = [
  { ratio: 0.5, area: 1 },
  { ratio: 1, area: 6 },
  { ratio: 1.08, area: 2 },
  { ratio: 3, area: 1 },
];

test("bars hold the shares of the area, what lies beyond in the end bars", () => {
  const { shares, floor, y } = barsOf(PARTS, AXIS, false);
  assert.deepEqual(
    shares.map((share) => Number(share.toFixed(9))),
    [0.1, 0.6, 0.3],
  );
  assert.equal(floor, 0);
  assert.deepEqual(
    y.map(([, label]) => label),
    ["0", "20", "40", "60"],
  );
});

test("a logarithmic axis begins a decade below the lowest bar", () => {
  const { floor, y } = barsOf(PARTS, AXIS, true);
  assert.equal(floor, 0.01);
  assert.deepEqual(y[0], [0.01, "1"]);
});

test("the summary and the brush are by area", () => {
  assert.match(summaryOf(PARTS, SPAN), /^median 1\.\d+, P1 0\.500, P99 3\.000; scale ±10%, 20% of the area beyond$/);
  assert.equal(brushText(PARTS, AXIS, [EDGES[2], EDGES[3]]), "1.03 to 1.10: 30% of the area");
  assert.equal(brushText(PARTS, AXIS, []), "");
});

test("a brush is opaque, and without a map nothing else is seen", () => {
  const ratios = { palette: new DataView(new Uint8Array(1024).fill(100).buffer), span: SPAN };
  const alpha = (/** @type {DataView} */ palette, /** @type {number} */ level) => palette.getUint8(4 * level + 3);
  const alone = tint(ratios, [1.05, 1.1], false);
  assert.deepEqual([alpha(alone.palette, 255), alpha(alone.palette, 100), alone.opacity > 0], [255, 0, true]);
  const shown = tint(ratios, [1.05, 1.1], true);
  assert.deepEqual([alpha(shown.palette, 255), alpha(shown.palette, 100)], [255, 12]);
  assert.equal(tint(ratios, [], false).opacity, 0);
});
