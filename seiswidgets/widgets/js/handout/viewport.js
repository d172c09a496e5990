// The window of a section that panes show, zoomed and panned as by interaction/viewport.py, and its axes.

const FEWEST = 4; // traces and samples across the window at the closest zoom
const FARTHEST = 2; // times the whole, in the direction that fills the pane more, at the farthest zoom
const TICK_DISTANCE = [95, 45]; // approximate, in css pixels, along x and z

/** @typedef {[number, number, number, number]} Window left, right, top and bottom, in the section's units */
/** @typedef {{ x: number, y: number }} Pixel */
/** @typedef {[number, number]} Pair of x and z */

/**
 * @typedef {object} Limits
 * @property {Window} whole the window of a fitted view
 * @property {Pair} sample distance between traces, and between samples
 * @property {Pair} metres of rock in a trace and in a sample
 */

/** A window in a pane of some size; methods return a new one. */
export class Viewport {
  /**
   * @param {Limits} limits
   * @param {{ width: number, height: number }} size in css pixels
   * @param {Window} [window]
   */
  constructor(limits, size, window = limits.whole) {
    this.limits = limits;
    this.size = size;
    this.window = window;
  }

  get isFitted() {
    return this.window === this.limits.whole;
  }

  fitted() {
    return new Viewport(this.limits, this.size);
  }

  /** @param {{ width: number, height: number }} size */
  resized(size) {
    return new Viewport(this.limits, size, this.window);
  }

  /** Vertical exaggeration of the rock as drawn. */
  get exaggeration() {
    const { metres, sample } = this.limits;
    const [x, z] = spans(this.window).map((span, axis) => (span * metres[axis]) / sample[axis]);
    return this.size.height / z / (this.size.width / x);
  }

  /**
   * Zoom in by a factor about a css pixel; the window keeps a few samples across, and always touches the whole.
   *
   * @param {number} factor
   * @param {Pixel} [at] by default the centre
   */
  zoomed(factor, at = { x: this.size.width / 2, y: this.size.height / 2 }) {
    const { whole, sample } = this.limits;
    const shown = spans(this.window);
    const closest = Math.min(...shown.map((span, axis) => span / (FEWEST * sample[axis])));
    const farthest = Math.min(...shown.map((span, axis) => span / (FARTHEST * spans(whole)[axis])));
    const applied = Math.min(Math.max(factor, Math.min(1, farthest)), Math.max(1, closest));
    const shares = [at.x / this.size.width, at.y / this.size.height];
    return this.along((low, high, axis) => {
      const centre = low + shares[axis] * (high - low);
      const [from, to] = [centre + (low - centre) / applied, centre + (high - centre) / applied];
      const shift = Math.max(0, whole[2 * axis] - to) - Math.max(0, from - whole[2 * axis + 1]);
      return [from + shift, to + shift];
    });
  }

  /**
   * Move the picture right and down by css pixels; its middle stays on the whole.
   *
   * @param {number} right
   * @param {number} down
   */
  panned(right, down) {
    const { whole } = this.limits;
    const shares = [right / this.size.width, down / this.size.height];
    return this.along((low, high, axis) => {
      const middle = (low + high) / 2;
      const [least, most] = [Math.min(whole[2 * axis], middle), Math.max(whole[2 * axis + 1], middle)];
      const shift = Math.min(Math.max(middle - shares[axis] * (high - low), least), most) - middle;
      return [low + shift, high + shift];
    });
  }

  /** @param {(low: number, high: number, axis: number) => [number, number]} change of the window along an axis */
  along(change) {
    const [left, right, top, bottom] = this.window;
    return new Viewport(this.limits, this.size, [...change(left, right, 0), ...change(top, bottom, 1)]);
  }

  /**
   * What a pointer layer draws: ticks with labels, and the vertical exaggeration.
   *
   * @param {[string, string]} titles
   * @param {number} left css pixels left of the plot area
   * @returns {import("../pointer_layer/types.js").Axes}
   */
  axes(titles, left) {
    const { exaggeration } = this;
    const isTrue = Math.abs(exaggeration - 1) < 0.005;
    const [x, z] = titles.map((title, axis) => {
      const [low, high] = this.window.slice(2 * axis, 2 * axis + 2);
      const length = axis ? this.size.height : this.size.width;
      const { ticks, decimals } = roundTicks(low, high, ((high - low) * TICK_DISTANCE[axis]) / length);
      const pixels = ticks.map((tick) => ((tick - low) * length) / (high - low));
      return { title, pixels, labels: ticks.map((tick) => tick.toFixed(decimals)) };
    });
    return { x, z, left, note: isTrue ? "true proportions" : `V.E. ${Number(exaggeration.toPrecision(3))}×` };
  }
}

/** @param {Window} window */
function spans([left, right, top, bottom]) {
  return [right - left, bottom - top];
}

/**
 * Multiples of 1, 2 or 5 times a power of ten from `low` to `high`, at least `least` apart unless two must fit.
 *
 * @param {number} low
 * @param {number} high
 * @param {number} least
 */
export function roundTicks(low, high, least) {
  const wanted = Math.min(least, (high - low) / 2);
  const power = Math.floor(Math.log10(wanted));
  const steps = [-1, 0, 1].flatMap((more) => [1, 2, 5].map((digit) => ({ digit, exponent: power + more })));
  const sized = steps.map(({ digit, exponent }) => ({ step: Number(`${digit}e${exponent}`), exponent }));
  const largest = sized.filter(({ step }) => step <= (high - low) / 2).at(-1) ?? sized[0];
  const { step, exponent } = wanted < least ? largest : (sized.find((one) => one.step >= least) ?? largest);
  const [first, last] = [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
  const decimals = Math.max(0, -exponent);
  const ticks = Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toFixed(decimals)) + 0);
  return { ticks, decimals };
}
