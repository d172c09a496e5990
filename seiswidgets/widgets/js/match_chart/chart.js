// The drawing of the curve with its peaks and the present match, and of the profiles along the fault.

import { append, appendText, pathData } from "../shared/svg.js";
import { Scale, ticks } from "./scale.js";

/** Room around the curve for the axes, in css pixels. */
export const MARGIN = { left: 48, right: 40, top: 8, bottom: 34 };

const DECIMALS = 2;
const GAP = 10; // css pixels between two profiles
const TICK_WIDTH = 70; // css pixels for the label of a tick

/**
 * Draw the curve anew.
 *
 * @param {SVGGElement} group
 * @param {import("./scale.js").Curve} curve
 * @param {import("./scale.js").Size} size
 * @param {number | null} slip of the present match
 */
export function drawCurve(group, curve, size, slip) {
  const scale = new Scale(curve, size);
  group.replaceChildren();
  drawAxes(group, scale);
  drawDeformation(group, scale);
  const chance = scale.y(curve.chance);
  append(append(group, "line", "chance", { x1: 0, x2: size.width, y1: chance, y2: chance }), "title", "").textContent =
    `Unrelated rock reaches a correlation of ${curve.chance.toFixed(DECIMALS)}`;
  const points = curve.slip.map((one, i) => ({ x: scale.x(one), y: scale.y(curve.correlation[i]) }));
  append(group, "path", "curve", { d: pathData(points) });
  curve.peaks.forEach((peak, rank) => {
    const at = { cx: scale.x(peak.slip), cy: scale.y(scale.correlationAt(peak.slip)), r: rank === 0 ? 6 : 4 };
    const tooltip = append(append(group, "circle", rank === 0 ? "peak first" : "peak", at), "title", "");
    const share = Math.round(100 * peak.weight);
    tooltip.textContent = `${Math.round(peak.slip)} m: correlation ${peak.correlation.toFixed(DECIMALS)}, ${share}% likely`;
  });
  if (slip !== null) drawMatch(group, scale, slip);
}

/**
 * @param {SVGGElement} group
 * @param {Scale} scale
 */
function drawAxes(group, scale) {
  const { width, height } = scale;
  append(group, "line", "axis", { x1: 0, x2: width, y1: height, y2: height });
  for (const slip of ticks(scale.low, scale.high, width / TICK_WIDTH)) {
    const x = scale.x(slip);
    append(group, "line", "axis", { x1: x, x2: x, y1: height, y2: height + 4 });
    appendText(group, "middle", { x, y: height + 15 }, String(slip));
  }
  for (const correlation of [0, 0.5, 1]) {
    const y = scale.y(correlation);
    append(group, "line", "grid", { x1: 0, x2: width, y1: y, y2: y });
    appendText(group, "end", { x: -5, y: y + 4 }, String(correlation));
  }
  appendText(group, "middle", { x: width / 2, y: height + 29 }, "Slip at the middle of the fault (m)");
  const upwards = (/** @type {number} */ x) => `translate(${x} ${height / 2}) rotate(-90)`;
  appendText(group, "middle", { transform: upwards(11 - MARGIN.left) }, "Correlation");
  if (scale.curve.deformation.length)
    appendText(group, "middle faint", { transform: upwards(width + 34) }, "Strain (%)");
}

/**
 * @param {SVGGElement} group
 * @param {Scale} scale
 */
function drawDeformation(group, scale) {
  const { deformation } = scale.curve;
  if (!deformation.length) return;
  const most = Math.max(...deformation.map(([, percent]) => percent), 1e-3);
  const y = (/** @type {number} */ percent) => scale.height * (1 - percent / most);
  const points = deformation.map(([slip, percent]) => ({ x: scale.x(slip), y: y(percent) }));
  append(group, "path", "deformation", { d: pathData(points) });
  for (const percent of [0, most])
    appendText(
      group,
      "start faint",
      { x: scale.width + 4, y: y(percent) + 4 },
      Number(percent.toPrecision(2)).toString(),
    );
}

/**
 * @param {SVGGElement} group
 * @param {Scale} scale
 * @param {number} slip
 */
function drawMatch(group, scale, slip) {
  const x = scale.x(slip);
  if (!(x >= 0 && x <= scale.width)) return;
  append(group, "line", "match", { x1: x, x2: x, y1: 0, y2: scale.height });
  append(group, "path", "handle", { d: `M ${x} ${scale.height} l -6 9 h 12 z` });
}

/**
 * Draw the profiles side by side, with a common axis of z.
 *
 * @param {SVGGElement} group
 * @param {import("./scale.js").Profile} profile
 * @param {import("./scale.js").Size} size
 * @param {number[]} span first and last z that the panes show
 */
export function drawProfiles(group, profile, size, span) {
  group.replaceChildren();
  const [top, bottom] = span;
  const y = (/** @type {number} */ z) => (size.height * (z - top)) / (bottom - top);
  const width = (size.width - GAP * (profile.lines.length - 1)) / profile.lines.length;
  for (const z of ticks(top, bottom, size.height / 30)) {
    append(group, "line", "grid", { x1: 0, x2: size.width, y1: y(z), y2: y(z) });
    appendText(group, "end", { x: -5, y: y(z) + 4 }, String(z));
  }
  appendText(
    group,
    "middle",
    { transform: `translate(${11 - MARGIN.left} ${size.height / 2}) rotate(-90)` },
    profile.title,
  );
  profile.lines.forEach(({ title, values, least, most }, i) => {
    const panel = append(group, "g", "panel", { transform: `translate(${i * (width + GAP)} 0)` });
    const x = (/** @type {number} */ value) => (width * (value - least)) / (most - least);
    append(panel, "rect", "frame", { width, height: size.height });
    if (least < 0 && most > 0) append(panel, "line", "axis", { x1: x(0), x2: x(0), y1: 0, y2: size.height });
    const points = values.map((value, k) => (value === null ? null : { x: x(value), y: y(profile.z[k]) }));
    const inside = points.map((point) => (point && point.y >= 0 && point.y <= size.height ? point : null));
    append(panel, "path", "profile", { d: pathData(inside) });
    appendText(panel, "middle", { x: width / 2, y: size.height + 29 }, title);
    appendText(panel, "start", { x: 0, y: size.height + 14 }, Number(least.toPrecision(3)).toString());
    appendText(panel, "end", { x: width, y: size.height + 14 }, Number(most.toPrecision(3)).toString());
  });
}
