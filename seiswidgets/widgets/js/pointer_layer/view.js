// One view of a pointer layer: its elements, what they show, and what it sends to the kernel.

import { carry, PiecewiseAffineMap } from "../maps/piecewise_affine_map.js";
import { append } from "../shared/svg.js";
import { drawAxes } from "./axes.js";
import { drawCross, drawRubberBand } from "./cursors.js";
import { modifiers } from "./keyboard.js";
import { drawMarks } from "./marks.js";
import { drawMesh } from "./mesh.js";
import { PlotArea } from "./plot_area.js";
import { drawStrokes } from "./strokes.js";

const REST = 250; // ms without a wheel step or a drag before the picture may be sharpened

/** @typedef {"axes" | "mesh" | "strokes" | "marks" | "cursors"} Part */

/** @type {Part[]} */
const ALL_PARTS = ["axes", "mesh", "strokes", "marks", "cursors"];

/**
 * The parts that show a trait.
 *
 * @type {Partial<Record<keyof import("./types.js").Traits, Part[]>>}
 */
export const PARTS_BY_TRAIT = {
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

/** @param {HTMLElement} el */
function createElements(el) {
  el.classList.add("seiswidgets-layer");
  const plot = append(el, "svg", "plot", { tabindex: 0, role: "application" });
  const axes = append(plot, "g", "axes");
  const inside = append(plot, "svg", "inside", { width: "100%", height: "100%" }); // clips what extends beyond
  const mesh = append(inside, "path", "mesh");
  const [strokes, marks, linked, own, band] = ["strokes", "marks", "linked", "own", "band"].map((name) =>
    append(inside, "g", name),
  );
  const note = document.createElement("div");
  note.className = "note";
  el.append(note);
  return { plot, axes, mesh, strokes, marks, linked, own, band, note };
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
    /** @type {Set<Part>} */
    this.outdated = new Set();
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
    if (!this.outdated.size) requestAnimationFrame(() => this.draw());
    for (const part of parts) this.outdated.add(part);
  }

  draw() {
    const { model, plotArea, elements, outdated } = this;
    this.outdated = new Set();
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
    const linked = x === undefined || z === undefined ? null : this.plotArea.toPixels(x, z);
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
    /** @type {NodeListOf<HTMLElement> | undefined} */
    const canvases = this.el.parentElement?.querySelectorAll(":scope > canvas");
    for (const canvas of canvases ?? []) canvas.inert = true; // ipycanvas would take the focus and trap Tab
    const { width, height } = this.plotArea;
    this.model.send({ kind: "size", width, height, ratio: window.devicePixelRatio || 1, fresh: !this.hasReported });
    this.hasReported = true;
    this.requestDraw(ALL_PARTS);
  }
}
