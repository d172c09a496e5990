// The distribution of the area ratio at a moment, for the histogram, and the colours of what is brushed.

import { Tracer } from "../picture/tracer.js";

const NODES = 60_000; // of the lattice over the present-day section at which the ratio is taken
const LEAST_SHARE = 1e-6; // of the area, above which a bar begins on a logarithmic axis
const USUAL_SPAN = 1.1;
const FADED = 0.12; // factor on the opacity outside the brush
const ALONE = 0.6; // opacity of what is brushed while the map itself is not shown

/** @typedef {import("../histogram/scale.js").Bars} Bars */
/** @typedef {Pick<Bars, "edges" | "colours" | "x" | "decimals">} Axis */
/** @typedef {{ ratio: number, area: number }} Part of the rock */

/**
 * The area ratios of the rock, present-day over its area at the picture's time, in ascending order.
 *
 * @param {import("../picture/picture.js").Picture} picture
 * @returns {Part[]}
 */
export function measure(picture) {
  const maps = picture.maps(false);
  if (!maps.length) return [{ ratio: 1, area: 1 }];
  const [rows, columns] = picture.grid.shape;
  const share = Math.min(1, Math.sqrt(NODES / (rows * columns)));
  const [width, height] = [columns, rows].map((count) => Math.max(2, Math.round(share * count)));
  const [stepX, stepZ] = [columns / width, rows / height];
  /** @type {Part[]} */
  const parts = [];
  new Tracer(maps, (_row, _column, count, _x, _z, _dx, _dz, logRatio) =>
    parts.push({ ratio: Math.exp(logRatio), area: count }),
  ).trace({ left: stepX / 2 - 0.5, top: stepZ / 2 - 0.5, stepX, stepZ, width, height });
  return parts.sort((one, other) => one.ratio - other.ratio);
}

/**
 * @param {Part[]} parts
 * @param {(part: Part) => boolean} isCounted
 */
function areaOf(parts, isCounted) {
  return parts.reduce((sum, part) => sum + (isCounted(part) ? part.area : 0), 0);
}

/**
 * The bars of the histogram; ratios beyond the axis are counted in the end bars.
 *
 * @param {Part[]} parts
 * @param {Axis} axis
 * @param {boolean} isLog true for a logarithmic axis of the shares
 * @returns {Bars}
 */
export function barsOf(parts, axis, isLog) {
  const count = axis.edges.length - 1;
  const [low, high] = [Math.log(axis.edges[0]), Math.log(axis.edges[count])];
  const shares = new Array(count).fill(0);
  const total = areaOf(parts, () => true);
  for (const { ratio, area } of parts) {
    const bar = Math.floor((count * (Math.log(ratio) - low)) / (high - low));
    shares[Math.min(Math.max(bar, 0), count - 1)] += area / total;
  }
  const least = Math.min(...shares.filter((share) => share > 0));
  const floor = isLog ? 10 ** (Math.ceil(Math.log10(Math.max(least, LEAST_SHARE))) - 1) : 0;
  return { ...axis, shares, floor, y: shareTicks(Math.max(...shares), floor) };
}

/**
 * Ticks of the shares: powers of ten from a floor above 0, or else round percentages.
 *
 * @param {number} most
 * @param {number} floor
 * @returns {[number, string][]}
 */
function shareTicks(most, floor) {
  const decades = Math.floor(Math.log10(most / (floor || most)) + 0.5) + 1;
  const step = roundStep((100 * most) / 3);
  const percents = floor
    ? Array.from({ length: decades }, (_, i) => 100 * floor * 10 ** i)
    : Array.from({ length: Math.floor((100 * most) / step + 1.5) }, (_, i) => step * i);
  return percents.map((percent) => [percent / 100, String(Number(percent.toPrecision(3)))]);
}

/** @param {number} least */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * power).find((step) => step >= least * (1 - 1e-9)) ?? least;
}

/**
 * Median and percentiles by area, and the scale.
 *
 * @param {Part[]} parts in ascending order
 * @param {number} span
 */
export function summaryOf(parts, span) {
  const total = areaOf(parts, () => true);
  const [low, median, high] = [1, 50, 99].map((percent) => percentile(parts, (percent / 100) * total).toFixed(3));
  const beyond = (100 * areaOf(parts, ({ ratio }) => ratio < 1 / span || ratio > span)) / total;
  const rest = beyond > 0 ? `, ${Number(beyond.toPrecision(2))}% of the area beyond` : "";
  const scale = `±${Number((100 * (span - 1)).toPrecision(3))}%${span === USUAL_SPAN ? "" : ", rescaled"}`;
  return `median ${median}, P1 ${low}, P99 ${high}; scale ${scale}${rest}`;
}

/**
 * The ratio below which there is some area: each lies at the middle of its own area, and between them it is linear.
 *
 * @param {Part[]} parts
 * @param {number} wanted
 */
function percentile(parts, wanted) {
  let through = 0;
  let last = { middle: 0, ratio: parts[0].ratio };
  for (const { ratio, area } of parts) {
    const middle = through + area / 2;
    if (middle >= wanted)
      return last.ratio + ((ratio - last.ratio) * (wanted - last.middle)) / (middle - last.middle || 1);
    last = { middle, ratio };
    through += area;
  }
  return last.ratio;
}

/**
 * The brushed range with its share of the area.
 *
 * @param {Part[]} parts
 * @param {Axis} axis
 * @param {number[]} brush
 */
export function brushText(parts, { edges, decimals }, brush) {
  if (!brush.length) return "";
  const [low, high] = brush;
  const [first, last] = [edges[0], edges[edges.length - 1]];
  const isInside = (/** @type {Part} */ { ratio }) => (ratio >= low || low <= first) && (ratio <= high || high >= last);
  const share = (100 * areaOf(parts, isInside)) / areaOf(parts, () => true);
  return `${low.toFixed(decimals)} to ${high.toFixed(decimals)}: ${Number(share.toPrecision(3))}% of the area`;
}

/**
 * The colours of the deformation map, in which only what is brushed is opaque; as RatioColouring.palette.
 *
 * @param {{ palette: DataView, span: number }} ratios
 * @param {number[]} brush
 * @param {boolean} isShown true while the map itself is shown
 */
export function tint({ palette, span }, brush, isShown) {
  const colours = new Uint8Array(palette.buffer.slice(palette.byteOffset, palette.byteOffset + palette.byteLength));
  if (brush.length) {
    const [low, high] = brush.map((ratio) => 128 + Math.round((127 * Math.log(ratio)) / Math.log(span)));
    for (let level = 0; level < 256; level++) {
      const isInside = level >= Math.max(low, 1) && level <= Math.min(high, 255);
      colours[4 * level + 3] = isInside ? 255 : colours[4 * level + 3] * (isShown ? FADED : 0);
    }
  }
  return { palette: new DataView(colours.buffer), span, opacity: isShown || brush.length ? ALONE : 0 };
}
