/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// shared/bytes.js
function toNumbers(bytes, NumberType) {
  return new NumberType(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

// maps/topology.js
var Topology = class {
  /** @param {Indices} triangles */
  constructor(triangles) {
    this.triangles = triangles;
    this.knownNeighbours = void 0;
    this.knownEdges = void 0;
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
};
function neighboursOf(triangles) {
  const result = new Int32Array(triangles.length).fill(-1);
  let count = 0;
  for (const vertex of triangles) count = Math.max(count, vertex + 1);
  const halfEdges = /* @__PURE__ */ new Map();
  for (let i = 0; i < triangles.length; i++) {
    const first = i - i % 3;
    const [from, to] = [triangles[first + (i + 1) % 3], triangles[first + (i + 2) % 3]];
    const twin = halfEdges.get(to * count + from) ?? -1;
    halfEdges.set(from * count + to, i);
    if (twin < 0) continue;
    result[i] = (twin - twin % 3) / 3;
    result[twin] = first / 3;
  }
  return result;
}
function edgesOf(triangles, beyond) {
  const edges = [];
  for (let i = 0; i < triangles.length; i++) {
    const first = i - i % 3;
    if (beyond[i] > first / 3) continue;
    edges.push(triangles[first + (i + 1) % 3], triangles[first + (i + 2) % 3]);
  }
  return Uint32Array.from(edges);
}

// maps/triangle_finder.js
var AXES = (
  /** @type {const} */
  [0, 1]
);
var MOST_STEPS = 40;
var TriangleFinder = class {
  /**
   * @param {Numbers} vertices x and z in turn
   * @param {Topology} topology
   * @param {number} tolerance the barycentric coordinate -tolerance still counts as inside
   */
  constructor(vertices, topology, tolerance) {
    this.vertices = vertices;
    this.topology = topology;
    this.triangles = topology.triangles;
    this.tolerance = tolerance;
    this.coefficients = barycentricCoefficients(vertices, topology.triangles);
    this.grid = void 0;
  }
  /**
   * A triangle that holds a point, or else the one that it is nearest to within the tolerance; -1 if there is none.
   *
   * @param {number} x
   * @param {number} z
   */
  find(x, z) {
    this.grid ??= new TriangleGrid(this.boundingBoxes());
    let [nearest, least] = [-1, -this.tolerance];
    for (const triangle of this.grid.candidates(x, z)) {
      const smallest = this.leastCoordinate(triangle, x, z);
      if (smallest >= 0) return triangle;
      if (smallest >= least) [nearest, least] = [triangle, smallest];
    }
    return nearest;
  }
  /**
   * As `find`, but starting from a triangle nearby: from there, cross edges towards the point. A fault is not crossed.
   *
   * @param {number} start
   * @param {number} x
   * @param {number} z
   */
  walk(start, x, z) {
    const { coefficients, tolerance } = this;
    const { neighbours } = this.topology;
    let triangle = start;
    for (let step = 0; step < MOST_STEPS && triangle >= 0; step++) {
      const base = 6 * triangle;
      const right = x - coefficients[base];
      const down = z - coefficients[base + 1];
      const b = coefficients[base + 2] * right + coefficients[base + 3] * down;
      const c = coefficients[base + 4] * right + coefficients[base + 5] * down;
      const a = 1 - b - c;
      if (a >= -tolerance && b >= -tolerance && c >= -tolerance) return triangle;
      triangle = neighbours[3 * triangle + (a <= b && a <= c ? 0 : b <= c ? 1 : 2)];
    }
    return this.find(x, z);
  }
  /**
   * @param {number} triangle
   * @param {number} x
   * @param {number} z
   */
  leastCoordinate(triangle, x, z) {
    const base = 6 * triangle;
    const { coefficients } = this;
    const right = x - coefficients[base];
    const down = z - coefficients[base + 1];
    const b = coefficients[base + 2] * right + coefficients[base + 3] * down;
    const c = coefficients[base + 4] * right + coefficients[base + 5] * down;
    return Math.min(1 - b - c, b, c);
  }
  /**
   * Barycentric coordinates of a point.
   *
   * @param {number} triangle
   * @param {number} x
   * @param {number} z
   * @returns {[number, number, number]}
   */
  weights(triangle, x, z) {
    const [x0, z0, bx, bz, cx, cz] = this.coefficients.subarray(6 * triangle, 6 * triangle + 6);
    const b = bx * (x - x0) + bz * (z - z0);
    const c = cx * (x - x0) + cz * (z - z0);
    return [1 - b - c, b, c];
  }
  /** Left, top, right and bottom of each triangle, padded by the tolerance. */
  boundingBoxes() {
    const { vertices, triangles } = this;
    const boxes = new Float64Array(4 * triangles.length / 3);
    for (let i = 0; i < boxes.length / 4; i++) {
      for (const axis of AXES) {
        const [a, b, c] = [0, 1, 2].map((corner) => vertices[2 * triangles[3 * i + corner] + axis]);
        const [low, high] = [Math.min(a, b, c), Math.max(a, b, c)];
        const padding = 2 * this.tolerance * (high - low);
        boxes[4 * i + axis] = low - padding;
        boxes[4 * i + 2 + axis] = high + padding;
      }
    }
    return boxes;
  }
};
function barycentricCoefficients(vertices, triangles) {
  const result = new Float64Array(2 * triangles.length);
  for (let i = 0, to = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [2 * triangles[i], 2 * triangles[i + 1], 2 * triangles[i + 2]];
    const [x0, z0] = [vertices[a], vertices[a + 1]];
    const [ux, uz] = [vertices[b] - x0, vertices[b + 1] - z0];
    const [vx, vz] = [vertices[c] - x0, vertices[c + 1] - z0];
    const twiceArea = ux * vz - uz * vx || Number.NaN;
    result[to++] = x0;
    result[to++] = z0;
    result[to++] = vz / twiceArea;
    result[to++] = -vx / twiceArea;
    result[to++] = -uz / twiceArea;
    result[to++] = ux / twiceArea;
  }
  return result;
}
var TriangleGrid = class {
  /** @param {Float64Array} boxes */
  constructor(boxes) {
    const count = boxes.length / 4;
    this.across = Math.max(1, Math.ceil(Math.sqrt(count) / 2));
    this.low = AXES.map((axis) => extreme(Math.min, boxes, axis));
    const high = AXES.map((axis) => extreme(Math.max, boxes, axis + 2));
    this.cellSize = AXES.map((axis) => (high[axis] - this.low[axis]) / this.across || 1);
    this.cells = Array.from({ length: this.across ** 2 }, () => []);
    for (let triangle = 0; triangle < count; triangle++) {
      const [left, top, right, bottom] = boxes.subarray(4 * triangle, 4 * triangle + 4);
      const [lastColumn, lastRow] = [this.index(right, 0), this.index(bottom, 1)];
      for (let row = this.index(top, 1); row <= lastRow; row++)
        for (let column = this.index(left, 0); column <= lastColumn; column++)
          this.cells[row * this.across + column].push(triangle);
    }
  }
  /**
   * @param {number} value
   * @param {0 | 1} axis
   */
  index(value, axis) {
    const index = Math.floor((value - this.low[axis]) / this.cellSize[axis]);
    return Math.max(0, Math.min(index, this.across - 1));
  }
  /**
   * @param {number} x
   * @param {number} z
   */
  candidates(x, z) {
    return this.cells[this.index(z, 1) * this.across + this.index(x, 0)] ?? [];
  }
};
function extreme(choose, boxes, side) {
  let result = boxes[side];
  for (let i = side; i < boxes.length; i += 4) result = choose(result, boxes[i]);
  return result;
}

// maps/piecewise_affine_map.js
var PiecewiseAffineMap = class _PiecewiseAffineMap {
  /**
   * @param {TriangleFinder} finder of the triangles before
   * @param {Numbers} target positions of the vertices after, x and z in turn
   */
  constructor(finder, target) {
    this.finder = finder;
    this.target = target;
    this.cachedLogRatios = void 0;
  }
  /**
   * @param {Numbers} source
   * @param {Numbers} target
   * @param {Topology} topology
   * @param {number} tolerance
   */
  static of(source, target, topology, tolerance) {
    return new _PiecewiseAffineMap(new TriangleFinder(source, topology, tolerance), target);
  }
  /** @param {import("../pointer_layer/types.js").AffineMapState} state */
  static fromState({ source, target, triangles, tolerance }) {
    const [before, after] = [toNumbers(source, Float64Array), toNumbers(target, Float64Array)];
    return _PiecewiseAffineMap.of(before, after, new Topology(toNumbers(triangles, Uint32Array)), tolerance);
  }
  /**
   * Carry a point to the target; null outside the mesh.
   *
   * @param {Point} point
   * @returns {Point | null}
   */
  forward({ x, z }) {
    const triangle = this.finder.find(x, z);
    return triangle < 0 ? null : this.carried(triangle, this.finder.weights(triangle, x, z));
  }
  /**
   * The point of a triangle of the target with these barycentric coordinates.
   *
   * @param {number} triangle
   * @param {number[]} weights
   */
  carried(triangle, weights) {
    const carried = { x: 0, z: 0 };
    weights.forEach((weight, corner) => {
      const vertex = this.finder.triangles[3 * triangle + corner];
      carried.x += weight * this.target[2 * vertex];
      carried.z += weight * this.target[2 * vertex + 1];
    });
    return carried;
  }
  /** Logarithm of the area before over the area after, of each triangle. */
  get logRatios() {
    if (!this.cachedLogRatios) {
      const { vertices, triangles } = this.finder;
      const [before, after] = [twiceAreas(vertices, triangles), twiceAreas(this.target, triangles)];
      this.cachedLogRatios = before.map((area, i) => Math.log(area / after[i]));
    }
    return this.cachedLogRatios;
  }
};
function twiceAreas(vertices, triangles) {
  const areas = new Float64Array(triangles.length / 3);
  for (let i = 0; i < areas.length; i++) {
    const [a, b, c] = [2 * triangles[3 * i], 2 * triangles[3 * i + 1], 2 * triangles[3 * i + 2]];
    const [ux, uz] = [vertices[b] - vertices[a], vertices[b + 1] - vertices[a + 1]];
    const [vx, vz] = [vertices[c] - vertices[a], vertices[c + 1] - vertices[a + 1]];
    areas[i] = ux * vz - uz * vx;
  }
  return areas;
}
function carry(maps, point) {
  return maps.reduce(
    (carried, map) => carried && map.forward(carried),
    /** @type {Point | null} */
    point
  );
}

// picture/motion.js
var Motion = class {
  /**
   * @param {Numbers} before positions of the vertices, x and z in turn
   * @param {Numbers} after
   * @param {Indices} triangles
   * @param {[number, number]} cell metres of rock in one unit of x and one of z
   */
  constructor(before, after, triangles, cell) {
    this.cell = cell;
    this.blocks = blocks(triangles, before.length / 2);
    const [start, stop] = [inMetres(before, cell), inMetres(after, cell)];
    const masses = vertexMasses(start, triangles);
    this.first = centres(start, this.blocks, masses);
    this.last = centres(stop, this.blocks, masses);
    subtract(start, this.first, this.blocks);
    subtract(stop, this.last, this.blocks);
    this.start = start;
    this.stop = stop;
    this.angles = angles(start, stop, this.blocks, masses);
  }
  /**
   * Positions after a share of the motion.
   *
   * Each block turns by a share of its angle about its pole, and the rest of its deformation grows linearly.
   *
   * @param {number} share from 0 to 1
   */
  at(share) {
    const { start, stop, blocks: blocks2, cell } = this;
    const moves = this.angles.map((angle, block) => this.blockMove(block, angle, share));
    const result = new Float64Array(start.length);
    for (let i = 0; i < blocks2.length; i++) {
      const { centre, turn, back } = moves[blocks2[i]];
      const [sx, sz, ex, ez] = [start[2 * i], start[2 * i + 1], stop[2 * i], stop[2 * i + 1]];
      const x = (1 - share) * sx + share * (back.x * ex - back.z * ez);
      const z = (1 - share) * sz + share * (back.z * ex + back.x * ez);
      result[2 * i] = (centre.x + turn.x * x - turn.z * z) / cell[0];
      result[2 * i + 1] = (centre.z + turn.z * x + turn.x * z) / cell[1];
    }
    return result;
  }
  /**
   * Where a block's centre is, its turn, and the turn that takes the whole motion's turn back.
   *
   * @param {number} block
   * @param {number} angle
   * @param {number} share
   */
  blockMove(block, angle, share) {
    const [x, z] = [this.first[2 * block], this.first[2 * block + 1]];
    const [dx, dz] = [this.last[2 * block] - x, this.last[2 * block + 1] - z];
    const along = share * sinc(share * angle / 2) / sinc(angle / 2);
    const arc = direction(0.5 * (share - 1) * angle);
    const centre = { x: x + along * (arc.x * dx - arc.z * dz), z: z + along * (arc.z * dx + arc.x * dz) };
    return { centre, turn: direction(share * angle), back: direction(-angle) };
  }
};
var sinc = (angle) => angle === 0 ? 1 : Math.sin(angle) / angle;
var direction = (angle) => ({ x: Math.cos(angle), z: Math.sin(angle) });
function inMetres(points, cell) {
  return Float64Array.from(points, (value, i) => value * cell[i % 2]);
}
function blocks(triangles, count) {
  const parents = Int32Array.from({ length: count }, (_, i) => i);
  const root = (vertex) => {
    let at = vertex;
    while (parents[at] !== at) {
      parents[at] = parents[parents[at]];
      at = parents[at];
    }
    return at;
  };
  for (let i = 0; i < triangles.length; i++) parents[root(triangles[i])] = root(triangles[i - i % 3]);
  const labels = /* @__PURE__ */ new Map();
  return Int32Array.from({ length: count }, (_, i) => {
    const label = labels.get(root(i)) ?? labels.size;
    labels.set(root(i), label);
    return label;
  });
}
function vertexMasses(vertices, triangles) {
  const masses = new Float64Array(vertices.length / 2);
  const areas = twiceAreas(vertices, triangles);
  for (let i = 0; i < triangles.length; i++) masses[triangles[i]] += Math.abs(areas[Math.floor(i / 3)]);
  return masses;
}
function centres(points, blocks2, masses) {
  const count = blocks2.reduce((most, block) => Math.max(most, block), 0) + 1;
  const sums = new Float64Array(2 * count);
  const totals = new Float64Array(count);
  blocks2.forEach((block, i) => {
    sums[2 * block] += masses[i] * points[2 * i];
    sums[2 * block + 1] += masses[i] * points[2 * i + 1];
    totals[block] += masses[i];
  });
  return sums.map((sum, i) => sum / totals[i >> 1]);
}
function subtract(points, centres2, blocks2) {
  blocks2.forEach((block, i) => {
    points[2 * i] -= centres2[2 * block];
    points[2 * i + 1] -= centres2[2 * block + 1];
  });
}
function angles(start, stop, blocks2, masses) {
  const sums = [];
  blocks2.forEach((block, i) => {
    sums[block] ??= { x: 0, z: 0 };
    const [sx, sz, ex, ez] = [start[2 * i], start[2 * i + 1], stop[2 * i], stop[2 * i + 1]];
    sums[block].x += masses[i] * (sx * ex + sz * ez);
    sums[block].z += masses[i] * (sx * ez - sz * ex);
  });
  return sums.map(({ x, z }) => Math.atan2(z, x));
}

// picture/live_chain.js
var NUDGES = [0, 0.05, -0.05];
var Stage = class _Stage {
  /**
   * @param {Numbers} before
   * @param {Numbers} after
   * @param {Topology} topology
   * @param {number} tolerance
   */
  constructor(before, after, topology, tolerance) {
    this.before = before;
    this.after = after;
    this.topology = topology;
    this.tolerance = tolerance;
    this.cache = /* @__PURE__ */ new Map();
  }
  /**
   * @template Value
   * @param {string} name
   * @param {() => Value} compute
   * @returns {Value}
   */
  cached(name, compute) {
    if (!this.cache.has(name)) this.cache.set(name, compute());
    return this.cache.get(name);
  }
  get finderBefore() {
    return this.cached("finderBefore", () => new TriangleFinder(this.before, this.topology, this.tolerance));
  }
  /** Each edge once. */
  get edges() {
    return this.topology.edges;
  }
  get toRestored() {
    return this.cached("toRestored", () => new PiecewiseAffineMap(this.finderBefore, this.after));
  }
  get toOriginal() {
    return this.cached(
      "toOriginal",
      () => PiecewiseAffineMap.of(this.after, this.before, this.topology, this.tolerance)
    );
  }
  /**
   * The step carried out in part.
   *
   * @param {number} share
   * @param {[number, number]} metres in a sample
   */
  part(share, metres) {
    const motion = this.cached("motion", () => new Motion(this.before, this.after, this.topology.triangles, metres));
    const part = new _Stage(this.before, motion.at(share), this.topology, this.tolerance);
    part.cache.set("finderBefore", this.finderBefore);
    return part;
  }
};
function unpacked(bytes, { quick, low, scale }) {
  if (!quick) return toNumbers(bytes, Float32Array);
  return Float64Array.from(toNumbers(bytes, Uint16Array), (value, i) => low[i % 2] + scale[i % 2] * value);
}
function decodeTriangles({ triangles, bits }) {
  return new Topology(bits === 16 ? toNumbers(triangles, Uint16Array) : toNumbers(triangles, Uint32Array));
}
var LiveChain = class {
  /**
   * @param {StageState[]} states
   * @param {Topology[]} topologies
   * @param {{ metres: [number, number], tolerance: number }} grid
   */
  constructor(states, topologies, grid) {
    this.grid = grid;
    this.stages = states.map(
      ({ before, after, ...packing }, i) => new Stage(unpacked(before, packing), unpacked(after, packing), topologies[i], grid.tolerance)
    );
    this.moment = { time: this.stages.length, stages: this.stages };
  }
  /**
   * The stages at a time from 0, the present day, to their number.
   *
   * @param {number} time
   */
  stagesAt(time) {
    if (time !== this.moment.time) {
      const whole = Math.floor(time);
      const part = whole < this.stages.length && time > whole;
      const started = part ? [this.stages[whole].part(time - whole, this.grid.metres)] : [];
      this.moment = { time, stages: [...this.stages.slice(0, whole), ...started] };
    }
    return this.moment.stages;
  }
  /**
   * Where a point of the restored section is at a time, in samples; null if it has no place.
   *
   * @param {Point} point
   * @param {number} time
   * @param {number} [end] number of stages after which the point is given
   */
  placed(point, time, end = this.stages.length) {
    const stages = this.stagesAt(time);
    const later = stages.slice(end);
    if (later.length)
      return carry(
        later.map(({ toRestored }) => toRestored),
        point
      );
    let at = (
      /** @type {Point | null} */
      point
    );
    for (let index = end - 1; index >= 0 && at; index--) {
      const { toOriginal } = this.stages[index];
      const { x, z } = at;
      const within = NUDGES.find((nudge) => toOriginal.finder.find(x, z + nudge) >= 0);
      if (within === void 0) return null;
      const triangle = toOriginal.finder.find(x, z + within);
      const weights = toOriginal.finder.weights(triangle, x, z + within);
      if (index < stages.length) return stages[index].toRestored.carried(triangle, weights);
      at = toOriginal.carried(triangle, weights);
    }
    return at;
  }
  /**
   * The maps from one section to the other.
   *
   * @param {number} time
   * @param {boolean} fromRestored
   */
  maps(time, fromRestored) {
    const stages = this.stagesAt(time);
    return fromRestored ? stages.map((stage) => stage.toOriginal).reverse() : stages.map((stage) => stage.toRestored);
  }
};

// picture/texture.js
var NO_DATA = -32768;
var Texture = class {
  /**
   * @param {Int16Array} data row by row; NO_DATA where there is none
   * @param {number} width
   * @param {number} height
   * @param {{ width: number, height: number }} section number of its traces and samples
   */
  constructor(data, width, height, section) {
    this.data = data;
    this.width = width;
    this.height = height;
    this.section = section;
    this.stepX = section.width / width;
    this.stepZ = section.height / height;
    this.hasGaps = data.includes(NO_DATA);
    this.reductions = /* @__PURE__ */ new Map();
  }
  /**
   * The texture with its cells averaged where a pixel covers many of them, as in a view of a large section: two remain.
   *
   * @param {number} samplesX in a pixel
   * @param {number} samplesZ
   */
  reducedTo(samplesX, samplesZ) {
    const across = Math.max(1, Math.floor(Math.min(samplesX / this.stepX, this.width) / 2));
    const down = Math.max(1, Math.floor(Math.min(samplesZ / this.stepZ, this.height) / 2));
    if (across === 1 && down === 1) return this;
    const key = `${across},${down}`;
    const reduced = this.reductions.get(key) ?? reduce(this, across, down);
    this.reductions.clear();
    this.reductions.set(key, reduced);
    return reduced;
  }
};
function reduce({ data, width, height, section }, across, down) {
  const [columns, rows] = [Math.ceil(width / across), Math.ceil(height / down)];
  const result = new Int16Array(columns * rows);
  for (let row = 0; row < rows; row++) {
    const [sums, counts] = [new Float32Array(columns), new Uint32Array(columns)];
    for (let from = row * down; from < Math.min((row + 1) * down, height); from++)
      addRow(data.subarray(from * width, (from + 1) * width), across, sums, counts);
    for (let i = 0; i < columns; i++) result[row * columns + i] = counts[i] ? Math.round(sums[i] / counts[i]) : NO_DATA;
  }
  const covered = {
    width: columns * across * section.width / width,
    height: rows * down * section.height / height
  };
  return new Texture(result, columns, rows, covered);
}
function addRow(row, across, sums, counts) {
  for (let i = 0; i < row.length; i++) {
    if (row[i] === NO_DATA) continue;
    const cell = Math.floor(i / across);
    sums[cell] += row[i];
    counts[cell]++;
  }
}

// picture/texture_loader.js
var PAUSE = 300;
var TextureLoader = class {
  /** @param {import("./types.js").PictureModel} model */
  constructor(model) {
    this.model = model;
    this.texture = null;
    this.data = new Int16Array(0);
    this.received = /* @__PURE__ */ new Set();
    this.changedAt = -Infinity;
  }
  /** Load the texture from the start. */
  start() {
    const { shape } = this.model.get("texture");
    this.texture = null;
    this.data = new Int16Array(shape[0] * shape[1]);
    this.received.clear();
    this.askForNext();
  }
  /** Note that the meshes have changed. */
  pause() {
    this.changedAt = performance.now();
  }
  get count() {
    const { shape, rows } = this.model.get("texture");
    return Math.ceil(shape[0] / rows);
  }
  askForNext() {
    const { id } = this.model.get("texture");
    const missing = Array.from({ length: this.count }, (_, index) => index).find((index) => !this.received.has(index));
    if (missing === void 0) return;
    const wait = this.changedAt + PAUSE - performance.now();
    const ask = () => id === this.model.get("texture").id && this.model.send({ kind: "tile", texture: id, index: missing });
    if (wait > 0) setTimeout(() => this.askForNext(), wait);
    else ask();
  }
  /**
   * @param {{ kind: string, texture: number, index: number }} message
   * @param {DataView[]} buffers
   */
  receive({ kind, texture, index }, [bytes]) {
    const { id, shape, rows } = this.model.get("texture");
    if (kind !== "tile" || texture !== id || this.received.has(index)) return;
    this.received.add(index);
    this.data.set(toNumbers(bytes, Int16Array), index * rows * shape[1]);
    if (this.received.size === this.count) this.finish();
    else this.askForNext();
  }
  finish() {
    const { shape } = this.model.get("texture");
    const [rows, columns] = this.model.get("grid").shape;
    this.texture = new Texture(this.data, shape[1], shape[0], { width: columns, height: rows });
    this.model.set("revision", this.model.get("revision") + 1);
  }
};

// picture/picture.js
var Picture = class {
  /** @param {import("./types.js").PictureModel} model */
  constructor(model) {
    this.model = model;
    this.loader = new TextureLoader(model);
    this.decoded = /* @__PURE__ */ new Map();
  }
  /**
   * @template {"grid" | "texture" | "stages" | "triangles" | "colours" | "deformation"} Name
   * @template Value
   * @param {Name} name of a trait
   * @param {(state: PictureTraits[Name]) => Value} decode
   * @returns {Value}
   */
  decode(name, decode) {
    const state = this.model.get(name);
    const known = this.decoded.get(name);
    if (known?.state === state) return known.value;
    const value = decode(state);
    this.decoded.set(name, { state, value });
    return value;
  }
  get grid() {
    return this.model.get("grid");
  }
  get chain() {
    const topologies = this.decode("triangles", (states) => states.map(decodeTriangles));
    return this.decode("stages", (states) => new LiveChain(states, topologies, this.grid));
  }
  /** From 0, the present day, to the number of stages. */
  get time() {
    const [frame, end] = [this.model.get("frame"), this.chain.stages.length];
    return frame === null ? end : Math.min(frame / this.model.get("frames"), end);
  }
  get texture() {
    return this.loader.texture ?? this.overview;
  }
  get overview() {
    return this.decode("texture", ({ overview }) => {
      const [height, width] = overview.shape;
      const [rows, columns] = this.grid.shape;
      return new Texture(toNumbers(overview.data, Int16Array), width, height, { width: columns, height: rows });
    });
  }
  /**
   * The maps from a pane's section to the other one, in samples.
   *
   * @param {boolean} isRestored
   */
  maps(isRestored) {
    return this.chain.maps(this.time, isRestored);
  }
  /**
   * What a pane shows.
   *
   * @param {boolean} isRestored
   * @param {number[]} window left, right, top and bottom, in the section's units
   * @returns {import("./scene.js").Scene}
   */
  scene(isRestored, [left, right, top, bottom]) {
    const [low, high] = [this.toSamples({ x: left, z: top }), this.toSamples({ x: right, z: bottom })];
    return {
      texture: this.texture,
      maps: this.maps(isRestored),
      isRestored,
      window: [low.x, high.x, low.z, high.z],
      colours: this.decode("colours", withPalette),
      deformation: this.decode("deformation", withPalette)
    };
  }
  /** @param {Point} point */
  toSamples({ x, z }) {
    const { origin, step } = this.grid;
    return { x: (x - origin[0]) / step[0], z: (z - origin[1]) / step[1] };
  }
  /** @param {Point} point */
  fromSamples({ x, z }) {
    const { origin, step } = this.grid;
    return { x: origin[0] + x * step[0], z: origin[1] + z * step[1] };
  }
  /**
   * Where a point of the restored section is at the present time; null if it has no place.
   *
   * @param {Point} point
   * @param {number} [end] number of stages after which the point is given
   */
  placed(point, end) {
    const placed = this.chain.placed(this.toSamples(point), this.time, end);
    return placed && this.fromSamples(placed);
  }
  get isAtEnd() {
    return this.time === this.chain.stages.length;
  }
  /**
   * The mesh in a pane, in the section's units; null if there is none.
   *
   * @param {boolean} isRestored
   */
  mesh(isRestored) {
    const stages = this.chain.stagesAt(this.time);
    const stage = isRestored ? stages.at(-1) : stages[0];
    if (!stage) return null;
    const { origin, step } = this.grid;
    const shape = isRestored ? stage.after : stage.before;
    return {
      vertices: Float64Array.from(shape, (value, i) => origin[i % 2] + value * step[i % 2]),
      edges: stage.edges
    };
  }
};
function withPalette(state) {
  return { ...state, palette: toNumbers(state.palette, Uint8Array) };
}

// shared/local_traits.js
function keepTraitsLocal(model, names) {
  const patched = /* @__PURE__ */ new WeakSet();
  const patch = (widgetModel) => {
    if (patched.has(widgetModel) || typeof widgetModel?.serialize !== "function") return;
    patched.add(widgetModel);
    const serialize = widgetModel.serialize.bind(widgetModel);
    widgetModel.serialize = (state) => {
      for (const name of names) delete state[name];
      return serialize(state);
    };
  };
  model.on(names.map((name) => `change:${name}`).join(" "), patch);
}

// live_picture.js
function initialize({ model }) {
  keepTraitsLocal(model, ["picture", "revision", "bare"]);
  const picture = new Picture(model);
  const handlers = [
    ["change:texture", () => picture.loader.start()],
    ["change:stages", () => picture.loader.pause()],
    ["msg:custom", (content, buffers) => picture.loader.receive(content, buffers)]
  ];
  for (const [name, handler] of handlers) model.on(name, handler);
  if (model.get("texture").shape) picture.loader.start();
  model.set("revision", 0);
  model.set("picture", picture);
  return () => {
    for (const [name, handler] of handlers) model.off(name, handler);
  };
}
var live_picture_default = { initialize };
export {
  live_picture_default as default
};
