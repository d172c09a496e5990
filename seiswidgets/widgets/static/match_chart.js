/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

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
function pathData(points) {
  let command = "M";
  let data = "";
  for (const point of points) {
    if (point) data += `${command}${point.x.toFixed(2)},${point.y.toFixed(2)}`;
    command = point ? "L" : "M";
  }
  return data;
}

// match_chart/scale.js
var NEAR = 8;
function clamp(value, low, high) {
  return Math.min(high, Math.max(low, value));
}
var Scale = class {
  /**
   * @param {Curve} curve
   * @param {Size} size
   */
  constructor(curve, { width, height }) {
    this.curve = curve;
    this.width = width;
    this.height = height;
    this.low = curve.slip[0];
    this.high = curve.slip[curve.slip.length - 1];
    this.bottom = Math.min(0, ...curve.correlation);
  }
  /** @param {number} slip */
  x(slip) {
    return this.width * (slip - this.low) / (this.high - this.low);
  }
  /** @param {number} correlation */
  y(correlation) {
    return this.height * (1 - (correlation - this.bottom) / (1 - this.bottom));
  }
  /**
   * The slip at a position, or that of a peak beside it.
   *
   * @param {number} x
   * @param {boolean} isFree whether peaks do not attract
   */
  slipAt(x, isFree) {
    const distance = (peak) => Math.abs(this.x(peak.slip) - x);
    const [nearest] = this.curve.peaks.filter((peak) => distance(peak) <= NEAR).sort((a, b) => distance(a) - distance(b));
    if (nearest && !isFree) return nearest.slip;
    return clamp(this.low + x / this.width * (this.high - this.low), this.low, this.high);
  }
  /**
   * The correlation for a slip.
   *
   * @param {number} slip
   */
  correlationAt(slip) {
    const { slip: slips, correlation } = this.curve;
    const found = slips.findIndex((other) => other >= slip);
    const after = found < 0 ? slips.length - 1 : Math.max(found, 1);
    const share = clamp((slip - slips[after - 1]) / (slips[after] - slips[after - 1]), 0, 1);
    return correlation[after - 1] + share * (correlation[after] - correlation[after - 1]);
  }
  /**
   * The slip that a key leads to; null if it has no meaning here.
   *
   * @param {string} key
   * @param {boolean} isFast
   * @param {number} slip
   */
  slipByKey(key, isFast, slip) {
    const step = this.curve.step * (isFast ? 10 : 1);
    const sorted = this.curve.peaks.map((peak) => peak.slip).sort((a, b) => a - b);
    const apart = this.curve.step / 100;
    const targets = {
      ArrowLeft: slip - step,
      ArrowDown: slip - step,
      ArrowRight: slip + step,
      ArrowUp: slip + step,
      PageDown: sorted.filter((peak) => peak < slip - apart).pop(),
      PageUp: sorted.find((peak) => peak > slip + apart),
      Home: this.low,
      End: this.high,
      Enter: this.curve.peaks[0]?.slip
    };
    const target = targets[key];
    return target === void 0 ? null : clamp(target, this.low, this.high);
  }
};
function ticks(low, high, most) {
  const rough = (high - low) / Math.max(most, 1);
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = decade * ([1, 2, 5, 10].find((factor) => factor * decade >= rough) ?? 10);
  const found = [];
  for (let tick = Math.ceil(low / step - 1e-9) * step; tick <= high + 1e-9 * step; tick += step)
    found.push(Number(tick.toPrecision(12)));
  return found;
}

