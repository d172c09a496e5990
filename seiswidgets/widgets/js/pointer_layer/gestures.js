// Recognises the gestures of a mouse, pen or fingers: hover, press, drag and release, the wheel, a double click or tap,
// and a pinch.

import { modifiers } from "./keyboard.js";

const WHEEL_STEP = 100; // css pixels of scrolling
const LINE_HEIGHT = 16; // css pixels, for wheels that count lines
const MIDDLE_BUTTON = 1;
const TAP = { time: 300, distance: 12 }; // ms and css pixels within which a finger comes and goes
const DOUBLE_TAP = { time: 400, distance: 30 }; // between two taps
const LONG_PRESS = 700; // ms, longer than that of browsers
const ECHO = 800; // ms after a double tap in which the browser may report the same one as a double click

/** @typedef {import("./types.js").Pixel} Pixel */

/**
 * @typedef {object} HeldPointer
 * @property {number} id
 * @property {Pixel} position
 * @property {Pixel} start
 * @property {number} startTime
 * @property {number} button
 * @property {boolean} pan
 */

/** @typedef {{ position: Pixel, time: number, isDouble: boolean }} Tap */

/**
 * @typedef {object} Actions
 * @property {import("./keyboard.js").Send} send at once
 * @property {(position: Pixel | null) => void} movePointer
 * @property {() => void} scheduleRest
 */

/**
 * @param {Pixel} one
 * @param {Pixel} other
 */
const distance = (one, other) => Math.hypot(one.x - other.x, one.y - other.y);

/** Turns the pointer events of one plot area into messages. */
export class GestureRecogniser {
  /**
   * @param {Pick<SVGSVGElement, "classList" | "focus" | "setPointerCapture">} plot
   * @param {import("./plot_area.js").PlotArea} plotArea
   * @param {{ startDrag: () => boolean }} keyboard
   * @param {Record<"drag" | "hover" | "wheel" | "pinch", { add: (message: object) => void, drop: () => void }>} throttles
   * @param {Actions} actions
   */
  constructor(plot, plotArea, keyboard, throttles, actions) {
    this.plot = plot;
    this.plotArea = plotArea;
    this.keyboard = keyboard;
    this.throttles = throttles;
    this.actions = actions;
    /** @type {HeldPointer | null} */
    this.held = null;
    /** @type {Map<number, Pixel>} */
    this.fingers = new Map(); // positions by pointer id
    /** @type {Pixel & { spread: number } | null} */
    this.pinch = null;
    /** @type {Tap | null} */
    this.lastTap = null;
  }

  /** @param {import("./keyboard.js").Listen} listen */
  listenWith(listen) {
    listen("pointerdown", (event) => this.press(event));
    listen("pointermove", (event) => this.move(event));
    listen("pointerup", (event) => this.lift(event));
    listen("pointercancel", (event) => this.lift(event));
    listen("pointerleave", (event) => this.leave(event));
    listen("dblclick", (event) => this.doubleClick(event));
    listen("wheel", (event) => this.scroll(event));
    listen("contextmenu", (event) => this.openMenu(event));
  }

  /** @param {PointerEvent} event */
  press(event) {
    event.preventDefault();
    const position = this.plotArea.pointerPosition(event);
    this.plot.classList.add("by-pointer"); // hides the focus ring
    this.plot.focus({ preventScroll: true });
    this.plot.setPointerCapture(event.pointerId);
    if (event.pointerType === "touch") this.fingers.set(event.pointerId, position);
    if (this.fingers.size > 1) this.startPinch(event);
    else if (!this.held) this.hold(event, position);
  }

  /**
   * @param {PointerEvent} event
   * @param {Pixel} position
   */
  hold(event, position) {
    const pan = this.keyboard.startDrag() || event.button === MIDDLE_BUTTON;
    const { pointerId, timeStamp, button } = event;
    this.held = { id: pointerId, position, start: position, startTime: timeStamp, button, pan };
    this.plot.classList.toggle("pans", pan);
    this.actions.movePointer(position);
    this.throttles.hover.drop();
    this.actions.send("press", event, buttonOf(this.held));
    if (event.pointerType === "touch") this.awaitLongPress(event, this.held);
  }

