// The picture of a pane: the section, or the restored section, in a window of it.

import { Painter } from "./painter.js";
import { Tracer } from "./tracer.js";

/** @typedef {import("../maps/piecewise_affine_map.js").PiecewiseAffineMap} PiecewiseAffineMap */

/**
 * @typedef {object} Scene
 * @property {import("./texture.js").Texture} texture of the present-day section
 * @property {PiecewiseAffineMap[]} maps from the pane's section to the other one
 * @property {boolean} isRestored true for the pane of the restored section
 * @property {[number, number, number, number]} window left, right, top and bottom, in samples
 * @property {import("./painter.js").Colours} colours
 * @property {import("./painter.js").Deformation} deformation
 */

/**
 * Draw a pane's section on transparent pixels; the restored one with its area ratios.
 *
 * @param {Uint32Array} pixels
 * @param {{ width: number, height: number }} size
 * @param {Scene} scene
 */
export function drawSection(pixels, size, scene) {
  const { painter, grid, isTinted } = prepare(pixels, size, scene);
  if (!scene.isRestored || !scene.maps.length) return drawPresentDay(painter, grid, scene.texture.section);
  new Tracer(scene.maps, (row, column, count, x, z, dx, dz, logRatio) => {
    painter.paint(row, column, count, x, z, dx, dz);
    if (isTinted) painter.tint(row, column, count, -logRatio);
  }).trace(grid);
}

/**
 * Draw the area ratios over a present-day section.
 *
 * @param {Uint32Array} pixels
 * @param {{ width: number, height: number }} size
 * @param {Scene} scene
 */
export function drawRatios(pixels, size, scene) {
  const { painter, grid, isTinted } = prepare(pixels, size, scene);
  if (!scene.maps.length || !isTinted) return;
  new Tracer(scene.maps, (row, column, count, _x, _z, _dx, _dz, logRatio) => {
    painter.tint(row, column, count, logRatio);
  }).trace(grid);
}

/**
 * @param {Uint32Array} pixels
 * @param {{ width: number, height: number }} size
 * @param {Scene} scene
 */
function prepare(pixels, size, { texture, window: [left, right, top, bottom], colours, deformation }) {
  const [stepX, stepZ] = [(right - left) / size.width, (bottom - top) / size.height];
  const grid = { left: left + stepX / 2, top: top + stepZ / 2, stepX, stepZ, ...size };
  const painter = new Painter(pixels, size.width, texture.reducedTo(stepX, stepZ), colours, deformation);
  return { painter, grid, isTinted: deformation.opacity > 0 };
}

/**
 * Draw the present-day section, to the outer edges of its samples.
 *
 * @param {Painter} painter
 * @param {import("./tracer.js").Grid} grid
 * @param {{ width: number, height: number }} section
 */
function drawPresentDay(painter, { left, top, stepX, stepZ, width, height }, section) {
  const [first, last] = within(left, stepX, width, section.width);
  const [firstRow, lastRow] = within(top, stepZ, height, section.height);
  const count = last - first + 1;
  if (count < 1) return;
  for (let row = firstRow; row <= lastRow; row++)
    painter.paint(row, first, count, left + first * stepX, top + row * stepZ, stepX, 0);
}

/**
 * The first and the last pixel that lie on some samples.
 *
 * @param {number} start
 * @param {number} step
 * @param {number} pixels
 * @param {number} samples
 */
function within(start, step, pixels, samples) {
  const first = Math.ceil((-0.5 - start) / step - 1e-9);
  const last = Math.floor((samples - 0.5 - start) / step + 1e-9);
  return [Math.max(first, 0), Math.min(last, pixels - 1)];
}
