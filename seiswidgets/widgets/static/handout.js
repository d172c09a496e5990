/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// handout/data.js
async function readState() {
  const packed = Uint8Array.from(atob(contentOf("data")), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const block = await new Response(stream).arrayBuffer();
  return JSON.parse(
    contentOf("state"),
    (_, value) => Array.isArray(value?.bytes) ? new DataView(block, ...value.bytes) : value
  );
}
function contentOf(id) {
  return document.getElementById(id)?.textContent ?? "";
}

// handout/local_model.js
var LocalModel = class {
  /**
   * @param {Record<string, any>} traits
   * @param {object} [options]
   * @param {(content: any) => void} [options.receive] takes the messages that views send
   * @param {Record<string, LocalModel>} [options.models] that traits refer to, by id
   */
  constructor(traits, { receive = () => {
  }, models = {} } = {}) {
    this.traits = traits;
    this.send = receive;
    this.widget_manager = { get_model: async (id) => models[id] };
    this.handlers = /* @__PURE__ */ new Map();
  }
  /** @param {string} name */
  get(name) {
    return this.traits[name];
  }
  /**
   * @param {string} name
   * @param {any} value
   */
  set(name, value) {
    if (this.traits[name] === value) return;
    this.traits[name] = value;
    for (const handler of [...this.handlers.get(`change:${name}`) ?? []]) handler();
  }
  /**
   * @param {string} names separated by spaces
   * @param {Handler} handler
   */
  on(names, handler) {
    for (const name of names.split(" ")) {
      const known = this.handlers.get(name) ?? /* @__PURE__ */ new Set();
      this.handlers.set(name, known.add(handler));
    }
  }
  /**
   * @param {string} names
   * @param {Handler} handler
   */
  off(names, handler) {
    for (const name of names.split(" ")) this.handlers.get(name)?.delete(handler);
  }
  save_changes() {
  }
  // there is nobody to send them to
};

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
  walk(start2, x, z) {
    const { coefficients, tolerance } = this;
    const { neighbours } = this.topology;
    let triangle = start2;
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
    const [start2, stop] = [inMetres(before, cell), inMetres(after, cell)];
    const masses = vertexMasses(start2, triangles);
    this.first = centres(start2, this.blocks, masses);
    this.last = centres(stop, this.blocks, masses);
    subtract(start2, this.first, this.blocks);
    subtract(stop, this.last, this.blocks);
    this.start = start2;
    this.stop = stop;
    this.angles = angles(start2, stop, this.blocks, masses);
  }
  /**
   * Positions after a share of the motion.
   *
   * Each block turns by a share of its angle about its pole, and the rest of its deformation grows linearly.
   *
   * @param {number} share from 0 to 1
   */
  at(share) {
    const { start: start2, stop, blocks: blocks2, cell } = this;
    const moves = this.angles.map((angle, block) => this.blockMove(block, angle, share));
    const result = new Float64Array(start2.length);
    for (let i = 0; i < blocks2.length; i++) {
      const { centre, turn, back } = moves[blocks2[i]];
      const [sx, sz, ex, ez] = [start2[2 * i], start2[2 * i + 1], stop[2 * i], stop[2 * i + 1]];
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
function angles(start2, stop, blocks2, masses) {
  const sums = [];
  blocks2.forEach((block, i) => {
    sums[block] ??= { x: 0, z: 0 };
    const [sx, sz, ex, ez] = [start2[2 * i], start2[2 * i + 1], stop[2 * i], stop[2 * i + 1]];
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
      const within2 = NUDGES.find((nudge) => toOriginal.finder.find(x, z + nudge) >= 0);
      if (within2 === void 0) return null;
      const triangle = toOriginal.finder.find(x, z + within2);
      const weights = toOriginal.finder.weights(triangle, x, z + within2);
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

// pointer_layer/keyboard.js
var BARE = "v";
function modifiers(event) {
  const pressed = { ctrl: event.ctrlKey, meta: event.metaKey, shift: event.shiftKey, alt: event.altKey };
  return Object.entries(pressed).flatMap(([name, isPressed]) => isPressed ? [name] : []);
}
var Keyboard = class {
  /**
   * @param {{ classList: Pick<DOMTokenList, "toggle" | "remove"> }} plot
   * @param {Pick<import("./types.js").Model, "get">} model
   * @param {Send} send
   * @param {(isBare: boolean) => void} showBare
   */
  constructor(plot, model, send, showBare) {
    this.plot = plot;
    this.model = model;
    this.send = send;
    this.showBare = showBare;
    this.isSpaceDown = false;
    this.hasPanned = false;
  }
  /** @param {Listen} listen */
  listenWith(listen) {
    listen("keydown", (event) => this.press(event));
    listen("keyup", (event) => this.release(event));
    listen("blur", () => {
      this.plot.classList.remove("by-pointer");
      this.setSpace(false);
      this.showBare(false);
    });
  }
  /** Start a drag; true if it pans, since Space is held. */
  startDrag() {
    this.hasPanned ||= this.isSpaceDown;
    return this.isSpaceDown;
  }
  /** @param {boolean} isDown */
  setSpace(isDown) {
    this.isSpaceDown = isDown;
    this.plot.classList.toggle("can-pan", isDown);
  }
  /** @param {string} name */
  isHotkey(name) {
    return this.model.get("hotkeys").includes(name);
  }
  /** @param {KeyboardEvent} event */
  press(event) {
    this.plot.classList.remove("by-pointer");
    const withCtrl = event.ctrlKey || event.metaKey;
    if (event.key === "ContextMenu" || event.key === "F10" && event.shiftKey) {
      event.preventDefault();
      this.send("menu", event);
      return;
    }
    if (event.key.toLowerCase() === BARE && !withCtrl && !event.altKey) {
      event.preventDefault();
      this.showBare(true);
      return;
    }
    const isSpace = event.key === " " && !withCtrl;
    if (!isSpace && !this.isHotkey((withCtrl ? "Ctrl+" : "") + event.key)) return;
    event.preventDefault();
    if (!isSpace) this.send("key", event, { key: event.key });
    else if (!event.repeat) {
      this.hasPanned = false;
      this.setSpace(true);
    }
  }
  /** @param {KeyboardEvent} event */
  release(event) {
    if (event.key.toLowerCase() === BARE) this.showBare(false);
    if (event.key !== " " || !this.isSpaceDown) return;
    event.preventDefault();
    this.setSpace(false);
    if (!this.hasPanned && this.isHotkey(" ")) this.send("key", event, { key: " " });
  }
};

// pointer_layer/gestures.js
var WHEEL_STEP = 100;
var LINE_HEIGHT = 16;
var MIDDLE_BUTTON = 1;
var TAP = { time: 300, distance: 12 };
var DOUBLE_TAP = { time: 400, distance: 30 };
var LONG_PRESS = 700;
var ECHO = 800;
var distance = (one, other) => Math.hypot(one.x - other.x, one.y - other.y);
var GestureRecogniser = class {
  /**
   * @param {Pick<SVGSVGElement, "classList" | "focus" | "setPointerCapture">} plot
   * @param {import("./plot_area.js").PlotArea} plotArea
   * @param {{ startDrag: () => boolean }} keyboard
   * @param {Record<"drag" | "hover" | "wheel" | "pinch", { add: (message: object) => void, drop: () => void }>} throttles
   * @param {Actions} actions
   */
  constructor(plot, plotArea, keyboard, throttles, actions) {
    this.plot = plot;
    this.plotArea = plotArea;
    this.keyboard = keyboard;
    this.throttles = throttles;
    this.actions = actions;
    this.held = null;
    this.fingers = /* @__PURE__ */ new Map();
    this.pinch = null;
    this.lastTap = null;
  }
  /** @param {import("./keyboard.js").Listen} listen */
  listenWith(listen) {
    listen("pointerdown", (event) => this.press(event));
    listen("pointermove", (event) => this.move(event));
    listen("pointerup", (event) => this.lift(event));
    listen("pointercancel", (event) => this.lift(event));
    listen("pointerleave", (event) => this.leave(event));
    listen("dblclick", (event) => this.doubleClick(event));
    listen("wheel", (event) => this.scroll(event));
    listen("contextmenu", (event) => this.openMenu(event));
  }
  /** @param {PointerEvent} event */
  press(event) {
    event.preventDefault();
    const position = this.plotArea.pointerPosition(event);
    this.plot.classList.add("by-pointer");
    this.plot.focus({ preventScroll: true });
    this.plot.setPointerCapture(event.pointerId);
    if (event.pointerType === "touch") this.fingers.set(event.pointerId, position);
    if (this.fingers.size > 1) this.startPinch(event);
    else if (!this.held) this.hold(event, position);
  }
  /**
   * @param {PointerEvent} event
   * @param {Pixel} position
   */
  hold(event, position) {
    const pan = this.keyboard.startDrag() || event.button === MIDDLE_BUTTON;
    const { pointerId, timeStamp, button } = event;
    this.held = { id: pointerId, position, start: position, startTime: timeStamp, button, pan };
    this.plot.classList.toggle("pans", pan);
    this.actions.movePointer(position);
    this.throttles.hover.drop();
    this.actions.send("press", event, buttonOf(this.held));
    if (event.pointerType === "touch") this.awaitLongPress(event, this.held);
  }
  /**
   * Ask for the menu in place of the browser's and JupyterLab's; what a long press has done is revoked.
   *
   * @param {MouseEvent} event
   */
  openMenu(event) {
    event.preventDefault();
    event.stopPropagation();
    if (this.held) this.release(
      this.held,
      /** @type {PointerEvent} */
      event,
      true,
      this.held.position
    );
    this.fingers.clear();
    this.actions.send("menu", event);
  }
  /** @param {PointerEvent} event */
  move(event) {
    const position = this.plotArea.pointerPosition(event);
    const { held } = this;
    if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, position);
    if (this.pinch) this.updatePinch(this.pinch);
    else if (held && event.pointerId === held.id) {
      held.position = position;
      this.report("drag", event, position, held.pan ? { pan: true } : {});
    } else if (!held && event.pointerType !== "touch") this.report("hover", event, position, {});
  }
  /**
   * @param {"drag" | "hover"} kind
   * @param {PointerEvent} event
   * @param {Pixel} position
   * @param {object} more
   */
  report(kind, event, position, more) {
    this.actions.movePointer(position);
    this.throttles[kind].add({ ...this.plotArea.toKernel(position), modifiers: modifiers(event), ...more });
  }
  /**
   * Open the menu under a finger that rests: not every browser reports that by itself.
   *
   * @param {PointerEvent} event
   * @param {HeldPointer} held
   */
  awaitLongPress(event, held) {
    setTimeout(() => {
      if (this.held === held && distance(held.position, held.start) < TAP.distance) this.openMenu(event);
    }, LONG_PRESS);
  }
  /** @param {PointerEvent} event */
  lift(event) {
    const { held } = this;
    this.fingers.delete(event.pointerId);
    if (this.pinch) this.pinch = this.fingers.size > 1 ? this.measurePinch() : null;
    if (!held || event.pointerId !== held.id) return;
    const isTouch = event.pointerType === "touch";
    this.release(held, event, event.type === "pointercancel", this.plotArea.pointerPosition(event));
    if (isTouch) this.actions.movePointer(null);
    if (isTouch && this.isTap(held, event)) this.tap(event);
  }
  /**
   * @param {HeldPointer} held
   * @param {PointerEvent} event
   * @param {boolean} cancelled
   * @param {Pixel} position
   */
  release(held, event, cancelled, position) {
    this.throttles.drag.drop();
    this.actions.send("release", event, { ...buttonOf(held), cancelled, ...this.plotArea.toKernel(position) });
    this.held = null;
    this.plot.classList.remove("pans");
    this.actions.scheduleRest();
  }
  /** @param {PointerEvent} event */
  leave(event) {
    if (this.held || this.pinch) return;
    this.actions.movePointer(null);
    this.throttles.hover.drop();
    this.actions.send("leave", event);
  }
  /**
   * @param {HeldPointer} held
   * @param {PointerEvent} event
   */
  isTap(held, event) {
    if (event.type !== "pointerup" || held.pan || event.timeStamp - held.startTime >= TAP.time) return false;
    return distance(this.plotArea.pointerPosition(event), held.start) < TAP.distance;
  }
  /**
   * Send a double click after the second of two taps, since not every browser does so itself.
   *
   * @param {PointerEvent} event
   */
  tap(event) {
    const [position, time, last] = [this.plotArea.pointerPosition(event), event.timeStamp, this.lastTap];
    const isSoon = last !== null && !last.isDouble && time - last.time < DOUBLE_TAP.time;
    const isDouble = isSoon && distance(position, last.position) < DOUBLE_TAP.distance;
    this.lastTap = { position, time, isDouble };
    if (isDouble) this.actions.send("double", event, { touch: true });
  }
  /** @param {MouseEvent} event */
  doubleClick(event) {
    if (this.lastTap?.isDouble && event.timeStamp - this.lastTap.time < ECHO) return;
    this.actions.send("double", event);
  }
  /** @param {WheelEvent} event */
  scroll(event) {
    event.preventDefault();
    const unit = [1, LINE_HEIGHT, this.plotArea.height][event.deltaMode];
    const steps = -event.deltaY * unit / WHEEL_STEP;
    const position = this.plotArea.toKernel(this.plotArea.pointerPosition(event));
    this.throttles.wheel.add({ ...position, steps, modifiers: modifiers(event) });
    this.actions.scheduleRest();
  }
  /**
   * Start a pinch, and cancel what the first finger has done.
   *
   * @param {PointerEvent} event
   */
  startPinch(event) {
    if (this.held) this.release(this.held, event, true, this.held.position);
    this.actions.movePointer(null);
    this.lastTap = null;
    this.pinch = this.measurePinch();
  }
  /** The midpoint of two fingers and the distance between them. */
  measurePinch() {
    const [one, other] = [...this.fingers.values()];
    return { x: (one.x + other.x) / 2, y: (one.y + other.y) / 2, spread: Math.max(1, distance(one, other)) };
  }
  /** @param {Pixel & { spread: number }} before */
  updatePinch(before) {
    const now = this.measurePinch();
    const [midpoint, midpointBefore] = [this.plotArea.toKernel(now), this.plotArea.toKernel(before)];
    const [dx, dz] = [midpoint.x - midpointBefore.x, midpoint.y - midpointBefore.y];
    this.throttles.pinch.add({ ...midpoint, factor: now.spread / before.spread, dx, dz, touch: true });
    this.pinch = now;
    this.actions.scheduleRest();
  }
};
function buttonOf({ button, pan }) {
  return pan ? { button, pan } : { button };
}

// shared/unscaled.js
function unscaledSize(element2) {
  const { width, height } = getComputedStyle(element2);
  return { width: Number.parseFloat(width), height: Number.parseFloat(height) };
}
function unscaledPosition(event, element2, { width, height }) {
  const box = element2.getBoundingClientRect();
  return {
    x: (event.clientX - box.left) * width / box.width,
    y: (event.clientY - box.top) * height / box.height
  };
}

// pointer_layer/menu.js
function openMenu(el, labels, position, choose) {
  const open = el.querySelector(":scope > .menu");
  if (open?.contains(document.activeElement)) document.activeElement.blur();
  open?.remove();
  const menu = document.createElement("div");
  let isClosed = false;
  let isPressed = false;
  menu.className = "menu";
  menu.setAttribute("role", "menu");
  const items = labels.map((label, index) => {
    const item = document.createElement("button");
    item.setAttribute("role", "menuitem");
    item.textContent = label;
    item.addEventListener("click", ({ detail }) => {
      if (detail && !isPressed) return;
      close();
      choose(index);
    });
    menu.append(item);
    return item;
  });
  function close(isKept = true) {
    if (isClosed) return;
    isClosed = true;
    menu.remove();
    if (isKept) el.querySelector(".plot")?.focus({ preventScroll: true });
  }
  menu.addEventListener("pointerdown", () => {
    isPressed = true;
  });
  menu.addEventListener("keydown", (event) => {
    const index = items.indexOf(
      /** @type {HTMLButtonElement} */
      document.activeElement
    );
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (event.key === "Escape") close();
    else if (step) items[(index + step + items.length) % items.length].focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  menu.addEventListener("focusout", ({ relatedTarget }) => {
    if (!menu.contains(
      /** @type {Node | null} */
      relatedTarget
    )) close(false);
  });
  menu.addEventListener("contextmenu", (event) => event.preventDefault());
  el.append(menu);
  menu.popover = "manual";
  menu.showPopover();
  place(menu, el, position);
  items[0]?.focus({ preventScroll: true });
}
function place(menu, el, position) {
  const [box, size] = [el.getBoundingClientRect(), menu.getBoundingClientRect()];
  const scale = box.width / unscaledSize(el).width;
  const zoom = (
    /** @type {{ currentCSSZoom?: number }} */
    menu.currentCSSZoom ?? 1
  );
  const [left, top] = [box.left + position.x * scale, box.top + position.y * scale];
  menu.style.left = `${Math.max(0, Math.min(left, window.innerWidth - size.width)) / zoom}px`;
  menu.style.top = `${Math.max(0, Math.min(top, window.innerHeight - size.height)) / zoom}px`;
}

// shared/svg.js
var NAMESPACE = "http://www.w3.org/2000/svg";
var PALE = 170;
function append(parent, tag, className, attributes = {}) {
  const element2 = document.createElementNS(NAMESPACE, tag);
  element2.setAttribute("class", className);
  for (const [name, value] of Object.entries(attributes)) element2.setAttribute(name, String(value));
  parent.append(element2);
  return element2;
}
function appendText(parent, className, attributes, content) {
  const text = append(parent, "text", className, attributes);
  text.textContent = content;
  return text;
}
var paleColours = /* @__PURE__ */ new Map();
function togglePale(text, coloured, colour) {
  let isPale = paleColours.get(colour);
  if (isPale === void 0) {
    const [red, green, blue] = (getComputedStyle(coloured).fill.match(/\d+/g) ?? [0, 0, 0]).map(Number);
    isPale = 0.299 * red + 0.587 * green + 0.114 * blue > PALE;
    paleColours.set(colour, isPale);
  }
  text.classList.toggle("pale", isPale);
}
function pathData(points) {
  let command = "M";
  let data = "";
  for (const point of points) {
    if (point) data += `${command}${point.x.toFixed(2)},${point.y.toFixed(2)}`;
    command = point ? "L" : "M";
  }
  return data;
}

// pointer_layer/axes.js
function drawAxes(group, axes, plotArea) {
  group.replaceChildren();
  if (!axes.x || !axes.z || axes.left === void 0) return;
  const { width, height, kernelScale } = plotArea;
  const { x: across, z: down } = axes;
  append(group, "rect", "frame", { x: 0, y: 0, width, height });
  across.pixels.forEach((pixel, i) => {
    const x = pixel / kernelScale.x;
    append(group, "line", "tick", { x1: x, x2: x, y1: height, y2: height + 5 });
    appendText(group, "label middle", { x, y: height + 17 }, across.labels[i]);
  });
  down.pixels.forEach((pixel, i) => {
    const y = pixel / kernelScale.y;
    append(group, "line", "tick", { x1: -5, x2: 0, y1: y, y2: y });
    appendText(group, "label end", { x: -8, y: y + 4 }, down.labels[i]);
  });
  appendText(group, "title middle", { x: width / 2, y: height + 35 }, across.title);
  const upwards = `translate(${-axes.left + 13} ${height / 2}) rotate(-90)`;
  appendText(group, "title middle", { transform: upwards }, down.title);
}

// pointer_layer/cursors.js
function drawCross(group, pointer, { width, height }) {
  group.replaceChildren();
  if (!pointer) return;
  for (const className of ["halo", "cross"]) {
    append(group, "line", className, { x1: pointer.x, x2: pointer.x, y1: 0, y2: height });
    append(group, "line", className, { x1: 0, x2: width, y1: pointer.y, y2: pointer.y });
  }
}
function drawRubberBand(group, rubber, pointer, plotArea) {
  group.replaceChildren();
  if (!pointer || !rubber.length) return;
  const d = pathData([...rubber.map((point) => plotArea.toPixels(...point)), pointer]);
  for (const className of ["halo", "rubber"]) append(group, "path", className, { d });
}

// pointer_layer/handles.js
var REACH = 12;
function nearestHandle(handles, pointer) {
  let [nearest, least] = [
    /** @type {Handle | undefined} */
    void 0,
    REACH
  ];
  for (const handle of pointer ? handles : []) {
    const distance2 = Math.hypot(handle.x - (pointer?.x ?? 0), handle.y - (pointer?.y ?? 0));
    if (distance2 <= least) [nearest, least] = [handle, distance2];
  }
  return nearest;
}
function drawGrown(group, handle) {
  group.replaceChildren();
  if (!handle) return;
  const { x, y, colour, text } = handle;
  const disc = append(group, "circle", "disc", { cx: x, cy: y, r: text ? 8 : 5.5, fill: colour });
  if (text) togglePale(appendText(group, "number", { x, y: y + 3.5 }, text), disc, colour);
}

// picture/painter.js
var FULL = 256;
var OPAQUE = 4278190080;
var Painter = class {
  /**
   * @param {Uint32Array} pixels
   * @param {number} width
   * @param {Texture} texture
   * @param {Colours} colours
   * @param {Deformation} deformation
   */
  constructor(pixels, width, texture, colours, deformation) {
    this.pixels = pixels;
    this.width = width;
    this.texture = texture;
    this.factor = colours.factor;
    this.colours = new Uint32Array(colours.palette.buffer, colours.palette.byteOffset, 256);
    this.tints = tints(deformation);
    this.levelsPerLog = 127 / Math.log(deformation.span);
    this.sample = texture.hasGaps ? this.sampleBesideGaps : this.sampleWhole;
  }
  /**
   * Paint a run of pixels from samples on a straight line.
   *
   * @param {number} row
   * @param {number} column
   * @param {number} count
   * @param {number} x in samples of the section
   * @param {number} z
   * @param {number} dx
   * @param {number} dz
   */
  paint(row, column, count, x, z, dx, dz) {
    const { stepX, stepZ } = this.texture;
    const [u, v] = [(x + 0.5) / stepX - 0.5, (z + 0.5) / stepZ - 0.5];
    this.sample(row * this.width + column, count, u, v, dx / stepX, dz / stepZ);
  }
  /**
   * @param {number} start
   * @param {number} count
   * @param {number} u
   * @param {number} v
   * @param {number} du
   * @param {number} dv
   */
  sampleWhole(start2, count, u, v, du, dv) {
    const { pixels, colours, factor } = this;
    const { data, width, height } = this.texture;
    const [lastX, lastZ] = [width - 1, height - 1];
    for (let i = 0; i < count; i++) {
      const x = Math.min(Math.max(u + i * du, 0), lastX);
      const z = Math.min(Math.max(v + i * dv, 0), lastZ);
      const left = x | 0;
      const above = z | 0;
      const at = above * width + left;
      const right = left < lastX ? 1 : 0;
      const below = above < lastZ ? width : 0;
      const upper = data[at] + (x - left) * (data[at + right] - data[at]);
      const lower = data[at + below] + (x - left) * (data[at + below + right] - data[at + below]);
      const level = 128.5 + factor * (upper + (z - above) * (lower - upper));
      pixels[start2 + i] = colours[Math.min(Math.max(level, 1), 255) | 0];
    }
  }
  /**
   * As `sampleWhole`, from the samples that have data, if these make up half of the weight.
   *
   * @param {number} start
   * @param {number} count
   * @param {number} u
   * @param {number} v
   * @param {number} du
   * @param {number} dv
   */
  sampleBesideGaps(start2, count, u, v, du, dv) {
    const { pixels, colours, factor, texture } = this;
    for (let i = 0; i < count; i++) {
      const value = meanOfData(texture, u + i * du, v + i * dv);
      const level = 128.5 + factor * value;
      pixels[start2 + i] = colours[value === NO_DATA ? 0 : Math.min(Math.max(level, 1), 255) | 0];
    }
  }
  /**
   * Lay the colour of an area ratio over a run of pixels.
   *
   * @param {number} row
   * @param {number} column
   * @param {number} count
   * @param {number} logRatio
   */
  tint(row, column, count, logRatio) {
    const { pixels } = this;
    const level = 128 + Math.round(Math.max(-127, Math.min(logRatio * this.levelsPerLog, 127)));
    const colour = this.tints.colours[level];
    const rest = this.tints.rests[level];
    if (rest === FULL) return;
    const start2 = row * this.width + column;
    for (let i = start2; i < start2 + count; i++) {
      const under = pixels[i];
      if (under >>> 24 === 0) continue;
      const redBlue = Math.imul(under & 16711935, rest) >>> 8 & 16711935;
      const green = Math.imul(under & 65280, rest) >>> 8 & 65280;
      pixels[i] = (redBlue | green) + colour | OPAQUE;
    }
  }
};
function tints({ palette, opacity }) {
  const colours = new Uint32Array(256);
  const rests = new Uint16Array(256);
  for (let level = 0; level < 256; level++) {
    const [red, green, blue, opaque] = palette.subarray(4 * level, 4 * level + 4);
    const alpha = opaque / 255 * opacity;
    rests[level] = Math.round(FULL * (1 - alpha));
    colours[level] = alpha * red | alpha * green << 8 | alpha * blue << 16;
  }
  return { colours, rests };
}
function meanOfData({ data, width, height }, u, v) {
  const x = Math.min(Math.max(u, 0), width - 1);
  const z = Math.min(Math.max(v, 0), height - 1);
  const [left, above] = [x | 0, z | 0];
  const [right, below] = [Math.min(left + 1, width - 1), Math.min(above + 1, height - 1)];
  let [sum, share] = [0, 0];
  for (const [column, weightX] of [
    [left, 1 - x + left],
    [right, x - left]
  ]) {
    for (const [row, weightZ] of [
      [above, 1 - z + above],
      [below, z - above]
    ]) {
      const value = data[row * width + column];
      if (value === NO_DATA) continue;
      sum += weightX * weightZ * value;
      share += weightX * weightZ;
    }
  }
  return share < 0.5 ? NO_DATA : sum / share;
}

// picture/spans.js
var TOLERANCE = 1e-5;
function forEachSpan(corners, triangles, { width, height }, visit) {
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
      const bent = row >= middleY ? crossing(middleX, middleY, bottomX, bottomY, row) : crossing(topX, topY, middleX, middleY, row);
      const first = Math.max(Math.ceil(Math.min(straight, bent) - TOLERANCE), 0);
      const last = Math.min(Math.floor(Math.max(straight, bent) + TOLERANCE), width - 1);
      if (first <= last) visit(i / 3, row, first, last);
    }
  }
}
function toGrid(vertices, { left, top, stepX, stepZ }) {
  const result = new Float64Array(vertices.length);
  for (let i = 0; i < vertices.length; i += 2) {
    result[i] = snapped((vertices[i] - left) / stepX);
    result[i + 1] = snapped((vertices[i + 1] - top) / stepZ);
  }
  return result;
}
function snapped(position) {
  const node = Math.round(position);
  return Math.abs(position - node) <= TOLERANCE ? node : position;
}
function downwards(corners, triangles, i) {
  let [a, b, c] = [2 * triangles[i], 2 * triangles[i + 1], 2 * triangles[i + 2]];
  if (corners[b + 1] < corners[a + 1]) [a, b] = [b, a];
  if (corners[c + 1] < corners[b + 1]) [b, c] = [c, b];
  if (corners[b + 1] < corners[a + 1]) [a, b] = [b, a];
  return [a, b, c];
}
function isSolid(ax, ay, bx, by, cx, cy) {
  const longest = Math.max(Math.max(ax, bx, cx) - Math.min(ax, bx, cx), cy - ay);
  return Math.abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) > TOLERANCE * longest;
}
function crossing(fromX, fromY, toX, toY, row) {
  const share = (row - fromY) / Math.max(toY - fromY, Number.MIN_VALUE);
  return fromX + Math.max(0, Math.min(share, 1)) * (toX - fromX);
}

// picture/tracer.js
var Tracer = class {
  /**
   * @param {PiecewiseAffineMap[]} maps at least one
   * @param {TakeRun} takeRun
   */
  constructor(maps, takeRun) {
    this.levels = maps.map(({ finder, target, logRatios }) => ({ finder, affine: affine(finder, target), logRatios }));
    this.takeRun = takeRun;
    this.starts = maps.map(() => 0);
  }
  /** @param {Grid} grid */
  trace(grid) {
    const { finder } = this.levels[0];
    forEachSpan(toGrid(finder.vertices, grid), finder.triangles, grid, (triangle, row, first, last) => {
      const [x, z] = [grid.left + first * grid.stepX, grid.top + row * grid.stepZ];
      this.carry(0, triangle, row, first, last - first + 1, x, z, grid.stepX, 0, 0);
    });
  }
  /**
   * Carry pixels that one triangle of a map holds to the next map.
   *
   * @param {number} level
   * @param {number} triangle
   * @param {number} row
   * @param {number} column
   * @param {number} count
   * @param {number} x
   * @param {number} z
   * @param {number} dx
   * @param {number} dz
   * @param {number} logRatio
   */
  carry(level, triangle, row, column, count, x, z, dx, dz, logRatio) {
    const { affine: affine2, logRatios } = this.levels[level];
    const at = 8 * triangle;
    const right = x - affine2[at];
    const down = z - affine2[at + 1];
    const newX = affine2[at + 2] + affine2[at + 4] * right + affine2[at + 5] * down;
    const newZ = affine2[at + 3] + affine2[at + 6] * right + affine2[at + 7] * down;
    const newDx = affine2[at + 4] * dx + affine2[at + 5] * dz;
    const newDz = affine2[at + 6] * dx + affine2[at + 7] * dz;
    const sum = logRatio + logRatios[triangle];
    if (level + 1 === this.levels.length) this.takeRun(row, column, count, newX, newZ, newDx, newDz, sum);
    else this.split(level + 1, row, column, count, newX, newZ, newDx, newDz, sum);
  }
  /**
   * Split pixels on a straight line into those of each triangle of a map.
   *
   * @param {number} level
   * @param {number} row
   * @param {number} column
   * @param {number} count
   * @param {number} x
   * @param {number} z
   * @param {number} dx
   * @param {number} dz
   * @param {number} logRatio
   */
  split(level, row, column, count, x, z, dx, dz, logRatio) {
    const { finder } = this.levels[level];
    let triangle = this.starts[level];
    let done = 0;
    while (done < count) {
      const nextX = x + done * dx;
      const nextZ = z + done * dz;
      const held = finder.walk(triangle, nextX, nextZ);
      if (held < 0) {
        done++;
        continue;
      }
      if (done === 0) this.starts[level] = held;
      const inside = Math.min(stepsInside(finder, held, nextX, nextZ, dx, dz), count - done);
      this.carry(level, held, row, column + done, inside, nextX, nextZ, dx, dz, logRatio);
      triangle = held;
      done += inside;
    }
  }
};
function stepsInside({ coefficients, tolerance }, triangle, x, z, dx, dz) {
  const at = 6 * triangle;
  const right = x - coefficients[at];
  const down = z - coefficients[at + 1];
  const b = coefficients[at + 2] * right + coefficients[at + 3] * down;
  const c = coefficients[at + 4] * right + coefficients[at + 5] * down;
  const db = coefficients[at + 2] * dx + coefficients[at + 3] * dz;
  const dc = coefficients[at + 4] * dx + coefficients[at + 5] * dz;
  const da = -db - dc;
  let steps = Number.POSITIVE_INFINITY;
  if (da < 0) steps = (1 - b - c + tolerance) / -da;
  if (db < 0) steps = Math.min(steps, (b + tolerance) / -db);
  if (dc < 0) steps = Math.min(steps, (c + tolerance) / -dc);
  return Math.max(1, Math.floor(steps) + 1);
}
function affine({ coefficients, triangles }, target) {
  const result = new Float64Array(8 * triangles.length / 3);
  for (let i = 0, from = 0, to = 0; i < triangles.length; i += 3, from += 6, to += 8) {
    const a = 2 * triangles[i];
    const b = 2 * triangles[i + 1];
    const c = 2 * triangles[i + 2];
    for (let axis = 0; axis < 2; axis++) {
      const origin = target[a + axis];
      const along = target[b + axis] - origin;
      const across = target[c + axis] - origin;
      result[to + axis] = coefficients[from + axis];
      result[to + 2 + axis] = origin;
      result[to + 4 + 2 * axis] = along * coefficients[from + 2] + across * coefficients[from + 4];
      result[to + 5 + 2 * axis] = along * coefficients[from + 3] + across * coefficients[from + 5];
    }
  }
  return result;
}

// picture/scene.js
function drawSection(pixels, size, scene) {
  const { painter, grid, isTinted } = prepare(pixels, size, scene);
  if (!scene.isRestored || !scene.maps.length) return drawPresentDay(painter, grid, scene.texture.section);
  new Tracer(scene.maps, (row, column, count, x, z, dx, dz, logRatio) => {
    painter.paint(row, column, count, x, z, dx, dz);
    if (isTinted) painter.tint(row, column, count, -logRatio);
  }).trace(grid);
}
function drawRatios(pixels, size, scene) {
  const { painter, grid, isTinted } = prepare(pixels, size, scene);
  if (!scene.maps.length || !isTinted) return;
  new Tracer(scene.maps, (row, column, count, _x, _z, _dx, _dz, logRatio) => {
    painter.tint(row, column, count, logRatio);
  }).trace(grid);
}
function prepare(pixels, size, { texture, window: [left, right, top, bottom], colours, deformation }) {
  const [stepX, stepZ] = [(right - left) / size.width, (bottom - top) / size.height];
  const grid = { left: left + stepX / 2, top: top + stepZ / 2, stepX, stepZ, ...size };
  const painter = new Painter(pixels, size.width, texture.reducedTo(stepX, stepZ), colours, deformation);
  return { painter, grid, isTinted: deformation.opacity > 0 };
}
function drawPresentDay(painter, { left, top, stepX, stepZ, width, height }, section) {
  const [first, last] = within(left, stepX, width, section.width);
  const [firstRow, lastRow] = within(top, stepZ, height, section.height);
  const count = last - first + 1;
  if (count < 1) return;
  for (let row = firstRow; row <= lastRow; row++)
    painter.paint(row, first, count, left + first * stepX, top + row * stepZ, stepX, 0);
}
function within(start2, step, pixels, samples) {
  const first = Math.ceil((-0.5 - start2) / step - 1e-9);
  const last = Math.floor((samples - 0.5 - start2) / step + 1e-9);
  return [Math.max(first, 0), Math.min(last, pixels - 1)];
}

// pointer_layer/live_pane.js
var LONGEST_HOLD = 1e3;
var SLOW = 10;
var SAVED = 3;
var SOON = 200;
var PARTS_BY_TRAIT = {
  stages: ["picture", "mesh", "strokes", "marks", "cursors", "note"],
  frame: ["picture", "mesh", "strokes", "marks", "cursors", "note"],
  texture: ["picture"],
  revision: ["picture"],
  picture: ["picture", "mesh"],
  colours: ["picture"],
  deformation: ["picture"],
  bare: ["bare", "picture"],
  changing: []
  // draws what was held back
};
var LivePane = class {
  /**
   * @param {import("./types.js").Model} model of the pane's layer
   * @param {HTMLElement} el
   * @param {(parts: Part[]) => void} requestDraw
   */
  constructor(model, el, requestDraw) {
    this.isRestored = model.get("restored");
    this.layer = model;
    this.requestDraw = requestDraw;
    this.last = { time: 0, start: -Infinity, took: 0 };
    this.isSkipping = false;
    this.refining = void 0;
    this.model = null;
    this.canvas = document.createElement("canvas");
    this.leastRatio = 1;
    this.pixels = new ImageData(1, 1);
    this.base = [];
    this.section = new Uint32Array(0);
    this.heldAt = -Infinity;
    this.isStopped = false;
    this.isBareAlone = false;
    this.stop = () => {
      this.isStopped = true;
    };
    const reference = model.get("picture");
    if (reference) this.start(model.widget_manager.get_model(reference.replace("IPY_MODEL_", "")), el);
  }
  /**
   * @param {Promise<import("../picture/types.js").PictureModel>} promise
   * @param {HTMLElement} el
   */
  async start(promise, el) {
    this.canvas.className = "seiswidgets-plot";
    el.prepend(this.canvas);
    const model = await promise;
    if (this.isStopped) return;
    this.model = model;
    const handlers = Object.entries(PARTS_BY_TRAIT).map(([trait, parts]) => [
      `change:${trait}`,
      trait === "stages" && !this.isRestored ? () => requestAnimationFrame(() => this.requestDraw(parts)) : () => this.requestDraw(parts)
    ]);
    handlers.push(["change:changing", () => this.heldAt = performance.now()]);
    for (const [name, handler] of handlers) model.on(name, handler);
    this.stop = () => {
      clearTimeout(this.refining);
      for (const [name, handler] of handlers) model.off(
        /** @type {"change:frame"} */
        name,
        handler
      );
    };
    this.requestDraw(["picture", "mesh"]);
  }
  /** The picture, once its own script has run. */
  get picture() {
    return this.model?.get("picture") ?? null;
  }
  /** True while the kernel is changing several things that are to be seen at once. */
  get isHeld() {
    return Boolean(this.model?.get("changing")) && performance.now() - this.heldAt < LONGEST_HOLD;
  }
  /** True while nothing but the section is to be seen, in all panes that share the picture. */
  get isBare() {
    return Boolean(this.model ? this.model.get("bare") : this.isBareAlone);
  }
  /** @param {boolean} isBare */
  showBare(isBare) {
    this.model?.set("bare", isBare);
    this.isBareAlone = isBare;
    this.requestDraw(["bare"]);
  }
  /** @param {import("./plot_area.js").PlotArea} plotArea */
  drawPicture({ width, height, pixelRatio, model }) {
    const { picture, canvas } = this;
    if (!picture) return;
    const start2 = performance.now();
    const coarse = this.coarseness(picture.time, start2);
    this.isSkipping = coarse > 1 && !this.isRestored && !this.isSkipping;
    if (this.isSkipping) return;
    const ratio = Math.max(pixelRatio, this.leastRatio) / coarse;
    const size = { width: Math.max(1, Math.round(width * ratio)), height: Math.max(1, Math.round(height * ratio)) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    if (this.pixels.width !== size.width || this.pixels.height !== size.height)
      this.pixels = new ImageData(size.width, size.height);
    const scene = picture.scene(this.isRestored, model.get("window"));
    this.drawScene(new Uint32Array(this.pixels.data.buffer), size, this.isBare ? withoutRatios(scene) : scene);
    canvas.getContext("2d")?.putImageData(this.pixels, 0, 0);
    const took = performance.now() - start2;
    this.last = { time: picture.time, start: start2, took: coarse > 1 ? took * SAVED : took };
  }
  /**
   * Screen pixels along the side of a picture's pixel: 1, or while time runs on a slow computer, 2. Then the picture is
   * drawn finely as soon as it stands still.
   *
   * @param {number} time
   * @param {number} now
   */
  coarseness(time, now) {
    clearTimeout(this.refining);
    const { last } = this;
    const isRunning = time !== last.time && now - last.start < SOON;
    if (!isRunning || last.took < SLOW) return 1;
    this.refining = setTimeout(() => this.requestDraw(["picture"]), SOON);
    return 2;
  }
  /**
   * Draw a scene; the section under the colours of the present-day pane is kept, since it stays the same in a drag.
   *
   * @param {Uint32Array} pixels
   * @param {{ width: number, height: number }} size
   * @param {import("../picture/scene.js").Scene} scene
   */
  drawScene(pixels, size, scene) {
    if (scene.isRestored) {
      drawSection(pixels.fill(0), size, scene);
      return;
    }
    const base = [scene.texture, scene.colours, size.width, size.height, ...scene.window];
    if (base.some((value, i) => value !== this.base[i])) {
      drawSection(pixels.fill(0), size, scene);
      this.base = base;
      this.section = pixels.slice();
    } else pixels.set(this.section);
    drawRatios(pixels, size, scene);
  }
  /** The moment that is shown, for the corner of the restored pane; empty at the end. */
  get moment() {
    const { picture } = this;
    if (!picture || !this.isRestored || picture.isAtEnd) return "";
    const step = Math.max(1, Math.ceil(picture.time));
    const share = Math.round(100 * (picture.time - step + 1));
    return picture.time ? ` · step ${step} of ${picture.chain.stages.length}, ${share}%` : " · present day";
  }
  get mesh() {
    return this.picture?.mesh(this.isRestored) ?? null;
  }
  /**
   * The place of a point of this pane in the other one; null if it has none or there is no picture.
   *
   * @param {SectionPoint} point
   */
  carried(point) {
    const { picture } = this;
    const carried = picture && carry(picture.maps(this.isRestored), picture.toSamples(point));
    return carried && picture.fromSamples(carried);
  }
  /**
   * Points of the restored section at the present time; they are sent as they are after some stage, or at the end.
   *
   * @template {[number, number] | null} Point
   * @param {Point[]} points
   * @returns {(Point | null)[]}
   */
  places(points) {
    const { picture } = this;
    const end = this.layer.get("stage") ?? picture?.chain.stages.length;
    if (!picture || !this.isRestored || picture.time === end) return points;
    return points.map((point) => {
      const placed = point && picture.placed({ x: point[0], z: point[1] }, end);
      return placed && /** @type {Point} */
      [placed.x, placed.z];
    });
  }
  /** @param {[number, number][]} points */
  placedPoints(points) {
    return this.places(points).filter((point) => point !== null);
  }
  /** @param {import("./types.js").Stroke[]} strokes */
  placedStrokes(strokes) {
    return strokes.map((stroke) => ({ ...stroke, points: this.places(stroke.points) }));
  }
  /** @param {import("./types.js").Mark[]} marks */
  placedMarks(marks) {
    return marks.flatMap((mark) => this.places([[mark.x, mark.z]]).map((at) => at && { ...mark, x: at[0], z: at[1] })).filter((mark) => mark !== null);
  }
};
function withoutRatios(scene) {
  return { ...scene, deformation: { ...scene.deformation, opacity: 0 } };
}

// pointer_layer/marks.js
var PIN = "M0,0C-2,-6 -7,-9 -7,-14A7,7 0 1 1 7,-14C7,-9 2,-6 0,0Z";
var FLAG = 14;
var CROSS = "M-18,0H-6M6,0H18M0,-18V-6M0,6V18";
var DRAW = {
  cutoff(group, mark) {
    append(group, "circle", "disc", { r: 3.5, fill: mark.colour });
  },
  held(group, mark) {
    append(group, "path", "pin", { d: PIN, fill: mark.colour });
    append(group, "circle", "eye", { cy: -14, r: 2.5 });
  },
  finding(group, mark, y) {
    const isUp = y > FLAG + 18;
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
  }
};
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
function drawMarks(group, marks, plotArea, open) {
  group.replaceChildren();
  let flags = 0;
  for (const mark of marks) {
    const { x, y } = plotArea.toPixels(mark.x, mark.z);
    const element2 = append(group, "g", `mark ${mark.kind}`, { transform: `translate(${x} ${y})` });
    DRAW[mark.kind](element2, mark, y);
    if (mark.kind !== "finding") continue;
    const index = flags++;
    makeButton(element2, mark.text ?? "", () => open(index));
  }
}

// pointer_layer/mesh.js
var UNITS = 10;
function drawMesh(path, mesh, opacity, plotArea) {
  path.setAttribute("transform", `scale(${1 / UNITS})`);
  path.setAttribute("stroke-opacity", String(opacity));
  path.setAttribute("d", mesh && opacity > 0 ? visibleEdges(mesh.vertices, mesh.edges, plotArea) : "");
}
function visibleEdges(vertices, ends, plotArea) {
  const [xs, ys] = pathCoordinates(vertices, plotArea);
  const [width, height] = [UNITS * plotArea.width, UNITS * plotArea.height];
  let data = "";
  for (let i = 0; i < ends.length; i += 2) {
    const [a, b] = [ends[i], ends[i + 1]];
    const isBeside = xs[a] < 0 && xs[b] < 0 || xs[a] > width && xs[b] > width;
    const isAboveOrBelow = ys[a] < 0 && ys[b] < 0 || ys[a] > height && ys[b] > height;
    if (!isBeside && !isAboveOrBelow) data += `M${xs[a]},${ys[a]}L${xs[b]},${ys[b]}`;
  }
  return data;
}
function pathCoordinates(vertices, plotArea) {
  const count = vertices.length / 2;
  const [xs, ys] = [new Float64Array(count), new Float64Array(count)];
  for (let i = 0; i < count; i++) {
    const { x, y } = plotArea.toPixels(vertices[2 * i], vertices[2 * i + 1]);
    [xs[i], ys[i]] = [Math.round(UNITS * x), Math.round(UNITS * y)];
  }
  return [xs, ys];
}

// pointer_layer/plot_area.js
var MOST_ENLARGED = 4;
var PlotArea = class {
  /**
   * @param {Pick<import("./types.js").Model, "get">} model
   * @param {Element} plot
   */
  constructor(model, plot) {
    this.model = model;
    this.plot = plot;
    this.width = 0;
    this.height = 0;
    this.pixelRatio = 1;
  }
  /** Read the present size, before any scaling of the page; false if the plot area is not shown. */
  measure() {
    const { width, height } = unscaledSize(this.plot);
    if (!(width >= 1 && height >= 1)) return false;
    [this.width, this.height] = [width, height];
    this.pixelRatio = this.presentPixelRatio;
    return true;
  }
  get isReady() {
    return this.width > 0 && this.model.get("window").length === 4;
  }
  /**
   * @param {number} x
   * @param {number} z
   * @returns {Pixel}
   */
  toPixels(x, z) {
    const [left, right, top, bottom] = this.model.get("window");
    return { x: (x - left) / (right - left) * this.width, y: (z - top) / (bottom - top) * this.height };
  }
  /**
   * @param {Pixel} point
   * @returns {import("./types.js").SectionPoint}
   */
  toSection(point) {
    const [left, right, top, bottom] = this.model.get("window");
    return { x: left + point.x / this.width * (right - left), z: top + point.y / this.height * (bottom - top) };
  }
  /** The kernel's pixels per css pixel, along x and along y. */
  get kernelScale() {
    const [width, height] = this.model.get("size");
    return width && this.width ? { x: width / this.width, y: height / this.height } : { x: 1, y: 1 };
  }
  /**
   * @param {Pixel} point
   * @returns {Pixel}
   */
  toKernel(point) {
    const scale = this.kernelScale;
    return { x: point.x * scale.x, y: point.y * scale.y };
  }
  /** @param {Pixel} point */
  contains(point) {
    return point.x >= 0 && point.x <= this.width && point.y >= 0 && point.y <= this.height;
  }
  /**
   * The position of a mouse or finger.
   *
   * @param {MouseEvent} event
   * @returns {Pixel}
   */
  pointerPosition(event) {
    return unscaledPosition(event, this.plot, this);
  }
  /** Device pixels per css pixel, to three decimals; more on a page that is enlarged. To ask for it takes long. */
  get presentPixelRatio() {
    const enlarged = Math.min(MOST_ENLARGED, this.plot.getBoundingClientRect().width / this.width || 1);
    return Number(((globalThis.devicePixelRatio || 1) * enlarged).toFixed(3));
  }
};

// pointer_layer/shade.js
function drawShade(image, shade, plotArea) {
  if (!shade?.href || !shade.window) {
    image.removeAttribute("href");
    return;
  }
  const [left, right, top, bottom] = shade.window;
  const [first, last] = [plotArea.toPixels(left, top), plotArea.toPixels(right, bottom)];
  if (image.getAttribute("href") !== shade.href) image.setAttribute("href", shade.href);
  const place2 = { x: first.x, y: first.y, width: last.x - first.x, height: last.y - first.y, opacity: shade.opacity };
  for (const [name, value] of Object.entries(place2)) image.setAttribute(name, String(value));
}

// pointer_layer/near.js
function splitNear(line, centres2, radius) {
  if (!centres2.length) return { near: [], far: line };
  const parts = { near: [], far: [] };
  for (let i = 1; i < line.length; i++) {
    const [from, to] = [line[i - 1], line[i]];
    if (from && to) addSegment(parts, from, to, centres2, radius);
    else for (const part of [parts.near, parts.far]) part.push(null);
  }
  return withoutShort(parts, 2 * radius);
}
function withoutShort({ near, far }, least) {
  const runs = runsOf(far);
  const isShort = (run) => lengthOf(run) < least && [run[0], run[run.length - 1]].every((end) => near.some((one) => isSame(one, end)));
  const join = (kept) => kept.flatMap((run) => [...run, null]);
  return { near: [...near, null, ...join(runs.filter(isShort))], far: join(runs.filter((run) => !isShort(run))) };
}
function runsOf(line) {
  const runs = [];
  line.forEach((point, i) => {
    if (point && line[i - 1]) runs[runs.length - 1].push(point);
    else if (point) runs.push([point]);
  });
  return runs;
}
var lengthOf = (run) => run.reduce((sum, { x, y }, i) => sum + (i ? Math.hypot(x - run[i - 1].x, y - run[i - 1].y) : 0), 0);
var isSame = (one, other) => one !== null && one.x === other.x && one.y === other.y;
function addSegment({ near, far }, from, to, centres2, radius) {
  const at = (share) => ({
    x: from.x + share * (to.x - from.x),
    y: from.y + share * (to.y - from.y)
  });
  const shares = [0, ...centres2.flatMap((centre) => crossings(from, to, centre, radius)), 1].sort((a, b) => a - b);
  for (let i = 1; i < shares.length; i++) {
    const middle = at((shares[i - 1] + shares[i]) / 2);
    const isNear = centres2.some(({ x, y }) => Math.hypot(x - middle.x, y - middle.y) < radius);
    const [part, other] = isNear ? [near, far] : [far, near];
    if (!part.at(-1)) part.push(at(shares[i - 1]));
    part.push(at(shares[i]));
    if (other.at(-1)) other.push(null);
  }
}
function crossings(from, to, centre, radius) {
  const [dx, dy, x, y] = [to.x - from.x, to.y - from.y, from.x - centre.x, from.y - centre.y];
  const [a, b, c] = [dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - radius * radius];
  const root = Math.sqrt(b * b - a * c);
  return [(-b - root) / a, (-b + root) / a].filter((share) => share > 0 && share < 1);
}

// pointer_layer/strokes.js
var NEAR = 14;
var DOT = { beyond: 0.75, halo: 1.25, distance: 10 };
var HALO = 1.5;
var LABEL_MARGIN = 4;
var LABEL_OFFSET = 9;
var CAPITAL_HEIGHT = 10;
var USUAL = { dots: false, dash: [], label: "", chosen: null, joined: true };
function decodeStroke({ origin, points, ...look }) {
  const offsets = toNumbers(points, Float32Array);
  const decoded = Array.from({ length: offsets.length / 2 }, (_, i) => {
    const [x, z] = [origin[0] + offsets[2 * i], origin[1] + offsets[2 * i + 1]];
    return Number.isNaN(x) ? null : (
      /** @type {[number, number]} */
      [x, z]
    );
  });
  return { ...USUAL, ...look, points: decoded };
}
function drawStrokes(group, strokes, plotArea, cutoffs) {
  group.replaceChildren();
  const handles = [];
  const lines = append(group, "g", "lines");
  const labels = append(group, "g", "labels");
  for (const stroke of strokes) {
    const pixels = stroke.points.map((point) => point && plotArea.toPixels(...point));
    const element2 = append(lines, "g", "stroke");
    if (stroke.joined) drawLine(element2, stroke, pixels, cutoffs);
    if (stroke.dots) handles.push(...drawDots(element2, stroke, pixels));
    if (stroke.label) drawLabel(labels, stroke, pixels, plotArea);
  }
  return handles;
}
function drawLine(group, { colour, width, dash }, pixels, cutoffs) {
  const { near, far } = splitNear(pixels, cutoffs, NEAR);
  const thick = { d: pathData(far), "stroke-dasharray": dash.join(" ") };
  append(group, "path", "halo", { ...thick, "stroke-width": width + 2 * HALO });
  append(group, "path", "line", { ...thick, "stroke-width": width, stroke: colour });
  const thin = pathData(near);
  if (thin) append(group, "path", "thin", { d: thin, stroke: colour });
}
function drawDots(group, { colour, width, chosen }, pixels) {
  const radius = width / 2 + DOT.beyond;
  const shown = thinned(pixels, chosen ?? -1, DOT.distance);
  const d = dotData(shown);
  append(group, "path", "halo", { d, "stroke-width": 2 * (radius + DOT.halo) });
  append(group, "path", "dots", { d, "stroke-width": 2 * radius, stroke: colour });
  const selected = pixels[chosen ?? -1];
  if (selected) append(group, "circle", "chosen", { cx: selected.x, cy: selected.y, r: radius + 3, stroke: colour });
  return shown.map((pixel) => ({ ...pixel, colour }));
}
function thinned(pixels, chosen, distance2) {
  const kept = [];
  pixels.forEach((pixel, index) => {
    const last = kept.at(-1);
    const isFar = pixel && last ? Math.hypot(pixel.x - last.x, pixel.y - last.y) >= distance2 : true;
    if (pixel && (isFar || index === chosen)) kept.push(pixel);
  });
  return kept;
}
function dotData(pixels) {
  return pixels.map(({ x, y }) => `M${x.toFixed(2)},${y.toFixed(2)}h0`).join("");
}
function drawLabel(group, stroke, pixels, plotArea) {
  const start2 = firstVisible(pixels, plotArea);
  if (!start2) return;
  const label = appendText(group, "name", {}, stroke.label);
  label.style.fill = stroke.colour;
  togglePale(label, label, stroke.colour);
  const { x, y } = labelPosition(start2, lengthOf2(label, stroke.label), plotArea);
  label.setAttribute("x", String(x));
  label.setAttribute("y", String(y));
}
var lengths = /* @__PURE__ */ new Map();
function lengthOf2(label, content) {
  const length = lengths.get(content) ?? label.getComputedTextLength();
  if (length > 0) lengths.set(content, length);
  return length;
}
function labelPosition(point, length, { width, height }) {
  const right = Math.min(point.x + LABEL_OFFSET, width - length - LABEL_MARGIN);
  const bottom = Math.min(point.y - LABEL_OFFSET, height - LABEL_MARGIN);
  return { x: Math.max(LABEL_MARGIN, right), y: Math.max(CAPITAL_HEIGHT + LABEL_MARGIN, bottom) };
}
function firstVisible(pixels, plotArea) {
  const vertex = pixels.find((pixel) => pixel && plotArea.contains(pixel));
  if (vertex) return vertex;
  for (let i = 1; i < pixels.length; i++) {
    const [from, to] = [pixels[i - 1], pixels[i]];
    const entry = from && to && entryPoint(from, to, plotArea);
    if (entry) return entry;
  }
  return null;
}
function entryPoint(from, to, { width, height }) {
  const sides = [
    { start: from.x, change: to.x - from.x, size: width },
    { start: from.y, change: to.y - from.y, size: height }
  ];
  let [first, last] = [0, 1];
  for (const { start: start2, change, size } of sides) {
    if (change === 0) {
      if (start2 < 0 || start2 > size) return null;
      continue;
    }
    const [one, other] = [-start2 / change, (size - start2) / change];
    [first, last] = [Math.max(first, Math.min(one, other)), Math.min(last, Math.max(one, other))];
  }
  return first <= last ? { x: from.x + first * (to.x - from.x), y: from.y + first * (to.y - from.y) } : null;
}

// pointer_layer/view.js
var REST = 250;
var ALL_PARTS = ["axes", "note", "picture", "bare", "mesh", "strokes", "marks", "cursors"];
var PARTS_BY_TRAIT2 = {
  axes: ["axes", "note"],
  label: ["axes"],
  size: ["axes"],
  window: ["picture", "mesh", "strokes", "marks", "cursors"],
  strokes: ["strokes"],
  changed_strokes: ["strokes"],
  marks: ["strokes", "marks"],
  // lines are thin near cut-offs
  mesh: ["mesh"],
  mesh_opacity: ["mesh"],
  stage: ["strokes", "marks"],
  shade: ["mesh"],
  rubber: ["cursors"],
  linked: ["cursors"]
};
function createElements(el) {
  el.classList.add("seiswidgets-layer");
  const plot = append(el, "svg", "plot", { tabindex: 0, role: "application" });
  const axes = append(plot, "g", "axes");
  const inside = append(plot, "svg", "inside", { width: "100%", height: "100%" });
  const shade = append(inside, "image", "shade", { preserveAspectRatio: "none" });
  const mesh = append(inside, "path", "mesh");
  const [strokes, marks, grown, linked, own, band] = ["strokes", "marks", "grown", "linked", "own", "band"].map(
    (name) => append(inside, "g", name)
  );
  const note = document.createElement("div");
  note.className = "note";
  el.append(note);
  return { plot, axes, shade, mesh, strokes, marks, grown, linked, own, band, note };
}
var LayerView = class {
  /**
   * @param {import("./types.js").Model} model
   * @param {HTMLElement} el
   */
  constructor(model, el) {
    this.model = model;
    this.el = el;
    this.elements = createElements(el);
    this.plotArea = new PlotArea(model, this.elements.plot);
    this.pointer = null;
    this.maps = null;
    this.decoded = { states: null, strokes: [] };
    this.handles = [];
    this.live = new LivePane(model, el, (parts) => this.requestDraw(parts));
    this.outdated = /* @__PURE__ */ new Set();
    this.isScheduled = false;
    this.hasReported = false;
    this.restTimer = void 0;
  }
  /**
   * Draw parts in the next frame, once however often they are requested.
   *
   * @param {Part[]} parts
   */
  requestDraw(parts) {
    for (const part of parts) this.outdated.add(part);
    if (this.isScheduled || !this.outdated.size) return;
    this.isScheduled = true;
    requestAnimationFrame(() => {
      this.isScheduled = false;
      this.draw();
    });
  }
  /** Draw everything outdated at once; while the kernel is changing several things, only what follows the pointer. */
  draw() {
    const { plotArea, outdated } = this;
    const isHeld = this.live.isHeld;
    this.outdated = new Set(isHeld ? [...outdated].filter((part) => part !== "cursors") : []);
    if (!plotArea.isReady) return;
    if (!isHeld) this.drawParts(outdated);
    if (outdated.has("cursors")) this.drawCursors();
  }
  /** @param {Set<Part>} outdated */
  drawParts(outdated) {
    const { model, plotArea, elements, live } = this;
    if (outdated.has("axes")) this.drawAxes();
    if (outdated.has("note")) elements.note.textContent = (model.get("axes").note ?? "") + live.moment;
    if (outdated.has("picture")) live.drawPicture(plotArea);
    if (outdated.has("mesh")) this.drawMesh();
    if (outdated.has("bare")) this.el.classList.toggle("bare", live.isBare);
    const marks = live.placedMarks(model.get("marks"));
    if (outdated.has("strokes")) this.drawLines(marks);
    if (outdated.has("marks"))
      drawMarks(elements.marks, marks, plotArea, (index) => model.send({ kind: "finding", key: String(index) }));
  }
  drawMesh() {
    const opacity = this.model.get("mesh_opacity");
    drawShade(this.elements.shade, this.model.get("shade"), this.plotArea);
    drawMesh(this.elements.mesh, opacity > 0 ? this.mesh : null, opacity, this.plotArea);
  }
  /** @param {import("./types.js").Mark[]} marks */
  drawLines(marks) {
    const cutoffs = marks.filter(({ kind }) => kind === "cutoff").map(({ x, z, colour, text }) => ({ ...this.plotArea.toPixels(x, z), colour, text }));
    const { strokes } = this.elements;
    this.handles = [...drawStrokes(strokes, this.live.placedStrokes(this.strokes), this.plotArea, cutoffs), ...cutoffs];
    this.growHandle();
  }
  /** Draw the handle at the pointer large. */
  growHandle() {
    drawGrown(this.elements.grown, nearestHandle(this.handles, this.pointer));
  }
  /** The strokes, decoded once, those that have changed replaced. */
  get strokes() {
    const states = this.model.get("strokes");
    if (this.decoded.states !== states) this.decoded = { states, strokes: states.map(decodeStroke) };
    const strokes = [...this.decoded.strokes];
    for (const { index, ...state } of this.model.get("changed_strokes") ?? []) strokes[index] = decodeStroke(state);
    return strokes;
  }
  get mesh() {
    const { vertices, edges } = this.model.get("mesh");
    if (!vertices || !edges) return this.live.mesh;
    return { vertices: toNumbers(vertices, Float64Array), edges: toNumbers(edges, Uint32Array) };
  }
  drawAxes() {
    const axes = this.model.get("axes");
    drawAxes(this.elements.axes, axes, this.plotArea);
    this.elements.plot.setAttribute("aria-label", this.model.get("label"));
  }
  drawCursors() {
    const { x, z } = this.model.get("linked");
    const linked = x === void 0 || z === void 0 ? null : this.plotArea.toPixels(x, z);
    this.growHandle();
    drawCross(this.elements.own, this.pointer, this.plotArea);
    drawCross(this.elements.linked, linked, this.plotArea);
    drawRubberBand(
      this.elements.band,
      this.live.placedPoints(this.model.get("rubber")),
      this.pointer ?? linked,
      this.plotArea
    );
  }
  /** @param {import("./types.js").Pixel | null} position */
  movePointer(position) {
    this.pointer = position;
    this.carryPointer();
    this.requestDraw(["cursors"]);
  }
  /** Draw for the present scale of the page: no event tells that it has changed. */
  followScale() {
    if (this.plotArea.presentPixelRatio !== this.plotArea.pixelRatio) this.reportSize();
  }
  /** Set the carried position. It is never saved: other layers need it, the kernel does not. */
  carryPointer() {
    if (!this.plotArea.isReady) return;
    this.maps ??= this.model.get("chain").map((state) => PiecewiseAffineMap.fromState(state));
    const point = this.pointer && this.plotArea.toSection(this.pointer);
    const carried = point && (this.live.picture ? this.live.carried(point) : carry(this.maps, point));
    this.model.set("carried", carried ?? {});
  }
  /**
   * Send a message about an event to the kernel. A key has no position of its own: it is sent with the pointer's.
   *
   * @type {import("./keyboard.js").Send}
   */
  send(kind, event, more = {}) {
    const middle = kind === "menu" ? { x: this.plotArea.width / 2, y: this.plotArea.height / 2 } : null;
    const position = "clientX" in event ? this.plotArea.pointerPosition(event) : this.pointer ?? middle;
    const touch = "pointerType" in event && event.pointerType === "touch";
    const kernelPosition = position ? this.plotArea.toKernel(position) : {};
    this.model.send({ kind, ...kernelPosition, modifiers: modifiers(event), touch, ...more });
  }
  /** Tell the kernel a moment after the last wheel step or drag. */
  scheduleRest() {
    clearTimeout(this.restTimer);
    this.restTimer = setTimeout(() => this.model.send({ kind: "rest" }), REST);
  }
  /** Send the size of the plot area to the kernel; the first time, also that this view is new and needs a picture. */
  reportSize() {
    if (!this.plotArea.measure()) return;
    const canvases = this.el.parentElement?.querySelectorAll(":scope > canvas");
    for (const canvas of canvases ?? []) canvas.inert = true;
    const { width, height, pixelRatio: ratio } = this.plotArea;
    this.model.send({ kind: "size", width, height, ratio, fresh: !this.hasReported });
    this.hasReported = true;
    this.requestDraw(ALL_PARTS);
  }
};

// shared/keep_keys.js
var SUPPRESS = "data-lm-suppress-shortcuts";
var stopPropagation = (event) => event.stopPropagation();
function keepKeys(findBox) {
  const controller = new AbortController();
  const { signal } = controller;
  const listen = (type, handle) => {
    const handleInside = (event) => {
      const box = findBox();
      if (box && event.composedPath().includes(box)) handle(event, box);
    };
    window.addEventListener(type, handleInside, { capture: true, signal });
  };
  const keep = (event, box) => {
    if (event.target instanceof Element) event.target.setAttribute(SUPPRESS, "true");
    box.addEventListener(event.type, stopPropagation, { signal });
  };
  for (
    const type of
    /** @type {const} */
    ["keydown", "keypress", "keyup"]
  ) listen(type, keep);
  listen("pointerdown", (_, box) => {
    if (!box.hasAttribute("tabindex")) box.tabIndex = -1;
  });
  return () => controller.abort();
}

// pointer_layer.js
function observe(model, view, throttles) {
  const receive = ({ kind, to, took, labels, x, y }) => {
    if (kind === "menu") {
      const { x: across, y: down } = view.plotArea.kernelScale;
      openMenu(
        view.el,
        labels,
        { x: x / across, y: y / down },
        (index) => model.send({ kind: "choose", key: String(index) })
      );
    } else if (kind === "show") requestAnimationFrame(() => view.el.scrollIntoView({ block: "nearest" }));
    else if (kind === "answer") throttles[to]?.answer(took);
  };
  const handlers = [
    ...Object.entries(PARTS_BY_TRAIT2).map(
      ([trait, parts]) => (
        /** @type {[string, () => void]} */
        [`change:${trait}`, () => view.requestDraw(parts)]
      )
    ),
    ["change:chain", () => view.maps = null],
    ["change:window", () => view.pointer && view.carryPointer()],
    ["msg:custom", receive]
  ];
  for (const [name, handler] of handlers) model.on(name, handler);
  return () => {
    for (const [name, handler] of handlers) model.off(name, handler);
  };
}
function mount(model, el, throttles) {
  const view = new LayerView(model, el);
  const { plot } = view.elements;
  const controller = new AbortController();
  const { signal } = controller;
  const listen = (name, handle) => plot.addEventListener(name, handle, { signal, passive: false });
  const actions = {
    send: (...message) => view.send(...message),
    movePointer: (position) => view.movePointer(position),
    scheduleRest: () => view.scheduleRest()
  };
  const keyboard = new Keyboard(plot, model, actions.send, (isBare) => view.live.showBare(isBare));
  keyboard.listenWith(listen);
  new GestureRecogniser(plot, view.plotArea, keyboard, throttles, actions).listenWith(listen);
  const stopObserving = observe(model, view, throttles);
  const stopKeepingKeys = keepKeys(() => el.parentElement);
  const observer = new ResizeObserver(() => view.reportSize());
  observer.observe(plot);
  window.addEventListener("resize", () => view.reportSize(), { signal });
  window.addEventListener("pointermove", () => view.followScale(), { signal });
  const stop = () => {
    controller.abort();
    observer.disconnect();
    clearTimeout(view.restTimer);
    view.live.stop();
    stopObserving();
    stopKeepingKeys();
  };
  return { view, stop };
}

// handout/navigation.js
var WHEEL_ZOOM = 1.2;
var KEY_ZOOM = 1.5;
var STRIDE = 60;
var BY_KEY = {
  0: (view) => view.fitted(),
  "+": (view) => view.zoomed(KEY_ZOOM),
  "=": (view) => view.zoomed(KEY_ZOOM),
  "-": (view) => view.zoomed(1 / KEY_ZOOM),
  _: (view) => view.zoomed(1 / KEY_ZOOM),
  ArrowLeft: (view) => view.panned(STRIDE, 0),
  ArrowRight: (view) => view.panned(-STRIDE, 0),
  ArrowUp: (view) => view.panned(0, STRIDE),
  ArrowDown: (view) => view.panned(0, -STRIDE)
};
var KEYS = Object.keys(BY_KEY);
var Navigation = class {
  constructor() {
    this.grip = null;
  }
  /**
   * The view after a message, the same one if it changes nothing.
   *
   * @param {Viewport} view
   * @param {Message} message
   */
  navigate(view, message) {
    const { kind } = message;
    if (kind === "wheel") return view.zoomed(WHEEL_ZOOM ** message.steps, message);
    if (kind === "pinch") return view.panned(message.dx, message.dz).zoomed(message.factor, message);
    if (kind === "double") return view.fitted();
    if (kind === "key") return BY_KEY[message.key]?.(view) ?? view;
    if (kind === "press") this.grip = message;
    return kind === "drag" || kind === "release" ? this.drag(view, message) : view;
  }
  /**
   * @param {Viewport} view
   * @param {Message} message
   */
  drag(view, message) {
    const { grip } = this;
    this.grip = message.kind === "release" ? null : message;
    const isMoved = grip && !message.cancelled && (message.x !== grip.x || message.y !== grip.y);
    return isMoved ? view.panned(message.x - grip.x, message.y - grip.y) : view;
  }
};

// handout/ratios.js
var NODES = 6e4;
var LEAST_SHARE = 1e-6;
var USUAL_SPAN = 1.1;
var FADED = 0.12;
var ALONE = 0.6;
function measure(picture) {
  const maps = picture.maps(false);
  if (!maps.length) return [{ ratio: 1, area: 1 }];
  const [rows, columns] = picture.grid.shape;
  const share = Math.min(1, Math.sqrt(NODES / (rows * columns)));
  const [width, height] = [columns, rows].map((count) => Math.max(2, Math.round(share * count)));
  const [stepX, stepZ] = [columns / width, rows / height];
  const parts = [];
  new Tracer(
    maps,
    (_row, _column, count, _x, _z, _dx, _dz, logRatio) => parts.push({ ratio: Math.exp(logRatio), area: count })
  ).trace({ left: stepX / 2 - 0.5, top: stepZ / 2 - 0.5, stepX, stepZ, width, height });
  return parts.sort((one, other) => one.ratio - other.ratio);
}
function areaOf(parts, isCounted) {
  return parts.reduce((sum, part) => sum + (isCounted(part) ? part.area : 0), 0);
}
function barsOf(parts, axis, isLog) {
  const count = axis.edges.length - 1;
  const [low, high] = [Math.log(axis.edges[0]), Math.log(axis.edges[count])];
  const shares = new Array(count).fill(0);
  const total = areaOf(parts, () => true);
  for (const { ratio, area } of parts) {
    const bar = Math.floor(count * (Math.log(ratio) - low) / (high - low));
    shares[Math.min(Math.max(bar, 0), count - 1)] += area / total;
  }
  const least = Math.min(...shares.filter((share) => share > 0));
  const floor = isLog ? 10 ** (Math.ceil(Math.log10(Math.max(least, LEAST_SHARE))) - 1) : 0;
  return { ...axis, shares, floor, y: shareTicks(Math.max(...shares), floor) };
}
function shareTicks(most, floor) {
  const decades = Math.floor(Math.log10(most / (floor || most)) + 0.5) + 1;
  const step = roundStep(100 * most / 3);
  const percents = floor ? Array.from({ length: decades }, (_, i) => 100 * floor * 10 ** i) : Array.from({ length: Math.floor(100 * most / step + 1.5) }, (_, i) => step * i);
  return percents.map((percent) => [percent / 100, String(Number(percent.toPrecision(3)))]);
}
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * power).find((step) => step >= least * (1 - 1e-9)) ?? least;
}
function summaryOf(parts, span) {
  const total = areaOf(parts, () => true);
  const [low, median, high] = [1, 50, 99].map((percent) => percentile(parts, percent / 100 * total).toFixed(3));
  const beyond = 100 * areaOf(parts, ({ ratio }) => ratio < 1 / span || ratio > span) / total;
  const rest = beyond > 0 ? `, ${Number(beyond.toPrecision(2))}% of the area beyond` : "";
  const scale = `±${Number((100 * (span - 1)).toPrecision(3))}%${span === USUAL_SPAN ? "" : ", rescaled"}`;
  return `median ${median}, P1 ${low}, P99 ${high}; scale ${scale}${rest}`;
}
function percentile(parts, wanted) {
  let through = 0;
  let last = { middle: 0, ratio: parts[0].ratio };
  for (const { ratio, area } of parts) {
    const middle = through + area / 2;
    if (middle >= wanted)
      return last.ratio + (ratio - last.ratio) * (wanted - last.middle) / (middle - last.middle || 1);
    last = { middle, ratio };
    through += area;
  }
  return last.ratio;
}
function brushText(parts, { edges, decimals }, brush) {
  if (!brush.length) return "";
  const [low, high] = brush;
  const [first, last] = [edges[0], edges[edges.length - 1]];
  const isInside = ({ ratio }) => (ratio >= low || low <= first) && (ratio <= high || high >= last);
  const share = 100 * areaOf(parts, isInside) / areaOf(parts, () => true);
  return `${low.toFixed(decimals)} to ${high.toFixed(decimals)}: ${Number(share.toPrecision(3))}% of the area`;
}
function tint({ palette, span }, brush, isShown) {
  const colours = new Uint8Array(palette.buffer.slice(palette.byteOffset, palette.byteOffset + palette.byteLength));
  if (brush.length) {
    const [low, high] = brush.map((ratio) => 128 + Math.round(127 * Math.log(ratio) / Math.log(span)));
    for (let level = 0; level < 256; level++) {
      const isInside = level >= Math.max(low, 1) && level <= Math.min(high, 255);
      colours[4 * level + 3] = isInside ? 255 : colours[4 * level + 3] * (isShown ? FADED : 0);
    }
  }
  return { palette: new DataView(colours.buffer), span, opacity: isShown || brush.length ? ALONE : 0 };
}

// stage_strip/strip.js
var LEAST = 3;
var SIZE = { width: 108, height: 60 };
var SHARPNESS = 2;
var REST2 = 300;
var StageStrip = class {
  /**
   * @param {HTMLElement} el
   * @param {(scene: Scene) => void} choose
   */
  constructor(el, choose) {
    this.el = el;
    this.choose = choose;
    this.scenes = [];
    this.buttons = [];
    this.timer = void 0;
    el.classList.add("seiswidgets-strip");
    el.setAttribute("role", "toolbar");
    el.setAttribute("aria-label", "Stages");
    el.addEventListener("keydown", (event) => this.press(event));
  }
  /** @param {Scene[]} scenes */
  show(scenes) {
    this.scenes = scenes;
    this.el.hidden = scenes.length < LEAST;
    this.buttons = (this.el.hidden ? [] : scenes).map((scene, index) => {
      const button = document.createElement("button");
      button.type = "button";
      button.tabIndex = index ? -1 : 0;
      const name = document.createElement("span");
      name.textContent = scene.label;
      button.title = scene.label;
      button.append(document.createElement("canvas"), name);
      button.addEventListener("click", () => this.choose(scene));
      button.addEventListener("focus", () => this.makeReachable(button));
      return button;
    });
    this.el.replaceChildren(...this.buttons);
  }
  /**
   * Press the button of the scene that is shown, if one is.
   *
   * @param {number} time in stages
   */
  mark(time) {
    this.buttons.forEach((button, index) => {
      button.setAttribute("aria-pressed", String(this.scenes[index].count === time));
    });
  }
  /**
   * The arrow keys, Home and End move among the buttons: Tab leaves them.
   *
   * @param {KeyboardEvent} event
   */
  press(event) {
    const now = this.buttons.findIndex((button) => button === document.activeElement);
    const last = this.buttons.length - 1;
    const target = { ArrowLeft: now - 1, ArrowRight: now + 1, Home: 0, End: last }[event.key];
    if (now < 0 || target === void 0) return;
    event.preventDefault();
    this.buttons[Math.min(Math.max(target, 0), last)].focus();
  }
  /** @param {HTMLButtonElement} chosen */
  makeReachable(chosen) {
    for (const button of this.buttons) button.tabIndex = button === chosen ? 0 : -1;
  }
  /**
   * Draw the pictures once nothing has changed for a moment.
   *
   * @param {() => Picture | null} getPicture
   */
  scheduleDraw(getPicture) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.draw(getPicture()), REST2);
  }
  /** @param {Picture | null} picture */
  draw(picture) {
    const count = picture?.chain.stages.length ?? 0;
    this.buttons.forEach((button, index) => {
      const canvas = (
        /** @type {HTMLCanvasElement} */
        button.firstChild
      );
      if (picture && this.scenes[index].count <= count) drawThumbnail(canvas, picture, this.scenes[index].count);
    });
  }
  stop() {
    clearTimeout(this.timer);
  }
};
function drawThumbnail(canvas, picture, count) {
  const size = { width: SHARPNESS * SIZE.width, height: SHARPNESS * SIZE.height };
  Object.assign(canvas, size);
  const image = new ImageData(size.width, size.height);
  const scene = picture.scene(true, [0, 1, 0, 1]);
  drawSection(new Uint32Array(image.data.buffer), size, {
    ...scene,
    maps: picture.chain.maps(count, true),
    window: rockWindow(picture),
    deformation: { ...scene.deformation, opacity: 0 }
  });
  canvas.getContext("2d")?.putImageData(image, 0, 0);
}
function rockWindow(picture) {
  const [rows, columns] = picture.grid.shape;
  const window2 = [-0.5, columns - 0.5, -0.5, rows - 0.5];
  for (const { after } of picture.chain.stages) {
    for (let i = 0; i < after.length; i++) {
      const side = 2 * (i % 2);
      window2[side] = Math.min(window2[side], after[i]);
      window2[side + 1] = Math.max(window2[side + 1], after[i]);
    }
  }
  return (
    /** @type {[number, number, number, number]} */
    window2
  );
}

// handout/timeline.js
var FRAME_TIME = 30;
var FRAMES = 60;
function element(tag, attributes, content = "") {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = content;
  return made;
}
var Timeline = class {
  /**
   * @param {HTMLElement} el
   * @param {string[]} names of the stages
   * @param {import("../stage_strip/strip.js").Scene[]} scenes
   * @param {(frame: number) => void} show
   */
  constructor(el, names, scenes, show) {
    this.names = names;
    this.show = show;
    this.end = FRAMES * names.length;
    this.frame = this.end;
    this.isRunning = false;
    this.playButton = element("button", { type: "button", class: "play" });
    const range = { type: "range", min: "0", max: String(this.end), step: "1", list: "scenes", "aria-label": "Time" };
    this.slider = /** @type {HTMLInputElement} */
    element("input", range);
    const ticks = element("datalist", { id: "scenes" });
    ticks.append(...scenes.map(({ count }) => element("option", { value: String(FRAMES * count) })));
    this.moment = element("output", {});
    const stops = element("div", {});
    this.strip = new StageStrip(stops, ({ count }) => this.stopAt(FRAMES * count));
    this.strip.show(scenes);
    this.playButton.addEventListener("click", () => this.toggle());
    this.slider.addEventListener("input", () => this.stopAt(this.slider.valueAsNumber));
    const track = element("div", { class: "track" });
    track.append(this.slider, ticks, stops);
    el.append(this.playButton, track, this.moment);
    this.draw();
  }
  /** The moment in words. */
  get text() {
    const { frame, end, names } = this;
    if (frame === 0) return "present day";
    if (frame === end) return "restored";
    const step = Math.ceil(frame / FRAMES) - 1;
    const percent = Math.round(100 * (frame - FRAMES * step) / FRAMES);
    return percent === 100 ? names[step] : `${names[step]} ${percent}%`;
  }
  /** @param {number} frame */
  stopAt(frame) {
    this.isRunning = false;
    this.goTo(frame);
  }
  /** @param {number} frame */
  goTo(frame) {
    this.frame = frame;
    this.draw();
    this.show(frame);
  }
  toggle() {
    if (this.isRunning) {
      this.stopAt(this.frame);
      return;
    }
    this.isRunning = true;
    const from = this.frame === this.end ? 0 : this.frame;
    const start2 = performance.now();
    const step = () => {
      if (!this.isRunning) return;
      const frame = Math.min(from + Math.floor((performance.now() - start2) / FRAME_TIME), this.end);
      this.isRunning = frame < this.end;
      this.goTo(frame);
      if (this.isRunning) requestAnimationFrame(step);
    };
    step();
  }
  draw() {
    this.playButton.textContent = this.isRunning ? "Pause" : "Play";
    this.slider.value = String(this.frame);
    this.slider.setAttribute("aria-valuetext", this.text);
    this.moment.textContent = this.text;
    this.strip.mark(this.frame / FRAMES);
  }
};

// handout/viewport.js
var FEWEST = 4;
var FARTHEST = 2;
var TICK_DISTANCE = [95, 45];
var Viewport = class _Viewport {
  /**
   * @param {Limits} limits
   * @param {{ width: number, height: number }} size in css pixels
   * @param {Window} [window]
   */
  constructor(limits, size, window2 = limits.whole) {
    this.limits = limits;
    this.size = size;
    this.window = window2;
  }
  get isFitted() {
    return this.window === this.limits.whole;
  }
  fitted() {
    return new _Viewport(this.limits, this.size);
  }
  /** @param {{ width: number, height: number }} size */
  resized(size) {
    return new _Viewport(this.limits, size, this.window);
  }
  /** Vertical exaggeration of the rock as drawn. */
  get exaggeration() {
    const { metres, sample } = this.limits;
    const [x, z] = spans(this.window).map((span, axis) => span * metres[axis] / sample[axis]);
    return this.size.height / z / (this.size.width / x);
  }
  /**
   * Zoom in by a factor about a css pixel; the window keeps a few samples across, and always touches the whole.
   *
   * @param {number} factor
   * @param {Pixel} [at] by default the centre
   */
  zoomed(factor, at = { x: this.size.width / 2, y: this.size.height / 2 }) {
    const { whole, sample } = this.limits;
    const shown = spans(this.window);
    const closest = Math.min(...shown.map((span, axis) => span / (FEWEST * sample[axis])));
    const farthest = Math.min(...shown.map((span, axis) => span / (FARTHEST * spans(whole)[axis])));
    const applied = Math.min(Math.max(factor, Math.min(1, farthest)), Math.max(1, closest));
    const shares = [at.x / this.size.width, at.y / this.size.height];
    return this.along((low, high, axis) => {
      const centre = low + shares[axis] * (high - low);
      const [from, to] = [centre + (low - centre) / applied, centre + (high - centre) / applied];
      const shift = Math.max(0, whole[2 * axis] - to) - Math.max(0, from - whole[2 * axis + 1]);
      return [from + shift, to + shift];
    });
  }
  /**
   * Move the picture right and down by css pixels; its middle stays on the whole.
   *
   * @param {number} right
   * @param {number} down
   */
  panned(right, down) {
    const { whole } = this.limits;
    const shares = [right / this.size.width, down / this.size.height];
    return this.along((low, high, axis) => {
      const middle = (low + high) / 2;
      const [least, most] = [Math.min(whole[2 * axis], middle), Math.max(whole[2 * axis + 1], middle)];
      const shift = Math.min(Math.max(middle - shares[axis] * (high - low), least), most) - middle;
      return [low + shift, high + shift];
    });
  }
  /** @param {(low: number, high: number, axis: number) => [number, number]} change of the window along an axis */
  along(change) {
    const [left, right, top, bottom] = this.window;
    return new _Viewport(this.limits, this.size, [...change(left, right, 0), ...change(top, bottom, 1)]);
  }
  /**
   * What a pointer layer draws: ticks with labels, and the vertical exaggeration.
   *
   * @param {[string, string]} titles
   * @param {number} left css pixels left of the plot area
   * @returns {import("../pointer_layer/types.js").Axes}
   */
  axes(titles, left) {
    const { exaggeration } = this;
    const isTrue = Math.abs(exaggeration - 1) < 5e-3;
    const [x, z] = titles.map((title, axis) => {
      const [low, high] = this.window.slice(2 * axis, 2 * axis + 2);
      const length = axis ? this.size.height : this.size.width;
      const { ticks, decimals } = roundTicks(low, high, (high - low) * TICK_DISTANCE[axis] / length);
      const pixels = ticks.map((tick) => (tick - low) * length / (high - low));
      return { title, pixels, labels: ticks.map((tick) => tick.toFixed(decimals)) };
    });
    return { x, z, left, note: isTrue ? "true proportions" : `V.E. ${Number(exaggeration.toPrecision(3))}×` };
  }
};
function spans([left, right, top, bottom]) {
  return [right - left, bottom - top];
}
function roundTicks(low, high, least) {
  const wanted = Math.min(least, (high - low) / 2);
  const power = Math.floor(Math.log10(wanted));
  const steps = [-1, 0, 1].flatMap((more) => [1, 2, 5].map((digit) => ({ digit, exponent: power + more })));
  const sized = steps.map(({ digit, exponent: exponent2 }) => ({ step: Number(`${digit}e${exponent2}`), exponent: exponent2 }));
  const largest = sized.filter(({ step: step2 }) => step2 <= (high - low) / 2).at(-1) ?? sized[0];
  const { step, exponent } = wanted < least ? largest : sized.find((one) => one.step >= least) ?? largest;
  const [first, last] = [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
  const decimals = Math.max(0, -exponent);
  const ticks = Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toFixed(decimals)) + 0);
  return { ticks, decimals };
}

