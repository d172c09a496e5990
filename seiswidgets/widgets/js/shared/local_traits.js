// Traits that stay in the browser. This relies on a method of ipywidgets' model that is not public: `serialize`.

/**
 * Keep traits from being sent to the kernel.
 *
 * jslink saves what it sets, so the kernel would get a message at every move of the pointer, though only other panes
 * need its position. Nothing is sent if no other trait has changed.
 *
 * @param {import("@anywidget/types").AnyModel} model
 * @param {string[]} names
 */
export function keepTraitsLocal(model, names) {
  const patched = new WeakSet();
  /** @param {any} [widgetModel] */
  const patch = (widgetModel) => {
    if (patched.has(widgetModel) || typeof widgetModel?.serialize !== "function") return;
    patched.add(widgetModel);
    const serialize = widgetModel.serialize.bind(widgetModel);
    widgetModel.serialize = (/** @type {Record<string, unknown>} */ state) => {
      for (const name of names) delete state[name];
      return serialize(state);
    };
  };
  model.on(names.map((name) => `change:${name}`).join(" "), patch);
}
