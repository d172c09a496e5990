// Marks on the section: a numbered disc at a cut-off, a pin at the held point, the cross of the keyboard's cursor.

const PIN = "M0,0C-2,-6 -7,-9 -7,-14A7,7 0 1 1 7,-14C7,-9 2,-6 0,0Z"; // its tip is at 0,0
const CROSS = "M-18,0H-6M6,0H18M0,-18V-6M0,6V18";

const MARKS = {
  cutoff(group, mark) {
    const disc = element("circle", "disc", group, { r: 8, fill: mark.colour });
    markPale(text("number", group, { y: 3.5 }, mark.text), disc);
  },
  held(group, mark) {
    element("path", "pin", group, { d: PIN, fill: mark.colour });
    element("circle", "eye", group, { cy: -14, r: 2.5 });
  },
  cursor(group, mark) {
    for (const [className, width, stroke] of [["halo", 5, "white"], ["aim", 2, mark.colour]]) {
      element("path", className, group, { d: CROSS, stroke, "stroke-width": width });
      element("circle", className, group, { r: 9, stroke, "stroke-width": width });
    }
  },
};

function drawMarks(group, marks, plane) {
  group.replaceChildren();
  for (const mark of marks) {
    const at = plane.toPixels(mark.x, mark.z);
    MARKS[mark.kind](element("g", `mark ${mark.kind}`, group, { transform: `translate(${at.x} ${at.y})` }), mark);
  }
}
