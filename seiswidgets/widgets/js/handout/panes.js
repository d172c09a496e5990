// The two panes of a handout: pointer layers over one picture, zoomed together, each with the other's cursor.

import { carry } from "../maps/piecewise_affine_map.js";
import { Picture } from "../picture/picture.js";
import { mount } from "../pointer_layer.js";
import { LocalModel } from "./local_model.js";
import { KEYS, Navigation } from "./navigation.js";
import { tint } from "./ratios.js";
import { FRAMES } from "./timeline.js";
import { Viewport } from "./viewport.js";

const PRINT_RATIO = 3; // pixels of the picture to a css pixel on paper
const MESH = 0.6; // opacity
/** @type {import("../pointer_layer/types.js").StrokeState[]} */
const NONE = [];
const NAMES = /** @type {const} */ (["original", "restored"]);

/** @typedef {import("./data.js").State} State */
/** @typedef {(typeof NAMES)[number]} Name */
/** @typedef {{ model: LocalModel, view: import("../pointer_layer/view.js").LayerView }} Pane */

/** @param {State} state */
function createPicture({ grid, texture, stages, triangles, colours, ratios }) {
  const model = new LocalModel({
    grid,
    texture: { id: 0, shape: texture.shape, rows: texture.shape[0], overview: texture },
    stages,
    triangles,
    frame: null,
    frames: FRAMES,
    colours,
    deformation: tint(ratios, [], false),
    changing: false,
    revision: 0,
  });
  model.set("picture", new Picture(/** @type {any} */ (model)));
  return model;
}

/** Both panes, with their elements "original" and "restored". */
export class Panes {
  /**
   * @param {State} state
   * @param {(key: string) => void} onKey called with keys that are not the panes' own
   */
  constructor(state, onKey) {
    this.state = state;
    this.onKey = onKey;
    this.picture = createPicture(state);
    const sample = /** @type {[number, number]} */ (state.grid.step.map(Math.abs));
    const limits = { whole: state.frame, sample, metres: state.grid.metres };
    this.viewport = new Viewport(limits, { width: 900, height: 600 });
    this.navigation = new Navigation();
    /** @type {((point: Reading | null) => void)[]} */
    this.readers = [];
    this.hasPicks = true;
    this.original = this.createPane("original");
    this.restored = this.createPane("restored");
    for (const [pane, other] of [
      [this.original, this.restored],
      [this.restored, this.original],
    ])
      pane.model.on("change:carried", () => {
        other.model.set("linked", pane.model.get("carried"));
        this.read(pane);
      });
    this.drawPicks();
    this.picture.on("change:frame", () => this.drawPicks());
  }

  /**
   * @param {Name} name
   * @returns {Pane}
   */
  createPane(name) {
    const traits = {
      ...{ axes: {}, window: this.state.frame, size: [], strokes: [], marks: [], rubber: [] },
      ...{ mesh: {}, mesh_opacity: 0, chain: [], carried: {}, linked: {}, hotkeys: [...KEYS, " "] },
      ...{ picture: "IPY_MODEL_picture", restored: name === "restored" },
      label: `${name === "restored" ? "Restored" : "Present day"}: ${this.state.label}. Arrows pan, + and - zoom, 0 fits`,
    };
    const receive = (/** @type {any} */ message) => this.receive(message);
    const model = new LocalModel(traits, { receive, models: { picture: this.picture } });
    const direct = (/** @type {string} */ kind) => ({
      add: (/** @type {object} */ message) => receive({ kind, ...message }),
      drop: () => {},
      answer: () => {},
    });
    const throttles = { drag: direct("drag"), hover: direct("hover"), wheel: direct("wheel"), pinch: direct("pinch") };
    const el = /** @type {HTMLElement} */ (document.getElementById(name));
    return { model, view: mount(/** @type {any} */ (model), el, throttles).view };
  }

  /** @param {import("./navigation.js").Message & { width: number, height: number }} message */
  receive(message) {
    if (message.kind === "size") this.show(this.viewport.resized({ width: message.width, height: message.height }));
    else if (message.kind === "key" && !KEYS.includes(message.key)) this.onKey(message.key);
    else this.show(this.navigation.navigate(this.viewport, message));
  }

  /** @param {Viewport} viewport */
  show(viewport) {
    if (viewport === this.viewport) return;
    this.viewport = viewport;
    for (const name of NAMES) {
      const { model, view } = this[name];
      model.set("window", viewport.window);
      model.set("axes", viewport.axes(this.state.titles, view.el.offsetLeft));
      view.el.classList.toggle("fitted", viewport.isFitted);
    }
  }

  /** @param {boolean} isShown */
  showPicks(isShown) {
    this.hasPicks = isShown;
    this.drawPicks();
  }

  /** Show the lines as they are after the stage that is being carried out; the layer moves them back from there. */
  drawPicks() {
    const { strokes } = this.state;
    const count = Math.ceil(this.picture.get("picture").time);
    this.restored.model.set("stage", count);
    this.original.model.set("strokes", this.hasPicks ? strokes[0] : NONE);
    this.restored.model.set("strokes", this.hasPicks ? strokes[count] : NONE);
  }

  /** @param {boolean} isShown */
  showMesh(isShown) {
    for (const name of NAMES) this[name].model.set("mesh_opacity", isShown ? MESH : 0);
  }

  /**
   * The positions under the pointer, and the area ratio there.
   *
   * @typedef {{ original: Point | null, restored: Point | null, ratio: number }} Reading
   * @typedef {import("../pointer_layer/types.js").SectionPoint} Point
   *
   * @param {Pane} pane
   */
  read({ model, view }) {
    const { pointer, plotArea } = view;
    const own = pointer && plotArea.toSection(pointer);
    const carried = model.get("carried").x === undefined ? null : model.get("carried");
    const [original, restored] = model.get("restored") ? [carried, own] : [own, carried];
    const ratio = original && restored ? this.ratioAt(original) : Number.NaN;
    for (const reader of this.readers) reader(own && { original, restored, ratio });
  }

  /** @param {Point} point of the present-day section */
  ratioAt(point) {
    const picture = /** @type {Picture} */ (this.picture.get("picture"));
    /** @type {import("../maps/piecewise_affine_map.js").Point | null} */
    let at = picture.toSamples(point);
    let log = 0;
    for (const map of picture.maps(false)) {
      const triangle = at ? map.finder.find(at.x, at.z) : -1;
      if (triangle < 0) return Number.NaN;
      log += map.logRatios[triangle];
      at = carry([map], /** @type {{ x: number, z: number }} */ (at));
    }
    return Math.exp(log);
  }

  /**
   * Draw at once, for paper or for the screen.
   *
   * @param {boolean} isForPaper
   */
  drawNow(isForPaper) {
    for (const name of NAMES) {
      const { view } = this[name];
      view.live.leastRatio = isForPaper ? PRINT_RATIO : 1;
      view.reportSize();
    }
    for (const name of NAMES) this[name].view.draw();
  }
}
