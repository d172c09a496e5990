/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// pointer_layer/keyboard.js
function modifiers(event) {
  const pressed = { ctrl: event.ctrlKey, meta: event.metaKey, shift: event.shiftKey, alt: event.altKey };
  return Object.entries(pressed).flatMap(([name, isPressed]) => isPressed ? [name] : []);
}
var Keyboard = class {
  /**
   * @param {{ classList: Pick<DOMTokenList, "toggle" | "remove"> }} plot
   * @param {Pick<import("./types.js").Model, "get">} model
   * @param {Send} send
   */
  constructor(plot, model, send) {
    this.plot = plot;
    this.model = model;
    this.send = send;
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
    listen("contextmenu", (event) => event.preventDefault());
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

// pointer_layer/throttle.js
var DRAG_PAUSE = 50;
var HOVER_PAUSE = 200;
var HOVER_MOVES = 18;
var LOST = 5e3;
var STILL = 100;
var MessageThrottle = class {
  /**
   * @param {(message: Message) => void} send
   * @param {object} [options]
   * @param {number} [options.pause] ms
   * @param {(waiting: any, newest: any) => Message} [options.merge] keeps the newest by default
   * @param {number} [options.batch]
   */
  constructor(send, { pause = 0, merge = (_, newest) => newest, batch = 1 } = {}) {
    this.send = send;
    this.pause = pause;
    this.merge = merge;
    this.batch = batch;
    this.waiting = null;
    this.merged = 0;
    this.addedAt = -Infinity;
    this.sentAt = -Infinity;
    this.isAnswered = true;
    this.isScheduled = false;
  }
  /** @param {Message} message */
  add(message) {
    this.waiting = this.waiting ? this.merge(this.waiting, message) : message;
    this.merged += 1;
    this.addedAt = performance.now();
    if (this.isScheduled) return;
    this.isScheduled = true;
    requestAnimationFrame(() => this.trySending());
  }
  /** Forget the message that is waiting. */
  drop() {
    this.waiting = null;
    this.merged = 0;
  }
  /** Note that the kernel has answered the last message. */
  answer() {
    this.isAnswered = true;
    if (!this.isScheduled) this.trySending();
  }
  trySending() {
    const now = performance.now();
    this.isScheduled = false;
    if (!this.waiting || !this.isAnswered && now - this.sentAt < LOST) return;
    const due = Math.max(this.sentAt + this.pause, this.merged < this.batch ? this.addedAt + STILL : 0);
    if (due - now > 1) {
      this.isScheduled = true;
      setTimeout(() => this.trySending(), due - now);
      return;
    }
    const message = this.waiting;
    this.sentAt = now;
    this.isAnswered = false;
    this.drop();
    this.send(message);
  }
};
function createThrottles(model) {
  const sender = (kind) => (message) => model.send({ kind, ...message });
  return {
    drag: new MessageThrottle(sender("drag"), { pause: DRAG_PAUSE }),
    hover: new MessageThrottle(sender("hover"), { pause: HOVER_PAUSE, batch: HOVER_MOVES }),
    wheel: new MessageThrottle(sender("wheel"), {
      merge: (waiting, newest) => ({ ...newest, steps: waiting.steps + newest.steps })
    }),
    pinch: new MessageThrottle(sender("pinch"), {
      merge: (waiting, newest) => ({
        ...newest,
        factor: waiting.factor * newest.factor,
        dx: waiting.dx + newest.dx,
        dz: waiting.dz + newest.dz
      })
    })
  };
}

// shared/bytes.js
function toNumbers(bytes, NumberType) {
  return new NumberType(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
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
   * @param {Indices} triangles
   * @param {number} tolerance the barycentric coordinate -tolerance still counts as inside
   */
  constructor(vertices, triangles, tolerance) {
    this.vertices = vertices;
    this.triangles = triangles;
    this.tolerance = tolerance;
    this.coefficients = barycentricCoefficients(vertices, triangles);
    this.grid = void 0;
    this.neighbours = void 0;
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
    this.neighbours ??= neighbours(this.triangles);
    const { coefficients, tolerance } = this;
    let triangle = start;
    for (let step = 0; step < MOST_STEPS && triangle >= 0; step++) {
      const base = 6 * triangle;
      const right = x - coefficients[base];
      const down = z - coefficients[base + 1];
      const b = coefficients[base + 2] * right + coefficients[base + 3] * down;
      const c = coefficients[base + 4] * right + coefficients[base + 5] * down;
      const a = 1 - b - c;
      if (a >= -tolerance && b >= -tolerance && c >= -tolerance) return triangle;
      triangle = this.neighbours[3 * triangle + (a <= b && a <= c ? 0 : b <= c ? 1 : 2)];
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
function neighbours(triangles) {
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
   * @param {Indices} triangles
   * @param {number} tolerance
   */
  static of(source, target, triangles, tolerance) {
    return new _PiecewiseAffineMap(new TriangleFinder(source, triangles, tolerance), target);
  }
  /** @param {import("../pointer_layer/types.js").AffineMapState} state */
  static fromState({ source, target, triangles, tolerance }) {
    const [before, after] = [toNumbers(source, Float64Array), toNumbers(target, Float64Array)];
    return _PiecewiseAffineMap.of(before, after, toNumbers(triangles, Uint32Array), tolerance);
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

// shared/svg.js
var NAMESPACE = "http://www.w3.org/2000/svg";
var PALE = 170;
function append(parent, tag, className, attributes = {}) {
  const element = document.createElementNS(NAMESPACE, tag);
  element.setAttribute("class", className);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  parent.append(element);
  return element;
}
function appendText(parent, className, attributes, content) {
  const text = append(parent, "text", className, attributes);
  text.textContent = content;
  return text;
}
function togglePale(text, coloured) {
  const [red, green, blue] = (getComputedStyle(coloured).fill.match(/\d+/g) ?? [0, 0, 0]).map(Number);
  text.classList.toggle("pale", 0.299 * red + 0.587 * green + 0.114 * blue > PALE);
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

// pointer_layer/marks.js
var PIN = "M0,0C-2,-6 -7,-9 -7,-14A7,7 0 1 1 7,-14C7,-9 2,-6 0,0Z";
var CROSS = "M-18,0H-6M6,0H18M0,-18V-6M0,6V18";
var DRAW = {
  cutoff(group, mark) {
    const disc = append(group, "circle", "disc", { r: 8, fill: mark.colour });
    togglePale(appendText(group, "number", { y: 3.5 }, mark.text), disc);
  },
  held(group, mark) {
    append(group, "path", "pin", { d: PIN, fill: mark.colour });
    append(group, "circle", "eye", { cy: -14, r: 2.5 });
  },
  cursor(group, mark) {
    const halo = { className: "halo", width: 5, stroke: "white" };
    for (const { className, width, stroke } of [halo, { className: "aim", width: 2, stroke: mark.colour }]) {
      append(group, "path", className, { d: CROSS, stroke, "stroke-width": width });
      append(group, "circle", className, { r: 9, stroke, "stroke-width": width });
    }
  }
};
function drawMarks(group, marks, plotArea) {
  group.replaceChildren();
  for (const mark of marks) {
    const { x, y } = plotArea.toPixels(mark.x, mark.z);
    DRAW[mark.kind](append(group, "g", `mark ${mark.kind}`, { transform: `translate(${x} ${y})` }), mark);
  }
}

// pointer_layer/mesh.js
var UNITS = 10;
function drawMesh(path, { vertices, edges }, opacity, plotArea) {
  path.setAttribute("transform", `scale(${1 / UNITS})`);
  path.setAttribute("stroke-opacity", String(opacity));
  path.setAttribute("d", vertices && edges && opacity > 0 ? visibleEdges(vertices, edges, plotArea) : "");
}
function visibleEdges(vertices, edges, plotArea) {
  const [xs, ys] = pathCoordinates(toNumbers(vertices, Float64Array), plotArea);
  const ends = toNumbers(edges, Uint32Array);
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
  }
  /** Read the present size, before any scaling of the page; false if the plot area is not shown. */
  measure() {
    const style = getComputedStyle(this.plot);
    const [width, height] = [style.width, style.height].map(Number.parseFloat);
    if (!(width >= 1 && height >= 1)) return false;
    [this.width, this.height] = [width, height];
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
    const box = this.plot.getBoundingClientRect();
    const [across, down] = [this.width / box.width, this.height / box.height];
    return { x: (event.clientX - box.left) * across, y: (event.clientY - box.top) * down };
  }
};

// pointer_layer/strokes.js
var HALO = 1.5;
var LABEL_MARGIN = 4;
var LABEL_OFFSET = 9;
var CAPITAL_HEIGHT = 10;
function drawStrokes(group, strokes, plotArea) {
  group.replaceChildren();
  const lines = append(group, "g", "lines");
  const labels = append(group, "g", "labels");
  for (const stroke of strokes) {
    const pixels = stroke.points.map((point) => point && plotArea.toPixels(...point));
    drawStroke(append(lines, "g", "stroke"), stroke, pixels);
    if (stroke.label) drawLabel(labels, stroke, pixels, plotArea);
  }
}
function drawStroke(group, stroke, pixels) {
  const { colour, width } = stroke;
  const line = { d: pathData(pixels), "stroke-dasharray": stroke.dash.join(" ") };
  const dots = { d: stroke.dots ? dotData(pixels) : "" };
  const radius = width + 1;
  append(group, "path", "halo", { ...line, "stroke-width": width + 2 * HALO });
  append(group, "path", "halo", { ...dots, "stroke-width": 2 * (radius + HALO) });
  append(group, "path", "line", { ...line, "stroke-width": width, stroke: colour });
  append(group, "path", "dots", { ...dots, "stroke-width": 2 * radius, stroke: colour });
  const chosen = pixels[stroke.chosen ?? -1];
  if (chosen) append(group, "circle", "chosen", { cx: chosen.x, cy: chosen.y, r: radius + 3, stroke: colour });
}
function dotData(pixels) {
  return pixels.map((pixel) => pixel && `M${pixel.x.toFixed(2)},${pixel.y.toFixed(2)}h0`).join("");
}
function drawLabel(group, stroke, pixels, plotArea) {
  const start = firstVisible(pixels, plotArea);
  if (!start) return;
  const label = appendText(group, "name", {}, stroke.label);
  label.style.fill = stroke.colour;
  togglePale(label, label);
  const { x, y } = labelPosition(start, label.getComputedTextLength(), plotArea);
  label.setAttribute("x", String(x));
  label.setAttribute("y", String(y));
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
  for (const { start, change, size } of sides) {
    if (change === 0) {
      if (start < 0 || start > size) return null;
      continue;
    }
    const [one, other] = [-start / change, (size - start) / change];
    [first, last] = [Math.max(first, Math.min(one, other)), Math.min(last, Math.max(one, other))];
  }
  return first <= last ? { x: from.x + first * (to.x - from.x), y: from.y + first * (to.y - from.y) } : null;
}

// pointer_layer/view.js
var REST = 250;
var ALL_PARTS = ["axes", "mesh", "strokes", "marks", "cursors"];
var PARTS_BY_TRAIT = {
  axes: ["axes"],
  label: ["axes"],
  size: ["axes"],
  window: ["mesh", "strokes", "marks", "cursors"],
  strokes: ["strokes"],
  marks: ["marks"],
  mesh: ["mesh"],
  mesh_opacity: ["mesh"],
  rubber: ["cursors"],
  linked: ["cursors"]
};
function createElements(el) {
  el.classList.add("seiswidgets-layer");
  const plot = append(el, "svg", "plot", { tabindex: 0, role: "application" });
  const axes = append(plot, "g", "axes");
  const inside = append(plot, "svg", "inside", { width: "100%", height: "100%" });
  const mesh = append(inside, "path", "mesh");
  const [strokes, marks, linked, own, band] = ["strokes", "marks", "linked", "own", "band"].map(
    (name) => append(inside, "g", name)
  );
  const note = document.createElement("div");
  note.className = "note";
  el.append(note);
  return { plot, axes, mesh, strokes, marks, linked, own, band, note };
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
    this.outdated = /* @__PURE__ */ new Set();
    this.hasReported = false;
    this.restTimer = void 0;
  }
  /**
   * Draw parts in the next frame, once however often they are requested.
   *
   * @param {Part[]} parts
   */
  requestDraw(parts) {
    if (!this.outdated.size) requestAnimationFrame(() => this.draw());
    for (const part of parts) this.outdated.add(part);
  }
  draw() {
    const { model, plotArea, elements, outdated } = this;
    this.outdated = /* @__PURE__ */ new Set();
    if (!plotArea.isReady) return;
    if (outdated.has("axes")) this.drawAxes();
    if (outdated.has("mesh")) drawMesh(elements.mesh, model.get("mesh"), model.get("mesh_opacity"), plotArea);
    if (outdated.has("strokes")) drawStrokes(elements.strokes, model.get("strokes"), plotArea);
    if (outdated.has("marks")) drawMarks(elements.marks, model.get("marks"), plotArea);
    if (outdated.has("cursors")) this.drawCursors();
  }
  drawAxes() {
    const axes = this.model.get("axes");
    drawAxes(this.elements.axes, axes, this.plotArea);
    this.elements.note.textContent = axes.note ?? "";
    this.elements.plot.setAttribute("aria-label", this.model.get("label"));
  }
  drawCursors() {
    const { x, z } = this.model.get("linked");
    const linked = x === void 0 || z === void 0 ? null : this.plotArea.toPixels(x, z);
    drawCross(this.elements.own, this.pointer, this.plotArea);
    drawCross(this.elements.linked, linked, this.plotArea);
    drawRubberBand(this.elements.band, this.model.get("rubber"), this.pointer ?? linked, this.plotArea);
  }
  /** @param {import("./types.js").Pixel | null} position */
  movePointer(position) {
    this.pointer = position;
    this.carryPointer();
    this.requestDraw(["cursors"]);
  }
  /** Set the carried position. It is never saved: other layers need it, the kernel does not. */
  carryPointer() {
    if (!this.plotArea.isReady) return;
    this.maps ??= this.model.get("chain").map((state) => PiecewiseAffineMap.fromState(state));
    const carried = this.pointer && carry(this.maps, this.plotArea.toSection(this.pointer));
    this.model.set("carried", carried ?? {});
  }
  /**
   * Send a message about an event to the kernel. A key has no position of its own: it is sent with the pointer's.
   *
   * @type {import("./keyboard.js").Send}
   */
  send(kind, event, more = {}) {
    const position = "clientX" in event ? this.plotArea.pointerPosition(event) : this.pointer;
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
    const { width, height } = this.plotArea;
    this.model.send({ kind: "size", width, height, ratio: window.devicePixelRatio || 1, fresh: !this.hasReported });
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
  listen("keydown", keep);
  listen("keypress", keep);
  listen("pointerdown", (_, box) => {
    if (!box.hasAttribute("tabindex")) box.tabIndex = -1;
  });
  return () => controller.abort();
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

// pointer_layer.js
function observe(model, view, throttles) {
  const receive = ({ kind, to }) => kind === "answer" && throttles[to]?.answer();
  const handlers = [
    ...Object.entries(PARTS_BY_TRAIT).map(
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
function initialize({ model }) {
  keepTraitsLocal(model, ["carried", "linked"]);
}
function render({ model, el }) {
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
  const throttles = createThrottles(model);
  const keyboard = new Keyboard(plot, model, actions.send);
  keyboard.listenWith(listen);
  new GestureRecogniser(plot, view.plotArea, keyboard, throttles, actions).listenWith(listen);
  const stopObserving = observe(model, view, throttles);
  const stopKeepingKeys = keepKeys(() => el.parentElement);
  const observer = new ResizeObserver(() => view.reportSize());
  observer.observe(plot);
  window.addEventListener("resize", () => view.reportSize(), { signal });
  return () => {
    controller.abort();
    observer.disconnect();
    clearTimeout(view.restTimer);
    stopObserving();
    stopKeepingKeys();
  };
}
var pointer_layer_default = { initialize, render };
export {
  pointer_layer_default as default
};
