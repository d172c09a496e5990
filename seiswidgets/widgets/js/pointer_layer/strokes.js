// Lines on the section: each with a pale halo, dots at its vertices and a label near its start.

import { toNumbers } from "../shared/bytes.js";
import { append, appendText, pathData, togglePale } from "../shared/svg.js";

const HALO = 1.5; // css pixels of the halo on either side of a line
const LABEL_MARGIN = 4; // css pixels between a label and the border
const LABEL_OFFSET = 9; // css pixels between a label and its vertex
const CAPITAL_HEIGHT = 10; // css pixels

/** @typedef {import("./types.js").Pixel} Pixel */
/** @typedef {import("./types.js").Stroke} Stroke */

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
  return { ...look, points: decoded };
}

/**
 * @param {SVGGElement} group
 * @param {Stroke[]} strokes
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
export function drawStrokes(group, strokes, plotArea) {
  group.replaceChildren();
  const lines = append(group, "g", "lines");
  const labels = append(group, "g", "labels"); // above all lines
  for (const stroke of strokes) {
    const pixels = stroke.points.map((point) => point && plotArea.toPixels(...point));
    drawStroke(append(lines, "g", "stroke"), stroke, pixels);
    if (stroke.label) drawLabel(labels, stroke, pixels, plotArea);
  }
}

/**
 * @param {SVGGElement} group
 * @param {Stroke} stroke
 * @param {(Pixel | null)[]} pixels
 */
function drawStroke(group, stroke, pixels) {
  const { colour, width } = stroke;
  const line = { d: stroke.joined ? pathData(pixels) : "", "stroke-dasharray": stroke.dash.join(" ") };
  const dots = { d: stroke.dots ? dotData(pixels) : "" };
  const radius = width + 1;
  append(group, "path", "halo", { ...line, "stroke-width": width + 2 * HALO });
  append(group, "path", "halo", { ...dots, "stroke-width": 2 * (radius + HALO) });
  append(group, "path", "line", { ...line, "stroke-width": width, stroke: colour });
  append(group, "path", "dots", { ...dots, "stroke-width": 2 * radius, stroke: colour });
  const chosen = pixels[stroke.chosen ?? -1];
  if (chosen) append(group, "circle", "chosen", { cx: chosen.x, cy: chosen.y, r: radius + 3, stroke: colour });
}

/**
 * The d attribute of dots: lines without length, whose round ends a browser draws all at once.
 *
 * @param {(Pixel | null)[]} pixels
 */
function dotData(pixels) {
  return pixels.map((pixel) => pixel && `M${pixel.x.toFixed(2)},${pixel.y.toFixed(2)}h0`).join("");
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
