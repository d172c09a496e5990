// A row of buttons, one for each scene of a restoration, with a small picture of the section then.

import { drawSection } from "../picture/scene.js";

const LEAST = 3; // scenes: the present day and the end are at the ends of the time slider anyway
const SIZE = { width: 108, height: 60 }; // css pixels
const SHARPNESS = 2; // pixels to a css pixel
const REST = 300; // ms after the last change: thumbnails must not slow down a drag

/** @typedef {import("../picture/picture.js").Picture} Picture */
/** @typedef {{ count: number, label: string }} Scene number of stages carried out, and its name */

/** Shows scenes, of which one may be pressed. */
export class StageStrip {
  /**
   * @param {HTMLElement} el
   * @param {(scene: Scene) => void} choose
   */
  constructor(el, choose) {
    this.el = el;
    this.choose = choose;
    /** @type {Scene[]} */
    this.scenes = [];
    /** @type {HTMLButtonElement[]} */
    this.buttons = [];
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
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
    if (now < 0 || target === undefined) return;
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
      const canvas = /** @type {HTMLCanvasElement} */ (button.firstChild);
      if (picture && this.scenes[index].count <= count) drawThumbnail(canvas, picture, this.scenes[index].count);
    });
  }

  stop() {
    clearTimeout(this.timer);
  }
}

/**
 * Draw the whole section as it is after some stages, without deformation.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {Picture} picture
 * @param {number} count
 */
function drawThumbnail(canvas, picture, count) {
  const size = { width: SHARPNESS * SIZE.width, height: SHARPNESS * SIZE.height };
  Object.assign(canvas, size);
  const image = new ImageData(size.width, size.height);
  const scene = picture.scene(true, [0, 1, 0, 1]);
  drawSection(new Uint32Array(image.data.buffer), size, {
    ...scene,
    maps: picture.chain.maps(count, true),
    window: rockWindow(picture),
    deformation: { ...scene.deformation, opacity: 0 },
  });
  canvas.getContext("2d")?.putImageData(image, 0, 0);
}

/**
 * The window, in samples, that holds the rock of every stage.
 *
 * @param {Picture} picture
 * @returns {[number, number, number, number]}
 */
function rockWindow(picture) {
  const [rows, columns] = picture.grid.shape;
  const window = [-0.5, columns - 0.5, -0.5, rows - 0.5];
  for (const { after } of picture.chain.stages) {
    for (let i = 0; i < after.length; i++) {
      const side = 2 * (i % 2);
      window[side] = Math.min(window[side], after[i]);
      window[side + 1] = Math.max(window[side + 1], after[i]);
    }
  }
  return /** @type {[number, number, number, number]} */ (window);
}