  /**
   * Ask for the menu in place of the browser's and JupyterLab's; what a long press has done is revoked.
   *
   * @param {MouseEvent} event
   */
  openMenu(event) {
    event.preventDefault();
    event.stopPropagation();
    if (this.held) this.release(this.held, /** @type {PointerEvent} */ (event), true, this.held.position);
    this.fingers.clear();
    this.actions.send("menu", event);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const position = this.plotArea.pointerPosition(event);
    const { held } = this;
    if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, position);
    if (this.pinch) this.updatePinch(this.pinch);
    else if (held && event.pointerId === held.id) {
      held.position = position;
      this.report("drag", event, position, held.pan ? { pan: true } : {});
    } else if (!held && event.pointerType !== "touch") this.report("hover", event, position, {});
  }

  /**
   * @param {"drag" | "hover"} kind
   * @param {PointerEvent} event
   * @param {Pixel} position
   * @param {object} more
   */
  report(kind, event, position, more) {
    this.actions.movePointer(position);
    this.throttles[kind].add({ ...this.plotArea.toKernel(position), modifiers: modifiers(event), ...more });
  }

  /**
   * Open the menu under a finger that rests: not every browser reports that by itself.
   *
   * @param {PointerEvent} event
   * @param {HeldPointer} held
   */
  awaitLongPress(event, held) {
    setTimeout(() => {
      if (this.held === held && distance(held.position, held.start) < TAP.distance) this.openMenu(event);
    }, LONG_PRESS);
  }

  /** @param {PointerEvent} event */
  lift(event) {
    const { held } = this;
    this.fingers.delete(event.pointerId);
    if (this.pinch) this.pinch = this.fingers.size > 1 ? this.measurePinch() : null;
    if (!held || event.pointerId !== held.id) return;
    const isTouch = event.pointerType === "touch";
    this.release(held, event, event.type === "pointercancel", this.plotArea.pointerPosition(event));
    if (isTouch) this.actions.movePointer(null);
    if (isTouch && this.isTap(held, event)) this.tap(event);
  }

  /**
   * @param {HeldPointer} held
   * @param {PointerEvent} event
   * @param {boolean} cancelled
   * @param {Pixel} position
   */
  release(held, event, cancelled, position) {
    this.throttles.drag.drop();
    this.actions.send("release", event, { ...buttonOf(held), cancelled, ...this.plotArea.toKernel(position) });
    this.held = null;
    this.plot.classList.remove("pans");
    this.actions.scheduleRest();
  }

  /** @param {PointerEvent} event */
  leave(event) {
    if (this.held || this.pinch) return;
    this.actions.movePointer(null);
    this.throttles.hover.drop();
    this.actions.send("leave", event);
  }

  /**
   * @param {HeldPointer} held
   * @param {PointerEvent} event
   */
  isTap(held, event) {
    if (event.type !== "pointerup" || held.pan || event.timeStamp - held.startTime >= TAP.time) return false;
    return distance(this.plotArea.pointerPosition(event), held.start) < TAP.distance;
  }

  /**
   * Send a double click after the second of two taps, since not every browser does so itself.
   *
   * @param {PointerEvent} event
   */
  tap(event) {
    const [position, time, last] = [this.plotArea.pointerPosition(event), event.timeStamp, this.lastTap];
    const isSoon = last !== null && !last.isDouble && time - last.time < DOUBLE_TAP.time;
    const isDouble = isSoon && distance(position, last.position) < DOUBLE_TAP.distance;
    this.lastTap = { position, time, isDouble };
    if (isDouble) this.actions.send("double", event, { touch: true });
  }

  /** @param {MouseEvent} event */
  doubleClick(event) {
    if (this.lastTap?.isDouble && event.timeStamp - this.lastTap.time < ECHO) return;
    this.actions.send("double", event);
  }

  /** @param {WheelEvent} event */
  scroll(event) {
    event.preventDefault();
    const unit = [1, LINE_HEIGHT, this.plotArea.height][event.deltaMode];
    const steps = (-event.deltaY * unit) / WHEEL_STEP; // positive zooms in
    const position = this.plotArea.toKernel(this.plotArea.pointerPosition(event));
    this.throttles.wheel.add({ ...position, steps, modifiers: modifiers(event) });
    this.actions.scheduleRest();
  }

  /**
   * Start a pinch, and cancel what the first finger has done.
   *
   * @param {PointerEvent} event
   */
  startPinch(event) {
    if (this.held) this.release(this.held, event, true, this.held.position);
    this.actions.movePointer(null);
    this.lastTap = null;
    this.pinch = this.measurePinch();
  }

  /** The midpoint of two fingers and the distance between them. */
  measurePinch() {
    const [one, other] = [...this.fingers.values()];
    return { x: (one.x + other.x) / 2, y: (one.y + other.y) / 2, spread: Math.max(1, distance(one, other)) };
  }

  /** @param {Pixel & { spread: number }} before */
  updatePinch(before) {
    const now = this.measurePinch();
    const [midpoint, midpointBefore] = [this.plotArea.toKernel(now), this.plotArea.toKernel(before)];
    const [dx, dz] = [midpoint.x - midpointBefore.x, midpoint.y - midpointBefore.y];
    this.throttles.pinch.add({ ...midpoint, factor: now.spread / before.spread, dx, dz, touch: true });
    this.pinch = now;
    this.actions.scheduleRest();
  }
}

/** @param {HeldPointer} held */
function buttonOf({ button, pan }) {
  return pan ? { button, pan } : { button };
}
