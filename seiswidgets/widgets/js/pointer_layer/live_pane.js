// The picture of a pane that the browser draws itself, and what moves with it.

import { carry } from "../maps/piecewise_affine_map.js";
import { drawRatios, drawSection } from "../picture/scene.js";

const LONGEST_HOLD = 1000; // ms after which a change of the kernel counts as interrupted
const SLOW = 10; // ms that a picture may take at 30 a second: there are two panes, and their lines
const SAVED = 3; // times as long takes a picture with twice as many pixels along either side
const SOON = 200; // ms within which another picture follows while time runs

/** @typedef {import("./types.js").SectionPoint} SectionPoint */
/** @typedef {import("./view.js").Part} Part */

/**
 * The parts of a pane that show a trait of the picture.
 *
 * @type {Partial<Record<keyof import("../picture/types.js").PictureTraits, Part[]>>}
 */
const PARTS_BY_TRAIT = {
  stages: ["picture", "mesh", "strokes", "marks", "cursors", "note"],
  frame: ["picture", "mesh", "strokes", "marks", "cursors", "note"],
  texture: ["picture"],
  revision: ["picture"],
  picture: ["picture", "mesh"],
  colours: ["picture"],
  deformation: ["picture"],
  bare: ["bare", "picture"],
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
    this.layer = model;
    this.requestDraw = requestDraw;
    this.last = { time: 0, start: -Infinity, took: 0 };
    this.isSkipping = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.refining = undefined;
    /** @type {import("../picture/types.js").PictureModel | null} */
    this.model = null;
    this.canvas = document.createElement("canvas");
    this.leastRatio = 1; // of the picture's pixels to css pixels, for a printer
    this.pixels = new ImageData(1, 1);
    /** @type {unknown[]} */
    this.base = []; // what the section below was drawn from
    this.section = new Uint32Array(0);
    this.heldAt = -Infinity;
    this.isStopped = false;
    this.isBareAlone = false;
    this.stop = () => {
      this.isStopped = true;
    };
    const reference = model.get("picture");
    if (reference) this.start(model.widget_manager.get_model(reference.replace("IPY_MODEL_", "")), el);
  }

  /**
   * @param {Promise<import("../picture/types.js").PictureModel>} promise
   * @param {HTMLElement} el
   */
  async start(promise, el) {
    this.canvas.className = "seiswidgets-plot";
    el.prepend(this.canvas);
    const model = await promise;
    if (this.isStopped) return;
    this.model = model;
    /** @type {[string, () => void][]} */
    const handlers = Object.entries(PARTS_BY_TRAIT).map(([trait, parts]) => [
      `change:${trait}`,
      trait === "stages" && !this.isRestored
        ? () => requestAnimationFrame(() => this.requestDraw(parts)) // only its colours change: the other pane is first
        : () => this.requestDraw(parts),
    ]);
    handlers.push(["change:changing", () => (this.heldAt = performance.now())]);
    for (const [name, handler] of handlers) model.on(name, handler);
    this.stop = () => {
      clearTimeout(this.refining);
      for (const [name, handler] of handlers) model.off(/** @type {"change:frame"} */ (name), handler);
    };
    this.requestDraw(["picture", "mesh"]);
  }

  /** The picture, once its own script has run. */
  get picture() {
    return this.model?.get("picture") ?? null;
  }

  /** True while the kernel is changing several things that are to be seen at once. */
  get isHeld() {
    return Boolean(this.model?.get("changing")) && performance.now() - this.heldAt < LONGEST_HOLD;
  }

  /** True while nothing but the section is to be seen, in all panes that share the picture. */
  get isBare() {
    return Boolean(this.model ? this.model.get("bare") : this.isBareAlone);
  }

  /** @param {boolean} isBare */
  showBare(isBare) {
    this.model?.set("bare", isBare);
    this.isBareAlone = isBare; // in a pane without a picture
    this.requestDraw(["bare"]);
  }

  /** @param {import("./plot_area.js").PlotArea} plotArea */
  drawPicture({ width, height, pixelRatio, model }) {
    const { picture, canvas } = this;
    if (!picture) return;
    const start = performance.now();
    const coarse = this.coarseness(picture.time, start);
    // of the present-day pane only the colours change with time: every other frame will do
    this.isSkipping = coarse > 1 && !this.isRestored && !this.isSkipping;
    if (this.isSkipping) return;
    const ratio = Math.max(pixelRatio, this.leastRatio) / coarse;
    const size = { width: Math.max(1, Math.round(width * ratio)), height: Math.max(1, Math.round(height * ratio)) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    if (this.pixels.width !== size.width || this.pixels.height !== size.height)
      this.pixels = new ImageData(size.width, size.height);
    const scene = picture.scene(this.isRestored, model.get("window"));
    this.drawScene(new Uint32Array(this.pixels.data.buffer), size, this.isBare ? withoutRatios(scene) : scene);
    canvas.getContext("2d")?.putImageData(this.pixels, 0, 0);
    const took = performance.now() - start;
    this.last = { time: picture.time, start, took: coarse > 1 ? took * SAVED : took };
  }

  /**
   * Screen pixels along the side of a picture's pixel: 1, or while time runs on a slow computer, 2. Then the picture is
   * drawn finely as soon as it stands still.
   *
   * @param {number} time
   * @param {number} now
   */
  coarseness(time, now) {
    clearTimeout(this.refining);
    const { last } = this;
    const isRunning = time !== last.time && now - last.start < SOON;
    if (!isRunning || last.took < SLOW) return 1;
    this.refining = setTimeout(() => this.requestDraw(["picture"]), SOON);
    return 2;
  }

  /**
   * Draw a scene; the section under the colours of the present-day pane is kept, since it stays the same in a drag.
   *
   * @param {Uint32Array} pixels
   * @param {{ width: number, height: number }} size
   * @param {import("../picture/scene.js").Scene} scene
   */
  drawScene(pixels, size, scene) {
    if (scene.isRestored) {
      drawSection(pixels.fill(0), size, scene);
      return;
    }
    const base = [scene.texture, scene.colours, size.width, size.height, ...scene.window];
    if (base.some((value, i) => value !== this.base[i])) {
      drawSection(pixels.fill(0), size, scene);
      this.base = base;
      this.section = pixels.slice();
    } else pixels.set(this.section);
    drawRatios(pixels, size, scene);
  }

  /** The moment that is shown, for the corner of the restored pane; empty at the end. */
  get moment() {
    const { picture } = this;
    if (!picture || !this.isRestored || picture.isAtEnd) return "";
    const step = Math.max(1, Math.ceil(picture.time));
    const share = Math.round(100 * (picture.time - step + 1));
    return picture.time ? ` · step ${step} of ${picture.chain.stages.length}, ${share}%` : " · present day";
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
   * Points of the restored section at the present time; they are sent as they are after some stage, or at the end.
   *
   * @template {[number, number] | null} Point
   * @param {Point[]} points
   * @returns {(Point | null)[]}
   */
  places(points) {
    const { picture } = this;
    const end = this.layer.get("stage") ?? picture?.chain.stages.length;
    if (!picture || !this.isRestored || picture.time === end) return points;
    return points.map((point) => {
      const placed = point && picture.placed({ x: point[0], z: point[1] }, end);
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

/** @param {import("../picture/scene.js").Scene} scene */
function withoutRatios(scene) {
  return { ...scene, deformation: { ...scene.deformation, opacity: 0 } };
}
