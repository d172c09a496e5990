// The keyboard: the hotkeys of the layer; Space, which pans while it is held; and V, which hides the picks meanwhile.

const BARE = "v";

/**
 * @typedef {object} ModifierKeys
 * @property {boolean} ctrlKey
 * @property {boolean} metaKey
 * @property {boolean} shiftKey
 * @property {boolean} altKey
 */

/** @typedef {(kind: import("./types.js").MessageKind, event: MouseEvent | KeyboardEvent, more?: object) => void} Send */
/** @typedef {<K extends keyof SVGElementEventMap>(name: K, handle: (event: SVGElementEventMap[K]) => void) => void} Listen */

/** @param {ModifierKeys} event */
export function modifiers(event) {
  const pressed = { ctrl: event.ctrlKey, meta: event.metaKey, shift: event.shiftKey, alt: event.altKey };
  return Object.entries(pressed).flatMap(([name, isPressed]) => (isPressed ? [name] : []));
}

/** Sends hotkeys to the kernel, and knows whether Space or V is held. */
export class Keyboard {
  /**
   * @param {{ classList: Pick<DOMTokenList, "toggle" | "remove"> }} plot
   * @param {Pick<import("./types.js").Model, "get">} model
   * @param {Send} send
   * @param {(isBare: boolean) => void} showBare
   */
  constructor(plot, model, send, showBare) {
    this.plot = plot;
    this.model = model;
    this.send = send;
    this.showBare = showBare;
    this.isSpaceDown = false;
    this.hasPanned = false; // since Space was pressed
  }

  /** @param {Listen} listen */
  listenWith(listen) {
    listen("keydown", (event) => this.press(event));
    listen("keyup", (event) => this.release(event));
    listen("blur", () => {
      this.plot.classList.remove("by-pointer");
      this.setSpace(false);
      this.showBare(false);
    });
  }

  /** Start a drag; true if it pans, since Space is held. */
  startDrag() {
    this.hasPanned ||= this.isSpaceDown;
    return this.isSpaceDown;
  }

  /** @param {boolean} isDown */
  setSpace(isDown) {
    this.isSpaceDown = isDown;
    this.plot.classList.toggle("can-pan", isDown);
  }

  /** @param {string} name */
  isHotkey(name) {
    return this.model.get("hotkeys").includes(name);
  }

  /** @param {KeyboardEvent} event */
  press(event) {
    this.plot.classList.remove("by-pointer");
    const withCtrl = event.ctrlKey || event.metaKey;
    if (event.key === "ContextMenu" || (event.key === "F10" && event.shiftKey)) {
      event.preventDefault();
      this.send("menu", event);
      return;
    }
    if (event.key.toLowerCase() === BARE && !withCtrl && !event.altKey) {
      event.preventDefault();
      this.showBare(true);
      return;
    }
    const isSpace = event.key === " " && !withCtrl;
    if (!isSpace && !this.isHotkey((withCtrl ? "Ctrl+" : "") + event.key)) return; // so that Tab leaves the pane
    event.preventDefault();
    if (!isSpace) this.send("key", event, { key: event.key });
    else if (!event.repeat) {
      this.hasPanned = false;
      this.setSpace(true);
    }
  }

  /** @param {KeyboardEvent} event */
  release(event) {
    if (event.key.toLowerCase() === BARE) this.showBare(false);
    if (event.key !== " " || !this.isSpaceDown) return;
    event.preventDefault();
    this.setSpace(false);
    if (!this.hasPanned && this.isHotkey(" ")) this.send("key", event, { key: " " });
  }
}
