// Loading of a section's full texture, band by band, while nothing moves.

import { toNumbers } from "../shared/bytes.js";
import { Texture } from "./texture.js";

const PAUSE = 300; // ms after the last change of the meshes: they must not wait behind a tile on a slow link

/** Asks the kernel for one tile after another; another page may have asked for it too. */
export class TextureLoader {
  /** @param {import("./types.js").PictureModel} model */
  constructor(model) {
    this.model = model;
    /** @type {Texture | null} */
    this.texture = null; // until all tiles are there
    this.data = new Int16Array(0);
    /** @type {Set<number>} */
    this.received = new Set();
    this.changedAt = -Infinity;
  }

  /** Load the texture from the start. */
  start() {
    const { shape } = this.model.get("texture");
    this.texture = null;
    this.data = new Int16Array(shape[0] * shape[1]);
    this.received.clear();
    this.askForNext();
  }

  /** Note that the meshes have changed. */
  pause() {
    this.changedAt = performance.now();
  }

  get count() {
    const { shape, rows } = this.model.get("texture");
    return Math.ceil(shape[0] / rows);
  }

  askForNext() {
    const { id } = this.model.get("texture");
    const missing = Array.from({ length: this.count }, (_, index) => index).find((index) => !this.received.has(index));
    if (missing === undefined) return;
    const wait = this.changedAt + PAUSE - performance.now();
    const ask = () =>
      id === this.model.get("texture").id && this.model.send({ kind: "tile", texture: id, index: missing });
    if (wait > 0) setTimeout(() => this.askForNext(), wait);
    else ask();
  }

  /**
   * @param {{ kind: string, texture: number, index: number }} message
   * @param {DataView[]} buffers
   */
  receive({ kind, texture, index }, [bytes]) {
    const { id, shape, rows } = this.model.get("texture");
    if (kind !== "tile" || texture !== id || this.received.has(index)) return;
    this.received.add(index);
    this.data.set(toNumbers(bytes, Int16Array), index * rows * shape[1]);
    if (this.received.size === this.count) this.finish();
    else this.askForNext();
  }

  finish() {
    const { shape } = this.model.get("texture");
    const [rows, columns] = this.model.get("grid").shape;
    this.texture = new Texture(this.data, shape[1], shape[0], { width: columns, height: rows });
    this.model.set("revision", this.model.get("revision") + 1);
  }
}
