// Zooming and panning by the messages of pointer layers, as interaction/navigation.py does.

const WHEEL_ZOOM = 1.2; // factor per step
const KEY_ZOOM = 1.5;
const STRIDE = 60; // css pixels that an arrow key pans

/** @typedef {import("./viewport.js").Viewport} Viewport */

/** @type {Record<string, (view: Viewport) => Viewport>} */
const BY_KEY = {
  0: (view) => view.fitted(),
  "+": (view) => view.zoomed(KEY_ZOOM),
  "=": (view) => view.zoomed(KEY_ZOOM),
  "-": (view) => view.zoomed(1 / KEY_ZOOM),
  _: (view) => view.zoomed(1 / KEY_ZOOM),
  ArrowLeft: (view) => view.panned(STRIDE, 0),
  ArrowRight: (view) => view.panned(-STRIDE, 0),
  ArrowUp: (view) => view.panned(0, STRIDE),
  ArrowDown: (view) => view.panned(0, -STRIDE),
};

export const KEYS = Object.keys(BY_KEY);

/**
 * @typedef {object} Message
 * @property {string} kind
 * @property {number} x
 * @property {number} y
 * @property {string} key
 * @property {number} steps
 * @property {number} factor
 * @property {number} dx
 * @property {number} dz
 * @property {boolean} cancelled
 */

/** Changes views by messages; between them it keeps only the pointer's last position in a drag. */
export class Navigation {
  constructor() {
    /** @type {{ x: number, y: number } | null} */
    this.grip = null;
  }

  /**
   * The view after a message, the same one if it changes nothing.
   *
   * @param {Viewport} view
   * @param {Message} message
   */
  navigate(view, message) {
    const { kind } = message;
    if (kind === "wheel") return view.zoomed(WHEEL_ZOOM ** message.steps, message);
    if (kind === "pinch") return view.panned(message.dx, message.dz).zoomed(message.factor, message);
    if (kind === "double") return view.fitted();
    if (kind === "key") return BY_KEY[message.key]?.(view) ?? view;
    if (kind === "press") this.grip = message;
    return kind === "drag" || kind === "release" ? this.drag(view, message) : view;
  }

  /**
   * @param {Viewport} view
   * @param {Message} message
   */
  drag(view, message) {
    const { grip } = this;
    this.grip = message.kind === "release" ? null : message;
    const isMoved = grip && !message.cancelled && (message.x !== grip.x || message.y !== grip.y);
    return isMoved ? view.panned(message.x - grip.x, message.y - grip.y) : view;
  }
}
