// Painting of runs of pixels: amplitudes in colours, and area ratios over them.

import { NO_DATA } from "./texture.js";

const FULL = 256;
const OPAQUE = 0xff000000;

/** @typedef {import("./texture.js").Texture} Texture */

/**
 * @typedef {object} Colours
 * @property {Uint8Array} palette red, green, blue and alpha of the 256 levels; level 0 is no data
 * @property {number} factor levels per unit of the texture
 */

/**
 * @typedef {object} Deformation
 * @property {Uint8Array} palette
 * @property {number} span the area ratio at which the colours end
 * @property {number} opacity 0 to 1
 */

/** Paints pixels of a picture: red, green, blue and alpha as one number each, as ImageData has them. */
export class Painter {
  /**
   * @param {Uint32Array} pixels
   * @param {number} width
   * @param {Texture} texture
   * @param {Colours} colours
   * @param {Deformation} deformation
   */
  constructor(pixels, width, texture, colours, deformation) {
    this.pixels = pixels;
    this.width = width;
    this.texture = texture;
    this.factor = colours.factor;
    this.colours = new Uint32Array(colours.palette.buffer, colours.palette.byteOffset, 256);
    this.tints = tints(deformation);
    this.levelsPerLog = 127 / Math.log(deformation.span);
    this.sample = texture.hasGaps ? this.sampleBesideGaps : this.sampleWhole;
  }

  /**
   * Paint a run of pixels from samples on a straight line.
   *
   * @param {number} row
   * @param {number} column
   * @param {number} count
   * @param {number} x in samples of the section
   * @param {number} z
   * @param {number} dx
   * @param {number} dz
   */
  paint(row, column, count, x, z, dx, dz) {
    const { stepX, stepZ } = this.texture;
    const [u, v] = [(x + 0.5) / stepX - 0.5, (z + 0.5) / stepZ - 0.5];
    this.sample(row * this.width + column, count, u, v, dx / stepX, dz / stepZ);
  }

  /**
   * @param {number} start
   * @param {number} count
   * @param {number} u
   * @param {number} v
   * @param {number} du
   * @param {number} dv
   */
  sampleWhole(start, count, u, v, du, dv) {
    const { pixels, colours, factor } = this;
    const { data, width, height } = this.texture;
    const [lastX, lastZ] = [width - 1, height - 1];
    for (let i = 0; i < count; i++) {
      const x = Math.min(Math.max(u + i * du, 0), lastX);
      const z = Math.min(Math.max(v + i * dv, 0), lastZ);
      const left = x | 0;
      const above = z | 0;
      const at = above * width + left;
      const right = left < lastX ? 1 : 0;
      const below = above < lastZ ? width : 0;
      const upper = data[at] + (x - left) * (data[at + right] - data[at]);
      const lower = data[at + below] + (x - left) * (data[at + below + right] - data[at + below]);
      const level = 128.5 + factor * (upper + (z - above) * (lower - upper));
      pixels[start + i] = colours[Math.min(Math.max(level, 1), 255) | 0];
    }
  }

  /**
   * As `sampleWhole`, from the samples that have data, if these make up half of the weight.
   *
   * @param {number} start
   * @param {number} count
   * @param {number} u
   * @param {number} v
   * @param {number} du
   * @param {number} dv
   */
  sampleBesideGaps(start, count, u, v, du, dv) {
    const { pixels, colours, factor, texture } = this;
    for (let i = 0; i < count; i++) {
      const value = meanOfData(texture, u + i * du, v + i * dv);
      const level = 128.5 + factor * value;
      pixels[start + i] = colours[value === NO_DATA ? 0 : Math.min(Math.max(level, 1), 255) | 0];
    }
  }

  /**
   * Lay the colour of an area ratio over a run of pixels.
   *
   * @param {number} row
   * @param {number} column
   * @param {number} count
   * @param {number} logRatio
   */
  tint(row, column, count, logRatio) {
    const { pixels } = this;
    const level = 128 + Math.round(Math.max(-127, Math.min(logRatio * this.levelsPerLog, 127)));
    const colour = this.tints.colours[level];
    const rest = this.tints.rests[level];
    if (rest === FULL) return;
    const start = row * this.width + column;
    for (let i = start; i < start + count; i++) {
      const under = pixels[i];
      if (under >>> 24 === 0) continue; // no data
      const redBlue = (Math.imul(under & 0xff00ff, rest) >>> 8) & 0xff00ff;
      const green = (Math.imul(under & 0xff00, rest) >>> 8) & 0xff00;
      pixels[i] = ((redBlue | green) + colour) | OPAQUE;
    }
  }
}

/**
 * The colour that each level adds to a pixel, and the share of 256 that it leaves of the pixel's own.
 *
 * @param {Deformation} deformation
 */
function tints({ palette, opacity }) {
  const colours = new Uint32Array(256);
  const rests = new Uint16Array(256);
  for (let level = 0; level < 256; level++) {
    const [red, green, blue, opaque] = palette.subarray(4 * level, 4 * level + 4);
    const alpha = (opaque / 255) * opacity;
    rests[level] = Math.round(FULL * (1 - alpha));
    colours[level] = (alpha * red) | ((alpha * green) << 8) | ((alpha * blue) << 16);
  }
  return { colours, rests };
}

/**
 * The amplitude between samples, of those that have data; NO_DATA if these have less than half of the weight.
 *
 * @param {Texture} texture
 * @param {number} u
 * @param {number} v
 */
function meanOfData({ data, width, height }, u, v) {
  const x = Math.min(Math.max(u, 0), width - 1);
  const z = Math.min(Math.max(v, 0), height - 1);
  const [left, above] = [x | 0, z | 0];
  const [right, below] = [Math.min(left + 1, width - 1), Math.min(above + 1, height - 1)];
  let [sum, share] = [0, 0];
  for (const [column, weightX] of [
    [left, 1 - x + left],
    [right, x - left],
  ]) {
    for (const [row, weightZ] of [
      [above, 1 - z + above],
      [below, z - above],
    ]) {
      const value = data[row * width + column];
      if (value === NO_DATA) continue;
      sum += weightX * weightZ * value;
      share += weightX * weightZ;
    }
  }
  return share < 0.5 ? NO_DATA : sum / share;
}
