// A button that sends a file to the kernel piece by piece: a server closes the connection on a message above 10 MB. The
// kernel asks for each piece by where it begins; what got lost with a connection is sent again.

const PIECE = 2 ** 20; // bytes
const PATIENCE = 10_000; // ms until a piece that was not answered is sent again

const share = (sent, size) => (size ? Math.floor((100 * sent) / size) : 0);

function render({ model, el }) {
  const [button, icon, label, chooser] = ["button", "i", "span", "input"].map((name) => document.createElement(name));
  let file = null; // that is being sent
  let timer = 0;

  function show(text, symbol) {
    label.textContent = ` ${text}`;
    icon.className = `fa fa-${symbol}`;
  }

  function send(content, ...buffers) {
    clearTimeout(timer);
    timer = setTimeout(send, PATIENCE, content, ...buffers);
    model.send(content, undefined, buffers);
  }

  function rest() {
    clearTimeout(timer);
    file = null;
    show("Upload", "upload");
  }

  function begin(chosen) {
    file = { content: chosen, id: crypto.getRandomValues(new Uint32Array(1))[0] };
    show("Stop, 0%", "stop");
    send({ kind: "begin", id: file.id, name: chosen.name, size: chosen.size });
  }

  async function answer({ id, next }) {
    if (file?.id !== id || next === file.next) return; // the latter to what was sent twice
    if (next === null) return rest();
    const { content } = file;
    file.next = next;
    show(`Stop, ${share(next, content.size)}%`, "stop");
    try {
      const piece = await content.slice(next, next + PIECE).arrayBuffer();
      if (file?.id === id) send({ kind: "piece", id, start: next }, piece);
    } catch (error) {
      send({ kind: "stop", id, reason: `it cannot be read: ${error.message}` });
    }
  }

  button.className = "jupyter-widgets jupyter-button widget-button";
  button.title = "send a file from your computer; press again to stop";
  button.style.width = "auto";
  chooser.type = "file";
  chooser.accept = model.get("accept");
  chooser.hidden = true;
  button.append(icon, label);
  el.append(button, chooser);
  rest();
  button.addEventListener("click", () => {
    if (file) send({ kind: "stop", id: file.id, reason: "" });
    else chooser.click();
  });
  chooser.addEventListener("change", () => {
    if (chooser.files.length) begin(chooser.files[0]);
    chooser.value = ""; // so that the same file can be chosen again
  });
  model.on("msg:custom", answer);
  return () => {
    clearTimeout(timer);
    model.off("msg:custom", answer);
  };
}

export default { render };
