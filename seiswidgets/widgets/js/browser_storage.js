// Keep texts in this browser. Each is written twice: to the tab's own storage, which survives a reload of the page
// whatever other tabs do, and to the storage shared by all tabs, for a tab opened later.

const PREFIX = "seiswidgets gallery: ";

/** @typedef {Record<string, string>} Texts by name */

/**
 * @param {"localStorage" | "sessionStorage"} kind
 * @returns {Storage | null}
 */
function storage(kind) {
  try {
    return window[kind]; // null or an error where the browser or the page's host forbids storage
  } catch {
    return null;
  }
}

/**
 * @param {Storage | null} store
 * @returns {[string, string][]}
 */
function storedTexts(store) {
  const keys = Array.from({ length: store?.length ?? 0 }, (_, index) => store?.key(index) ?? "");
  return keys
    .filter((key) => key.startsWith(PREFIX))
    .map((key) => [key.slice(PREFIX.length), store?.getItem(key) ?? ""]);
}

/**
 * The texts of this tab, or else of other tabs. An empty text in this tab marks one that was deleted here.
 *
 * @returns {Texts}
 */
function loadTexts() {
  const texts = Object.fromEntries([
    ...storedTexts(storage("localStorage")),
    ...storedTexts(storage("sessionStorage")),
  ]);
  return Object.fromEntries(Object.entries(texts).filter(([, text]) => text));
}

/**
 * @param {string} name
 * @param {string} text empty to delete it
 */
function storeText(name, text) {
  const key = PREFIX + name;
  const [own, shared] = [storage("sessionStorage"), storage("localStorage")];
  try {
    if (!own) throw new Error("it does not let this page store anything");
    own.setItem(key, text);
  } catch (error) {
    own?.removeItem(key); // or an older text would be taken for the newest
    throw error;
  } finally {
    if (text) shared?.setItem(key, text);
    else shared?.removeItem(key);
  }
}

/**
 * Store the texts that differ from those stored before; the error of one that cannot be stored, else "".
 *
 * @param {Texts} texts
 * @param {Texts} stored updated
 */
function storeChanges(texts, stored) {
  let trouble = "";
  for (const [name, text] of Object.entries(texts)) {
    if ((stored[name] ?? "") === text) continue;
    try {
      storeText(name, text);
      stored[name] = text;
    } catch (error) {
      trouble = error instanceof Error ? error.message : String(error); // the next change tries again
    }
  }
  return trouble;
}

/** @type {import("@anywidget/types").Initialize<{ kept: Texts }>} */
function initialize({ model }) {
  const stored = loadTexts(); // not written again: another tab may have stored something newer
  /** @type {Texts} */
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

export default { initialize };
