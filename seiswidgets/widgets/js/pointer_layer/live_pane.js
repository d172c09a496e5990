// The picture of a pane that the browser draws itself, and what moves with it.

import { carry } from "../maps/piecewise_affine_map.js";
import { drawRatios, drawSection } from "../picture/scene.js";

const LONGEST_HOLD = 1000; // ms after which a change of the kernel counts as interrupted

/** @typedef {import("./types.js").SectionPoint} SectionPoint */
/** @typedef {import("./view.js").Part} Part */

/**
 * The parts of a pane that show a trait of the picture.
 *
 * @type {Partial<Record<keyof import("../picture/types.js").PictureTraits, Part[]>>}
 */
const PARTS_BY_TRAIT = {
  stages: ["picture", "mesh", "strokes", "marks", "cursors"],
  frame: ["picture", "mesh", "strokes", "marks", "cursors"],
  texture: ["picture"],
  revision: ["picture"],
  picture: ["picture", "mesh"],
  colours: ["picture"],
  deformation: ["picture"],
  changing: [], // draws what was held back
};

/** Draws a LivePicture in a pane; does nothing in a pane without one. */
export class LivePane {
  /**
   * @param {import("./types.js").Model} model of the pane's layer
   * @param {HTMLElement} el
   * @param {(parts: Part[]) => void} requestDraw
   */
  constructor(model, el, requestDraw) {
    this.isRestored = model.get("restored");
    /** @type {import("../picture/types.js").PictureModel | null} */
    this.model = null;
    this.canvas = document.createElement("canvas");
    this.pixels = new ImageData(1, 1);
    /** @type {unknown[]} */
    this.base = []; // what the section below was drawn from
    this.section = new Uint32Array(0);
    this.heldAt = -Infinity;
    this.isStopped = false;
    this.stop = () => {
      this.isStopped = true;
    };
    const reference = model.get("picture");
    if (reference) this.start(model.widget_manager.get_model(reference.replace("IPY_MODEL_", "")), el, requestDraw);
  }

  /**
   * @param {Promise<import("../picture/types.js").PictureModel>} promise
   * @param {HTMLElement} el
   * @param {(parts: Part[]) => void} requestDraw
   */
  async start(promise, el, requestDraw) {
    this.canvas.className = "seiswidgets-plot";
    el.prepend(this.canvas);
    const model = await promise;
    if (this.isStopped) return;
    this.model = model;
    /** @type {[string, () => void][]} */
    const handlers = Object.entries(PARTS_BY_TRAIT).map(([trait, parts]) => [
      `change:${trait}`,
      () => requestDraw(parts),
    ]);
    handlers.push(["change:changing", () => (this.heldAt = performance.now())]);
    for (const [name, handler] of handlers) model.on(name, handler);
    this.stop = () => {
      for (const [name, handler] of handlers) model.off(/** @type {"change:frame"} */ (name), handler);
    };
    requestDraw(["picture", "mesh"]);
  }

  /** The picture, once its own script has run. */
  get picture() {
    return this.model?.get("picture") ?? null;
  }

  /** True while the kernel is changing several things that are to be seen at once. */
  get isHeld() {
    return Boolean(this.model?.get("changing")) && performance.now() - this.heldAt < LONGEST_HOLD;
  }

  /** @param {import("./plot_area.js").PlotArea} plotArea */
  drawPicture({ width, height, model }) {
    const { picture, canvas } = this;
    if (!picture) return;
    const ratio = window.devicePixelRatio || 1;
    const size = { width: Math.max(1, Math.round(width * ratio)), height: Math.max(1, Math.round(height * ratio)) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    if (this.pixels.width !== size.width || this.pixels.height !== size.height)
      this.pixels = new ImageData(size.width, size.height);
    const scene = picture.scene(this.isRestored, model.get("window"));
    this.drawScene(new Uint32Array(this.pixels.data.buffer), size, scene);
    canvas.getContext("2d")?.putImageData(this.pixels, 0, 0);
  }

  /**
   * Draw a scene; the section under the colours of the present-day pane is kept, since it stays the same in a drag.
   *
   * @param {Uint32Array} pixels
   * @param {{ width: number, height: number }} size
   * @param {import("../picture/scene.js").Scene} scene
   */
  drawScene(pixels, size, scene) {
    const base = [scene.texture, scene.colours, size.width, size.height, ...scene.window];
    if (scene.isRestored || base.some((value, i) => value !== this.base[i])) {
      pixels.fill(0);
      drawSection(pixels, size, scene);
    } else pixels.set(this.section);
    if (scene.isRestored) return;
    this.base = base;
    this.section = pixels.slice();
    drawRatios(pixels, size, scene);
  }

  get mesh() {
    return this.picture?.mesh(this.isRestored) ?? null;
  }

  /**
   * The place of a point of this pane in the other one; null if it has none or there is no picture.
   *
   * @param {SectionPoint} point
   */
  carried(point) {
    const { picture } = this;
    const carried = picture && carry(picture.maps(this.isRestored), picture.toSamples(point));
    return carried && picture.fromSamples(carried);
  }

  /**
   * Points of the restored section at the present time: the kernel sends them as they are at the end.
   *
   * @template {[number, number] | null} Point
   * @param {Point[]} points
   * @returns {(Point | null)[]}
   */
  places(points) {
    const { picture } = this;
    if (!picture || !this.isRestored || picture.isAtEnd) return points;
    return points.map((point) => {
      const placed = point && picture.placed({ x: point[0], z: point[1] });
      return placed && /** @type {Point} */ ([placed.x, placed.z]);
    });
  }

  /** @param {[number, number][]} points */
  placedPoints(points) {
    return this.places(points).filter((point) => point !== null);
  }

  /** @param {import("./types.js").Stroke[]} strokes */
  placedStrokes(strokes) {
    return strokes.map((stroke) => ({ ...stroke, points: this.places(stroke.points) }));
  }

  /** @param {import("./types.js").Mark[]} marks */
  placedMarks(marks) {
    return marks
      .flatMap((mark) => this.places([[mark.x, mark.z]]).map((at) => at && { ...mark, x: at[0], z: at[1] }))
      .filter((mark) => mark !== null);
  }
}
