// The chain of meshes that both panes share, as the kernel sends it, at any time between its stages.

import { carry, PiecewiseAffineMap } from "../maps/piecewise_affine_map.js";
import { Topology } from "../maps/topology.js";
import { TriangleFinder } from "../maps/triangle_finder.js";
import { toNumbers } from "../shared/bytes.js";
import { Motion } from "./motion.js";

/** @typedef {import("../maps/triangle_finder.js").Numbers} Numbers */
/** @typedef {import("../maps/piecewise_affine_map.js").Point} Point */

const NUDGES = [0, 0.05, -0.05]; // samples: a line on the border may lie just outside the rock

/**
 * @typedef {object} StageState
 * @property {DataView} before
 * @property {DataView} after
 * @property {boolean} quick true for 16-bit integers, which are to be scaled and shifted
 * @property {[number, number]} low
 * @property {[number, number]} scale
 */

/** @typedef {{ triangles: DataView, bits: 16 | 32 }} TrianglesState */

/** One step of a restoration: a mesh before and after. Everything is computed when first needed. */
class Stage {
  /**
   * @param {Numbers} before
   * @param {Numbers} after
   * @param {Topology} topology
   * @param {number} tolerance
   */
  constructor(before, after, topology, tolerance) {
    this.before = before;
    this.after = after;
    this.topology = topology;
    this.tolerance = tolerance;
    /** @type {Map<string, any>} */
    this.cache = new Map();
  }

  /**
   * @template Value
   * @param {string} name
   * @param {() => Value} compute
   * @returns {Value}
   */
  cached(name, compute) {
    if (!this.cache.has(name)) this.cache.set(name, compute());
    return this.cache.get(name);
  }

  get finderBefore() {
    return this.cached("finderBefore", () => new TriangleFinder(this.before, this.topology, this.tolerance));
  }

  /** Each edge once. */
  get edges() {
    return this.topology.edges;
  }

  get toRestored() {
    return this.cached("toRestored", () => new PiecewiseAffineMap(this.finderBefore, this.after));
  }

  get toOriginal() {
    return this.cached("toOriginal", () =>
      PiecewiseAffineMap.of(this.after, this.before, this.topology, this.tolerance),
    );
  }

  /**
   * The step carried out in part.
   *
   * @param {number} share
   * @param {[number, number]} metres in a sample
   */
  part(share, metres) {
    const motion = this.cached("motion", () => new Motion(this.before, this.after, this.topology.triangles, metres));
    const part = new Stage(this.before, motion.at(share), this.topology, this.tolerance);
    part.cache.set("finderBefore", this.finderBefore);
    return part;
  }
}

/**
 * @param {DataView} bytes
 * @param {Pick<StageState, "quick" | "low" | "scale">} packing
 */
function unpacked(bytes, { quick, low, scale }) {
  if (!quick) return toNumbers(bytes, Float32Array);
  return Float64Array.from(toNumbers(bytes, Uint16Array), (value, i) => low[i % 2] + scale[i % 2] * value);
}

/** @param {TrianglesState} state */
export function decodeTriangles({ triangles, bits }) {
  return new Topology(bits === 16 ? toNumbers(triangles, Uint16Array) : toNumbers(triangles, Uint32Array));
}

/** The maps between the present-day section and the restored one, in samples. */
export class LiveChain {
  /**
   * @param {StageState[]} states
   * @param {Topology[]} topologies
   * @param {{ metres: [number, number], tolerance: number }} grid
   */
  constructor(states, topologies, grid) {
    this.grid = grid;
    this.stages = states.map(
      ({ before, after, ...packing }, i) =>
        new Stage(unpacked(before, packing), unpacked(after, packing), topologies[i], grid.tolerance),
    );
    /** @type {{ time: number, stages: Stage[] }} */
    this.moment = { time: this.stages.length, stages: this.stages };
  }

  /**
   * The stages at a time from 0, the present day, to their number.
   *
   * @param {number} time
   */
  stagesAt(time) {
    if (time !== this.moment.time) {
      const whole = Math.floor(time);
      const part = whole < this.stages.length && time > whole;
      const started = part ? [this.stages[whole].part(time - whole, this.grid.metres)] : [];
      this.moment = { time, stages: [...this.stages.slice(0, whole), ...started] };
    }
    return this.moment.stages;
  }

  /**
   * Where a point of the restored section is at a time, in samples; null if it has no place.
   *
   * @param {Point} point
   * @param {number} time
   * @param {number} [end] number of stages after which the point is given
   */
  placed(point, time, end = this.stages.length) {
    const stages = this.stagesAt(time);
    const later = stages.slice(end);
    if (later.length)
      return carry(
        later.map(({ toRestored }) => toRestored),
        point,
      );
    let at = /** @type {Point | null} */ (point);
    for (let index = end - 1; index >= 0 && at; index--) {
      const { toOriginal } = this.stages[index];
      const { x, z } = at;
      const within = NUDGES.find((nudge) => toOriginal.finder.find(x, z + nudge) >= 0);
      if (within === undefined) return null;
      const triangle = toOriginal.finder.find(x, z + within);
      const weights = toOriginal.finder.weights(triangle, x, z + within);
      if (index < stages.length) return stages[index].toRestored.carried(triangle, weights);
      at = toOriginal.carried(triangle, weights);
    }
    return at;
  }

  /**
   * The maps from one section to the other.
   *
   * @param {number} time
   * @param {boolean} fromRestored
   */
  maps(time, fromRestored) {
    const stages = this.stagesAt(time);
    return fromRestored ? stages.map((stage) => stage.toOriginal).reverse() : stages.map((stage) => stage.toRestored);
  }
}
