// Maps that are affine in each triangle of a mesh. The result agrees with PiecewiseAffineMap in core/mapping.py, whose
// tolerance the kernel sends along.

import { toNumbers } from "../shared/bytes.js";
import { Topology } from "./topology.js";
import { TriangleFinder } from "./triangle_finder.js";

/** @typedef {{ x: number, z: number }} Point */
/** @typedef {import("./triangle_finder.js").Numbers} Numbers */
/** @typedef {import("./triangle_finder.js").Indices} Indices */

/** A map from one shape of a mesh to another. */
export class PiecewiseAffineMap {
  /**
   * @param {TriangleFinder} finder of the triangles before
   * @param {Numbers} target positions of the vertices after, x and z in turn
   */
  constructor(finder, target) {
    this.finder = finder;
    this.target = target;
    /** @type {Float64Array | undefined} */
    this.cachedLogRatios = undefined;
  }

  /**
   * @param {Numbers} source
   * @param {Numbers} target
   * @param {Topology} topology
   * @param {number} tolerance
   */
  static of(source, target, topology, tolerance) {
    return new PiecewiseAffineMap(new TriangleFinder(source, topology, tolerance), target);
  }

  /** @param {import("../pointer_layer/types.js").AffineMapState} state */
  static fromState({ source, target, triangles, tolerance }) {
    const [before, after] = [toNumbers(source, Float64Array), toNumbers(target, Float64Array)];
    return PiecewiseAffineMap.of(before, after, new Topology(toNumbers(triangles, Uint32Array)), tolerance);
  }

  /**
   * Carry a point to the target; null outside the mesh.
   *
   * @param {Point} point
   * @returns {Point | null}
   */
  forward({ x, z }) {
    const triangle = this.finder.find(x, z);
    return triangle < 0 ? null : this.carried(triangle, this.finder.weights(triangle, x, z));
  }

  /**
   * The point of a triangle of the target with these barycentric coordinates.
   *
   * @param {number} triangle
   * @param {number[]} weights
   */
  carried(triangle, weights) {
    const carried = { x: 0, z: 0 };
    weights.forEach((weight, corner) => {
      const vertex = this.finder.triangles[3 * triangle + corner];
      carried.x += weight * this.target[2 * vertex];
      carried.z += weight * this.target[2 * vertex + 1];
    });
    return carried;
  }

  /** Logarithm of the area before over the area after, of each triangle. */
  get logRatios() {
    if (!this.cachedLogRatios) {
      const { vertices, triangles } = this.finder;
      const [before, after] = [twiceAreas(vertices, triangles), twiceAreas(this.target, triangles)];
      this.cachedLogRatios = before.map((area, i) => Math.log(area / after[i]));
    }
    return this.cachedLogRatios;
  }
}

/**
 * Twice the signed area of each triangle.
 *
 * @param {Numbers} vertices
 * @param {Indices} triangles
 */
export function twiceAreas(vertices, triangles) {
  const areas = new Float64Array(triangles.length / 3);
  for (let i = 0; i < areas.length; i++) {
    const [a, b, c] = [2 * triangles[3 * i], 2 * triangles[3 * i + 1], 2 * triangles[3 * i + 2]];
    const [ux, uz] = [vertices[b] - vertices[a], vertices[b + 1] - vertices[a + 1]];
    const [vx, vz] = [vertices[c] - vertices[a], vertices[c + 1] - vertices[a + 1]];
    areas[i] = ux * vz - uz * vx;
  }
  return areas;
}

/**
 * Carry a point through maps one after another; null once it is outside one.
 *
 * @param {PiecewiseAffineMap[]} maps
 * @param {Point} point
 * @returns {Point | null}
 */
export function carry(maps, point) {
  return maps.reduce((carried, map) => carried && map.forward(carried), /** @type {Point | null} */ (point));
}
