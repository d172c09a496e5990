// Bars of the area ratio's distribution. Everything is drawn, and brushed, in the browser; the kernel is told the brush.

const [LEFT, RIGHT, TOP, BOTTOM] = [46, 22, 4, 38]; // css pixels about the bars, for the axes
const ROOM = 1.12; // the axis is so much higher than the highest bar, for the mark above it
const WIDE = 400; // css pixels from which there is room for the whole title
const TITLES = ["Area ratio (–): < 1 expansion, > 1 compression", "Area ratio, initial / final (–): < 1 expansion, > 1 compression"];
const HELP = "Arrow keys brush a bar, with Shift several; Escape clears.";
const PAUSE = 50; // ms between two messages

function line(className, parent) {
  const made = document.createElement("div");
  made.className = className;
  parent.append(made);
  return made;
}

// A function that sends what has changed: not before a pause, and by ipywidgets' own rule not before the kernel is done
// with the last; what changes meanwhile is merged.
function saver(model) {
  let timer = null;
  let last = -Infinity;
  const save = () => {
    [timer, last] = [null, performance.now()];
    model.save_changes();
  };
  return () => (timer ??= setTimeout(save, Math.max(0, last + PAUSE - performance.now())));
}

function within(value, low, high) {
  return Math.min(high, Math.max(low, value));
}

// Where things are on so many css pixels. Bars are evenly wide, as their edges are even in the logarithm.
function scales({ edges, shares }, width, height) {
  const count = shares.length;
  const [low, high] = [edges[0], edges[count]].map(Math.log);
  const highest = ROOM * Math.max(...shares);
  const inBars = (ratio) => within((count * (Math.log(ratio) - low)) / (high - low), 0, count);
  return {
    x: (ratio) => (inBars(ratio) / count) * width,
    y: (share) => height * (1 - share / highest),
    highest,
    barAt: (x) => within(Math.floor((x / width) * count), 0, count - 1),
    barOf: (ratio) => Math.min(Math.floor(inBars(ratio)), count - 1),
    // The first and the last of those whose middles are brushed, or that nearest to a narrower brush.
    covered: ([from, to]) => {
      const first = Math.min(Math.round(inBars(from)), count - 1);
      return [first, Math.max(first, Math.round(inBars(to)) - 1)];
    },
  };
}

function drawAxes(group, bars, scale, width, height) {
  element("line", "axis", group, { x1: 0, x2: width, y1: height, y2: height });
  for (const [ratio, label] of bars.x) {
    const x = scale.x(ratio);
    element("line", "axis", group, { x1: x, x2: x, y1: height, y2: height + 4 });
    element("text", "middle", group, { x, y: height + 15 }).textContent = label;
  }
  for (const [share, label] of bars.y.filter(([share]) => share <= scale.highest)) {
    const y = scale.y(share);
    element("line", "grid", group, { x1: 0, x2: width, y1: y, y2: y });
    element("text", "end", group, { x: -5, y: y + 4 }).textContent = label;
  }
  const title = TITLES[Number(width >= WIDE)];
  element("text", "middle", group, { x: width / 2, y: height + 32 }).textContent = title;
  const turned = `translate(${12 - LEFT} ${height / 2}) rotate(-90)`;
  element("text", "middle", group, { transform: turned }).textContent = "Share of the area (%)";
}

function drawBars(group, bars, scale, width, height, brush) {
  const [first, last] = brush.length ? scale.covered(brush) : [0, bars.shares.length];
  const each = width / bars.shares.length;
  bars.shares.forEach((share, i) => {
    const y = scale.y(share);
    const look = { x: i * each, y, width: each, height: height - y, fill: bars.colours[i] };
    element("rect", i < first || i > last ? "bar faded" : "bar", group, look);
    const column = element("rect", "column", group, { x: i * each, y: 0, width: each, height });
    const [low, high] = [bars.edges[i], bars.edges[i + 1]].map((edge) => edge.toFixed(bars.decimals));
    element("title", "", column).textContent = `${low} to ${high}: ${Number((100 * share).toPrecision(3))}% of the area`;
  });
}

function drawBrush(group, brush, scale, height) {
  const [left, right] = brush.map(scale.x);
  element("rect", "brush", group, { x: left, y: 0, width: Math.max(1, right - left), height });
}

function drawMark(group, bars, i, scale, width, height) {
  const each = width / bars.shares.length;
  const [x, y] = [i * each, scale.y(bars.shares[i])];
  element("rect", "mark", group, { x, y, width: each, height: height - y, "data-bar": i });
  element("path", "pointer", group, { d: `M ${x + each / 2} ${y - 2} l -5 -7 h 10 z` });
}

