// Carries points for tests/widgets/test_carried_points.py: reads maps and points as JSON, and writes JSON.

import { readFileSync } from "node:fs";
import { carry, PiecewiseAffineMap } from "../../../seiswidgets/widgets/js/maps/piecewise_affine_map.js";

/** @param {string} base64 */
function decode(base64) {
  const bytes = Buffer.from(base64, "base64");
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

const { maps, points } = JSON.parse(readFileSync(0, "utf8"));
const chain = maps.map((/** @type {Record<"source" | "target" | "triangles", string> & { tolerance: number }} */ map) =>
  PiecewiseAffineMap.fromState({
    source: decode(map.source),
    target: decode(map.target),
    triangles: decode(map.triangles),
    tolerance: map.tolerance,
  }),
);
/** @type {(import("../../../seiswidgets/widgets/js/pointer_layer/types.js").SectionPoint | null)[]} */
const carried = points.map((/** @type {(number | null)[]} */ [x, z]) => carry(chain, { x: x ?? NaN, z: z ?? NaN }));
process.stdout.write(JSON.stringify(carried.map((point) => point && [point.x, point.z])));
