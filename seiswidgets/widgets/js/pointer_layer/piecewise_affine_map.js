// Maps that are affine in each triangle of a mesh: they carry the pointer from this pane to another without the kernel.
// The result agrees with PiecewiseAffineMap in core/mapping.py, whose tolerance the kernel sends along.

import { toNumbers } from "../shared/bytes.js";

const AXES = /** @type {const} */ ([0, 1]);

/** @typedef {import("./types.js").SectionPoint} SectionPoint */
/** @typedef {[number, number, number]} Weights barycentric coordinates */

/** A map from one shape of a mesh to another. */
export class PiecewiseAffineMap {
  /** @param {import("./types.js").AffineMapState} state */
  constructor({ source, target, triangles, tolerance }) {
    this.source = toNumbers(source, Float64Array);
    this.target = toNumbers(target, Float64Array);
    this.triangles = toNumbers(triangles, Uint32Array);
    this.tolerance = tolerance; // the barycentric coordinate -tolerance still counts as inside
    this.grid = new TriangleGrid(this.boundingBoxes());
  }

  /** Left, top, right and bottom of each triangle, padded by the tolerance. */
  boundingBoxes() {
    const boxes = new Float64Array((4 * this.triangles.length) / 3);
    for (let i = 0; i < boxes.length / 4; i++) {
      for (const axis of AXES) {
        const [a, b, c] = [0, 1, 2].map((corner) => this.source[2 * this.triangles[3 * i + corner] + axis]);
        const [low, high] = [Math.min(a, b, c), Math.max(a, b, c)];
        const padding = 2 * this.tolerance * (high - low); // how far the tolerance extends a triangle beyond a corner
        boxes[4 * i + axis] = low - padding;
        boxes[4 * i + 2 + axis] = high + padding;
      }
    }
    return boxes;
  }

  /**
   * Find a triangle that holds a point, or else the triangle that it is nearest to within the tolerance.
   *
   * @param {SectionPoint} point
   * @returns {{ triangle: number, weights: Weights } | null}
   */
  locate(point) {
    let [nearest, least] = [/** @type {{ triangle: number, weights: Weights } | null} */ (null), -this.tolerance];
    for (const triangle of this.grid.candidates(point)) {
      const weights = this.weights(triangle, point);
      const smallest = Math.min(...weights); // NaN in a triangle without area, which holds no point
      if (smallest >= 0) return { triangle, weights };
      if (smallest >= least) [nearest, least] = [{ triangle, weights }, smallest];
    }
    return nearest;
  }

  /**
   * @param {number} triangle
   * @param {SectionPoint} point
   * @returns {Weights}
   */
  weights(triangle, { x, z }) {
    const [a, b, c] = this.triangles.subarray(3 * triangle, 3 * triangle + 3);
    const source = this.source;
    const [x0, z0] = [source[2 * a], source[2 * a + 1]];
    const [bx, bz] = [source[2 * b] - x0, source[2 * b + 1] - z0];
    const [cx, cz] = [source[2 * c] - x0, source[2 * c + 1] - z0];
    const [px, pz] = [x - x0, z - z0];
    const twiceArea = bx * cz - bz * cx;
    const [second, third] = [(px * cz - pz * cx) / twiceArea, (bx * pz - bz * px) / twiceArea];
    return [1 - second - third, second, third];
  }

  /**
   * Carry a point to the target; null outside the mesh.
   *
   * @param {SectionPoint} point
   * @returns {SectionPoint | null}
   */
  forward(point) {
    const located = this.locate(point);
    if (!located) return null;
    const carried = { x: 0, z: 0 };
    located.weights.forEach((weight, corner) => {
      const vertex = this.triangles[3 * located.triangle + corner];
      carried.x += weight * this.target[2 * vertex];
      carried.z += weight * this.target[2 * vertex + 1];
    });
    return carried;
  }
}

/**
 * Carry a point through maps one after another; null once it is outside one.
 *
 * @param {PiecewiseAffineMap[]} maps
 * @param {SectionPoint} point
 * @returns {SectionPoint | null}
 */
export function carry(maps, point) {
  return maps.reduce((carried, map) => carried && map.forward(carried), /** @type {SectionPoint | null} */ (point));
}

/** A grid of cells, each with the triangles whose bounding boxes reach into it: about a quarter as many cells. */
class TriangleGrid {
  /** @param {Float64Array} boxes */
  constructor(boxes) {
    const count = boxes.length / 4;
    this.across = Math.max(1, Math.ceil(Math.sqrt(count) / 2)); // cells along either axis
    this.low = AXES.map((axis) => extreme(Math.min, boxes, axis));
    const high = AXES.map((axis) => extreme(Math.max, boxes, axis + 2));
    this.cellSize = AXES.map((axis) => (high[axis] - this.low[axis]) / this.across || 1);
    /** @type {number[][]} */
    this.cells = Array.from({ length: this.across ** 2 }, () => []);
    for (let triangle = 0; triangle < count; triangle++) {
      const [left, top, right, bottom] = boxes.subarray(4 * triangle, 4 * triangle + 4);
      const [lastColumn, lastRow] = [this.index(right, 0), this.index(bottom, 1)];
      for (let row = this.index(top, 1); row <= lastRow; row++)
        for (let column = this.index(left, 0); column <= lastColumn; column++)
          this.cells[row * this.across + column].push(triangle);
    }
  }

  /**
   * @param {number} value
   * @param {0 | 1} axis
   */
  index(value, axis) {
    const index = Math.floor((value - this.low[axis]) / this.cellSize[axis]);
    return Math.max(0, Math.min(index, this.across - 1));
  }

  /** @param {SectionPoint} point */
  candidates({ x, z }) {
    return this.cells[this.index(z, 1) * this.across + this.index(x, 0)] ?? []; // none for NaN
  }
}

/**
 * @param {(one: number, other: number) => number} choose
 * @param {Float64Array} boxes
 * @param {number} side 0 to 3
 */
function extreme(choose, boxes, side) {
  let result = boxes[side];
  for (let i = side; i < boxes.length; i += 4) result = choose(result, boxes[i]);
  return result;
}
