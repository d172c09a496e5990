// The time between the present day and the restored section: Play, a slider, and a button for each stage.

import { StageStrip } from "../stage_strip/strip.js";

const FRAME_TIME = 30; // ms
export const FRAMES = 60; // per stage

/**
 * @param {string} tag
 * @param {Record<string, string>} attributes
 * @param {string} [content]
 */
function element(tag, attributes, content = "") {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = content;
  return made;
}

/** Plays the stages once from the present day to the end, or from where it stands. */
export class Timeline {
  /**
   * @param {HTMLElement} el
   * @param {string[]} names of the stages
   * @param {import("../stage_strip/strip.js").Scene[]} scenes
   * @param {(frame: number) => void} show
   */
  constructor(el, names, scenes, show) {
    this.names = names;
    this.show = show;
    this.end = FRAMES * names.length;
    this.frame = this.end;
    this.isRunning = false;
    this.playButton = element("button", { type: "button", class: "play" });
    const range = { type: "range", min: "0", max: String(this.end), step: "1", list: "scenes", "aria-label": "Time" };
    this.slider = /** @type {HTMLInputElement} */ (element("input", range));
    const ticks = element("datalist", { id: "scenes" });
    ticks.append(...scenes.map(({ count }) => element("option", { value: String(FRAMES * count) })));
    this.moment = element("output", {});
    const stops = element("div", {});
    this.strip = new StageStrip(stops, ({ count }) => this.stopAt(FRAMES * count));
    this.strip.show(scenes);
    this.playButton.addEventListener("click", () => this.toggle());
    this.slider.addEventListener("input", () => this.stopAt(this.slider.valueAsNumber));
    const track = element("div", { class: "track" });
    track.append(this.slider, ticks, stops);
    el.append(this.playButton, track, this.moment);
    this.draw();
  }

  /** The moment in words. */
  get text() {
    const { frame, end, names } = this;
    if (frame === 0) return "present day";
    if (frame === end) return "restored";
    const step = Math.ceil(frame / FRAMES) - 1;
    const percent = Math.round((100 * (frame - FRAMES * step)) / FRAMES);
    return percent === 100 ? names[step] : `${names[step]} ${percent}%`;
  }

  /** @param {number} frame */
  stopAt(frame) {
    this.isRunning = false;
    this.goTo(frame);
  }

  /** @param {number} frame */
  goTo(frame) {
    this.frame = frame;
    this.draw();
    this.show(frame);
  }

  toggle() {
    if (this.isRunning) {
      this.stopAt(this.frame);
      return;
    }
    this.isRunning = true;
    const from = this.frame === this.end ? 0 : this.frame;
    const start = performance.now();
    const step = () => {
      if (!this.isRunning) return;
      const frame = Math.min(from + Math.floor((performance.now() - start) / FRAME_TIME), this.end);
      this.isRunning = frame < this.end;
      this.goTo(frame);
      if (this.isRunning) requestAnimationFrame(step);
    };
    step();
  }

  draw() {
    this.playButton.textContent = this.isRunning ? "Pause" : "Play";
    this.slider.value = String(this.frame);
    this.slider.setAttribute("aria-valuetext", this.text);
    this.moment.textContent = this.text;
    this.strip.mark(this.frame / FRAMES);
  }
}
