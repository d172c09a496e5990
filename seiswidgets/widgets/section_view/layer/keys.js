// The keyboard: the keys that the layer takes, and Space, which pans while it is held.

function modifiers(event) {
  return ["ctrl", "meta", "shift", "alt"].filter((name) => event[`${name}Key`]);
}

class Keys {
  constructor(plot, model, tell) {
    Object.assign(this, { plot, model, tell, isSpaceDown: false, hasPanned: false });
  }

  listenTo(listen) {
    listen("keydown", (event) => this.press(event));
    listen("keyup", (event) => this.release(event));
    listen("blur", () => {
      this.plot.classList.remove("by-pointer");
      this.setSpace(false);
    });
  }

  // Whether a drag that begins now pans.
  takeSpace() {
    this.hasPanned ||= this.isSpaceDown;
    return this.isSpaceDown;
  }

  setSpace(isDown) {
    this.isSpaceDown = isDown;
    this.plot.classList.toggle("can-pan", isDown);
  }

  isTaken(name) {
    return this.model.get("hotkeys").includes(name);
  }

  press(event) {
    this.plot.classList.remove("by-pointer");
    const pressed = modifiers(event);
    const withCtrl = pressed.includes("ctrl") || pressed.includes("meta");
    const isSpace = event.key === " " && !withCtrl;
    if (!isSpace && !this.isTaken((withCtrl ? "Ctrl+" : "") + event.key)) return; // Tab among them: it leaves the pane
    event.preventDefault();
    if (!isSpace) this.tell("key", event, { key: event.key });
    else if (!event.repeat) {
      this.hasPanned = false;
      this.setSpace(true);
    }
  }

  release(event) {
    if (event.key !== " " || !this.isSpaceDown) return;
    event.preventDefault();
    this.setSpace(false);
    if (!this.hasPanned && this.isTaken(" ")) this.tell("key", event, { key: " " });
  }
}
