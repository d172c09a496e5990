// Lines on the section: each with a pale halo, dots at its vertices and a label near its start. Near cut-offs, where the
// reflectors are the evidence, they are thin and without a halo.

import { toNumbers } from "../shared/bytes.js";
import { append, appendText, pathData, togglePale } from "../shared/svg.js";
import { splitNear } from "./near.js";

const NEAR = 14; // css pixels around a cut-off
const DOT = { beyond: 0.75, halo: 1.25, distance: 10 }; // css pixels beyond a line, around a dot, between two of a line
const HALO = 1.5; // css pixels of the halo on either side of a line
const LABEL_MARGIN = 4; // css pixels between a label and the border
const LABEL_OFFSET = 9; // css pixels between a label and its vertex
const CAPITAL_HEIGHT = 10; // css pixels

/** @typedef {import("./types.js").Pixel} Pixel */
/** @typedef {import("./types.js").Stroke} Stroke */

/** What a stroke is unless it says otherwise; see USUAL in interaction/overlay.py. */
const USUAL = { dots: false, dash: [], label: "", chosen: null, joined: true };

/**
 * @param {import("./types.js").StrokeState} state
 * @returns {Stroke}
 */
export function decodeStroke({ origin, points, ...look }) {
  const offsets = toNumbers(points, Float32Array);
  const decoded = Array.from({ length: offsets.length / 2 }, (_, i) => {
    const [x, z] = [origin[0] + offsets[2 * i], origin[1] + offsets[2 * i + 1]];
    return Number.isNaN(x) ? null : /** @type {[number, number]} */ ([x, z]);
  });
  return { ...USUAL, ...look, points: decoded };
}

/**
 * @param {SVGGElement} group
 * @param {Stroke[]} strokes
 * @param {import("./plot_area.js").PlotArea} plotArea
 * @param {Pixel[]} cutoffs
 * @returns {import("./handles.js").Handle[]} the dots
 */
export function drawStrokes(group, strokes, plotArea, cutoffs) {
  group.replaceChildren();
  /** @type {import("./handles.js").Handle[]} */
  const handles = [];
  const lines = append(group, "g", "lines");
  const labels = append(group, "g", "labels"); // above all lines
  for (const stroke of strokes) {
    const pixels = stroke.points.map((point) => point && plotArea.toPixels(...point));
    const element = append(lines, "g", "stroke");
    if (stroke.joined) drawLine(element, stroke, pixels, cutoffs);
    if (stroke.dots) handles.push(...drawDots(element, stroke, pixels));
    if (stroke.label) drawLabel(labels, stroke, pixels, plotArea);
  }
  return handles;
}

/**
 * @param {SVGGElement} group
 * @param {Stroke} stroke
 * @param {(Pixel | null)[]} pixels
 * @param {Pixel[]} cutoffs
 */
function drawLine(group, { colour, width, dash }, pixels, cutoffs) {
  const { near, far } = splitNear(pixels, cutoffs, NEAR);
  const thick = { d: pathData(far), "stroke-dasharray": dash.join(" ") };
  append(group, "path", "halo", { ...thick, "stroke-width": width + 2 * HALO });
  append(group, "path", "line", { ...thick, "stroke-width": width, stroke: colour });
  const thin = pathData(near);
  if (thin) append(group, "path", "thin", { d: thin, stroke: colour });
}

/**
 * Draw dots at vertices; where these are dense, at some of them, but always at the chosen one.
 *
 * @param {SVGGElement} group
 * @param {Stroke} stroke
 * @param {(Pixel | null)[]} pixels
 * @returns {import("./handles.js").Handle[]}
 */
function drawDots(group, { colour, width, chosen }, pixels) {
  const radius = width / 2 + DOT.beyond;
  const shown = thinned(pixels, chosen ?? -1, DOT.distance);
  const d = dotData(shown);
  append(group, "path", "halo", { d, "stroke-width": 2 * (radius + DOT.halo) });
  append(group, "path", "dots", { d, "stroke-width": 2 * radius, stroke: colour });
  const selected = pixels[chosen ?? -1];
  if (selected) append(group, "circle", "chosen", { cx: selected.x, cy: selected.y, r: radius + 3, stroke: colour });
  return shown.map((pixel) => ({ ...pixel, colour }));
}

