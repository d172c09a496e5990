// The brush of the histogram, moved by mouse, touch and keyboard.

import { clamp } from "./scale.js";

/** A range of whole bars: it starts at the anchor and extends to the end, on either side. */
export class Brush {
  /**
   * @param {() => import("./scale.js").Scale | null} getScale null while there are no bars
   * @param {() => { brush: number[], edges: number[] }} read
   * @param {(brush: number[]) => void} write
   */
  constructor(getScale, read, write) {
    this.getScale = getScale;
    this.read = read;
    this.write = write;
    /** @type {number | null} */
    this.anchor = null;
    /** @type {number | null} */
    this.end = null;
    /** @type {number | null} */
    this.pointerId = null; // of the pointer that is down
  }

  /**
   * @param {SVGSVGElement} chart
   * @param {(event: PointerEvent) => number} xOf x of a pointer from the first bar's left side, in css pixels
   * @param {AbortSignal} signal
   */
  listenTo(chart, xOf, signal) {
    chart.addEventListener("pointerdown", (event) => this.handlePress(event, chart, xOf(event)), { signal });
    chart.addEventListener("pointermove", (event) => this.handleMove(event, xOf(event)), { signal });
    for (const name of /** @type {const} */ (["pointerup", "pointercancel"]))
      chart.addEventListener(name, (event) => this.handleRelease(event), { signal });
    chart.addEventListener("dblclick", () => this.clear(), { signal });
    chart.addEventListener("keydown", (event) => this.handleKey(event, chart), { signal });
    chart.addEventListener("blur", () => chart.classList.remove("by-pointer"), { signal });
  }

  /**
   * @param {PointerEvent} event
   * @param {SVGSVGElement} chart
   * @param {number} x
   */
  handlePress(event, chart, x) {
    const scale = this.getScale();
    if (this.pointerId !== null || event.button !== 0 || !scale) return;
    event.preventDefault();
    chart.classList.add("by-pointer"); // hides the focus ring
    chart.focus({ preventScroll: true });
    chart.setPointerCapture(event.pointerId);
    this.pointerId = event.pointerId;
    this.follow(scale);
    this.extendTo(scale.barAt(x), event.shiftKey);
  }

  /**
   * @param {PointerEvent} event
   * @param {number} x
   */
  handleMove(event, x) {
    const scale = this.getScale();
    if (event.pointerId === this.pointerId && scale) this.extendTo(scale.barAt(x), true);
  }

  /** @param {PointerEvent} event */
  handleRelease(event) {
    if (event.pointerId === this.pointerId) this.pointerId = null;
  }

  /**
   * @param {KeyboardEvent} event
   * @param {SVGSVGElement} chart
   */
  handleKey(event, chart) {
    chart.classList.remove("by-pointer");
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (this.press(event.key, event.shiftKey)) event.preventDefault();
  }

  /**
   * Handle a key; false if it has no meaning here.
   *
   * @param {string} key
   * @param {boolean} extend
   */
  press(key, extend) {
    const scale = this.getScale();
    if (!scale) return false;
    this.follow(scale);
    if (key === "Escape" && this.anchor !== null) {
      this.clear();
      return true;
    }
    const last = scale.count - 1;
    const current = this.end ?? Math.floor(last / 2);
    const step = this.end === null ? 0 : 1; // the first press shows where the brush is
    /** @type {Record<string, number>} */
    const targets = { ArrowLeft: current - step, ArrowRight: current + step, Home: 0, End: last };
    if (targets[key] === undefined) return false;
    this.extendTo(clamp(targets[key], 0, last), extend);
    return true;
  }

  /**
   * Move the end to a bar, and the anchor with it unless the brush is to be extended.
   *
   * @param {number} bar
   * @param {boolean} extend
   */
  extendTo(bar, extend) {
    this.anchor = extend ? (this.anchor ?? bar) : bar;
    this.end = bar;
    const { edges } = this.read();
    this.write([edges[Math.min(this.anchor, bar)], edges[Math.max(this.anchor, bar) + 1]]);
  }

  clear() {
    this.write([]);
  }

  /**
   * Take over a brush that was set elsewhere since it was last moved here.
   *
   * @param {import("./scale.js").Scale} scale
   */
  follow(scale) {
    const { brush } = this.read();
    if (!brush.length) {
      this.anchor = this.end = null;
      return;
    }
    const [first, last] = scale.brushedBars(brush);
    const [anchor, end] = [this.anchor ?? -1, this.end ?? -1];
    if (Math.min(anchor, end) !== first || Math.max(anchor, end) !== last) [this.anchor, this.end] = [first, last];
  }
}
