// The pointer's own cross, that of a linked pane, and the rubber band.

function drawCross(group, at, plane) {
  group.replaceChildren();
  if (!at) return;
  for (const className of ["halo", "cross"]) {
    element("line", className, group, { x1: at.x, x2: at.x, y1: 0, y2: plane.height });
    element("line", className, group, { x1: 0, x2: plane.width, y1: at.y, y2: at.y });
  }
}

function drawRubber(group, rubber, at, plane) {
  group.replaceChildren();
  if (!at || !rubber.length) return;
  const d = path([...rubber.map((point) => plane.toPixels(...point)), at]);
  for (const className of ["halo", "rubber"]) element("path", className, group, { d });
}
