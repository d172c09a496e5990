// The picture that both panes draw: the section's texture, the chain of meshes, the time, and the colours.

import { toNumbers } from "../shared/bytes.js";
import { decodeTriangles, LiveChain } from "./live_chain.js";
import { Texture } from "./texture.js";
import { TextureLoader } from "./texture_loader.js";

/** @typedef {import("./types.js").PictureTraits} PictureTraits */
/** @typedef {{ x: number, z: number }} Point in the section's units */

/** Reads a LivePicture's traits; each is decoded once. */
export class Picture {
  /** @param {import("./types.js").PictureModel} model */
  constructor(model) {
    this.model = model;
    this.loader = new TextureLoader(model);
    /** @type {Map<string, { state: any, value: any }>} */
    this.decoded = new Map();
  }

  /**
   * @template {"grid" | "texture" | "stages" | "triangles" | "colours" | "deformation"} Name
   * @template Value
   * @param {Name} name of a trait
   * @param {(state: PictureTraits[Name]) => Value} decode
   * @returns {Value}
   */
  decode(name, decode) {
    const state = this.model.get(name);
    const known = this.decoded.get(name);
    if (known?.state === state) return known.value;
    const value = decode(state);
    this.decoded.set(name, { state, value });
    return value;
  }

  get grid() {
    return this.model.get("grid");
  }

  get chain() {
    const topologies = this.decode("triangles", (states) => states.map(decodeTriangles));
    return this.decode("stages", (states) => new LiveChain(states, topologies, this.grid));
  }

  /** From 0, the present day, to the number of stages. */
  get time() {
    const [frame, end] = [this.model.get("frame"), this.chain.stages.length];
    return frame === null ? end : Math.min(frame / this.model.get("frames"), end);
  }

  get texture() {
    return this.loader.texture ?? this.overview;
  }

  get overview() {
    return this.decode("texture", ({ overview }) => {
      const [height, width] = overview.shape;
      const [rows, columns] = this.grid.shape;
      return new Texture(toNumbers(overview.data, Int16Array), width, height, { width: columns, height: rows });
    });
  }

  /**
   * The maps from a pane's section to the other one, in samples.
   *
   * @param {boolean} isRestored
   */
  maps(isRestored) {
    return this.chain.maps(this.time, isRestored);
  }

  /**
   * What a pane shows.
   *
   * @param {boolean} isRestored
   * @param {number[]} window left, right, top and bottom, in the section's units
   * @returns {import("./scene.js").Scene}
   */
  scene(isRestored, [left, right, top, bottom]) {
    const [low, high] = [this.toSamples({ x: left, z: top }), this.toSamples({ x: right, z: bottom })];
    return {
      texture: this.texture,
      maps: this.maps(isRestored),
      isRestored,
      window: [low.x, high.x, low.z, high.z],
      colours: this.decode("colours", withPalette),
      deformation: this.decode("deformation", withPalette),
    };
  }

  /** @param {Point} point */
  toSamples({ x, z }) {
    const { origin, step } = this.grid;
    return { x: (x - origin[0]) / step[0], z: (z - origin[1]) / step[1] };
  }

  /** @param {Point} point */
  fromSamples({ x, z }) {
    const { origin, step } = this.grid;
    return { x: origin[0] + x * step[0], z: origin[1] + z * step[1] };
  }

  /**
   * Where a point of the restored section is at the present time; null if it has no place.
   *
   * @param {Point} point
   * @param {number} [end] number of stages after which the point is given
   */
  placed(point, end) {
    const placed = this.chain.placed(this.toSamples(point), this.time, end);
    return placed && this.fromSamples(placed);
  }

  get isAtEnd() {
    return this.time === this.chain.stages.length;
  }

  /**
   * The mesh in a pane, in the section's units; null if there is none.
   *
   * @param {boolean} isRestored
   */
  mesh(isRestored) {
    const stages = this.chain.stagesAt(this.time);
    const stage = isRestored ? stages.at(-1) : stages[0];
    if (!stage) return null;
    const { origin, step } = this.grid;
    const shape = isRestored ? stage.after : stage.before;
    return {
      vertices: Float64Array.from(shape, (value, i) => origin[i % 2] + value * step[i % 2]),
      edges: stage.edges,
    };
  }
}

/**
 * @template {{ palette: DataView }} State
 * @param {State} state
 */
function withPalette(state) {
  return { ...state, palette: toNumbers(state.palette, Uint8Array) };
}
