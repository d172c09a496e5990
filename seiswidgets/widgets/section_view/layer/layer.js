// The layer on top of a pane. It owns every event, draws all that need not be asked of the kernel, and tells the kernel
// only what it needs.

const REST = 250; // ms without a wheel or a drag until the picture may be sharpened
const GROUPS = ["strokes", "marks", "linked", "own", "band"];
// What is drawn anew when a trait changes.
const DRAWN_BY = {
  axes: ["axes"],
  label: ["axes"],
  size: ["axes"],
  window: ["mesh", "strokes", "marks", "cursors"],
  strokes: ["strokes"],
  marks: ["marks"],
  mesh: ["mesh"],
  mesh_opacity: ["mesh"],
  rubber: ["cursors"],
  linked: ["cursors"],
};
const EVERYTHING = ["axes", "mesh", "strokes", "marks", "cursors"];

class Layer {
  constructor(model, el) {
    this.model = model;
    el.classList.add("seiswidgets-layer");
    this.plot = element("svg", "plot", el, { tabindex: 0, role: "application" });
    this.axes = element("g", "axes", this.plot);
    const inside = element("svg", "inside", this.plot, { width: "100%", height: "100%" }); // cuts off what sticks out
    this.mesh = element("path", "mesh", inside);
    for (const name of GROUPS) this[name] = element("g", name, inside);
    this.below = () => el.parentElement?.querySelectorAll(":scope > canvas") ?? [];
    this.note = document.createElement("div");
    this.note.className = "note";
    el.append(this.note);
    this.plane = new Plane(model, this.plot);
    this.pointer = null; // where the pointer is, null while it is elsewhere
    this.pieces = null; // of the chain, made when they are first needed
    this.stale = new Set();
  }

  // Draw some of it in the next frame, however often that is asked for.
  soon(names) {
    if (!this.stale.size) requestAnimationFrame(() => this.draw());
    for (const name of names) this.stale.add(name);
  }

  draw() {
    const [model, plane, stale] = [this.model, this.plane, this.stale];
    this.stale = new Set();
    if (!plane.isReady) return;
    if (stale.has("axes")) this.drawAxes();
    if (stale.has("mesh")) drawMesh(this.mesh, model.get("mesh"), model.get("mesh_opacity"), plane);
    if (stale.has("strokes")) drawStrokes(this.strokes, model.get("strokes"), plane);
    if (stale.has("marks")) drawMarks(this.marks, model.get("marks"), plane);
    if (stale.has("cursors")) this.drawCursors();
  }

  drawAxes() {
    drawAxes(this.axes, this.model.get("axes"), this.plane);
    this.note.textContent = this.model.get("axes").note ?? "";
    this.plot.setAttribute("aria-label", this.model.get("label"));
  }

  drawCursors() {
    const { x, z } = this.model.get("linked");
    const linked = x === undefined ? null : this.plane.toPixels(x, z);
    drawCross(this.own, this.pointer, this.plane);
    drawCross(this.linked, linked, this.plane);
    drawRubber(this.band, this.model.get("rubber"), this.pointer ?? linked, this.plane);
  }

  moveTo(at) {
    this.pointer = at;
    this.carry();
    this.soon(["cursors"]);
  }

  // Set, but never saved: other layers are to know it, not the kernel.
  carry() {
    if (!this.plane.isReady) return;
    this.pieces ??= this.model.get("chain").map((map) => new AffinePieces(map));
    this.model.set("carried", (this.pointer && carryAlong(this.pieces, this.plane.toSection(this.pointer))) || {});
  }

  tell(kind, event, more = {}) {
    const at = event.clientX === undefined ? this.pointer : this.plane.under(event); // a key has no place of its own
    const where = at ? this.plane.forKernel(at) : {};
    this.model.send({ kind, ...where, modifiers: modifiers(event), touch: event.pointerType === "touch", ...more });
  }

  restSoon() {
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.model.send({ kind: "rest" }), REST);
  }

  // Tell the kernel the size of the plot area; the first time, that there is a view that knows nothing yet.
  report() {
    if (!this.plane.measure()) return;
    this.below().forEach((canvas) => (canvas.inert = true)); // ipycanvas would take the focus, and Tab never leave it
    const { width, height } = this.plane;
    this.model.send({ kind: "size", width, height, ratio: window.devicePixelRatio || 1, fresh: !this.isReported });
    this.isReported = true;
    this.soon(EVERYTHING);
  }
}

// Calls of the model, kept so that they can be ended with the view.
function follow(model, layer, lanes) {
  const handlers = Object.entries(DRAWN_BY).map(([trait, names]) => [`change:${trait}`, () => layer.soon(names)]);
  handlers.push(["change:chain", () => (layer.pieces = null)]);
  handlers.push(["change:window", () => layer.pointer && layer.carry()]);
  handlers.push(["msg:custom", (message) => message.kind === "answer" && lanes[message.to]?.answer()]);
  for (const [name, handler] of handlers) model.on(name, handler);
  return () => handlers.forEach(([name, handler]) => model.off(name, handler));
}

function initialize({ model }) {
  keepFromKernel(model, ["carried", "linked"]);
}

function render({ model, el }) {
  const layer = new Layer(model, el);
  const ended = new AbortController();
  const listen = (name, act) => layer.plot.addEventListener(name, act, { signal: ended.signal, passive: false });
  const tell = (...what) => layer.tell(...what);
  const keys = new Keys(layer.plot, model, tell);
  const roads = lanes(model);
  const does = { tell, moveTo: (at) => layer.moveTo(at), restSoon: () => layer.restSoon() };
  keys.listenTo(listen);
  new Hand(layer.plot, layer.plane, keys, roads, does).listenTo(listen);
  const unfollow = follow(model, layer, roads);
  const endKeeping = keepKeys(() => el.parentElement); // with the canvases below
  const watcher = new ResizeObserver(() => layer.report());
  watcher.observe(layer.plot);
  window.addEventListener("resize", () => layer.report(), { signal: ended.signal }); // the browser's own zoom
  return () => {
    ended.abort();
    watcher.disconnect();
    clearTimeout(layer.resting);
    unfollow();
    endKeeping();
  };
}

export default { initialize, render };
