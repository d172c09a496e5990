// Point location in a triangle mesh. The result agrees with TriangleFinder in core/point_location.py.

const AXES = /** @type {const} */ ([0, 1]);
const MOST_STEPS = 40; // triangles that a walk crosses before a search in the grid is quicker

/** @typedef {Float64Array | Float32Array} Numbers */
/** @typedef {import("./topology.js").Indices} Indices */
/** @typedef {import("./topology.js").Topology} Topology */

/** Finds the triangle that holds a point, in any set of triangles: cut, with gaps, even overlapping. */
export class TriangleFinder {
  /**
   * @param {Numbers} vertices x and z in turn
   * @param {Topology} topology
   * @param {number} tolerance the barycentric coordinate -tolerance still counts as inside
   */
  constructor(vertices, topology, tolerance) {
    this.vertices = vertices;
    this.topology = topology;
    this.triangles = topology.triangles;
    this.tolerance = tolerance;
    this.coefficients = barycentricCoefficients(vertices, topology.triangles);
    /** @type {TriangleGrid | undefined} */
    this.grid = undefined; // built when first needed
  }

  /**
   * A triangle that holds a point, or else the one that it is nearest to within the tolerance; -1 if there is none.
   *
   * @param {number} x
   * @param {number} z
   */
  find(x, z) {
    this.grid ??= new TriangleGrid(this.boundingBoxes());
    let [nearest, least] = [-1, -this.tolerance];
    for (const triangle of this.grid.candidates(x, z)) {
      const smallest = this.leastCoordinate(triangle, x, z); // NaN in a triangle without area, which holds no point
      if (smallest >= 0) return triangle;
      if (smallest >= least) [nearest, least] = [triangle, smallest];
    }
    return nearest;
  }

  /**
   * As `find`, but starting from a triangle nearby: from there, cross edges towards the point. A fault is not crossed.
   *
   * @param {number} start
   * @param {number} x
   * @param {number} z
   */
  walk(start, x, z) {
    const { coefficients, tolerance } = this;
    const { neighbours } = this.topology;
    let triangle = start;
    for (let step = 0; step < MOST_STEPS && triangle >= 0; step++) {
      const base = 6 * triangle;
      const right = x - coefficients[base];
      const down = z - coefficients[base + 1];
      const b = coefficients[base + 2] * right + coefficients[base + 3] * down;
      const c = coefficients[base + 4] * right + coefficients[base + 5] * down;
      const a = 1 - b - c;
      if (a >= -tolerance && b >= -tolerance && c >= -tolerance) return triangle;
      triangle = neighbours[3 * triangle + (a <= b && a <= c ? 0 : b <= c ? 1 : 2)];
    }
    return this.find(x, z);
  }

  /**
   * @param {number} triangle
   * @param {number} x
   * @param {number} z
   */
  leastCoordinate(triangle, x, z) {
    const base = 6 * triangle;
    const { coefficients } = this;
    const right = x - coefficients[base];
    const down = z - coefficients[base + 1];
    const b = coefficients[base + 2] * right + coefficients[base + 3] * down;
    const c = coefficients[base + 4] * right + coefficients[base + 5] * down;
    return Math.min(1 - b - c, b, c);
  }

  /**
   * Barycentric coordinates of a point.
   *
   * @param {number} triangle
   * @param {number} x
   * @param {number} z
   * @returns {[number, number, number]}
   */
  weights(triangle, x, z) {
    const [x0, z0, bx, bz, cx, cz] = this.coefficients.subarray(6 * triangle, 6 * triangle + 6);
    const b = bx * (x - x0) + bz * (z - z0);
    const c = cx * (x - x0) + cz * (z - z0);
    return [1 - b - c, b, c];
  }

  /** Left, top, right and bottom of each triangle, padded by the tolerance. */
  boundingBoxes() {
    const { vertices, triangles } = this;
    const boxes = new Float64Array((4 * triangles.length) / 3);
    for (let i = 0; i < boxes.length / 4; i++) {
      for (const axis of AXES) {
        const [a, b, c] = [0, 1, 2].map((corner) => vertices[2 * triangles[3 * i + corner] + axis]);
        const [low, high] = [Math.min(a, b, c), Math.max(a, b, c)];
        const padding = 2 * this.tolerance * (high - low); // how far the tolerance extends a triangle beyond a corner
        boxes[4 * i + axis] = low - padding;
        boxes[4 * i + 2 + axis] = high + padding;
      }
    }
    return boxes;
  }
}

/**
 * The first corner of each triangle, and the gradients of its barycentric coordinates 1 and 2: six numbers each.
 *
 * @param {Numbers} vertices
 * @param {Indices} triangles
 */
function barycentricCoefficients(vertices, triangles) {
  const result = new Float64Array(2 * triangles.length);
  for (let i = 0, to = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [2 * triangles[i], 2 * triangles[i + 1], 2 * triangles[i + 2]];
    const [x0, z0] = [vertices[a], vertices[a + 1]];
    const [ux, uz] = [vertices[b] - x0, vertices[b + 1] - z0];
    const [vx, vz] = [vertices[c] - x0, vertices[c + 1] - z0];
    const twiceArea = ux * vz - uz * vx || Number.NaN;
    result[to++] = x0;
    result[to++] = z0;
    result[to++] = vz / twiceArea;
    result[to++] = -vx / twiceArea;
    result[to++] = -uz / twiceArea;
    result[to++] = ux / twiceArea;
  }
  return result;
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

  /**
   * @param {number} x
   * @param {number} z
   */
  candidates(x, z) {
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
