// A stage carried out in part. The result agrees with part_of_motion in core/rigid.py.

import { twiceAreas } from "../maps/piecewise_affine_map.js";

/** @typedef {import("../maps/triangle_finder.js").Numbers} Numbers */
/** @typedef {import("../maps/triangle_finder.js").Indices} Indices */

/** @typedef {{ x: number, z: number }} Vector */

/** The motion of a mesh, of which a share can be carried out: no block shrinks because it turns. */
export class Motion {
  /**
   * @param {Numbers} before positions of the vertices, x and z in turn
   * @param {Numbers} after
   * @param {Indices} triangles
   * @param {[number, number]} cell metres of rock in one unit of x and one of z
   */
  constructor(before, after, triangles, cell) {
    this.cell = cell;
    this.blocks = blocks(triangles, before.length / 2);
    const [start, stop] = [inMetres(before, cell), inMetres(after, cell)];
    const masses = vertexMasses(start, triangles);
    this.first = centres(start, this.blocks, masses);
    this.last = centres(stop, this.blocks, masses);
    subtract(start, this.first, this.blocks);
    subtract(stop, this.last, this.blocks);
    this.start = start;
    this.stop = stop;
    this.angles = angles(start, stop, this.blocks, masses);
  }

  /**
   * Positions after a share of the motion.
   *
   * Each block turns by a share of its angle about its pole, and the rest of its deformation grows linearly.
   *
   * @param {number} share from 0 to 1
   */
  at(share) {
    const { start, stop, blocks, cell } = this;
    const moves = this.angles.map((angle, block) => this.blockMove(block, angle, share));
    const result = new Float64Array(start.length);
    for (let i = 0; i < blocks.length; i++) {
      const { centre, turn, back } = moves[blocks[i]];
      const [sx, sz, ex, ez] = [start[2 * i], start[2 * i + 1], stop[2 * i], stop[2 * i + 1]];
      const x = (1 - share) * sx + share * (back.x * ex - back.z * ez);
      const z = (1 - share) * sz + share * (back.z * ex + back.x * ez);
      result[2 * i] = (centre.x + turn.x * x - turn.z * z) / cell[0];
      result[2 * i + 1] = (centre.z + turn.z * x + turn.x * z) / cell[1];
    }
    return result;
  }

  /**
   * Where a block's centre is, its turn, and the turn that takes the whole motion's turn back.
   *
   * @param {number} block
   * @param {number} angle
   * @param {number} share
   */
  blockMove(block, angle, share) {
    const [x, z] = [this.first[2 * block], this.first[2 * block + 1]];
    const [dx, dz] = [this.last[2 * block] - x, this.last[2 * block + 1] - z];
    // the centre's share of its arc, in a form that is finite at angle 0
    const along = (share * sinc((share * angle) / 2)) / sinc(angle / 2);
    const arc = direction(0.5 * (share - 1) * angle);
    const centre = { x: x + along * (arc.x * dx - arc.z * dz), z: z + along * (arc.z * dx + arc.x * dz) };
    return { centre, turn: direction(share * angle), back: direction(-angle) };
  }
}

/** @param {number} angle */
const sinc = (angle) => (angle === 0 ? 1 : Math.sin(angle) / angle);

/**
 * @param {number} angle
 * @returns {Vector}
 */
const direction = (angle) => ({ x: Math.cos(angle), z: Math.sin(angle) });

/**
 * @param {Numbers} points
 * @param {[number, number]} cell
 */
function inMetres(points, cell) {
  return Float64Array.from(points, (value, i) => value * cell[i % 2]);
}

/**
 * Label of the connected part that each vertex belongs to.
 *
 * @param {Indices} triangles
 * @param {number} count
 */
function blocks(triangles, count) {
  const parents = Int32Array.from({ length: count }, (_, i) => i);
  /** @param {number} vertex */
  const root = (vertex) => {
    let at = vertex;
    while (parents[at] !== at) {
      parents[at] = parents[parents[at]];
      at = parents[at];
    }
    return at;
  };
  for (let i = 0; i < triangles.length; i++) parents[root(triangles[i])] = root(triangles[i - (i % 3)]);
  /** @type {Map<number, number>} */
  const labels = new Map();
  return Int32Array.from({ length: count }, (_, i) => {
    const label = labels.get(root(i)) ?? labels.size;
    labels.set(root(i), label);
    return label;
  });
}

/**
 * @param {Numbers} vertices
 * @param {Indices} triangles
 */
function vertexMasses(vertices, triangles) {
  const masses = new Float64Array(vertices.length / 2);
  const areas = twiceAreas(vertices, triangles);
  for (let i = 0; i < triangles.length; i++) masses[triangles[i]] += Math.abs(areas[Math.floor(i / 3)]);
  return masses;
}

/**
 * Centre of mass of each block, x and z in turn.
 *
 * @param {Float64Array} points
 * @param {Int32Array} blocks
 * @param {Float64Array} masses
 */
function centres(points, blocks, masses) {
  const count = blocks.reduce((most, block) => Math.max(most, block), 0) + 1;
  const sums = new Float64Array(2 * count);
  const totals = new Float64Array(count);
  blocks.forEach((block, i) => {
    sums[2 * block] += masses[i] * points[2 * i];
    sums[2 * block + 1] += masses[i] * points[2 * i + 1];
    totals[block] += masses[i];
  });
  return sums.map((sum, i) => sum / totals[i >> 1]);
}

/**
 * @param {Float64Array} points changed
 * @param {Float64Array} centres
 * @param {Int32Array} blocks
 */
function subtract(points, centres, blocks) {
  blocks.forEach((block, i) => {
    points[2 * i] -= centres[2 * block];
    points[2 * i + 1] -= centres[2 * block + 1];
  });
}

/**
 * The turn of each block: of the rigid motion nearest to its own (Procrustes).
 *
 * @param {Float64Array} start
 * @param {Float64Array} stop
 * @param {Int32Array} blocks
 * @param {Float64Array} masses
 */
function angles(start, stop, blocks, masses) {
  /** @type {Vector[]} */
  const sums = [];
  blocks.forEach((block, i) => {
    sums[block] ??= { x: 0, z: 0 };
    const [sx, sz, ex, ez] = [start[2 * i], start[2 * i + 1], stop[2 * i], stop[2 * i + 1]];
    sums[block].x += masses[i] * (sx * ex + sz * ez);
    sums[block].z += masses[i] * (sx * ez - sz * ex);
  });
  return sums.map(({ x, z }) => Math.atan2(z, x));
}