// match_chart/chart.js
var MARGIN = { left: 48, right: 40, top: 8, bottom: 34 };
var DECIMALS = 2;
var GAP = 10;
var TICK_WIDTH = 70;
function drawCurve(group, curve, size, slip) {
  const scale = new Scale(curve, size);
  group.replaceChildren();
  drawAxes(group, scale);
  drawDeformation(group, scale);
  const chance = scale.y(curve.chance);
  append(append(group, "line", "chance", { x1: 0, x2: size.width, y1: chance, y2: chance }), "title", "").textContent = `Unrelated rock reaches a correlation of ${curve.chance.toFixed(DECIMALS)}`;
  const points = curve.slip.map((one, i) => ({ x: scale.x(one), y: scale.y(curve.correlation[i]) }));
  append(group, "path", "curve", { d: pathData(points) });
  curve.peaks.forEach((peak, rank) => {
    const at = { cx: scale.x(peak.slip), cy: scale.y(scale.correlationAt(peak.slip)), r: rank === 0 ? 6 : 4 };
    const tooltip = append(append(group, "circle", rank === 0 ? "peak first" : "peak", at), "title", "");
    const share = Math.round(100 * peak.weight);
    tooltip.textContent = `${Math.round(peak.slip)} m: correlation ${peak.correlation.toFixed(DECIMALS)}, ${share}% likely`;
  });
  if (slip !== null) drawMatch(group, scale, slip);
}
function drawAxes(group, scale) {
  const { width, height } = scale;
  append(group, "line", "axis", { x1: 0, x2: width, y1: height, y2: height });
  for (const slip of ticks(scale.low, scale.high, width / TICK_WIDTH)) {
    const x = scale.x(slip);
    append(group, "line", "axis", { x1: x, x2: x, y1: height, y2: height + 4 });
    appendText(group, "middle", { x, y: height + 15 }, String(slip));
  }
  for (const correlation of [0, 0.5, 1]) {
    const y = scale.y(correlation);
    append(group, "line", "grid", { x1: 0, x2: width, y1: y, y2: y });
    appendText(group, "end", { x: -5, y: y + 4 }, String(correlation));
  }
  appendText(group, "middle", { x: width / 2, y: height + 29 }, "Slip at the middle of the fault (m)");
  const upwards = (x) => `translate(${x} ${height / 2}) rotate(-90)`;
  appendText(group, "middle", { transform: upwards(11 - MARGIN.left) }, "Correlation");
  if (scale.curve.deformation.length)
    appendText(group, "middle faint", { transform: upwards(width + 34) }, "Strain (%)");
}
function drawDeformation(group, scale) {
  const { deformation } = scale.curve;
  if (!deformation.length) return;
  const most = Math.max(...deformation.map(([, percent]) => percent), 1e-3);
  const y = (percent) => scale.height * (1 - percent / most);
  const points = deformation.map(([slip, percent]) => ({ x: scale.x(slip), y: y(percent) }));
  append(group, "path", "deformation", { d: pathData(points) });
  for (const percent of [0, most])
    appendText(
      group,
      "start faint",
      { x: scale.width + 4, y: y(percent) + 4 },
      Number(percent.toPrecision(2)).toString()
    );
}
function drawMatch(group, scale, slip) {
  const x = scale.x(slip);
  if (!(x >= 0 && x <= scale.width)) return;
  append(group, "line", "match", { x1: x, x2: x, y1: 0, y2: scale.height });
  append(group, "path", "handle", { d: `M ${x} ${scale.height} l -6 9 h 12 z` });
}
function drawProfiles(group, profile, size, span) {
  group.replaceChildren();
  const [top, bottom] = span;
  const y = (z) => size.height * (z - top) / (bottom - top);
  const width = (size.width - GAP * (profile.lines.length - 1)) / profile.lines.length;
  for (const z of ticks(top, bottom, size.height / 30)) {
    append(group, "line", "grid", { x1: 0, x2: size.width, y1: y(z), y2: y(z) });
    appendText(group, "end", { x: -5, y: y(z) + 4 }, String(z));
  }
  appendText(
    group,
    "middle",
    { transform: `translate(${11 - MARGIN.left} ${size.height / 2}) rotate(-90)` },
    profile.title
  );
  profile.lines.forEach(({ title, values, least, most }, i) => {
    const panel = append(group, "g", "panel", { transform: `translate(${i * (width + GAP)} 0)` });
    const x = (value) => width * (value - least) / (most - least);
    append(panel, "rect", "frame", { width, height: size.height });
    if (least < 0 && most > 0) append(panel, "line", "axis", { x1: x(0), x2: x(0), y1: 0, y2: size.height });
    const points = values.map((value, k) => value === null ? null : { x: x(value), y: y(profile.z[k]) });
    const inside = points.map((point) => point && point.y >= 0 && point.y <= size.height ? point : null);
    append(panel, "path", "profile", { d: pathData(inside) });
    appendText(panel, "middle", { x: width / 2, y: size.height + 29 }, title);
    appendText(panel, "start", { x: 0, y: size.height + 14 }, Number(least.toPrecision(3)).toString());
    appendText(panel, "end", { x: width, y: size.height + 14 }, Number(most.toPrecision(3)).toString());
  });
}

