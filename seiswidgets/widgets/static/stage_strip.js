/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

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

// stage_strip/strip.js
var LEAST = 3;
var SIZE = { width: 108, height: 60 };
var SHARPNESS = 2;
var REST = 300;
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
    this.timer = setTimeout(() => this.draw(getPicture()), REST);
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

// stage_strip.js
var REDRAWN = "change:stages change:texture change:revision change:colours change:picture";
function render({ model, el }) {
  const frames = model.get("frames");
  const strip = new StageStrip(el, ({ count }) => {
    model.set("frame", frames * count);
    model.save_changes();
  });
  let picture = null;
  const redraw = () => strip.scheduleDraw(() => picture?.get("picture") ?? null);
  const mark = () => strip.mark(model.get("frame") / frames);
  const show = () => {
    strip.show(model.get("scenes"));
    mark();
    redraw();
  };
  model.on("change:scenes", show);
  model.on("change:frame", mark);
  let isStopped = false;
  const reference = model.get("picture").replace("IPY_MODEL_", "");
  model.widget_manager.get_model(reference).then((found) => {
    if (isStopped) return;
    picture = found;
    found.on(REDRAWN, redraw);
    redraw();
  });
  const stopKeepingKeys = keepKeys(() => el);
  show();
  return () => {
    isStopped = true;
    strip.stop();
    stopKeepingKeys();
    model.off("change:scenes", show);
    model.off("change:frame", mark);
    picture?.off(
      /** @type {"change:stages"} */
      REDRAWN,
      redraw
    );
  };
}
var stage_strip_default = { render };
export {
  stage_strip_default as default
};