/**
 * The first point, each that lies far enough from the last one kept, and the chosen one.
 *
 * @param {(Pixel | null)[]} pixels
 * @param {number} chosen index
 * @param {number} distance
 * @returns {Pixel[]}
 */
export function thinned(pixels, chosen, distance) {
  /** @type {Pixel[]} */
  const kept = [];
  pixels.forEach((pixel, index) => {
    const last = kept.at(-1);
    const isFar = pixel && last ? Math.hypot(pixel.x - last.x, pixel.y - last.y) >= distance : true;
    if (pixel && (isFar || index === chosen)) kept.push(pixel);
  });
  return kept;
}

/**
 * The d attribute of dots: lines without length, whose round ends a browser draws all at once.
 *
 * @param {Pixel[]} pixels
 */
function dotData(pixels) {
  return pixels.map(({ x, y }) => `M${x.toFixed(2)},${y.toFixed(2)}h0`).join("");
}

/**
 * @param {SVGGElement} group
 * @param {Stroke} stroke
 * @param {(Pixel | null)[]} pixels
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
function drawLabel(group, stroke, pixels, plotArea) {
  const start = firstVisible(pixels, plotArea);
  if (!start) return;
  const label = appendText(group, "name", {}, stroke.label);
  label.style.fill = stroke.colour;
  togglePale(label, label, stroke.colour);
  const { x, y } = labelPosition(start, lengthOf(label, stroke.label), plotArea);
  label.setAttribute("x", String(x));
  label.setAttribute("y", String(y));
}

/** @type {Map<string, number>} */
const lengths = new Map(); // measuring a text makes the browser lay out the page

/**
 * The length of a label, in css pixels.
 *
 * @param {SVGTextElement} label
 * @param {string} content
 */
function lengthOf(label, content) {
  const length = lengths.get(content) ?? label.getComputedTextLength();
  if (length > 0) lengths.set(content, length);
  return length;
}

/**
 * The left end of a label's baseline: up and to the right of a point, but inside the plot area.
 *
 * @param {Pixel} point
 * @param {number} length of the label, in css pixels
 * @param {{ width: number, height: number }} plotArea
 * @returns {Pixel}
 */
export function labelPosition(point, length, { width, height }) {
  const right = Math.min(point.x + LABEL_OFFSET, width - length - LABEL_MARGIN);
  const bottom = Math.min(point.y - LABEL_OFFSET, height - LABEL_MARGIN);
  return { x: Math.max(LABEL_MARGIN, right), y: Math.max(CAPITAL_HEIGHT + LABEL_MARGIN, bottom) };
}

/**
 * The first vertex in the plot area, or else the first point where the line enters it; null if it never does.
 *
 * @param {(Pixel | null)[]} pixels
 * @param {import("./plot_area.js").PlotArea} plotArea
 * @returns {Pixel | null}
 */
export function firstVisible(pixels, plotArea) {
  const vertex = pixels.find((pixel) => pixel && plotArea.contains(pixel));
  if (vertex) return vertex;
  for (let i = 1; i < pixels.length; i++) {
    const [from, to] = [pixels[i - 1], pixels[i]];
    const entry = from && to && entryPoint(from, to, plotArea);
    if (entry) return entry;
  }
  return null;
}

/**
 * The point where a segment enters the plot area (Liang and Barsky); null if it does not.
 *
 * @param {Pixel} from
 * @param {Pixel} to
 * @param {{ width: number, height: number }} plotArea
 * @returns {Pixel | null}
 */
function entryPoint(from, to, { width, height }) {
  const sides = [
    { start: from.x, change: to.x - from.x, size: width },
    { start: from.y, change: to.y - from.y, size: height },
  ];
  let [first, last] = [0, 1]; // the share of the segment that is inside so far
  for (const { start, change, size } of sides) {
    if (change === 0) {
      if (start < 0 || start > size) return null;
      continue;
    }
    const [one, other] = [-start / change, (size - start) / change];
    [first, last] = [Math.max(first, Math.min(one, other)), Math.min(last, Math.max(one, other))];
  }
  return first <= last ? { x: from.x + first * (to.x - from.x), y: from.y + first * (to.y - from.y) } : null;
}
