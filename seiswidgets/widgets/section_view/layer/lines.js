// Lines on the section: each on a pale rim, with dots at its vertices and a label at its start.

const ROOM = 4; // css pixels between a label and the border
const AWAY = 9; // css pixels between a label and the vertex that it stands at
const CAPITAL = 10; // css pixels of a letter's height

function drawStrokes(group, strokes, plane) {
  group.replaceChildren();
  const lines = element("g", "lines", group);
  const labels = element("g", "labels", group); // above all lines
  for (const stroke of strokes) {
    const pixels = stroke.points.map((point) => point && plane.toPixels(...point));
    drawStroke(element("g", "stroke", lines), stroke, pixels);
    if (stroke.label) drawLabel(labels, stroke, pixels, plane);
  }
}

function drawStroke(group, stroke, pixels) {
  const { colour, width } = stroke;
  const line = { d: path(pixels), "stroke-dasharray": stroke.dash.join(" ") };
  const dots = { d: stroke.dots ? dotted(pixels) : "" };
  const radius = width + 1;
  element("path", "halo", group, { ...line, "stroke-width": width + 2 * RIM });
  element("path", "halo", group, { ...dots, "stroke-width": 2 * (radius + RIM) });
  element("path", "line", group, { ...line, "stroke-width": width, stroke: colour });
  element("path", "dots", group, { ...dots, "stroke-width": 2 * radius, stroke: colour });
  const chosen = pixels[stroke.chosen ?? -1];
  if (chosen) element("circle", "chosen", group, { cx: chosen.x, cy: chosen.y, r: radius + 3, stroke: colour });
}

// The d of dots: lines of no length, whose round ends a browser draws all at once.
function dotted(pixels) {
  return pixels.map((at) => at && `M${at.x.toFixed(2)},${at.y.toFixed(2)}h0`).join("");
}

function drawLabel(group, stroke, pixels, plane) {
  const start = firstSeen(pixels, plane);
  if (!start) return;
  const label = text("name", group, {}, stroke.label);
  label.style.fill = stroke.colour;
  markPale(label, label);
  const length = label.getComputedTextLength();
  const within = (low, value, high) => Math.max(low, Math.min(value, high));
  label.setAttribute("x", within(ROOM, start.x + AWAY, plane.width - length - ROOM));
  label.setAttribute("y", within(CAPITAL + ROOM, start.y - AWAY, plane.height - ROOM));
}

// The first vertex in the plot area; else the first place where the line passes through it.
function firstSeen(pixels, plane) {
  const vertex = pixels.find((at) => at && plane.holds(at));
  if (vertex) return vertex;
  for (let i = 1; i < pixels.length; i++) {
    const entry = pixels[i - 1] && pixels[i] && entered(pixels[i - 1], pixels[i], plane);
    if (entry) return entry;
  }
  return null;
}

// Where a segment enters the plot area (Liang and Barsky); null if it does not.
function entered(from, to, plane) {
  let [first, last] = [0, 1];
  for (const [axis, size] of [["x", plane.width], ["y", plane.height]]) {
    const way = to[axis] - from[axis];
    if (way === 0 && (from[axis] < 0 || from[axis] > size)) return null;
    const [near, far] = [-from[axis] / way, (size - from[axis]) / way];
    if (way !== 0) [first, last] = [Math.max(first, Math.min(near, far)), Math.min(last, Math.max(near, far))];
  }
  return first <= last ? { x: from.x + first * (to.x - from.x), y: from.y + first * (to.y - from.y) } : null;
}
