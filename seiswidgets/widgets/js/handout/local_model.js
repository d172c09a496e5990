// A model that lives in the page: what views use of a widget's model, without a kernel.

/** @typedef {(...args: any[]) => void} Handler */

/** Holds traits, and tells handlers of changes. */
export class LocalModel {
  /**
   * @param {Record<string, any>} traits
   * @param {object} [options]
   * @param {(content: any) => void} [options.receive] takes the messages that views send
   * @param {Record<string, LocalModel>} [options.models] that traits refer to, by id
   */
  constructor(traits, { receive = () => {}, models = {} } = {}) {
    this.traits = traits;
    this.send = receive;
    this.widget_manager = { get_model: async (/** @type {string} */ id) => models[id] };
    /** @type {Map<string, Set<Handler>>} */
    this.handlers = new Map();
  }

  /** @param {string} name */
  get(name) {
    return this.traits[name];
  }

  /**
   * @param {string} name
   * @param {any} value
   */
  set(name, value) {
    if (this.traits[name] === value) return;
    this.traits[name] = value;
    for (const handler of [...(this.handlers.get(`change:${name}`) ?? [])]) handler();
  }

  /**
   * @param {string} names separated by spaces
   * @param {Handler} handler
   */
  on(names, handler) {
    for (const name of names.split(" ")) {
      const known = this.handlers.get(name) ?? new Set();
      this.handlers.set(name, known.add(handler));
    }
  }

  /**
   * @param {string} names
   * @param {Handler} handler
   */
  off(names, handler) {
    for (const name of names.split(" ")) this.handlers.get(name)?.delete(handler);
  }

  save_changes() {} // there is nobody to send them to
}