// handout/panes.js
var PRINT_RATIO = 3;
var MESH = 0.6;
var NONE = [];
var NAMES = (
  /** @type {const} */
  ["original", "restored"]
);
function createPicture({ grid, texture, stages, triangles, colours, ratios }) {
  const model = new LocalModel({
    grid,
    texture: { id: 0, shape: texture.shape, rows: texture.shape[0], overview: texture },
    stages,
    triangles,
    frame: null,
    frames: FRAMES,
    colours,
    deformation: tint(ratios, [], false),
    changing: false,
    revision: 0
  });
  model.set("picture", new Picture(
    /** @type {any} */
    model
  ));
  return model;
}
var Panes = class {
  /**
   * @param {State} state
   * @param {(key: string) => void} onKey called with keys that are not the panes' own
   */
  constructor(state, onKey) {
    this.state = state;
    this.onKey = onKey;
    this.picture = createPicture(state);
    const sample = (
      /** @type {[number, number]} */
      state.grid.step.map(Math.abs)
    );
    const limits = { whole: state.frame, sample, metres: state.grid.metres };
    this.viewport = new Viewport(limits, { width: 900, height: 600 });
    this.navigation = new Navigation();
    this.readers = [];
    this.hasPicks = true;
    this.original = this.createPane("original");
    this.restored = this.createPane("restored");
    for (const [pane, other] of [
      [this.original, this.restored],
      [this.restored, this.original]
    ])
      pane.model.on("change:carried", () => {
        other.model.set("linked", pane.model.get("carried"));
        this.read(pane);
      });
    this.drawPicks();
    this.picture.on("change:frame", () => this.drawPicks());
  }
  /**
   * @param {Name} name
   * @returns {Pane}
   */
  createPane(name) {
    const traits = {
      ...{ axes: {}, window: this.state.frame, size: [], strokes: [], marks: [], rubber: [] },
      ...{ mesh: {}, mesh_opacity: 0, chain: [], carried: {}, linked: {}, hotkeys: [...KEYS, " "] },
      ...{ picture: "IPY_MODEL_picture", restored: name === "restored" },
      label: `${name === "restored" ? "Restored" : "Present day"}: ${this.state.label}. Arrows pan, + and - zoom, 0 fits`
    };
    const receive = (message) => this.receive(message);
    const model = new LocalModel(traits, { receive, models: { picture: this.picture } });
    const direct = (kind) => ({
      add: (message) => receive({ kind, ...message }),
      drop: () => {
      },
      answer: () => {
      }
    });
    const throttles = { drag: direct("drag"), hover: direct("hover"), wheel: direct("wheel"), pinch: direct("pinch") };
    const el = (
      /** @type {HTMLElement} */
      document.getElementById(name)
    );
    return { model, view: mount(
      /** @type {any} */
      model,
      el,
      throttles
    ).view };
  }
  /** @param {import("./navigation.js").Message & { width: number, height: number }} message */
  receive(message) {
    if (message.kind === "size") this.show(this.viewport.resized({ width: message.width, height: message.height }));
    else if (message.kind === "key" && !KEYS.includes(message.key)) this.onKey(message.key);
    else this.show(this.navigation.navigate(this.viewport, message));
  }
  /** @param {Viewport} viewport */
  show(viewport) {
    if (viewport === this.viewport) return;
    this.viewport = viewport;
    for (const name of NAMES) {
      const { model, view } = this[name];
      model.set("window", viewport.window);
      model.set("axes", viewport.axes(this.state.titles, view.el.offsetLeft));
      view.el.classList.toggle("fitted", viewport.isFitted);
    }
  }
  /** @param {boolean} isShown */
  showPicks(isShown) {
    this.hasPicks = isShown;
    this.drawPicks();
  }
  /** Show the lines as they are after the stage that is being carried out; the layer moves them back from there. */
  drawPicks() {
    const { strokes } = this.state;
    const count = Math.ceil(this.picture.get("picture").time);
    this.restored.model.set("stage", count);
    this.original.model.set("strokes", this.hasPicks ? strokes[0] : NONE);
    this.restored.model.set("strokes", this.hasPicks ? strokes[count] : NONE);
  }
  /** @param {boolean} isShown */
  showMesh(isShown) {
    for (const name of NAMES) this[name].model.set("mesh_opacity", isShown ? MESH : 0);
  }
  /**
   * The positions under the pointer, and the area ratio there.
   *
   * @typedef {{ original: Point | null, restored: Point | null, ratio: number }} Reading
   * @typedef {import("../pointer_layer/types.js").SectionPoint} Point
   *
   * @param {Pane} pane
   */
  read({ model, view }) {
    const { pointer, plotArea } = view;
    const own = pointer && plotArea.toSection(pointer);
    const carried = model.get("carried").x === void 0 ? null : model.get("carried");
    const [original, restored] = model.get("restored") ? [carried, own] : [own, carried];
    const ratio = original && restored ? this.ratioAt(original) : Number.NaN;
    for (const reader of this.readers) reader(own && { original, restored, ratio });
  }
  /** @param {Point} point of the present-day section */
  ratioAt(point) {
    const picture = (
      /** @type {Picture} */
      this.picture.get("picture")
    );
    let at = picture.toSamples(point);
    let log = 0;
    for (const map of picture.maps(false)) {
      const triangle = at ? map.finder.find(at.x, at.z) : -1;
      if (triangle < 0) return Number.NaN;
      log += map.logRatios[triangle];
      at = carry(
        [map],
        /** @type {{ x: number, z: number }} */
        at
      );
    }
    return Math.exp(log);
  }
  /**
   * Draw at once, for paper or for the screen.
   *
   * @param {boolean} isForPaper
   */
  drawNow(isForPaper) {
    for (const name of NAMES) {
      const { view } = this[name];
      view.live.leastRatio = isForPaper ? PRINT_RATIO : 1;
      view.reportSize();
    }
    for (const name of NAMES) this[name].view.draw();
  }
};

