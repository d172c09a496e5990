/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// browser_storage.js
var PREFIX = "seiswidgets gallery: ";
function storage(kind) {
  try {
    return window[kind];
  } catch {
    return null;
  }
}
function storedTexts(store) {
  const keys = Array.from({ length: store?.length ?? 0 }, (_, index) => store?.key(index) ?? "");
  return keys.filter((key) => key.startsWith(PREFIX)).map((key) => [key.slice(PREFIX.length), store?.getItem(key) ?? ""]);
}
function loadTexts() {
  const texts = Object.fromEntries([
    ...storedTexts(storage("localStorage")),
    ...storedTexts(storage("sessionStorage"))
  ]);
  return Object.fromEntries(Object.entries(texts).filter(([, text]) => text));
}
function storeText(name, text) {
  const key = PREFIX + name;
  const [own, shared] = [storage("sessionStorage"), storage("localStorage")];
  try {
    if (!own) throw new Error("it does not let this page store anything");
    own.setItem(key, text);
  } catch (error) {
    own?.removeItem(key);
    throw error;
  } finally {
    if (text) shared?.setItem(key, text);
    else shared?.removeItem(key);
  }
}
function storeChanges(texts, stored) {
  let trouble = "";
  for (const [name, text] of Object.entries(texts)) {
    if ((stored[name] ?? "") === text) continue;
    try {
      storeText(name, text);
      stored[name] = text;
    } catch (error) {
      trouble = error instanceof Error ? error.message : String(error);
    }
  }
  return trouble;
}
function initialize({ model }) {
  const stored = loadTexts();
  let previous = {};
  let reported = "";
  function write() {
    const kept = model.get("kept");
    const deleted = Object.fromEntries(Object.keys(previous).map((name) => [name, ""]));
    const trouble = storeChanges({ ...deleted, ...kept }, stored);
    previous = kept;
    if (trouble !== reported) model.send({ kind: "trouble", text: trouble });
    reported = trouble;
  }
  model.send({ kind: "found", texts: { ...stored } });
  model.on("change:kept", write);
  write();
}
var browser_storage_default = { initialize };
export {
  browser_storage_default as default
};
