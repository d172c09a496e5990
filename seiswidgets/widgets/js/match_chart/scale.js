// Positions on the curve of correlation against slip, and on the profiles along the fault.

/**
 * @typedef {object} Peak
 * @property {number} slip
 * @property {number} correlation
 * @property {number} weight relative likelihood, 0 to 1
 */

/**
 * @typedef {object} Curve
 * @property {number[]} slip in increasing order
 * @property {number[]} correlation
 * @property {Peak[]} peaks the likeliest first
 * @property {[number, number][]} deformation slip and mean change of the area, in percent
 * @property {number} chance correlation that unrelated rock reaches
 * @property {number} step by which an arrow key changes the slip
 */

/**
 * @typedef {object} Profile
 * @property {number[]} z
 * @property {{ title: string, values: (number | null)[], least: number, most: number }[]} lines
 * @property {string} title of the axis of z
 */

/** @typedef {{ width: number, height: number }} Size in css pixels */

const NEAR = 8; // css pixels within which a slip is drawn to a peak

/**
 * @param {number} value
 * @param {number} low
 * @param {number} high
 */
export function clamp(value, low, high) {
  return Math.min(high, Math.max(low, value));
}

/** Conversions between slip, correlation and css pixels. */
export class Scale {
  /**
   * @param {Curve} curve
   * @param {Size} size
   */
  constructor(curve, { width, height }) {
    this.curve = curve;
    this.width = width;
    this.height = height;
    this.low = curve.slip[0];
    this.high = curve.slip[curve.slip.length - 1];
    this.bottom = Math.min(0, ...curve.correlation);
  }

  /** @param {number} slip */
  x(slip) {
    return (this.width * (slip - this.low)) / (this.high - this.low);
  }

  /** @param {number} correlation */
  y(correlation) {
    return this.height * (1 - (correlation - this.bottom) / (1 - this.bottom));
  }

  /**
   * The slip at a position, or that of a peak beside it.
   *
   * @param {number} x
   * @param {boolean} isFree whether peaks do not attract
   */
  slipAt(x, isFree) {
    const distance = (/** @type {Peak} */ peak) => Math.abs(this.x(peak.slip) - x);
    const [nearest] = this.curve.peaks
      .filter((peak) => distance(peak) <= NEAR)
      .sort((a, b) => distance(a) - distance(b));
    if (nearest && !isFree) return nearest.slip;
    return clamp(this.low + (x / this.width) * (this.high - this.low), this.low, this.high);
  }

  /**
   * The correlation for a slip.
   *
   * @param {number} slip
   */
  correlationAt(slip) {
    const { slip: slips, correlation } = this.curve;
    const found = slips.findIndex((other) => other >= slip);
    const after = found < 0 ? slips.length - 1 : Math.max(found, 1);
    const share = clamp((slip - slips[after - 1]) / (slips[after] - slips[after - 1]), 0, 1);
    return correlation[after - 1] + share * (correlation[after] - correlation[after - 1]);
  }

  /**
   * The slip that a key leads to; null if it has no meaning here.
   *
   * @param {string} key
   * @param {boolean} isFast
   * @param {number} slip
   */
  slipByKey(key, isFast, slip) {
    const step = this.curve.step * (isFast ? 10 : 1);
    const sorted = this.curve.peaks.map((peak) => peak.slip).sort((a, b) => a - b);
    const apart = this.curve.step / 100;
    /** @type {Record<string, number | undefined>} */
    const targets = {
      ArrowLeft: slip - step,
      ArrowDown: slip - step,
      ArrowRight: slip + step,
      ArrowUp: slip + step,
      PageDown: sorted.filter((peak) => peak < slip - apart).pop(),
      PageUp: sorted.find((peak) => peak > slip + apart),
      Home: this.low,
      End: this.high,
      Enter: this.curve.peaks[0]?.slip,
    };
    const target = targets[key];
    return target === undefined ? null : clamp(target, this.low, this.high);
  }
}

/**
 * Round numbers in a range, no more than `most`.
 *
 * @param {number} low
 * @param {number} high
 * @param {number} most
 */
export function ticks(low, high, most) {
  const rough = (high - low) / Math.max(most, 1);
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = decade * ([1, 2, 5, 10].find((factor) => factor * decade >= rough) ?? 10);
  const found = [];
  for (let tick = Math.ceil(low / step - 1e-9) * step; tick <= high + 1e-9 * step; tick += step)
    found.push(Number(tick.toPrecision(12)));
  return found;
}
