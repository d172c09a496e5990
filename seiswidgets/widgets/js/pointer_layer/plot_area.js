// Coordinates in the plot area. The kernel may know another size of it than this view has: it sends and receives
// positions in its own pixels.

import { unscaledPosition, unscaledSize } from "../shared/unscaled.js";

const MOST_ENLARGED = 4; // times, beyond which the picture may be coarse

/** @typedef {import("./types.js").Pixel} Pixel */

/** The plot area of one view, with conversions between section, css pixels and the kernel's pixels. */
export class PlotArea {
  /**
   * @param {Pick<import("./types.js").Model, "get">} model
   * @param {Element} plot
   */
  constructor(model, plot) {
    this.model = model;
    this.plot = plot;
    this.width = 0;
    this.height = 0;
    this.pixelRatio = 1; // when it was measured
  }

  /** Read the present size, before any scaling of the page; false if the plot area is not shown. */
  measure() {
    const { width, height } = unscaledSize(this.plot);
    if (!(width >= 1 && height >= 1)) return false;
    [this.width, this.height] = [width, height];
    this.pixelRatio = this.presentPixelRatio;
    return true;
  }

  get isReady() {
    return this.width > 0 && this.model.get("window").length === 4;
  }

  /**
   * @param {number} x
   * @param {number} z
   * @returns {Pixel}
   */
  toPixels(x, z) {
    const [left, right, top, bottom] = this.model.get("window");
    return { x: ((x - left) / (right - left)) * this.width, y: ((z - top) / (bottom - top)) * this.height };
  }

  /**
   * @param {Pixel} point
   * @returns {import("./types.js").SectionPoint}
   */
  toSection(point) {
    const [left, right, top, bottom] = this.model.get("window");
    return { x: left + (point.x / this.width) * (right - left), z: top + (point.y / this.height) * (bottom - top) };
  }

  /** The kernel's pixels per css pixel, along x and along y. */
  get kernelScale() {
    const [width, height] = this.model.get("size");
    return width && this.width ? { x: width / this.width, y: height / this.height } : { x: 1, y: 1 };
  }

  /**
   * @param {Pixel} point
   * @returns {Pixel}
   */
  toKernel(point) {
    const scale = this.kernelScale;
    return { x: point.x * scale.x, y: point.y * scale.y };
  }

  /** @param {Pixel} point */
  contains(point) {
    return point.x >= 0 && point.x <= this.width && point.y >= 0 && point.y <= this.height;
  }

  /**
   * The position of a mouse or finger.
   *
   * @param {MouseEvent} event
   * @returns {Pixel}
   */
  pointerPosition(event) {
    return unscaledPosition(event, this.plot, this);
  }

  /** Device pixels per css pixel, to three decimals; more on a page that is enlarged. To ask for it takes long. */
  get presentPixelRatio() {
    const enlarged = Math.min(MOST_ENLARGED, this.plot.getBoundingClientRect().width / this.width || 1);
    return Number(((globalThis.devicePixelRatio || 1) * enlarged).toFixed(3));
  }
}