// handout/switches.js
function appendSwitch(parent, text, isOn, act) {
  const label = document.createElement("label");
  const box = document.createElement("input");
  box.type = "checkbox";
  box.checked = isOn;
  box.addEventListener("change", () => act(box.checked));
  label.append(box, ` ${text}`);
  parent.append(label);
}
function appendButton(parent, text, name, act) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = text;
  button.setAttribute("aria-label", name);
  button.title = name;
  button.addEventListener("click", act);
  parent.append(button);
}

// histogram/scale.js
var HEADROOM = 1.12;
function clamp(value, low, high) {
  return Math.min(high, Math.max(low, value));
}
var Scale = class {
  /**
   * @param {Bars} bars
   * @param {Size} size
   */
  constructor({ edges, shares, floor }, { width, height }) {
    this.count = shares.length;
    this.width = width;
    this.height = height;
    this.low = Math.log(edges[0]);
    this.high = Math.log(edges[this.count]);
    this.floor = floor;
    const highest = Math.max(...shares);
    this.highest = floor ? highest * (highest / floor) ** (HEADROOM - 1) : HEADROOM * highest;
  }
  get barWidth() {
    return this.width / this.count;
  }
  /**
   * An area ratio as a fractional bar index, within the axis.
   *
   * @param {number} ratio
   */
  position(ratio) {
    return clamp(this.count * (Math.log(ratio) - this.low) / (this.high - this.low), 0, this.count);
  }
  /** @param {number} ratio */
  x(ratio) {
    return this.position(ratio) * this.barWidth;
  }
  /** @param {number} share */
  y(share) {
    const { floor, highest } = this;
    if (!floor) return this.height * (1 - share / highest);
    return this.height * (1 - Math.max(0, Math.log(share / floor)) / Math.log(highest / floor));
  }
  /** @param {number} x */
  barAt(x) {
    return clamp(Math.floor(x / this.barWidth), 0, this.count - 1);
  }
  /** @param {number} ratio */
  barOf(ratio) {
    return Math.min(Math.floor(this.position(ratio)), this.count - 1);
  }
  /**
   * The first and last bar whose centre is brushed, or the nearest bar if the brush holds no centre.
   *
   * @param {number[]} brush
   * @returns {[number, number]}
   */
  brushedBars([from, to]) {
    const first = Math.min(Math.round(this.position(from)), this.count - 1);
    return [first, Math.max(first, Math.round(this.position(to)) - 1)];
  }
};

