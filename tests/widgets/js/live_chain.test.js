import assert from "node:assert/strict";
import { test } from "node:test";
import { decodeTriangles, LiveChain } from "../../../seiswidgets/widgets/js/picture/live_chain.js";

const CORNERS = [0, 0, 100, 0, 0, 100];

/** @param {number[]} values */
const bytes = (values) => new DataView(Float32Array.from(values).buffer);

/** @param {number} from */
function shifted(from) {
  return CORNERS.map((value, i) => value + (i % 2 ? 0 : from));
}

/** @type {import("../../../seiswidgets/widgets/js/picture/live_chain.js").StageState[]} */
const STAGES = [
  [0, 1],
  [1, 3],
].map(([before, after]) => ({
  before: bytes(shifted(before)),
  after: bytes(shifted(after)),
  quick: false,
  low: [0, 0],
  scale: [1, 1],
}));

function chain() {
  const triangles = { triangles: new DataView(Uint16Array.of(0, 1, 2).buffer), bits: /** @type {16} */ (16) };
  const topologies = STAGES.map(() => decodeTriangles(triangles));
  return new LiveChain(STAGES, topologies, { metres: [1, 1], tolerance: 1e-9 });
}

test("a point that is given after some stages is moved to any time, back or on", () => {
  /** @type {[number, number, number][]} time, stages after which the point is given, and where it is then */
  const cases = [
    [1, 2, 18],
    [0, 1, 19],
    [2, 1, 22],
    [1.5, 1, 21],
  ];
  for (const [time, end, x] of cases) {
    const placed = chain().placed({ x: 20, z: 30 }, time, end);
    assert.ok(placed && Math.hypot(placed.x - x, placed.z - 30) < 1e-9, `${time}, ${end}`);
  }
});

test("a point on the border is not lost by rounding, one outside is", () => {
  assert.equal(chain().placed({ x: 20, z: -0.01 }, 1)?.x, 18);
  assert.equal(chain().placed({ x: 20, z: -5 }, 1), null);
});
