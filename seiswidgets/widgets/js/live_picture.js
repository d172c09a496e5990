// The browser's side of LivePicture: it has no view of its own, and serves those of two pointer layers.

import { Picture } from "./picture/picture.js";
import { keepTraitsLocal } from "./shared/local_traits.js";

/** @type {import("@anywidget/types").Initialize<import("./picture/types.js").PictureTraits>} */
function initialize({ model }) {
  keepTraitsLocal(model, ["picture", "revision", "bare"]);
  const picture = new Picture(model);
  /** @type {[string, (...args: any[]) => void][]} */
  const handlers = [
    ["change:texture", () => picture.loader.start()],
    ["change:stages", () => picture.loader.pause()],
    ["msg:custom", (content, buffers) => picture.loader.receive(content, buffers)],
  ];
  for (const [name, handler] of handlers) model.on(name, handler);
  if (model.get("texture").shape) picture.loader.start();
  model.set("revision", 0);
  model.set("picture", picture);
  return () => {
    for (const [name, handler] of handlers) model.off(name, handler);
  };
}

export default { initialize };
