// The layer on top of a pane. It owns every event, draws axes, cursors and the rubber band, and tells the kernel
// only what it needs. Positions are css pixels from the plot area's upper left corner.

const SVG = "http://www.w3.org/2000/svg";
const STEP = 100; // css pixels of scrolling in one step of a wheel
const LINE = 16; // css pixels in a line, for wheels that count lines
const DRAG_PAUSE = 50; // ms between two messages
const HOVER_PAUSE = 350;
const REST = 250; // ms without a wheel or a drag until the picture may be sharpened

function element(name, className, parent) {
  const made = document.createElementNS(SVG, name);
  made.setAttribute("class", className);
  parent.append(made);
  return made;
}

function place(node, attributes) {
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  return node;
}

// A line of messages of one kind to the kernel. The next is sent when the kernel has answered the last, and not before
// a pause; what comes meanwhile is merged into one.
function lane(model, kind, pause, merge = (_, newest) => newest) {
  let waiting = null;
  let answered = true;
  let timer = null;
  let last = -Infinity;
  const pump = () => {
    timer = null;
    if (!waiting || !answered) return;
    const left = last + pause - performance.now();
    if (left > 1) {
      timer = setTimeout(pump, left);
      return;
    }
    [last, answered] = [performance.now(), false];
    model.send({ kind, ...waiting });
    waiting = null;
  };
  return {
    add(message) {
      waiting = waiting ? merge(waiting, message) : message;
      if (timer === null) timer = requestAnimationFrame(() => pump());
    },
    drop() {
      waiting = null;
    },
    answer() {
      answered = true;
      if (timer === null) pump();
    },
  };
}

function modifiers(event) {
  return ["ctrl", "meta", "shift", "alt"].filter((name) => event[`${name}Key`]);
}

