// The script of a handout: the app's panes, time and histogram in a page without a kernel.

import { readState } from "./handout/data.js";
import { LocalModel } from "./handout/local_model.js";
import { Panes } from "./handout/panes.js";
import { barsOf, brushText, measure, summaryOf, tint } from "./handout/ratios.js";
import { appendButton, appendSwitch } from "./handout/switches.js";
import { Timeline } from "./handout/timeline.js";
import histogram from "./histogram.js";

const ZOOM = 1.5;
const PAUSE = 100; // ms between two histograms while time runs: the panes are first

/** @param {string} id */
const find = (id) => /** @type {HTMLElement} */ (document.getElementById(id));

/**
 * Show the histogram of the area ratio; returns a function that lets it follow time.
 *
 * @param {import("./handout/data.js").State} state
 * @param {Panes} panes
 */
function showDeformation({ ratios }, panes) {
  const { picture } = panes;
  const traits = { bars: {}, summary: "", brushed: "", brush: [], mark: null, log_shares: false };
  const model = new LocalModel(traits);
  let parts = measure(picture.get("picture"));
  let isShown = false;
  const describe = () => model.set("brushed", brushText(parts, ratios.axis, model.get("brush")));
  const draw = () => {
    model.set("bars", barsOf(parts, ratios.axis, model.get("log_shares")));
    model.set("summary", summaryOf(parts, ratios.span));
    describe();
  };
  const colour = () => picture.set("deformation", tint(ratios, model.get("brush"), isShown));
  model.on("change:brush", () => {
    describe();
    colour();
  });
  model.on("change:log_shares", draw);
  draw();
  histogram.render(/** @type {any} */ ({ model, el: find("histogram") }));
  let isScheduled = false;
  const update = () => {
    isScheduled = false;
    parts = measure(picture.get("picture"));
    draw();
  };
  return {
    follow: () => {
      if (!isScheduled) setTimeout(update, PAUSE);
      isScheduled = true;
    },
    show: (/** @type {boolean} */ isOn) => {
      isShown = isOn;
      colour();
    },
  };
}

/**
 * @param {import("./handout/data.js").State} state
 * @param {Panes} panes
 */
function showReadings({ height, units: [x, z] }, panes) {
  const round = (/** @type {number} */ value) => String(Number(value.toPrecision(6)));
  panes.readers.push((reading) => {
    const places = reading ? Object.entries({ "present day": reading.original, restored: reading.restored }) : [];
    const parts = places.flatMap(([name, at]) =>
      at ? [`${name}: x ${round(at.x)} ${x}, ${height} ${round(at.z)} ${z}`] : [],
    );
    if (reading && Number.isFinite(reading.ratio)) parts.push(`area ratio ${reading.ratio.toFixed(3)}`);
    find("readout").textContent = parts.join(" · ");
  });
}

/**
 * @param {Panes} panes
 * @param {(isOn: boolean) => void} showMap
 * @param {boolean} isRestored
 */
function showSwitches(panes, showMap, isRestored) {
  const el = find("switches");
  appendSwitch(el, "Picks", true, (isOn) => panes.showPicks(isOn));
  if (isRestored) {
    appendSwitch(el, "Deformation map", false, showMap);
    appendSwitch(el, "Mesh", false, (isOn) => panes.showMesh(isOn));
  }
  const zoom = el.appendChild(document.createElement("span"));
  appendButton(zoom, "+", "Zoom in", () => panes.show(panes.viewport.zoomed(ZOOM)));
  appendButton(zoom, "−", "Zoom out", () => panes.show(panes.viewport.zoomed(1 / ZOOM)));
  appendButton(zoom, "Fit", "Show everything", () => panes.show(panes.viewport.fitted()));
}

/**
 * Print both panes as a whole, at the end of time.
 *
 * @param {Panes} panes
 */
function preparePrinting(panes) {
  const { picture } = panes;
  /** @type {{ frame: number | null, viewport: Panes["viewport"] } | null} */
  let before = null;
  window.addEventListener("beforeprint", () => {
    before = { frame: picture.get("frame"), viewport: panes.viewport };
    document.documentElement.classList.add("printing");
    picture.set("frame", null);
    panes.show(panes.viewport.fitted());
    panes.drawNow(true);
  });
  window.addEventListener("afterprint", () => {
    document.documentElement.classList.remove("printing");
    if (!before) return;
    picture.set("frame", before.frame);
    panes.show(before.viewport);
    panes.drawNow(false);
  });
}

async function start() {
  const state = await readState();
  const isRestored = state.stages.length > 0;
  /** @type {Timeline | null} */
  let timeline = null;
  const panes = new Panes(state, () => timeline?.toggle());
  const deformation = isRestored ? showDeformation(state, panes) : null;
  if (isRestored) {
    timeline = new Timeline(find("time"), state.names, state.scenes, (frame) => {
      panes.picture.set("frame", frame);
      deformation?.follow();
    });
    timeline.strip.draw(panes.picture.get("picture"));
  } else {
    find("restored-title").textContent = "Not restored yet";
    find("deformation").hidden = true;
  }
  showReadings(state, panes);
  showSwitches(panes, (isOn) => deformation?.show(isOn), isRestored);
  preparePrinting(panes);
}

start().catch((error) => {
  find("trouble").textContent = `The sections cannot be shown; a newer browser may help (${error}).`;
  throw error;
});