// histogram/brush.js
var Brush = class {
  /**
   * @param {() => import("./scale.js").Scale | null} getScale null while there are no bars
   * @param {() => { brush: number[], edges: number[] }} read
   * @param {(brush: number[]) => void} write
   */
  constructor(getScale, read, write) {
    this.getScale = getScale;
    this.read = read;
    this.write = write;
    this.anchor = null;
    this.end = null;
    this.pointerId = null;
  }
  /**
   * @param {SVGSVGElement} chart
   * @param {(event: PointerEvent) => number} xOf x of a pointer from the first bar's left side, in css pixels
   * @param {AbortSignal} signal
   */
  listenTo(chart, xOf, signal) {
    chart.addEventListener("pointerdown", (event) => this.handlePress(event, chart, xOf(event)), { signal });
    chart.addEventListener("pointermove", (event) => this.handleMove(event, xOf(event)), { signal });
    for (
      const name of
      /** @type {const} */
      ["pointerup", "pointercancel"]
    )
      chart.addEventListener(name, (event) => this.handleRelease(event), { signal });
    chart.addEventListener("dblclick", () => this.clear(), { signal });
    chart.addEventListener("keydown", (event) => this.handleKey(event, chart), { signal });
    chart.addEventListener("blur", () => chart.classList.remove("by-pointer"), { signal });
  }
  /**
   * @param {PointerEvent} event
   * @param {SVGSVGElement} chart
   * @param {number} x
   */
  handlePress(event, chart, x) {
    const scale = this.getScale();
    if (this.pointerId !== null || event.button !== 0 || !scale) return;
    event.preventDefault();
    chart.classList.add("by-pointer");
    chart.focus({ preventScroll: true });
    chart.setPointerCapture(event.pointerId);
    this.pointerId = event.pointerId;
    this.follow(scale);
    this.extendTo(scale.barAt(x), event.shiftKey);
  }
  /**
   * @param {PointerEvent} event
   * @param {number} x
   */
  handleMove(event, x) {
    const scale = this.getScale();
    if (event.pointerId === this.pointerId && scale) this.extendTo(scale.barAt(x), true);
  }
  /** @param {PointerEvent} event */
  handleRelease(event) {
    if (event.pointerId === this.pointerId) this.pointerId = null;
  }
  /**
   * @param {KeyboardEvent} event
   * @param {SVGSVGElement} chart
   */
  handleKey(event, chart) {
    chart.classList.remove("by-pointer");
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (this.press(event.key, event.shiftKey)) event.preventDefault();
  }
  /**
   * Handle a key; false if it has no meaning here.
   *
   * @param {string} key
   * @param {boolean} extend
   */
  press(key, extend) {
    const scale = this.getScale();
    if (!scale) return false;
    this.follow(scale);
    if (key === "Escape" && this.anchor !== null) {
      this.clear();
      return true;
    }
    const last = scale.count - 1;
    const current = this.end ?? Math.floor(last / 2);
    const step = this.end === null ? 0 : 1;
    const targets = { ArrowLeft: current - step, ArrowRight: current + step, Home: 0, End: last };
    if (targets[key] === void 0) return false;
    this.extendTo(clamp(targets[key], 0, last), extend);
    return true;
  }
  /**
   * Move the end to a bar, and the anchor with it unless the brush is to be extended.
   *
   * @param {number} bar
   * @param {boolean} extend
   */
  extendTo(bar, extend) {
    this.anchor = extend ? this.anchor ?? bar : bar;
    this.end = bar;
    const { edges } = this.read();
    this.write([edges[Math.min(this.anchor, bar)], edges[Math.max(this.anchor, bar) + 1]]);
  }
  clear() {
    this.write([]);
  }
  /**
   * Take over a brush that was set elsewhere since it was last moved here.
   *
   * @param {import("./scale.js").Scale} scale
   */
  follow(scale) {
    const { brush } = this.read();
    if (!brush.length) {
      this.anchor = this.end = null;
      return;
    }
    const [first, last] = scale.brushedBars(brush);
    const [anchor, end] = [this.anchor ?? -1, this.end ?? -1];
    if (Math.min(anchor, end) !== first || Math.max(anchor, end) !== last) [this.anchor, this.end] = [first, last];
  }
};

