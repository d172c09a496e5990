// The cross at the pointer, that of a linked pane, and the rubber band.

import { append, pathData } from "../shared/svg.js";

/** @typedef {import("./types.js").Pixel} Pixel */

/**
 * @param {SVGGElement} group
 * @param {Pixel | null} pointer
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
export function drawCross(group, pointer, { width, height }) {
  group.replaceChildren();
  if (!pointer) return;
  for (const className of ["halo", "cross"]) {
    append(group, "line", className, { x1: pointer.x, x2: pointer.x, y1: 0, y2: height });
    append(group, "line", className, { x1: 0, x2: width, y1: pointer.y, y2: pointer.y });
  }
}

/**
 * @param {SVGGElement} group
 * @param {[number, number][]} rubber
 * @param {Pixel | null} pointer
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
export function drawRubberBand(group, rubber, pointer, plotArea) {
  group.replaceChildren();
  if (!pointer || !rubber.length) return;
  const d = pathData([...rubber.map((point) => plotArea.toPixels(...point)), pointer]);
  for (const className of ["halo", "rubber"]) append(group, "path", className, { d });
}