// shared/keep_keys.js
var SUPPRESS = "data-lm-suppress-shortcuts";
var stopPropagation = (event) => event.stopPropagation();
function keepKeys(findBox) {
  const controller = new AbortController();
  const { signal } = controller;
  const listen2 = (type, handle) => {
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
  ) listen2(type, keep);
  listen2("pointerdown", (_, box) => {
    if (!box.hasAttribute("tabindex")) box.tabIndex = -1;
  });
  return () => controller.abort();
}

// match_chart.js
var PAUSE = 50;
var ANSWERED = 1500;
var CHANGES = "change:curve change:slip change:profile change:span change:summary";
var HELP = "Arrow keys change the slip, with Shift by ten; Page Up and Page Down go to the next peak, Enter to the best.";
function createChart(parent, className, attributes) {
  const chart = append(parent, "svg", className, attributes);
  return { chart, group: append(chart, "g", "drawing", { transform: `translate(${MARGIN.left} ${MARGIN.top})` }) };
}
function curveOf(model) {
  const curve = model.get("curve");
  return "slip" in curve ? (
    /** @type {import("./match_chart/scale.js").Curve} */
    curve
  ) : null;
}
function sizeOf(chart) {
  const box = chart.getBoundingClientRect();
  return { width: box.width - MARGIN.left - MARGIN.right, height: box.height - MARGIN.top - MARGIN.bottom };
}
var Drag = class {
  /**
   * @param {Model} model
   * @param {() => void} redraw
   */
  constructor(model, redraw) {
    this.model = model;
    this.redraw = redraw;
    this.slip = null;
    this.pointerId = null;
    this.timer = void 0;
    this.forgetting = void 0;
  }
  /** @param {number} slip */
  move(slip) {
    clearTimeout(this.forgetting);
    this.slip = slip;
    this.redraw();
    this.timer ??= setTimeout(() => this.send(false), PAUSE);
  }
  release() {
    if (this.slip === null) return;
    this.send(true);
    this.forgetting = setTimeout(() => this.forget(), ANSWERED);
  }
  /** Show the kernel's slip from now on, unless it is still being dragged. */
  forget() {
    if (this.pointerId !== null || this.timer !== void 0) return;
    clearTimeout(this.forgetting);
    this.slip = null;
    this.redraw();
  }
  /** @param {boolean} settled */
  send(settled) {
    clearTimeout(this.timer);
    this.timer = void 0;
    this.model.send({ kind: "slide", slip: this.slip, settled });
  }
};
function listen(chart, drag, getScale, signal) {
  const xOf = (event) => event.clientX - chart.getBoundingClientRect().left - MARGIN.left;
  const follow = (event) => {
    const scale = getScale();
    if (event.pointerId === drag.pointerId && scale) drag.move(scale.slipAt(xOf(event), event.shiftKey));
  };
  const press = (event) => {
    if (drag.pointerId !== null || event.button !== 0 || !getScale()) return;
    event.preventDefault();
    chart.classList.add("by-pointer");
    chart.focus({ preventScroll: true });
    chart.setPointerCapture(event.pointerId);
    drag.pointerId = event.pointerId;
    follow(event);
  };
  const release = (event) => {
    if (event.pointerId !== drag.pointerId) return;
    drag.pointerId = null;
    drag.release();
  };
  const key = (event) => {
    const scale = getScale();
    chart.classList.remove("by-pointer");
    if (!scale || event.ctrlKey || event.altKey || event.metaKey) return;
    const slip = scale.slipByKey(event.key, event.shiftKey, drag.slip ?? drag.model.get("slip") ?? 0);
    if (slip === null) return;
    event.preventDefault();
    drag.move(slip);
  };
  chart.addEventListener("pointerdown", press, { signal });
  chart.addEventListener("pointermove", follow, { signal });
  chart.addEventListener("pointerup", release, { signal });
  chart.addEventListener("pointercancel", release, { signal });
  chart.addEventListener("keydown", key, { signal });
  chart.addEventListener("keyup", () => drag.pointerId === null && drag.release(), { signal });
  chart.addEventListener("blur", () => drag.pointerId === null && drag.release(), { signal });
}
function describe(chart, scale, slip) {
  chart.setAttribute("aria-disabled", String(!scale));
  if (!scale) return;
  const now = slip ?? 0;
  chart.setAttribute("aria-valuemin", String(Math.round(scale.low)));
  chart.setAttribute("aria-valuemax", String(Math.round(scale.high)));
  chart.setAttribute("aria-valuenow", String(Math.round(now)));
  const correlation = scale.correlationAt(now).toFixed(2);
  chart.setAttribute("aria-valuetext", slip === null ? "no match" : `${Math.round(now)} m, correlation ${correlation}`);
}
function render({ model, el }) {
  el.classList.add("seiswidgets-match");
  const summary = document.createElement("div");
  summary.className = "summary";
  summary.setAttribute("aria-live", "polite");
  const charts = document.createElement("div");
  charts.className = "charts";
  el.append(summary, charts);
  const names = { tabindex: 0, role: "slider", "aria-label": `Slip of the fault. ${HELP}`, "aria-valuenow": 0 };
  const { chart, group } = createChart(charts, "chart", names);
  const side = createChart(charts, "profiles", { role: "img" });
  let size = { width: 0, height: 0 };
  const getScale = () => {
    const curve = curveOf(model);
    return curve && size.width >= 1 && size.height >= 1 ? new Scale(curve, size) : null;
  };
  function draw() {
    const [scale, profile] = [getScale(), model.get("profile")];
    const slip = drag.slip ?? model.get("slip");
    summary.textContent = model.get("summary");
    el.classList.toggle("empty", !scale);
    describe(chart, scale, slip);
    if (scale) drawCurve(group, scale.curve, size, slip);
    else group.replaceChildren();
    const room = sizeOf(side.chart);
    side.chart.setAttribute("aria-label", `Profiles along the fault. ${model.get("summary")}`);
    if ("z" in profile && room.width >= 1 && room.height >= 1)
      drawProfiles(
        side.group,
        /** @type {import("./match_chart/scale.js").Profile} */
        profile,
        room,
        model.get("span")
      );
    else side.group.replaceChildren();
  }
  const drag = new Drag(model, draw);
  const observer = new ResizeObserver(() => {
    size = sizeOf(chart);
    draw();
  });
  const controller = new AbortController();
  listen(chart, drag, getScale, controller.signal);
  const stopKeepingKeys = keepKeys(() => el);
  const forget = () => drag.forget();
  model.on(CHANGES, draw);
  model.on("change:slip", forget);
  observer.observe(charts);
  draw();
  return () => {
    stopKeepingKeys();
    controller.abort();
    observer.disconnect();
    clearTimeout(drag.timer);
    clearTimeout(drag.forgetting);
    model.off("change:slip", forget);
    model.off(
      /** @type {"change:curve"} */
      CHANGES,
      draw
    );
  };
}
var match_chart_default = { render };
export {
  match_chart_default as default
};
