/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

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

// shared/svg.js
var NAMESPACE = "http://www.w3.org/2000/svg";
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

// histogram/chart.js
var MARGIN = { left: 46, right: 22, top: 4, bottom: 38 };
var WIDE = 400;
var TITLE = "Area ratio (–): > 1, restoring compressed";
var WIDE_TITLE = "Area, present-day / restored (–): > 1, restoring compressed";
function drawChart(group, bars, size, brush, mark) {
  const scale = new Scale(bars, size);
  group.replaceChildren();
  drawAxes(group, bars, scale);
  if (brush.length) drawBrush(group, brush, scale);
  drawBars(group, bars, scale, brush);
  if (mark !== null) drawMark(group, bars, scale, scale.barOf(mark));
}
function drawAxes(group, bars, scale) {
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

// histogram.js
var HELP = "Arrow keys brush a bar, with Shift several; Escape clears.";
var SUMMARY_TOOLTIP = "Half, 1% and 99% of the area have a lower area ratio.";
var PAUSE = 50;
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
    const delay = Math.max(0, savedAt + PAUSE - performance.now());
    setTimeout(() => {
      isScheduled = false;
      savedAt = performance.now();
      model.save_changes();
    }, delay);
  };
}
function createElements(el) {
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
function barsOf(model) {
  const bars = model.get("bars");
  return "shares" in bars ? (
    /** @type {import("./histogram/scale.js").Bars} */
    bars
  ) : null;
}
function createBrush(model, getSize) {
  const save = throttledSave(model);
  const getScale = () => {
    const bars = barsOf(model);
    return bars && new Scale(bars, getSize());
  };
  const read = () => ({ brush: model.get("brush"), edges: barsOf(model)?.edges ?? [] });
  return new Brush(getScale, read, (brush) => {
    if (String(brush) === String(model.get("brush"))) return;
    model.set("brush", brush);
    save();
  });
}
function render({ model, el }) {
  const { summary, brushed, log, chart, drawing } = createElements(el);
  let [whole, size] = [1, 2].map(() => ({ width: 0, height: 0 }));
  function draw() {
    const bars = barsOf(model);
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
export {
  histogram_default as default
};
