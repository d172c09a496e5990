// Marks on the section: a disc at a cut-off, whose number shows while the pointer is near, a pin at the held point, the
// keyboard's cursor, and flags of findings, which can be clicked.

import { append } from "../shared/svg.js";

const PIN = "M0,0C-2,-6 -7,-9 -7,-14A7,7 0 1 1 7,-14C7,-9 2,-6 0,0Z"; // its tip is at 0,0
const FLAG = 14; // css pixels from a finding's point up to its icon
const CROSS = "M-18,0H-6M6,0H18M0,-18V-6M0,6V18";

/** @typedef {import("./types.js").Mark} Mark */

/** @type {Record<Mark["kind"], (group: SVGGElement, mark: Mark, y: number) => void>} */
const DRAW = {
  cutoff(group, mark) {
    append(group, "circle", "disc", { r: 3.5, fill: mark.colour });
  },
  held(group, mark) {
    append(group, "path", "pin", { d: PIN, fill: mark.colour });
    append(group, "circle", "eye", { cy: -14, r: 2.5 });
  },
  finding(group, mark, y) {
    const isUp = y > FLAG + 18; // else it would not be seen
    append(group, "path", "mast", { d: `M0,0V${isUp ? -FLAG : FLAG}`, stroke: mark.colour });
    const flag = append(group, "g", "flag", { transform: `translate(-8 ${isUp ? -FLAG - 14 : FLAG - 2})` });
    append(flag, "circle", "ground", { cx: 8, cy: 8, r: 10 });
    append(flag, "path", "icon", { d: mark.path ?? "", stroke: mark.colour });
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
 * Let a flag be clicked, by mouse, finger and keyboard; none of that is a gesture on the section below it.
 *
 * @param {SVGGElement} flag
 * @param {string} text
 * @param {() => void} open
 */
function makeButton(flag, text, open) {
  for (const [name, value] of Object.entries({ role: "button", tabindex: "0", "aria-label": text }))
    flag.setAttribute(name, value);
  append(flag, "title", "").textContent = text;
  for (const type of ["pointerdown", "dblclick"]) flag.addEventListener(type, (event) => event.stopPropagation());
  flag.addEventListener("click", open);
  flag.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    event.stopPropagation();
    open();
  });
}

/**
 * @param {SVGGElement} group
 * @param {Mark[]} marks
 * @param {import("./plot_area.js").PlotArea} plotArea
 * @param {(index: number) => void} open called with the index of a flag that is clicked
 */
export function drawMarks(group, marks, plotArea, open) {
  group.replaceChildren();
  let flags = 0;
  for (const mark of marks) {
    const { x, y } = plotArea.toPixels(mark.x, mark.z);
    const element = append(group, "g", `mark ${mark.kind}`, { transform: `translate(${x} ${y})` });
    DRAW[mark.kind](element, mark, y);
    if (mark.kind !== "finding") continue;
    const index = flags++;
    makeButton(element, mark.text ?? "", () => open(index));
  }
}
