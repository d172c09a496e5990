// The curve of correlation against slip, on which the slip is dragged, and the profiles along the fault beside it.

import { drawCurve, drawProfiles, MARGIN } from "./match_chart/chart.js";
import { Scale } from "./match_chart/scale.js";
import { keepKeys } from "./shared/keep_keys.js";
import { append } from "./shared/svg.js";

const PAUSE = 50; // ms between two messages
const ANSWERED = 1500; // ms after which the kernel's slip is shown in any case
const CHANGES = "change:curve change:slip change:profile change:span change:summary";
const HELP =
  "Arrow keys change the slip, with Shift by ten; Page Up and Page Down go to the next peak, Enter to the best.";

/**
 * @typedef {object} Traits
 * @property {import("./match_chart/scale.js").Curve | Record<string, never>} curve empty before the first scan
 * @property {import("./match_chart/scale.js").Profile | Record<string, never>} profile
 * @property {number[]} span
 * @property {string} summary
 * @property {number | null} slip
 */

/** @typedef {import("@anywidget/types").AnyModel<Traits>} Model */

/**
 * @param {Element} parent
 * @param {string} className
 * @param {Record<string, string | number>} attributes
 */
function createChart(parent, className, attributes) {
  const chart = append(parent, "svg", className, attributes);
  return { chart, group: append(chart, "g", "drawing", { transform: `translate(${MARGIN.left} ${MARGIN.top})` }) };
}

/**
 * @param {Model} model
 * @returns {import("./match_chart/scale.js").Curve | null}
 */
function curveOf(model) {
  const curve = model.get("curve");
  return "slip" in curve ? /** @type {import("./match_chart/scale.js").Curve} */ (curve) : null;
}

/** @param {Element} chart */
function sizeOf(chart) {
  const box = chart.getBoundingClientRect();
  return { width: box.width - MARGIN.left - MARGIN.right, height: box.height - MARGIN.top - MARGIN.bottom };
}

/** The slip as it is dragged: shown at once, sent with pauses. */
class Drag {
  /**
   * @param {Model} model
   * @param {() => void} redraw
   */
  constructor(model, redraw) {
    this.model = model;
    this.redraw = redraw;
    /** @type {number | null} */
    this.slip = null; // while it is dragged; the kernel's answers are older
    /** @type {number | null} */
    this.pointerId = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.forgetting = undefined;
  }

  /** @param {number} slip */
  move(slip) {
    clearTimeout(this.forgetting);
    this.slip = slip;
    this.redraw();
    this.timer ??= setTimeout(() => this.send(false), PAUSE);
  }

  release() {
    if (this.slip === null) return;
    this.send(true);
    this.forgetting = setTimeout(() => this.forget(), ANSWERED);
  }

  /** Show the kernel's slip from now on, unless it is still being dragged. */
  forget() {
    if (this.pointerId !== null || this.timer !== undefined) return;
    clearTimeout(this.forgetting);
    this.slip = null;
    this.redraw();
  }

  /** @param {boolean} settled */
  send(settled) {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.model.send({ kind: "slide", slip: this.slip, settled });
  }
}

/**
 * @param {SVGSVGElement} chart
 * @param {Drag} drag
 * @param {() => Scale | null} getScale
 * @param {AbortSignal} signal
 */
