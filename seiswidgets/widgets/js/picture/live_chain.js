// The chain of meshes that both panes share, as the kernel sends it, at any time between its stages.

import { PiecewiseAffineMap } from "../maps/piecewise_affine_map.js";
import { TriangleFinder } from "../maps/triangle_finder.js";
import { toNumbers } from "../shared/bytes.js";
import { Motion } from "./motion.js";

/** @typedef {import("../maps/triangle_finder.js").Numbers} Numbers */
/** @typedef {import("../maps/triangle_finder.js").Indices} Indices */
/** @typedef {{ before: DataView, after: DataView, triangles: DataView, bits: 16 | 32 }} StageState */

/** One step of a restoration: a mesh before and after. Everything is computed when first needed. */
class Stage {
  /**
   * @param {Numbers} before
   * @param {Numbers} after
   * @param {Indices} triangles
   * @param {number} tolerance
   */
  constructor(before, after, triangles, tolerance) {
    this.before = before;
    this.after = after;
    this.triangles = triangles;
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
    return this.cached("finderBefore", () => new TriangleFinder(this.before, this.triangles, this.tolerance));
  }

  get toRestored() {
    return this.cached("toRestored", () => new PiecewiseAffineMap(this.finderBefore, this.after));
  }

  get toOriginal() {
    return this.cached("toOriginal", () =>
      PiecewiseAffineMap.of(this.after, this.before, this.triangles, this.tolerance),
    );
  }

  /**
   * The step carried out in part.
   *
   * @param {number} share
   * @param {[number, number]} metres in a sample
   */
  part(share, metres) {
    const motion = this.cached("motion", () => new Motion(this.before, this.after, this.triangles, metres));
    const part = new Stage(this.before, motion.at(share), this.triangles, this.tolerance);
    part.cache.set("finderBefore", this.finderBefore);
    return part;
  }
}

/** The maps between the present-day section and the restored one, in samples. */
export class LiveChain {
  /**
   * @param {StageState[]} states
   * @param {{ metres: [number, number], tolerance: number }} grid
   */
  constructor(states, grid) {
    this.grid = grid;
    this.stages = states.map(
      ({ before, after, triangles, bits }) =>
        new Stage(
          toNumbers(before, Float32Array),
          toNumbers(after, Float32Array),
          bits === 16 ? toNumbers(triangles, Uint16Array) : toNumbers(triangles, Uint32Array),
          grid.tolerance,
        ),
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