// histogram/chart.js
var MARGIN = { left: 46, right: 22, top: 4, bottom: 38 };
var WIDE = 400;
var TITLE = "Area ratio (–): > 1, restoring compressed";
var WIDE_TITLE = "Area, present-day / restored (–): > 1, restoring compressed";
function drawChart(group, bars, size, brush, mark) {
  const scale = new Scale(bars, size);
  group.replaceChildren();
  drawAxes2(group, bars, scale);
  if (brush.length) drawBrush(group, brush, scale);
  drawBars(group, bars, scale, brush);
  if (mark !== null) drawMark(group, bars, scale, scale.barOf(mark));
}
function drawAxes2(group, bars, scale) {
  const { width, height } = scale;
  append(group, "line", "axis", { x1: 0, x2: width, y1: height, y2: height });
  for (const [ratio, label] of bars.x) {
    const x = scale.x(ratio);
    append(group, "line", "axis", { x1: x, x2: x, y1: height, y2: height + 4 });
    appendText(group, "middle", { x, y: height + 15 }, label);
  }
  for (const [share, label] of bars.y.filter(([share2]) => share2 <= scale.highest)) {
    const y = scale.y(share);
    append(group, "line", "grid", { x1: 0, x2: width, y1: y, y2: y });
    appendText(group, "end", { x: -5, y: y + 4 }, label);
  }
  appendText(group, "middle", { x: width / 2, y: height + 32 }, width < WIDE ? TITLE : WIDE_TITLE);
  const upwards = `translate(${12 - MARGIN.left} ${height / 2}) rotate(-90)`;
  appendText(group, "middle", { transform: upwards }, "Share of the area (%)");
}
function drawBars(group, bars, scale, brush) {
  const [first, last] = brush.length ? scale.brushedBars(brush) : [0, scale.count];
  bars.shares.forEach((share, i) => {
    const column = { x: i * scale.barWidth, width: scale.barWidth };
    const y = scale.y(share);
    const look = { ...column, y, height: scale.height - y, fill: bars.colours[i] };
    append(group, "rect", i < first || i > last ? "bar faded" : "bar", look);
    const [low, high] = [bars.edges[i], bars.edges[i + 1]].map((edge) => edge.toFixed(bars.decimals));
    const tooltip = append(append(group, "rect", "column", { ...column, y: 0, height: scale.height }), "title", "");
    tooltip.textContent = `${low} to ${high}: ${Number((100 * share).toPrecision(3))}% of the area`;
  });
}
function drawBrush(group, brush, scale) {
  const [left, right] = brush.map((ratio) => scale.x(ratio));
  append(group, "rect", "brush", { x: left, y: 0, width: Math.max(1, right - left), height: scale.height });
}
function drawMark(group, bars, scale, bar) {
  const [x, y, width] = [bar * scale.barWidth, scale.y(bars.shares[bar]), scale.barWidth];
  append(group, "rect", "mark", { x, y, width, height: scale.height - y, "data-bar": bar });
  append(group, "path", "pointer", { d: `M ${x + width / 2} ${y - 2} l -5 -7 h 10 z` });
}

