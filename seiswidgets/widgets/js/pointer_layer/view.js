// One view of a pointer layer: its elements, what they show, and what it sends to the kernel.

import { carry, PiecewiseAffineMap } from "../maps/piecewise_affine_map.js";
import { toNumbers } from "../shared/bytes.js";
import { append } from "../shared/svg.js";
import { drawAxes } from "./axes.js";
import { drawCross, drawRubberBand } from "./cursors.js";
import { drawGrown, nearestHandle } from "./handles.js";
import { modifiers } from "./keyboard.js";
import { LivePane } from "./live_pane.js";
import { drawMarks } from "./marks.js";
import { drawMesh } from "./mesh.js";
import { PlotArea } from "./plot_area.js";
import { drawShade } from "./shade.js";
import { decodeStroke, drawStrokes } from "./strokes.js";

const REST = 250; // ms without a wheel step or a drag before the picture may be sharpened

/** @typedef {"axes" | "note" | "picture" | "bare" | "mesh" | "strokes" | "marks" | "cursors"} Part */

/** @type {Part[]} */
const ALL_PARTS = ["axes", "note", "picture", "bare", "mesh", "strokes", "marks", "cursors"];

/**
 * The parts that show a trait.
 *
 * @type {Partial<Record<keyof import("./types.js").Traits, Part[]>>}
 */
export const PARTS_BY_TRAIT = {
  axes: ["axes", "note"],
  label: ["axes"],
  size: ["axes"],
  window: ["picture", "mesh", "strokes", "marks", "cursors"],
  strokes: ["strokes"],
  changed_strokes: ["strokes"],
  marks: ["strokes", "marks"], // lines are thin near cut-offs
  mesh: ["mesh"],
  mesh_opacity: ["mesh"],
  stage: ["strokes", "marks"],
  shade: ["mesh"],
  rubber: ["cursors"],
  linked: ["cursors"],
};

/** @param {HTMLElement} el */
function createElements(el) {
  el.classList.add("seiswidgets-layer");
  const plot = append(el, "svg", "plot", { tabindex: 0, role: "application" });
  const axes = append(plot, "g", "axes");
  const inside = append(plot, "svg", "inside", { width: "100%", height: "100%" }); // clips what extends beyond
  const shade = append(inside, "image", "shade", { preserveAspectRatio: "none" });
  const mesh = append(inside, "path", "mesh");
  const [strokes, marks, grown, linked, own, band] = ["strokes", "marks", "grown", "linked", "own", "band"].map(
    (name) => append(inside, "g", name),
  );
  const note = document.createElement("div");
  note.className = "note";
  el.append(note);
  return { plot, axes, shade, mesh, strokes, marks, grown, linked, own, band, note };
}

/** Draws the traits of the layer in one element. */
export class LayerView {
  /**
   * @param {import("./types.js").Model} model
   * @param {HTMLElement} el
   */
  constructor(model, el) {
    this.model = model;
    this.el = el;
    this.elements = createElements(el);
    this.plotArea = new PlotArea(model, this.elements.plot);
    /** @type {import("./types.js").Pixel | null} */
    this.pointer = null; // null while it is elsewhere
    /** @type {PiecewiseAffineMap[] | null} */
    this.maps = null; // of the chain, built when first needed
    /** @type {{ states: unknown, strokes: import("./types.js").Stroke[] }} */
    this.decoded = { states: null, strokes: [] };
    /** @type {import("./handles.js").Handle[]} */
    this.handles = [];
    this.live = new LivePane(model, el, (parts) => this.requestDraw(parts));
    /** @type {Set<Part>} */
    this.outdated = new Set();
    this.isScheduled = false;
    this.hasReported = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.restTimer = undefined;
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
    const cutoffs = marks
      .filter(({ kind }) => kind === "cutoff")
      .map(({ x, z, colour, text }) => ({ ...this.plotArea.toPixels(x, z), colour, text }));
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
    const linked = x === undefined || z === undefined ? null : this.plotArea.toPixels(x, z);
    this.growHandle();
    drawCross(this.elements.own, this.pointer, this.plotArea);
    drawCross(this.elements.linked, linked, this.plotArea);
    drawRubberBand(
      this.elements.band,
      this.live.placedPoints(this.model.get("rubber")),
      this.pointer ?? linked,
      this.plotArea,
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
    const position = "clientX" in event ? this.plotArea.pointerPosition(event) : (this.pointer ?? middle);
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
    /** @type {NodeListOf<HTMLElement> | undefined} */
    const canvases = this.el.parentElement?.querySelectorAll(":scope > canvas");
    for (const canvas of canvases ?? []) canvas.inert = true; // ipycanvas would take the focus and trap Tab
    const { width, height, pixelRatio: ratio } = this.plotArea;
    this.model.send({ kind: "size", width, height, ratio, fresh: !this.hasReported });
    this.hasReported = true;
    this.requestDraw(ALL_PARTS);
  }
}
