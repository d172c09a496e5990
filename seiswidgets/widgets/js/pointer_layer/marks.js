// Marks on the section: a numbered disc at a cut-off, a pin at the held point, and the keyboard's cursor.

import { append, appendText, togglePale } from "../shared/svg.js";

const PIN = "M0,0C-2,-6 -7,-9 -7,-14A7,7 0 1 1 7,-14C7,-9 2,-6 0,0Z"; // its tip is at 0,0
const CROSS = "M-18,0H-6M6,0H18M0,-18V-6M0,6V18";

/** @typedef {import("./types.js").Mark} Mark */

/** @type {Record<Mark["kind"], (group: SVGGElement, mark: Mark) => void>} */
const DRAW = {
  cutoff(group, mark) {
    const disc = append(group, "circle", "disc", { r: 8, fill: mark.colour });
    togglePale(appendText(group, "number", { y: 3.5 }, mark.text), disc, mark.colour);
  },
  held(group, mark) {
    append(group, "path", "pin", { d: PIN, fill: mark.colour });
    append(group, "circle", "eye", { cy: -14, r: 2.5 });
  },
  cursor(group, mark) {
    const halo = { className: "halo", width: 5, stroke: "white" };
    for (const { className, width, stroke } of [halo, { className: "aim", width: 2, stroke: mark.colour }]) {
      append(group, "path", className, { d: CROSS, stroke, "stroke-width": width });
      append(group, "circle", className, { r: 9, stroke, "stroke-width": width });
    }
  },
};

/**
 * @param {SVGGElement} group
 * @param {Mark[]} marks
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
export function drawMarks(group, marks, plotArea) {
  group.replaceChildren();
  for (const mark of marks) {
    const { x, y } = plotArea.toPixels(mark.x, mark.z);
    DRAW[mark.kind](append(group, "g", `mark ${mark.kind}`, { transform: `translate(${x} ${y})` }), mark);
  }
}
