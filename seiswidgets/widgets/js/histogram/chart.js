// The drawing of the histogram: axes, bars, brush and mark.

import { append, appendText } from "../shared/svg.js";
import { Scale } from "./scale.js";

/** Room around the bars for the axes, in css pixels. */
export const MARGIN = { left: 46, right: 22, top: 4, bottom: 38 };

const WIDE = 400; // css pixels from which the whole title fits
const TITLE = "Area ratio (–): > 1, restoring compressed";
const WIDE_TITLE = "Area, present-day / restored (–): > 1, restoring compressed";

/**
 * Draw the histogram anew.
 *
 * @param {SVGGElement} group
 * @param {import("./scale.js").Bars} bars
 * @param {import("./scale.js").Size} size
 * @param {number[]} brush
 * @param {number | null} mark
 */
export function drawChart(group, bars, size, brush, mark) {
  const scale = new Scale(bars, size);
  group.replaceChildren();
  drawAxes(group, bars, scale);
  if (brush.length) drawBrush(group, brush, scale); // behind the bars, whose colours match the map's
  drawBars(group, bars, scale, brush);
  if (mark !== null) drawMark(group, bars, scale, scale.barOf(mark));
}

/**
 * @param {SVGGElement} group
 * @param {import("./scale.js").Bars} bars
 * @param {Scale} scale
 */
function drawAxes(group, bars, scale) {
  const { width, height } = scale;
  append(group, "line", "axis", { x1: 0, x2: width, y1: height, y2: height });
  for (const [ratio, label] of bars.x) {
    const x = scale.x(ratio);
    append(group, "line", "axis", { x1: x, x2: x, y1: height, y2: height + 4 });
    appendText(group, "middle", { x, y: height + 15 }, label);
  }
  for (const [share, label] of bars.y.filter(([share]) => share <= scale.highest)) {
    const y = scale.y(share);
    append(group, "line", "grid", { x1: 0, x2: width, y1: y, y2: y });
    appendText(group, "end", { x: -5, y: y + 4 }, label);
  }
  appendText(group, "middle", { x: width / 2, y: height + 32 }, width < WIDE ? TITLE : WIDE_TITLE);
  const upwards = `translate(${12 - MARGIN.left} ${height / 2}) rotate(-90)`;
  appendText(group, "middle", { transform: upwards }, "Share of the area (%)");
}

/**
 * @param {SVGGElement} group
 * @param {import("./scale.js").Bars} bars
 * @param {Scale} scale
 * @param {number[]} brush
 */
function drawBars(group, bars, scale, brush) {
  const [first, last] = brush.length ? scale.brushedBars(brush) : [0, scale.count];
  bars.shares.forEach((share, i) => {
    const column = { x: i * scale.barWidth, width: scale.barWidth };
    const y = scale.y(share);
    const look = { ...column, y, height: scale.height - y, fill: bars.colours[i] };
    append(group, "rect", i < first || i > last ? "bar faded" : "bar", look);
    const [low, high] = [bars.edges[i], bars.edges[i + 1]].map((edge) => edge.toFixed(bars.decimals));
    const tooltip = append(append(group, "rect", "column", { ...column, y: 0, height: scale.height }), "title", "");
    tooltip.textContent = `${low} to ${high}: ${Number((100 * share).toPrecision(3))}% of the area`;
  });
}

/**
 * @param {SVGGElement} group
 * @param {number[]} brush
 * @param {Scale} scale
 */
function drawBrush(group, brush, scale) {
  const [left, right] = brush.map((ratio) => scale.x(ratio));
  append(group, "rect", "brush", { x: left, y: 0, width: Math.max(1, right - left), height: scale.height });
}

/**
 * @param {SVGGElement} group
 * @param {import("./scale.js").Bars} bars
 * @param {Scale} scale
 * @param {number} bar
 */
function drawMark(group, bars, scale, bar) {
  const [x, y, width] = [bar * scale.barWidth, scale.y(bars.shares[bar]), scale.barWidth];
  append(group, "rect", "mark", { x, y, width, height: scale.height - y, "data-bar": bar });
  append(group, "path", "pointer", { d: `M ${x + width / 2} ${y - 2} l -5 -7 h 10 z` });
}
