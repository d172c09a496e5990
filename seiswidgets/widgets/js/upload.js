// A button that sends a file to the kernel in pieces, since a server closes the connection on a message above 10 MB. The
// kernel asks for each piece by its start. A message without an answer was lost with a connection, and is sent again.

const PIECE = 2 ** 20; // bytes
const PATIENCE = 10_000; // ms without an answer before a message is sent again

/**
 * @typedef {object} FileTransfer
 * @property {File} content
 * @property {number} id
 * @property {number} [next] start of the piece that was sent last, in bytes
 */

/**
 * @param {number} sent
 * @param {number} size
 */
const percentage = (sent, size) => (size ? Math.floor((100 * sent) / size) : 0);

/** Sends a file, and resends what is lost. */
class Uploader {
  /**
   * @param {import("@anywidget/types").AnyModel} model
   * @param {(text: string, symbol: string) => void} show
   */
  constructor(model, show) {
    this.model = model;
    this.show = show;
    /** @type {FileTransfer | null} */
    this.transfer = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
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
    this.model.send(message, undefined, buffers);
  }

  /**
   * Send the piece that the kernel asks for.
   *
   * @param {{ id: number, next: number | null }} request
   */
  async sendPiece({ id, next }) {
    const { transfer } = this;
    if (transfer?.id !== id || next === transfer.next) return; // answers a message that was sent twice
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
}

/** @type {import("@anywidget/types").Render<{ accept: string }>} */
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
    chooser.value = ""; // so that the same file can be chosen again
  });
  const controller = new AbortController();
  const { signal } = controller;
  const isHere = (/** @type {Event} */ event) =>
    event.composedPath().includes(el.closest(".seiswidgets-drop") ?? el.parentElement ?? el);
  const accept = (/** @type {DragEvent} */ event) => isHere(event) && event.preventDefault();
  for (const type of /** @type {const} */ (["dragenter", "dragover"]))
    window.addEventListener(type, accept, { capture: true, signal });
  const drop = (/** @type {DragEvent} */ event) => {
    const file = event.dataTransfer?.files[0];
    if (!isHere(event) || !file) return;
    event.preventDefault(); // or the browser would show the file instead of the notebook
    event.stopPropagation();
    uploader.begin(file);
  };
  window.addEventListener("drop", drop, { capture: true, signal });
  /** @param {{ id: number, next: number | null }} request */
  const answer = (request) => uploader.sendPiece(request);
  model.on("msg:custom", answer);
  return () => {
    controller.abort();
    clearTimeout(uploader.timer);
    model.off("msg:custom", answer);
  };
}

export default { render };
