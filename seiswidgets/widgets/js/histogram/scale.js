// Positions on the histogram. Bars are equally wide, since their edges are equally spaced in the logarithm.

const HEADROOM = 1.12; // height of the axis over that of the highest bar, for the mark above it

/**
 * @typedef {object} Bars
 * @property {number[]} edges area ratios between the bars, one more than there are bars
 * @property {number[]} shares of the area, 0 to 1
 * @property {string[]} colours
 * @property {[number, string][]} x ticks with their labels
 * @property {[number, string][]} y
 * @property {number} decimals that tell one edge from the next
 * @property {number} floor lowest share of a logarithmic axis; 0 for a linear one
 */

/** @typedef {{ width: number, height: number }} Size of the bars, in css pixels */

/**
 * @param {number} value
 * @param {number} low
 * @param {number} high
 */
export function clamp(value, low, high) {
  return Math.min(high, Math.max(low, value));
}

/** Conversions between area ratios, shares, bars and css pixels. */
export class Scale {
  /**
   * @param {Bars} bars
   * @param {Size} size
   */
  constructor({ edges, shares, floor }, { width, height }) {
    this.count = shares.length;
    this.width = width;
    this.height = height;
    this.low = Math.log(edges[0]);
    this.high = Math.log(edges[this.count]);
    this.floor = floor;
    const highest = Math.max(...shares);
    this.highest = floor ? highest * (highest / floor) ** (HEADROOM - 1) : HEADROOM * highest;
  }

  get barWidth() {
    return this.width / this.count;
  }

  /**
   * An area ratio as a fractional bar index, within the axis.
   *
   * @param {number} ratio
   */
  position(ratio) {
    return clamp((this.count * (Math.log(ratio) - this.low)) / (this.high - this.low), 0, this.count);
  }

  /** @param {number} ratio */
  x(ratio) {
    return this.position(ratio) * this.barWidth;
  }

  /** @param {number} share */
  y(share) {
    const { floor, highest } = this;
    if (!floor) return this.height * (1 - share / highest);
    return this.height * (1 - Math.max(0, Math.log(share / floor)) / Math.log(highest / floor));
  }

  /** @param {number} x */
  barAt(x) {
    return clamp(Math.floor(x / this.barWidth), 0, this.count - 1);
  }

  /** @param {number} ratio */
  barOf(ratio) {
    return Math.min(Math.floor(this.position(ratio)), this.count - 1);
  }

  /**
   * The first and last bar whose centre is brushed, or the nearest bar if the brush holds no centre.
   *
   * @param {number[]} brush
   * @returns {[number, number]}
   */
  brushedBars([from, to]) {
    const first = Math.min(Math.round(this.position(from)), this.count - 1);
    return [first, Math.max(first, Math.round(this.position(to)) - 1)];
  }
}
