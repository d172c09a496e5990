// The frame of the plot area, with ticks, labels and titles.

import { append, appendText } from "../shared/svg.js";

/**
 * @param {SVGGElement} group
 * @param {Partial<import("./types.js").Axes>} axes
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
export function drawAxes(group, axes, plotArea) {
  group.replaceChildren();
  if (!axes.x || !axes.z || axes.left === undefined) return;
  const { width, height, kernelScale } = plotArea;
  const { x: across, z: down } = axes;
  append(group, "rect", "frame", { x: 0, y: 0, width, height });
  across.pixels.forEach((pixel, i) => {
    const x = pixel / kernelScale.x;
    append(group, "line", "tick", { x1: x, x2: x, y1: height, y2: height + 5 });
    appendText(group, "label middle", { x, y: height + 17 }, across.labels[i]);
  });
  down.pixels.forEach((pixel, i) => {
    const y = pixel / kernelScale.y;
    append(group, "line", "tick", { x1: -5, x2: 0, y1: y, y2: y });
    appendText(group, "label end", { x: -8, y: y + 4 }, down.labels[i]);
  });
  appendText(group, "title middle", { x: width / 2, y: height + 35 }, across.title);
  const upwards = `translate(${-axes.left + 13} ${height / 2}) rotate(-90)`;
  appendText(group, "title middle", { transform: upwards }, down.title);
}
