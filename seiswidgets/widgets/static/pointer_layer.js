/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

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
function unscaledSize(element) {
  const { width, height } = getComputedStyle(element);
  return { width: Number.parseFloat(width), height: Number.parseFloat(height) };
}
function unscaledPosition(event, element, { width, height }) {
  const box = element.getBoundingClientRect();
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
   * @param {boolean} [options.isPrompt] true to send at once rather than in the next frame
   */
  constructor(send, { pause = 0, merge = (_, newest) => newest, batch = 1, isPrompt = false } = {}) {
    this.send = send;
    this.pause = pause;
    this.merge = merge;
    this.batch = batch;
    this.isPrompt = isPrompt;
    this.waiting = null;
    this.merged = 0;
    this.addedAt = -Infinity;
    this.sentAt = -Infinity;
    this.unanswered = [];
    this.limit = 1;
    this.isScheduled = false;
  }
  /** @param {Message} message */
  add(message) {
    this.waiting = this.waiting ? this.merge(this.waiting, message) : message;
    this.merged += 1;
    this.addedAt = performance.now();
    if (this.isScheduled) return;
    if (this.isPrompt) {
      this.trySending();
      return;
    }
    this.isScheduled = true;
    requestAnimationFrame(() => this.trySending());
  }
  /** Forget the message that is waiting. */
  drop() {
    this.waiting = null;
    this.merged = 0;
  }
  /**
   * Note that the kernel has answered the oldest message.
   *
   * @param {number} [took] ms that it worked on it
   */
  answer(took = Number.POSITIVE_INFINITY) {
    const sentAt = this.unanswered.shift();
    if (sentAt !== void 0) this.limit = performance.now() - sentAt > 2 * took ? 2 : 1;
    if (!this.isScheduled) this.trySending();
  }
  trySending() {
    const now = performance.now();
    this.isScheduled = false;
    if (now - this.sentAt >= LOST) this.unanswered = [];
    if (!this.waiting || this.unanswered.length >= this.limit) return;
    const due = Math.max(this.sentAt + this.pause, this.merged < this.batch ? this.addedAt + STILL : 0);
    if (due - now > 1) {
      this.isScheduled = true;
      setTimeout(() => this.trySending(), due - now);
      return;
    }
    const message = this.waiting;
    this.sentAt = now;
    this.unanswered.push(now);
    this.drop();
    this.send(message);
  }
};
function createThrottles(model) {
  const sender = (kind) => (message) => model.send({ kind, ...message });
  return {
    drag: new MessageThrottle(sender("drag"), { pause: DRAG_PAUSE, isPrompt: true }),
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

// picture/texture.js
var NO_DATA = -32768;

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
  sampleWhole(start, count, u, v, du, dv) {
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
      pixels[start + i] = colours[Math.min(Math.max(level, 1), 255) | 0];
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
  sampleBesideGaps(start, count, u, v, du, dv) {
    const { pixels, colours, factor, texture } = this;
    for (let i = 0; i < count; i++) {
      const value = meanOfData(texture, u + i * du, v + i * dv);
      const level = 128.5 + factor * value;
      pixels[start + i] = colours[value === NO_DATA ? 0 : Math.min(Math.max(level, 1), 255) | 0];
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
    const start = row * this.width + column;
    for (let i = start; i < start + count; i++) {
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
function within(start, step, pixels, samples) {
  const first = Math.ceil((-0.5 - start) / step - 1e-9);
  const last = Math.floor((samples - 0.5 - start) / step + 1e-9);
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
    const start = performance.now();
    const coarse = this.coarseness(picture.time, start);
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
    const took = performance.now() - start;
    this.last = { time: picture.time, start, took: coarse > 1 ? took * SAVED : took };
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
    const element = append(group, "g", `mark ${mark.kind}`, { transform: `translate(${x} ${y})` });
    DRAW[mark.kind](element, mark, y);
    if (mark.kind !== "finding") continue;
    const index = flags++;
    makeButton(element, mark.text ?? "", () => open(index));
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
function splitNear(line, centres, radius) {
  if (!centres.length) return { near: [], far: line };
  const parts = { near: [], far: [] };
  for (let i = 1; i < line.length; i++) {
    const [from, to] = [line[i - 1], line[i]];
    if (from && to) addSegment(parts, from, to, centres, radius);
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
function addSegment({ near, far }, from, to, centres, radius) {
  const at = (share) => ({
    x: from.x + share * (to.x - from.x),
    y: from.y + share * (to.y - from.y)
  });
  const shares = [0, ...centres.flatMap((centre) => crossings(from, to, centre, radius)), 1].sort((a, b) => a - b);
  for (let i = 1; i < shares.length; i++) {
    const middle = at((shares[i - 1] + shares[i]) / 2);
    const isNear = centres.some(({ x, y }) => Math.hypot(x - middle.x, y - middle.y) < radius);
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
    const element = append(lines, "g", "stroke");
    if (stroke.joined) drawLine(element, stroke, pixels, cutoffs);
    if (stroke.dots) handles.push(...drawDots(element, stroke, pixels));
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
  const start = firstVisible(pixels, plotArea);
  if (!start) return;
  const label = appendText(group, "name", {}, stroke.label);
  label.style.fill = stroke.colour;
  togglePale(label, label, stroke.colour);
  const { x, y } = labelPosition(start, lengthOf2(label, stroke.label), plotArea);
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
function initialize({ model }) {
  keepTraitsLocal(model, ["carried", "linked"]);
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
function render({ model, el }) {
  return mount(model, el, createThrottles(model)).stop;
}
var pointer_layer_default = { initialize, render };
export {
  pointer_layer_default as default,
  mount
};