function listen(chart, drag, getScale, signal) {
  const xOf = (/** @type {PointerEvent} */ event) => event.clientX - chart.getBoundingClientRect().left - MARGIN.left;
  const follow = (/** @type {PointerEvent} */ event) => {
    const scale = getScale();
    if (event.pointerId === drag.pointerId && scale) drag.move(scale.slipAt(xOf(event), event.shiftKey));
  };
  const press = (/** @type {PointerEvent} */ event) => {
    if (drag.pointerId !== null || event.button !== 0 || !getScale()) return;
    event.preventDefault();
    chart.classList.add("by-pointer"); // hides the focus ring
    chart.focus({ preventScroll: true });
    chart.setPointerCapture(event.pointerId);
    drag.pointerId = event.pointerId;
    follow(event);
  };
  const release = (/** @type {PointerEvent} */ event) => {
    if (event.pointerId !== drag.pointerId) return;
    drag.pointerId = null;
    drag.release();
  };
  const key = (/** @type {KeyboardEvent} */ event) => {
    const scale = getScale();
    chart.classList.remove("by-pointer");
    if (!scale || event.ctrlKey || event.altKey || event.metaKey) return;
    const slip = scale.slipByKey(event.key, event.shiftKey, drag.slip ?? drag.model.get("slip") ?? 0);
    if (slip === null) return;
    event.preventDefault();
    drag.move(slip);
  };
  chart.addEventListener("pointerdown", press, { signal });
  chart.addEventListener("pointermove", follow, { signal });
  chart.addEventListener("pointerup", release, { signal });
  chart.addEventListener("pointercancel", release, { signal });
  chart.addEventListener("keydown", key, { signal });
  chart.addEventListener("keyup", () => drag.pointerId === null && drag.release(), { signal });
  chart.addEventListener("blur", () => drag.pointerId === null && drag.release(), { signal });
}

/**
 * Tell what the chart shows to those who do not see it.
 *
 * @param {SVGSVGElement} chart
 * @param {Scale | null} scale
 * @param {number | null} slip
 */
function describe(chart, scale, slip) {
  chart.setAttribute("aria-disabled", String(!scale));
  if (!scale) return;
  const now = slip ?? 0;
  chart.setAttribute("aria-valuemin", String(Math.round(scale.low)));
  chart.setAttribute("aria-valuemax", String(Math.round(scale.high)));
  chart.setAttribute("aria-valuenow", String(Math.round(now)));
  const correlation = scale.correlationAt(now).toFixed(2);
  chart.setAttribute("aria-valuetext", slip === null ? "no match" : `${Math.round(now)} m, correlation ${correlation}`);
}

/** @type {import("@anywidget/types").Render<Traits>} */
function render({ model, el }) {
  el.classList.add("seiswidgets-match");
  const summary = document.createElement("div");
  summary.className = "summary";
  summary.setAttribute("aria-live", "polite");
  const charts = document.createElement("div");
  charts.className = "charts";
  el.append(summary, charts);
  const names = { tabindex: 0, role: "slider", "aria-label": `Slip of the fault. ${HELP}`, "aria-valuenow": 0 };
  const { chart, group } = createChart(charts, "chart", names);
  const side = createChart(charts, "profiles", { role: "img" });
  let size = { width: 0, height: 0 };
  const getScale = () => {
    const curve = curveOf(model);
    return curve && size.width >= 1 && size.height >= 1 ? new Scale(curve, size) : null;
  };

  function draw() {
    const [scale, profile] = [getScale(), model.get("profile")];
    const slip = drag.slip ?? model.get("slip");
    summary.textContent = model.get("summary");
    el.classList.toggle("empty", !scale);
    describe(chart, scale, slip);
    if (scale) drawCurve(group, scale.curve, size, slip);
    else group.replaceChildren();
    const room = sizeOf(side.chart);
    side.chart.setAttribute("aria-label", `Profiles along the fault. ${model.get("summary")}`);
    if ("z" in profile && room.width >= 1 && room.height >= 1)
      drawProfiles(
        side.group,
        /** @type {import("./match_chart/scale.js").Profile} */ (profile),
        room,
        model.get("span"),
      );
    else side.group.replaceChildren();
  }

  const drag = new Drag(model, draw);
  const observer = new ResizeObserver(() => {
    size = sizeOf(chart);
    draw();
  });
  const controller = new AbortController();
  listen(chart, drag, getScale, controller.signal);
  const stopKeepingKeys = keepKeys(() => el);
  const forget = () => drag.forget();
  model.on(CHANGES, draw);
  model.on("change:slip", forget);
  observer.observe(charts);
  draw();
  return () => {
    stopKeepingKeys();
    controller.abort();
    observer.disconnect();
    clearTimeout(drag.timer);
    clearTimeout(drag.forgetting);
    model.off("change:slip", forget);
    model.off(/** @type {"change:curve"} */ (CHANGES), draw);
  };
}

export default { render };
