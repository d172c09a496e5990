// The layer on top of a pane. It receives every event, draws all that does not need the kernel, and sends the kernel
// only what it needs.

import { GestureRecogniser } from "./pointer_layer/gestures.js";
import { Keyboard } from "./pointer_layer/keyboard.js";
import { openMenu } from "./pointer_layer/menu.js";
import { createThrottles } from "./pointer_layer/throttle.js";
import { LayerView, PARTS_BY_TRAIT } from "./pointer_layer/view.js";
import { keepKeys } from "./shared/keep_keys.js";
import { keepTraitsLocal } from "./shared/local_traits.js";

/** @typedef {import("./pointer_layer/types.js").Traits} Traits */
/** @typedef {import("./pointer_layer/types.js").Model} Model */

/**
 * Observe the model.
 *
 * @param {Model} model
 * @param {LayerView} view
 * @param {import("./pointer_layer/throttle.js").Throttles} throttles
 * @returns {() => void} stops it
 */
function observe(model, view, throttles) {
  /**
   * @typedef {{ kind: string, to: keyof typeof throttles, took: number, labels: string[], x: number, y: number }} Message
   *
   * @param {Message} message
   */
  const receive = ({ kind, to, took, labels, x, y }) => {
    if (kind === "menu") {
      const { x: across, y: down } = view.plotArea.kernelScale;
      openMenu(view.el, labels, { x: x / across, y: y / down }, (index) =>
        model.send({ kind: "choose", key: String(index) }),
      );
    } else if (kind === "show") requestAnimationFrame(() => view.el.scrollIntoView({ block: "nearest" }));
    else if (kind === "answer") throttles[to]?.answer(took);
  };
  /** @type {[string, (...args: any[]) => void][]} */
  const handlers = [
    ...Object.entries(PARTS_BY_TRAIT).map(
      ([trait, parts]) => /** @type {[string, () => void]} */ ([`change:${trait}`, () => view.requestDraw(parts)]),
    ),
    ["change:chain", () => (view.maps = null)],
    ["change:window", () => view.pointer && view.carryPointer()],
    ["msg:custom", receive],
  ];
  for (const [name, handler] of handlers) model.on(name, handler);
  return () => {
    for (const [name, handler] of handlers) model.off(name, handler);
  };
}

/** @type {import("@anywidget/types").Initialize<Traits>} */
function initialize({ model }) {
  keepTraitsLocal(model, ["carried", "linked"]);
}

/**
 * Show a layer in an element.
 *
 * @param {Model} model
 * @param {HTMLElement} el
 * @param {import("./pointer_layer/throttle.js").Throttles} throttles
 * @returns {{ view: LayerView, stop: () => void }}
 */
export function mount(model, el, throttles) {
  const view = new LayerView(model, el);
  const { plot } = view.elements;
  const controller = new AbortController();
  const { signal } = controller;
  /** @type {import("./pointer_layer/keyboard.js").Listen} */
  const listen = (name, handle) => plot.addEventListener(name, handle, { signal, passive: false });
  /** @type {import("./pointer_layer/gestures.js").Actions} */
  const actions = {
    send: (...message) => view.send(...message),
    movePointer: (position) => view.movePointer(position),
    scheduleRest: () => view.scheduleRest(),
  };
  const keyboard = new Keyboard(plot, model, actions.send, (isBare) => view.live.showBare(isBare));
  keyboard.listenWith(listen);
  new GestureRecogniser(plot, view.plotArea, keyboard, throttles, actions).listenWith(listen);
  const stopObserving = observe(model, view, throttles);
  const stopKeepingKeys = keepKeys(() => el.parentElement); // the canvases below the layer, too
  const observer = new ResizeObserver(() => view.reportSize());
  observer.observe(plot);
  window.addEventListener("resize", () => view.reportSize(), { signal }); // the browser's own zoom
  window.addEventListener("pointermove", () => view.followScale(), { signal });
  const stop = () => {
    controller.abort();
    observer.disconnect();
    clearTimeout(view.restTimer);
    view.live.stop();
    stopObserving();
    stopKeepingKeys();
  };
  return { view, stop };
}

/** @type {import("@anywidget/types").Render<Traits>} */
function render({ model, el }) {
  return mount(model, el, createThrottles(model)).stop;
}

export default { initialize, render };