// histogram.js
var HELP = "Arrow keys brush a bar, with Shift several; Escape clears.";
var SUMMARY_TOOLTIP = "Half, 1% and 99% of the area have a lower area ratio.";
var PAUSE2 = 50;
var CHANGES = "change:bars change:summary change:brushed change:brush change:mark change:log_shares";
function appendDiv(parent, className) {
  const div = document.createElement("div");
  div.className = className;
  parent.append(div);
  return div;
}
function throttledSave(model) {
  let isScheduled = false;
  let savedAt = -Infinity;
  return () => {
    if (isScheduled) return;
    isScheduled = true;
    const delay = Math.max(0, savedAt + PAUSE2 - performance.now());
    setTimeout(() => {
      isScheduled = false;
      savedAt = performance.now();
      model.save_changes();
    }, delay);
  };
}
function createElements2(el) {
  el.classList.add("seiswidgets-histogram");
  const head = appendDiv(el, "head");
  const summary = appendDiv(head, "summary");
  const brushed = appendDiv(head, "brushed");
  brushed.setAttribute("aria-live", "polite");
  const log = document.createElement("button");
  log.className = "log";
  log.textContent = "log";
  log.title = "Logarithmic axis for the share of the area";
  head.append(log);
  const chart = append(el, "svg", "chart", { tabindex: 0, role: "application" });
  const drawing = append(chart, "g", "drawing", { transform: `translate(${MARGIN.left} ${MARGIN.top})` });
  return { summary, brushed, log, chart, drawing };
}
function barsOf2(model) {
  const bars = model.get("bars");
  return "shares" in bars ? (
    /** @type {import("./histogram/scale.js").Bars} */
    bars
  ) : null;
}
function createBrush(model, getSize) {
  const save = throttledSave(model);
  const getScale = () => {
    const bars = barsOf2(model);
    return bars && new Scale(bars, getSize());
  };
  const read = () => ({ brush: model.get("brush"), edges: barsOf2(model)?.edges ?? [] });
  return new Brush(getScale, read, (brush) => {
    if (String(brush) === String(model.get("brush"))) return;
    model.set("brush", brush);
    save();
  });
}
function render({ model, el }) {
  const { summary, brushed, log, chart, drawing } = createElements2(el);
  let [whole, size] = [1, 2].map(() => ({ width: 0, height: 0 }));
  function draw() {
    const bars = barsOf2(model);
    summary.textContent = model.get("summary");
    summary.title = `${model.get("summary")}. ${SUMMARY_TOOLTIP}`;
    brushed.textContent = model.get("brushed");
    log.setAttribute("aria-pressed", String(model.get("log_shares")));
    el.classList.toggle("empty", !bars);
    chart.setAttribute("aria-label", `Histogram of the area ratio: ${model.get("summary")}. ${HELP}`);
    if (bars && size.width >= 1 && size.height >= 1)
      drawChart(drawing, bars, size, model.get("brush"), model.get("mark"));
    else drawing.replaceChildren();
  }
  const observer = new ResizeObserver(() => {
    whole = unscaledSize(chart);
    size = { width: whole.width - MARGIN.left - MARGIN.right, height: whole.height - MARGIN.top - MARGIN.bottom };
    draw();
  });
  const controller = new AbortController();
  const xOf = (event) => unscaledPosition(event, chart, whole).x - MARGIN.left;
  createBrush(model, () => size).listenTo(chart, xOf, controller.signal);
  log.addEventListener("click", () => {
    model.set("log_shares", !model.get("log_shares"));
    model.save_changes();
  });
  const stopKeepingKeys = keepKeys(() => el);
  model.on(CHANGES, draw);
  observer.observe(chart);
  draw();
  return () => {
    stopKeepingKeys();
    controller.abort();
    observer.disconnect();
    model.off(
      /** @type {"change:bars"} */
      CHANGES,
      draw
    );
  };
}
var histogram_default = { render };

