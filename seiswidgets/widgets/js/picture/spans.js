// The pixels of triangles, row by row. The result agrees with triangles_at_grid in core/mapping.py: where triangles
// overlap, the last wins.

const TOLERANCE = 1e-5; // pixels; that of core/point_location.py

/**
 * A function that receives a triangle and the first and last column of one of its rows.
 *
 * @callback Visit
 * @param {number} triangle
 * @param {number} row
 * @param {number} first
 * @param {number} last
 */

/**
 * @param {Float64Array} corners of the vertices, x and y in turn, in pixels whose centres are whole numbers
 * @param {import("../maps/triangle_finder.js").Indices} triangles
 * @param {{ width: number, height: number }} size
 * @param {Visit} visit
 */
export function forEachSpan(corners, triangles, { width, height }, visit) {
  for (let i = 0; i < triangles.length; i += 3) {
    const [top, middle, bottom] = downwards(corners, triangles, i);
    const topX = corners[top];
    const topY = corners[top + 1];
    const middleX = corners[middle];
    const middleY = corners[middle + 1];
    const bottomX = corners[bottom];
    const bottomY = corners[bottom + 1];
    if (!isSolid(topX, topY, middleX, middleY, bottomX, bottomY)) continue;
    const lastRow = Math.min(Math.floor(bottomY), height - 1);
    for (let row = Math.max(Math.ceil(topY), 0); row <= lastRow; row++) {
      const straight = crossing(topX, topY, bottomX, bottomY, row);
      const bent =
        row >= middleY
          ? crossing(middleX, middleY, bottomX, bottomY, row)
          : crossing(topX, topY, middleX, middleY, row);
      const first = Math.max(Math.ceil(Math.min(straight, bent) - TOLERANCE), 0);
      const last = Math.min(Math.floor(Math.max(straight, bent) + TOLERANCE), width - 1);
      if (first <= last) visit(i / 3, row, first, last);
    }
  }
}

/**
 * Positions in pixels, moved onto a pixel's centre where they differ from it by rounding.
 *
 * @param {import("../maps/triangle_finder.js").Numbers} vertices
 * @param {{ left: number, top: number, stepX: number, stepZ: number }} grid the first pixel's centre, and the steps
 */
export function toGrid(vertices, { left, top, stepX, stepZ }) {
  const result = new Float64Array(vertices.length);
  for (let i = 0; i < vertices.length; i += 2) {
    result[i] = snapped((vertices[i] - left) / stepX);
    result[i + 1] = snapped((vertices[i + 1] - top) / stepZ);
  }
  return result;
}

/** @param {number} position */
function snapped(position) {
  const node = Math.round(position);
  return Math.abs(position - node) <= TOLERANCE ? node : position;
}

/**
 * Where a triangle's corners begin in the coordinates, from the top down. An edge's crossing is thus computed downwards
 * in both of its triangles, hence equal to the last bit: no pinholes.
 *
 * @param {Float64Array} corners
 * @param {import("../maps/triangle_finder.js").Indices} triangles
 * @param {number} i
 */
function downwards(corners, triangles, i) {
  let [a, b, c] = [2 * triangles[i], 2 * triangles[i + 1], 2 * triangles[i + 2]];
  if (corners[b + 1] < corners[a + 1]) [a, b] = [b, a];
  if (corners[c + 1] < corners[b + 1]) [b, c] = [c, b];
  if (corners[b + 1] < corners[a + 1]) [a, b] = [b, a];
  return [a, b, c];
}

/**
 * @param {number} ax
 * @param {number} ay
 * @param {number} bx
 * @param {number} by
 * @param {number} cx
 * @param {number} cy
 */
function isSolid(ax, ay, bx, by, cx, cy) {
  const longest = Math.max(Math.max(ax, bx, cx) - Math.min(ax, bx, cx), cy - ay);
  return Math.abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) > TOLERANCE * longest;
}

/**
 * @param {number} fromX
 * @param {number} fromY
 * @param {number} toX
 * @param {number} toY
 * @param {number} row
 */
function crossing(fromX, fromY, toX, toY, row) {
  const share = (row - fromY) / Math.max(toY - fromY, Number.MIN_VALUE);
  return fromX + Math.max(0, Math.min(share, 1)) * (toX - fromX);
}
