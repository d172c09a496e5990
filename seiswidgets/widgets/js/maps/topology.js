// The triangles of a mesh, wherever its vertices are.

/** @typedef {Uint32Array | Uint16Array} Indices */

/** Triangles, with what follows from them alone: computed when first needed, and kept while vertices move. */
export class Topology {
  /** @param {Indices} triangles */
  constructor(triangles) {
    this.triangles = triangles;
    /** @type {Int32Array | undefined} */
    this.knownNeighbours = undefined;
    /** @type {Uint32Array | undefined} */
    this.knownEdges = undefined;
  }

  /** The triangle beyond the edge opposite to each corner; -1 at the border and at a cut. */
  get neighbours() {
    this.knownNeighbours ??= neighboursOf(this.triangles);
    return this.knownNeighbours;
  }

  /** Each edge once. */
  get edges() {
    this.knownEdges ??= edgesOf(this.triangles, this.neighbours);
    return this.knownEdges;
  }
}

/** @param {Indices} triangles */
function neighboursOf(triangles) {
  const result = new Int32Array(triangles.length).fill(-1);
  let count = 0;
  for (const vertex of triangles) count = Math.max(count, vertex + 1);
  /** @type {Map<number, number>} */
  const halfEdges = new Map(); // the corner opposite to each directed edge
  for (let i = 0; i < triangles.length; i++) {
    const first = i - (i % 3);
    const [from, to] = [triangles[first + ((i + 1) % 3)], triangles[first + ((i + 2) % 3)]];
    const twin = halfEdges.get(to * count + from) ?? -1;
    halfEdges.set(from * count + to, i);
    if (twin < 0) continue;
    result[i] = (twin - (twin % 3)) / 3;
    result[twin] = first / 3;
  }
  return result;
}

/**
 * @param {Indices} triangles
 * @param {Int32Array} beyond
 */
function edgesOf(triangles, beyond) {
  /** @type {number[]} */
  const edges = [];
  for (let i = 0; i < triangles.length; i++) {
    const first = i - (i % 3);
    if (beyond[i] > first / 3) continue; // the other triangle has it
    edges.push(triangles[first + ((i + 1) % 3)], triangles[first + ((i + 2) % 3)]);
  }
  return Uint32Array.from(edges);
}
