// The edges of a mesh, those that can be in sight, as one path.

const FINE = 10; // units of the path in a css pixel, all of them whole: to write 40,000 decimals takes too long

// The numbers in a message's bytes, which may lie at an address that their type does not allow.
function numbers(bytes, Kind) {
  return new Kind(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

function drawMesh(path, mesh, opacity, plane) {
  path.setAttribute("transform", `scale(${1 / FINE})`);
  path.setAttribute("stroke-opacity", opacity);
  path.setAttribute("d", mesh.edges && opacity > 0 ? edgesInSight(mesh, plane) : "");
}

function edgesInSight(mesh, plane) {
  const vertices = numbers(mesh.vertices, Float64Array);
  const edges = numbers(mesh.edges, Uint32Array);
  const [width, height] = [FINE * plane.width, FINE * plane.height];
  const [xs, ys] = [new Float64Array(vertices.length / 2), new Float64Array(vertices.length / 2)];
  for (let i = 0; i < xs.length; i++) {
    const at = plane.toPixels(vertices[2 * i], vertices[2 * i + 1]);
    [xs[i], ys[i]] = [Math.round(FINE * at.x), Math.round(FINE * at.y)];
  }
  let d = "";
  for (let i = 0; i < edges.length; i += 2) {
    const [a, b] = [edges[i], edges[i + 1]];
    const isBeside = (xs[a] < 0 && xs[b] < 0) || (xs[a] > width && xs[b] > width);
    const isAbove = (ys[a] < 0 && ys[b] < 0) || (ys[a] > height && ys[b] > height);
    if (!isBeside && !isAbove) d += `M${xs[a]},${ys[a]}L${xs[b]},${ys[b]}`;
  }
  return d;
}
