// The histogram of the area ratio. The browser draws and brushes it; the kernel receives the brush.

import { Brush } from "./histogram/brush.js";
import { drawChart, MARGIN } from "./histogram/chart.js";
import { Scale } from "./histogram/scale.js";
import { keepKeys } from "./shared/keep_keys.js";
import { append } from "./shared/svg.js";
import { unscaledPosition, unscaledSize } from "./shared/unscaled.js";

const HELP = "Arrow keys brush a bar, with Shift several; Escape clears.";
const SUMMARY_TOOLTIP = "Half, 1% and 99% of the area have a lower area ratio.";
const PAUSE = 50; // ms between two messages
const CHANGES = "change:bars change:summary change:brushed change:brush change:mark change:log_shares";

/**
 * @typedef {object} Traits
 * @property {import("./histogram/scale.js").Bars | Record<string, never>} bars empty before the first restoration
 * @property {string} summary
 * @property {string} brushed
 * @property {number[]} brush
 * @property {number | null} mark
 * @property {boolean} log_shares
 */

/** @typedef {import("@anywidget/types").AnyModel<Traits>} Model */

/**
 * @param {Element} parent
 * @param {string} className
 */
function appendDiv(parent, className) {
  const div = document.createElement("div");
  div.className = className;
  parent.append(div);
  return div;
}

/**
 * A function that sends changes with a pause between messages. ipywidgets itself waits until the kernel has handled the
 * last one, and merges what changes meanwhile.
 *
 * @param {Model} model
 */
function throttledSave(model) {
  let isScheduled = false;
  let savedAt = -Infinity;
  return () => {
    if (isScheduled) return;
    isScheduled = true;
    const delay = Math.max(0, savedAt + PAUSE - performance.now());
    setTimeout(() => {
      isScheduled = false;
      savedAt = performance.now();
      model.save_changes();
    }, delay);
  };
}

/** @param {HTMLElement} el */
function createElements(el) {
  el.classList.add("seiswidgets-histogram");
  const head = appendDiv(el, "head");
  const summary = appendDiv(head, "summary");
  const brushed = appendDiv(head, "brushed");
  brushed.setAttribute("aria-live", "polite");
  const log = document.createElement("button");
  log.className = "log";
  log.textContent = "log";
  log.title = "Logarithmic axis for the share of the area";
  head.append(log);
  const chart = append(el, "svg", "chart", { tabindex: 0, role: "application" });
  const drawing = append(chart, "g", "drawing", { transform: `translate(${MARGIN.left} ${MARGIN.top})` });
  return { summary, brushed, log, chart, drawing };
}

/**
 * @param {Model} model
 * @returns {import("./histogram/scale.js").Bars | null}
 */
function barsOf(model) {
  const bars = model.get("bars");
  return "shares" in bars ? /** @type {import("./histogram/scale.js").Bars} */ (bars) : null;
}

/**
 * @param {Model} model
 * @param {() => import("./histogram/scale.js").Size} getSize
 */
function createBrush(model, getSize) {
  const save = throttledSave(model);
  const getScale = () => {
    const bars = barsOf(model);
    return bars && new Scale(bars, getSize());
  };
  const read = () => ({ brush: model.get("brush"), edges: barsOf(model)?.edges ?? [] });
  return new Brush(getScale, read, (brush) => {
    if (String(brush) === String(model.get("brush"))) return;
    model.set("brush", brush);
    save();
  });
}

/** @type {import("@anywidget/types").Render<Traits>} */
function render({ model, el }) {
  const { summary, brushed, log, chart, drawing } = createElements(el);
  let [whole, size] = [1, 2].map(() => ({ width: 0, height: 0 })); // of the chart, and of its bars

  function draw() {
    const bars = barsOf(model);
    summary.textContent = model.get("summary");
    summary.title = `${model.get("summary")}. ${SUMMARY_TOOLTIP}`;
    brushed.textContent = model.get("brushed");
    log.setAttribute("aria-pressed", String(model.get("log_shares")));
    el.classList.toggle("empty", !bars);
    chart.setAttribute("aria-label", `Histogram of the area ratio: ${model.get("summary")}. ${HELP}`);
    if (bars && size.width >= 1 && size.height >= 1)
      drawChart(drawing, bars, size, model.get("brush"), model.get("mark"));
    else drawing.replaceChildren();
  }

  const observer = new ResizeObserver(() => {
    whole = unscaledSize(chart);
    size = { width: whole.width - MARGIN.left - MARGIN.right, height: whole.height - MARGIN.top - MARGIN.bottom };
    draw();
  });
  const controller = new AbortController();
  const xOf = (/** @type {PointerEvent} */ event) => unscaledPosition(event, chart, whole).x - MARGIN.left;
  createBrush(model, () => size).listenTo(chart, xOf, controller.signal);
  log.addEventListener("click", () => {
    model.set("log_shares", !model.get("log_shares"));
    model.save_changes();
  });
  const stopKeepingKeys = keepKeys(() => el);
  model.on(CHANGES, draw);
  observer.observe(chart);
  draw();
  return () => {
    stopKeepingKeys();
    controller.abort();
    observer.disconnect();
    model.off(/** @type {"change:bars"} */ (CHANGES), draw);
  };
}

export default { render };