function position(event, plot) {
  const box = plot.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

// Wheel, as steps towards the section.
function steps(event, height) {
  const unit = [1, LINE, height][event.deltaMode];
  return (-event.deltaY * unit) / STEP;
}

function drawAxes(group, axes, width, height) {
  group.replaceChildren();
  if (!axes.x) return;
  place(element("rect", "frame", group), { x: 0, y: 0, width, height });
  axes.x.pixels.forEach((x, i) => {
    place(element("line", "tick", group), { x1: x, x2: x, y1: height, y2: height + 5 });
    place(element("text", "label middle", group), { x, y: height + 17 }).textContent = axes.x.labels[i];
  });
  axes.z.pixels.forEach((y, i) => {
    place(element("line", "tick", group), { x1: -5, x2: 0, y1: y, y2: y });
    place(element("text", "label end", group), { x: -8, y: y + 4 }).textContent = axes.z.labels[i];
  });
  place(element("text", "title middle", group), { x: width / 2, y: height + 35 }).textContent = axes.x.title;
  const turned = `translate(${-axes.left + 13} ${height / 2}) rotate(-90)`;
  place(element("text", "title middle", group), { transform: turned }).textContent = axes.z.title;
}

function drawCross(group, at, width, height) {
  group.replaceChildren();
  if (!at) return;
  for (const className of ["halo", "cross"]) {
    place(element("line", className, group), { x1: at.x, x2: at.x, y1: 0, y2: height });
    place(element("line", className, group), { x1: 0, x2: width, y1: at.y, y2: at.y });
  }
}

function drawRubber(group, rubber, at) {
  group.replaceChildren();
  if (!at || !rubber.length) return;
  const points = [...rubber, [at.x, at.y]].map((point) => point.join(",")).join(" ");
  for (const className of ["halo", "rubber"]) place(element("polyline", className, group), { points });
}

function render({ model, el }) {
  el.classList.add("seiswidgets-layer");
  el.setAttribute("data-lm-suppress-shortcuts", "true"); // or JupyterLab would take "0 0" for restarting the kernel
  const plot = element("svg", "plot", el);
  plot.setAttribute("tabindex", "0");
  plot.setAttribute("role", "application");
  const [axes, linked, cross, rubber] = ["axes", "linked", "own", "band"].map((name) => element("g", name, plot));
  const note = document.createElement("div");
  note.className = "note";
  el.append(note);

  const ended = new AbortController();
  const lanes = {
    drag: lane(model, "drag", DRAG_PAUSE),
    hover: lane(model, "hover", HOVER_PAUSE),
    wheel: lane(model, "wheel", 0, (old, newest) => ({ ...newest, steps: old.steps + newest.steps })),
  };
  let size = { width: 0, height: 0 };
  let pointer = null; // where the pointer is, null while it is elsewhere
  let held = null; // the pointer that is down
  let resting = null;
  let reported = false;

  const inWindow = (at) => {
    const [left, right, top, bottom] = model.get("window");
    return { x: left + (at.x / size.width) * (right - left), z: top + (at.y / size.height) * (bottom - top) };
  };
  const onScreen = (at) => {
    const [left, right, top, bottom] = model.get("window");
    return { x: ((at.x - left) / (right - left)) * size.width, y: ((at.z - top) / (bottom - top)) * size.height };
  };
  const has = () => model.get("window").length === 4 && size.width > 0;

  function paintCursors() {
    const other = model.get("linked");
    drawCross(cross, pointer, size.width, size.height);
    drawCross(linked, other.x !== undefined && has() ? onScreen(other) : null, size.width, size.height);
    drawRubber(rubber, model.get("rubber"), pointer);
  }
  function paint() {
    drawAxes(axes, model.get("axes"), size.width, size.height);
    note.textContent = model.get("axes").note ?? "";
    plot.setAttribute("aria-label", model.get("label"));
    paintCursors();
  }
  function point(at) {
    pointer = at;
    if (has()) model.set("cursor", at ? inWindow(at) : {}); // never saved: it goes to other layers, not to the kernel
    paintCursors();
  }
  function report(fresh) {
    const { width, height } = plot.getBoundingClientRect();
    if (width < 1 || height < 1) return;
    size = { width, height };
    model.send({ kind: "size", width, height, ratio: window.devicePixelRatio || 1, fresh });
    reported = true;
    paint();
  }
  function restSoon() {
    clearTimeout(resting);
    resting = setTimeout(() => model.send({ kind: "rest" }), REST);
  }
  function say(kind, event, more = {}) {
    model.send({ kind, ...position(event, plot), modifiers: modifiers(event), touch: event.pointerType === "touch", ...more });
  }

  const listen = (name, act) => plot.addEventListener(name, act, { signal: ended.signal, passive: false });
  listen("pointerdown", (event) => {
    if (held !== null) return;
    event.preventDefault();
    plot.classList.add("by-pointer"); // without the ring that shows the keyboard's focus
    plot.focus({ preventScroll: true });
    plot.setPointerCapture(event.pointerId);
    held = event.pointerId;
    point(position(event, plot));
    lanes.hover.drop();
    say("press", event, { button: event.button });
  });
  listen("pointermove", (event) => {
    if (held !== null && event.pointerId !== held) return;
    const at = position(event, plot);
    point(at);
    lanes[held === null ? "hover" : "drag"].add({ ...at, modifiers: modifiers(event) });
  });
  const release = (event) => {
    if (event.pointerId !== held) return;
    held = null;
    lanes.drag.drop();
    say("release", event, { button: event.button, cancelled: event.type === "pointercancel" });
    if (event.pointerType === "touch") point(null);
    restSoon();
  };
  listen("pointerup", release);
  listen("pointercancel", release);
  listen("pointerleave", (event) => {
    if (held !== null) return;
    point(null);
    lanes.hover.drop();
    say("leave", event);
  });
  listen("dblclick", (event) => say("double", event));
  listen("contextmenu", (event) => event.preventDefault());
  listen("wheel", (event) => {
    event.preventDefault();
    lanes.wheel.add({ ...position(event, plot), steps: steps(event, size.height), modifiers: modifiers(event) });
    restSoon();
  });
  listen("keydown", (event) => {
    plot.classList.remove("by-pointer");
    const pressed = modifiers(event);
    const name = (pressed.includes("ctrl") || pressed.includes("meta") ? "Ctrl+" : "") + event.key;
    if (!model.get("hotkeys").includes(name)) return; // Tab among them: it leaves the pane
    event.preventDefault();
    event.stopPropagation();
    model.send({ kind: "key", key: event.key, modifiers: pressed, ...(pointer ?? {}) });
  });
  listen("blur", () => plot.classList.remove("by-pointer"));

  const answered = (message) => message.kind === "answer" && lanes[message.to]?.answer();
  model.on("msg:custom", answered);
  model.on("change:axes change:window change:label", paint);
  model.on("change:linked change:rubber", paintCursors);
  const watcher = new ResizeObserver(() => report(!reported));
  watcher.observe(plot);
  window.addEventListener("resize", () => report(!reported), { signal: ended.signal }); // the browser's own zoom
  return () => {
    ended.abort();
    watcher.disconnect();
    clearTimeout(resting);
    model.off("msg:custom", answered);
    model.off("change:axes change:window change:label", paint);
    model.off("change:linked change:rubber", paintCursors);
  };
}

export default { render };
