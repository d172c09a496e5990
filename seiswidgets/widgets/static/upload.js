/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// upload.js
var PIECE = 2 ** 20;
var PATIENCE = 1e4;
var percentage = (sent, size) => size ? Math.floor(100 * sent / size) : 0;
var Uploader = class {
  /**
   * @param {import("@anywidget/types").AnyModel} model
   * @param {(text: string, symbol: string) => void} show
   */
  constructor(model, show) {
    this.model = model;
    this.show = show;
    this.transfer = null;
    this.timer = void 0;
    this.reset();
  }
  reset() {
    clearTimeout(this.timer);
    this.transfer = null;
    this.show("Upload", "upload");
  }
  /** @param {File} file */
  begin(file) {
    this.transfer = { content: file, id: crypto.getRandomValues(new Uint32Array(1))[0] };
    this.show("Stop, 0%", "stop");
    this.send({ kind: "begin", id: this.transfer.id, name: file.name, size: file.size });
  }
  stop(reason = "") {
    if (this.transfer) this.send({ kind: "stop", id: this.transfer.id, reason });
  }
  /**
   * @param {object} message
   * @param {ArrayBuffer[]} buffers
   */
  send(message, ...buffers) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.send(message, ...buffers), PATIENCE);
    this.model.send(message, void 0, buffers);
  }
  /**
   * Send the piece that the kernel asks for.
   *
   * @param {{ id: number, next: number | null }} request
   */
  async sendPiece({ id, next }) {
    const { transfer } = this;
    if (transfer?.id !== id || next === transfer.next) return;
    if (next === null) {
      this.reset();
      return;
    }
    transfer.next = next;
    this.show(`Stop, ${percentage(next, transfer.content.size)}%`, "stop");
    try {
      const piece = await transfer.content.slice(next, next + PIECE).arrayBuffer();
      if (this.transfer === transfer) this.send({ kind: "piece", id, start: next }, piece);
    } catch (error) {
      const message = error instanceof Error ? error.message : String(error);
      if (this.transfer === transfer) this.stop(`it cannot be read: ${message}`);
    }
  }
};
function render({ model, el }) {
  const button = document.createElement("button");
  const icon = document.createElement("i");
  const label = document.createElement("span");
  const chooser = document.createElement("input");
  const uploader = new Uploader(model, (text, symbol) => {
    label.textContent = ` ${text}`;
    icon.className = `fa fa-${symbol}`;
  });
  button.className = "jupyter-widgets jupyter-button widget-button";
  button.title = "send a file from your computer; press again to stop";
  button.style.width = "auto";
  chooser.type = "file";
  chooser.accept = model.get("accept");
  chooser.hidden = true;
  button.append(icon, label);
  el.append(button, chooser);
  button.addEventListener("click", () => {
    if (uploader.transfer) uploader.stop();
    else chooser.click();
  });
  chooser.addEventListener("change", () => {
    const file = chooser.files?.[0];
    if (file) uploader.begin(file);
    chooser.value = "";
  });
  const controller = new AbortController();
  const { signal } = controller;
  const isHere = (event) => event.composedPath().includes(el.closest(".seiswidgets-drop") ?? el.parentElement ?? el);
  const accept = (event) => isHere(event) && event.preventDefault();
  for (
    const type of
    /** @type {const} */
    ["dragenter", "dragover"]
  )
    window.addEventListener(type, accept, { capture: true, signal });
  const drop = (event) => {
    const file = event.dataTransfer?.files[0];
    if (!isHere(event) || !file) return;
    event.preventDefault();
    event.stopPropagation();
    uploader.begin(file);
  };
  window.addEventListener("drop", drop, { capture: true, signal });
  const answer = (request) => uploader.sendPiece(request);
  model.on("msg:custom", answer);
  return () => {
    controller.abort();
    clearTimeout(uploader.timer);
    model.off("msg:custom", answer);
  };
}
var upload_default = { render };
export {
  upload_default as default
};