function render({ model, el }) {
  el.classList.add("seiswidgets-histogram");
  const head = line("head", el);
  const summary = line("summary", head);
  summary.title = "Half, 1% and 99% of the area have a lower area ratio";
  const brushed = line("brushed", head);
  brushed.setAttribute("aria-live", "polite");
  const chart = element("svg", "chart", el, { tabindex: 0, role: "application" });
  const drawing = element("g", "drawing", chart, { transform: `translate(${LEFT} ${TOP})` });
  const ended = new AbortController();
  const save = saver(model);
  let size = { width: 0, height: 0 }; // of the bars
  let anchor = null; // the bar where the brush was begun; it ends at the other
  let end = null;
  let held = null; // the pointer that is down

  const isEmpty = () => !model.get("bars").shares;
  const scale = () => scales(model.get("bars"), size.width, size.height);

  function paint() {
    const [bars, brush, mark] = ["bars", "brush", "mark"].map((name) => model.get(name));
    summary.textContent = model.get("summary");
    brushed.textContent = model.get("brushed");
    el.classList.toggle("empty", isEmpty());
    chart.setAttribute("aria-label", `Histogram of the area ratio: ${model.get("summary")}. ${HELP}`);
    drawing.replaceChildren();
    const { width, height } = size;
    if (isEmpty() || width < 1 || height < 1) return;
    const at = scale();
    drawAxes(drawing, bars, at, width, height);
    if (brush.length) drawBrush(drawing, brush, at, height); // behind the bars, whose colours are those of the map
    drawBars(drawing, bars, at, width, height, brush);
    if (mark !== null) drawMark(drawing, bars, at.barOf(mark), at, width, height);
  }
  function setBrush(brush) {
    if (String(brush) === String(model.get("brush"))) return;
    model.set("brush", brush);
    save();
  }
  function brushBars(from, to) {
    [anchor, end] = [from, to];
    const { edges } = model.get("bars");
    setBrush([edges[Math.min(from, to)], edges[Math.max(from, to) + 1]]);
  }
  // The brush may have been set by somebody else since it was drawn here.
  function recall() {
    if (!model.get("brush").length) anchor = end = null;
    else {
      const [first, last] = scale().covered(model.get("brush"));
      if (Math.min(anchor, end) !== first || Math.max(anchor, end) !== last) [anchor, end] = [first, last];
    }
  }
  const barUnder = (event) => scale().barAt(event.clientX - chart.getBoundingClientRect().left - LEFT);

  const listen = (name, act) => chart.addEventListener(name, act, { signal: ended.signal });
  listen("pointerdown", (event) => {
    if (held !== null || event.button !== 0 || isEmpty()) return;
    event.preventDefault();
    chart.classList.add("by-pointer"); // without the ring that shows the keyboard's focus
    chart.focus({ preventScroll: true });
    chart.setPointerCapture(event.pointerId);
    held = event.pointerId;
    recall();
    brushBars(event.shiftKey && anchor !== null ? anchor : barUnder(event), barUnder(event));
  });
  listen("pointermove", (event) => {
    if (event.pointerId === held && !isEmpty()) brushBars(anchor, barUnder(event));
  });
  for (const name of ["pointerup", "pointercancel"])
    listen(name, (event) => {
      if (event.pointerId === held) held = null;
    });
  listen("dblclick", () => setBrush([]));
  listen("keydown", (event) => {
    chart.classList.remove("by-pointer");
    if (isEmpty() || event.ctrlKey || event.altKey || event.metaKey) return;
    recall();
    const last = model.get("bars").shares.length - 1;
    const start = end ?? Math.floor(last / 2);
    const step = end === null ? 0 : 1; // the first press shows where one is
    const to = { ArrowLeft: start - step, ArrowRight: start + step, Home: 0, End: last }[event.key];
    if (event.key === "Escape" && model.get("brush").length) setBrush([]);
    else if (to === undefined) return;
    else brushBars(event.shiftKey && anchor !== null ? anchor : within(to, 0, last), within(to, 0, last));
    event.preventDefault();
  });
  listen("blur", () => chart.classList.remove("by-pointer"));

  const CHANGES = "change:bars change:summary change:brushed change:brush change:mark";
  model.on(CHANGES, paint);
  const watcher = new ResizeObserver(() => {
    const box = chart.getBoundingClientRect();
    size = { width: box.width - LEFT - RIGHT, height: box.height - TOP - BOTTOM };
    paint();
  });
  watcher.observe(chart);
  paint();
  const endKeeping = keepKeys(() => el);
  return () => {
    endKeeping();
    ended.abort();
    watcher.disconnect();
    model.off(CHANGES, paint);
  };
}

export default { render };
