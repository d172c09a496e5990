// Tracing of pixels through a chain of meshes: each pixel's place after all maps, exact at faults.

import { forEachSpan, toGrid } from "./spans.js";

/** @typedef {import("../maps/piecewise_affine_map.js").PiecewiseAffineMap} PiecewiseAffineMap */

/**
 * The places of pixels: `left + column * stepX`, `top + row * stepZ`.
 *
 * @typedef {object} Grid
 * @property {number} left
 * @property {number} top
 * @property {number} stepX
 * @property {number} stepZ
 * @property {number} width
 * @property {number} height
 */

/**
 * A function that receives neighbouring pixels of a row which all maps carry affinely: the first pixel's place after
 * them, the step from pixel to pixel, and the logarithm of the area ratio of all maps together.
 *
 * @callback TakeRun
 * @param {number} row
 * @param {number} column
 * @param {number} count
 * @param {number} x
 * @param {number} z
 * @param {number} dx
 * @param {number} dz
 * @param {number} logRatio
 */

/** Traces the pixels of a grid through maps, run by run. */
export class Tracer {
  /**
   * @param {PiecewiseAffineMap[]} maps at least one
   * @param {TakeRun} takeRun
   */
  constructor(maps, takeRun) {
    this.levels = maps.map(({ finder, target, logRatios }) => ({ finder, affine: affine(finder, target), logRatios }));
    this.takeRun = takeRun;
    this.starts = maps.map(() => 0); // the triangle in which the last span began, for each map
  }

  /** @param {Grid} grid */
  trace(grid) {
    const { finder } = this.levels[0];
    forEachSpan(toGrid(finder.vertices, grid), finder.triangles, grid, (triangle, row, first, last) => {
      const [x, z] = [grid.left + first * grid.stepX, grid.top + row * grid.stepZ];
      this.carry(0, triangle, row, first, last - first + 1, x, z, grid.stepX, 0, 0);
    });
  }

  /**
   * Carry pixels that one triangle of a map holds to the next map.
   *
   * @param {number} level
   * @param {number} triangle
   * @param {number} row
   * @param {number} column
   * @param {number} count
   * @param {number} x
   * @param {number} z
   * @param {number} dx
   * @param {number} dz
   * @param {number} logRatio
   */
  carry(level, triangle, row, column, count, x, z, dx, dz, logRatio) {
    const { affine, logRatios } = this.levels[level];
    const at = 8 * triangle;
    const right = x - affine[at];
    const down = z - affine[at + 1];
    const newX = affine[at + 2] + affine[at + 4] * right + affine[at + 5] * down;
    const newZ = affine[at + 3] + affine[at + 6] * right + affine[at + 7] * down;
    const newDx = affine[at + 4] * dx + affine[at + 5] * dz;
    const newDz = affine[at + 6] * dx + affine[at + 7] * dz;
    const sum = logRatio + logRatios[triangle];
    if (level + 1 === this.levels.length) this.takeRun(row, column, count, newX, newZ, newDx, newDz, sum);
    else this.split(level + 1, row, column, count, newX, newZ, newDx, newDz, sum);
  }

  /**
   * Split pixels on a straight line into those of each triangle of a map.
   *
   * @param {number} level
   * @param {number} row
   * @param {number} column
   * @param {number} count
   * @param {number} x
   * @param {number} z
   * @param {number} dx
   * @param {number} dz
   * @param {number} logRatio
   */
  split(level, row, column, count, x, z, dx, dz, logRatio) {
    const { finder } = this.levels[level];
    let triangle = this.starts[level];
    let done = 0;
    while (done < count) {
      const nextX = x + done * dx;
      const nextZ = z + done * dz;
      const held = finder.walk(triangle, nextX, nextZ);
      if (held < 0) {
        done++;
        continue;
      }
      if (done === 0) this.starts[level] = held;
      const inside = Math.min(stepsInside(finder, held, nextX, nextZ, dx, dz), count - done);
      this.carry(level, held, row, column + done, inside, nextX, nextZ, dx, dz, logRatio);
      triangle = held;
      done += inside;
    }
  }
}

/**
 * How many steps from a point in a triangle stay in it, the point included.
 *
 * @param {import("../maps/triangle_finder.js").TriangleFinder} finder
 * @param {number} triangle
 * @param {number} x
 * @param {number} z
 * @param {number} dx
 * @param {number} dz
 */
function stepsInside({ coefficients, tolerance }, triangle, x, z, dx, dz) {
  const at = 6 * triangle;
  const right = x - coefficients[at];
  const down = z - coefficients[at + 1];
  const b = coefficients[at + 2] * right + coefficients[at + 3] * down;
  const c = coefficients[at + 4] * right + coefficients[at + 5] * down;
  const db = coefficients[at + 2] * dx + coefficients[at + 3] * dz;
  const dc = coefficients[at + 4] * dx + coefficients[at + 5] * dz;
  const da = -db - dc;
  let steps = Number.POSITIVE_INFINITY;
  if (da < 0) steps = (1 - b - c + tolerance) / -da;
  if (db < 0) steps = Math.min(steps, (b + tolerance) / -db);
  if (dc < 0) steps = Math.min(steps, (c + tolerance) / -dc);
  return Math.max(1, Math.floor(steps) + 1);
}

/**
 * Each triangle's first corner before and after, and the Jacobian between, row by row: eight numbers each.
 *
 * @param {import("../maps/triangle_finder.js").TriangleFinder} finder
 * @param {import("../maps/triangle_finder.js").Numbers} target
 */
function affine({ coefficients, triangles }, target) {
  const result = new Float64Array((8 * triangles.length) / 3);
  for (let i = 0, from = 0, to = 0; i < triangles.length; i += 3, from += 6, to += 8) {
    const a = 2 * triangles[i];
    const b = 2 * triangles[i + 1];
    const c = 2 * triangles[i + 2];
    for (let axis = 0; axis < 2; axis++) {
      const origin = target[a + axis];
      const along = target[b + axis] - origin;
      const across = target[c + axis] - origin;
      result[to + axis] = coefficients[from + axis];
      result[to + 2 + axis] = origin;
      result[to + 4 + 2 * axis] = along * coefficients[from + 2] + across * coefficients[from + 4];
      result[to + 5 + 2 * axis] = along * coefficients[from + 3] + across * coefficients[from + 5];
    }
  }
  return result;
}
