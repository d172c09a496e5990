// The edges of a mesh that may be visible, as one path.

const UNITS = 10; // path units per css pixel: integers, since writing 40,000 decimals takes too long

/**
 * @param {SVGPathElement} path
 * @param {{ vertices: Float64Array, edges: Uint32Array } | null} mesh
 * @param {number} opacity
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
export function drawMesh(path, mesh, opacity, plotArea) {
  path.setAttribute("transform", `scale(${1 / UNITS})`);
  path.setAttribute("stroke-opacity", String(opacity));
  path.setAttribute("d", mesh && opacity > 0 ? visibleEdges(mesh.vertices, mesh.edges, plotArea) : "");
}

/**
 * The d attribute of the edges that are not all on one side of the plot area.
 *
 * @param {Float64Array} vertices
 * @param {Uint32Array} ends
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
function visibleEdges(vertices, ends, plotArea) {
  const [xs, ys] = pathCoordinates(vertices, plotArea);
  const [width, height] = [UNITS * plotArea.width, UNITS * plotArea.height];
  let data = "";
  for (let i = 0; i < ends.length; i += 2) {
    const [a, b] = [ends[i], ends[i + 1]];
    const isBeside = (xs[a] < 0 && xs[b] < 0) || (xs[a] > width && xs[b] > width);
    const isAboveOrBelow = (ys[a] < 0 && ys[b] < 0) || (ys[a] > height && ys[b] > height);
    if (!isBeside && !isAboveOrBelow) data += `M${xs[a]},${ys[a]}L${xs[b]},${ys[b]}`;
  }
  return data;
}

/**
 * @param {Float64Array} vertices
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
function pathCoordinates(vertices, plotArea) {
  const count = vertices.length / 2;
  const [xs, ys] = [new Float64Array(count), new Float64Array(count)];
  for (let i = 0; i < count; i++) {
    const { x, y } = plotArea.toPixels(vertices[2 * i], vertices[2 * i + 1]);
    [xs[i], ys[i]] = [Math.round(UNITS * x), Math.round(UNITS * y)];
  }
  return [xs, ys];
}
