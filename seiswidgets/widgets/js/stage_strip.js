// The strip of thumbnails under the time slider. The browser draws them from the picture of the panes.

import { keepKeys } from "./shared/keep_keys.js";
import { StageStrip } from "./stage_strip/strip.js";

const REDRAWN = "change:stages change:texture change:revision change:colours change:picture";

/**
 * @typedef {object} Traits
 * @property {string} picture
 * @property {import("./stage_strip/strip.js").Scene[]} scenes
 * @property {number} frame
 * @property {number} frames per stage
 */

/** @type {import("@anywidget/types").Render<Traits>} */
function render({ model, el }) {
  const frames = model.get("frames");
  const strip = new StageStrip(el, ({ count }) => {
    model.set("frame", frames * count);
    model.save_changes();
  });
  /** @type {import("./picture/types.js").PictureModel | null} */
  let picture = null;
  const redraw = () => strip.scheduleDraw(() => picture?.get("picture") ?? null);
  const mark = () => strip.mark(model.get("frame") / frames);
  const show = () => {
    strip.show(model.get("scenes"));
    mark();
    redraw();
  };
  model.on("change:scenes", show);
  model.on("change:frame", mark);
  let isStopped = false;
  const reference = model.get("picture").replace("IPY_MODEL_", "");
  model.widget_manager.get_model(reference).then((/** @type {any} */ found) => {
    if (isStopped) return;
    picture = found;
    found.on(REDRAWN, redraw);
    redraw();
  });
  const stopKeepingKeys = keepKeys(() => el);
  show();
  return () => {
    isStopped = true;
    strip.stop();
    stopKeepingKeys();
    model.off("change:scenes", show);
    model.off("change:frame", mark);
    picture?.off(/** @type {"change:stages"} */ (REDRAWN), redraw);
  };
}

export default { render };
