// Draws a scene for tests/widgets/test_live_pictures.py: reads it as JSON, and writes the pixels.

import { readFileSync } from "node:fs";
import { decodeTriangles, LiveChain } from "../../../seiswidgets/widgets/js/picture/live_chain.js";
import { drawRatios, drawSection } from "../../../seiswidgets/widgets/js/picture/scene.js";
import { Texture } from "../../../seiswidgets/widgets/js/picture/texture.js";
import { toNumbers } from "../../../seiswidgets/widgets/js/shared/bytes.js";

/** @param {string} base64 */
function decode(base64) {
  const bytes = Buffer.from(base64, "base64");
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

const task = JSON.parse(readFileSync(0, "utf8"), (_, value) =>
  value?.bytes === undefined ? value : decode(value.bytes),
);
const { grid, stages, triangles, texture, time, size, window, isRestored, colours, deformation } = task;
const palette = (/** @type {{ palette: DataView }} */ one) => ({
  ...one,
  palette: toNumbers(one.palette, Uint8Array),
});
const [height, width] = texture.shape;
const [rows, columns] = grid.shape;
const pixels = new Uint32Array(size.width * size.height);
const scene = {
  texture: new Texture(toNumbers(texture.data, Int16Array), width, height, { width: columns, height: rows }),
  maps: new LiveChain(stages, triangles.map(decodeTriangles), grid).maps(time, isRestored),
  isRestored,
  window,
  colours: /** @type {import("../../../seiswidgets/widgets/js/picture/painter.js").Colours} */ (palette(colours)),
  deformation: /** @type {import("../../../seiswidgets/widgets/js/picture/painter.js").Deformation} */ (
    palette(deformation)
  ),
};
const runs = task.runs ?? 1;
const start = process.cpuUsage();
for (let i = 0; i < runs; i++) {
  drawSection(pixels.fill(0), size, scene);
  if (!isRestored) drawRatios(pixels, size, scene);
}
if (task.runs) process.stderr.write(`${process.cpuUsage(start).user / runs / 1000} ms\n`);
process.stdout.write(new Uint8Array(pixels.buffer));