// handout.js
var ZOOM = 1.5;
var PAUSE3 = 100;
var find = (id) => (
  /** @type {HTMLElement} */
  document.getElementById(id)
);
function showDeformation({ ratios }, panes) {
  const { picture } = panes;
  const traits = { bars: {}, summary: "", brushed: "", brush: [], mark: null, log_shares: false };
  const model = new LocalModel(traits);
  let parts = measure(picture.get("picture"));
  let isShown = false;
  const describe = () => model.set("brushed", brushText(parts, ratios.axis, model.get("brush")));
  const draw = () => {
    model.set("bars", barsOf(parts, ratios.axis, model.get("log_shares")));
    model.set("summary", summaryOf(parts, ratios.span));
    describe();
  };
  const colour = () => picture.set("deformation", tint(ratios, model.get("brush"), isShown));
  model.on("change:brush", () => {
    describe();
    colour();
  });
  model.on("change:log_shares", draw);
  draw();
  histogram_default.render(
    /** @type {any} */
    { model, el: find("histogram") }
  );
  let isScheduled = false;
  const update = () => {
    isScheduled = false;
    parts = measure(picture.get("picture"));
    draw();
  };
  return {
    follow: () => {
      if (!isScheduled) setTimeout(update, PAUSE3);
      isScheduled = true;
    },
    show: (isOn) => {
      isShown = isOn;
      colour();
    }
  };
}
function showReadings({ height, units: [x, z] }, panes) {
  const round = (value) => String(Number(value.toPrecision(6)));
  panes.readers.push((reading) => {
    const places = reading ? Object.entries({ "present day": reading.original, restored: reading.restored }) : [];
    const parts = places.flatMap(
      ([name, at]) => at ? [`${name}: x ${round(at.x)} ${x}, ${height} ${round(at.z)} ${z}`] : []
    );
    if (reading && Number.isFinite(reading.ratio)) parts.push(`area ratio ${reading.ratio.toFixed(3)}`);
    find("readout").textContent = parts.join(" · ");
  });
}
function showSwitches(panes, showMap, isRestored) {
  const el = find("switches");
  appendSwitch(el, "Picks", true, (isOn) => panes.showPicks(isOn));
  if (isRestored) {
    appendSwitch(el, "Deformation map", false, showMap);
    appendSwitch(el, "Mesh", false, (isOn) => panes.showMesh(isOn));
  }
  const zoom = el.appendChild(document.createElement("span"));
  appendButton(zoom, "+", "Zoom in", () => panes.show(panes.viewport.zoomed(ZOOM)));
  appendButton(zoom, "−", "Zoom out", () => panes.show(panes.viewport.zoomed(1 / ZOOM)));
  appendButton(zoom, "Fit", "Show everything", () => panes.show(panes.viewport.fitted()));
}
function preparePrinting(panes) {
  const { picture } = panes;
  let before = null;
  window.addEventListener("beforeprint", () => {
    before = { frame: picture.get("frame"), viewport: panes.viewport };
    document.documentElement.classList.add("printing");
    picture.set("frame", null);
    panes.show(panes.viewport.fitted());
    panes.drawNow(true);
  });
  window.addEventListener("afterprint", () => {
    document.documentElement.classList.remove("printing");
    if (!before) return;
    picture.set("frame", before.frame);
    panes.show(before.viewport);
    panes.drawNow(false);
  });
}
async function start() {
  const state = await readState();
  const isRestored = state.stages.length > 0;
  let timeline = null;
  const panes = new Panes(state, () => timeline?.toggle());
  const deformation = isRestored ? showDeformation(state, panes) : null;
  if (isRestored) {
    timeline = new Timeline(find("time"), state.names, state.scenes, (frame) => {
      panes.picture.set("frame", frame);
      deformation?.follow();
    });
    timeline.strip.draw(panes.picture.get("picture"));
  } else {
    find("restored-title").textContent = "Not restored yet";
    find("deformation").hidden = true;
  }
  showReadings(state, panes);
  showSwitches(panes, (isOn) => deformation?.show(isOn), isRestored);
  preparePrinting(panes);
}
start().catch((error) => {
  find("trouble").textContent = `The sections cannot be shown; a newer browser may help (${error}).`;
  throw error;
});
