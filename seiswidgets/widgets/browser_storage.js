// Keeps texts in this browser. Each is written twice: into the tab's own storage, which a reload of the page finds again
// whatever other tabs do, and into the storage of all tabs, for a tab that is opened later.

const PREFIX = "seiswidgets gallery: ";

function storage(kind) {
  try {
    return window[kind]; // null, or an error, where the browser or the page's host forbids it
  } catch {
    return null;
  }
}

function textsIn(store) {
  const names = Array.from({ length: store?.length ?? 0 }, (_, index) => store.key(index));
  const ours = names.filter((name) => name?.startsWith(PREFIX));
  return ours.map((name) => [name.slice(PREFIX.length), store.getItem(name)]);
}

/** What this tab kept, else what another did; an empty text of this tab says that there is to be none. */
function found() {
  const texts = [...textsIn(storage("localStorage")), ...textsIn(storage("sessionStorage"))];
  return Object.fromEntries(Object.entries(Object.fromEntries(texts)).filter(([, text]) => text));
}

function put(name, text) {
  const key = PREFIX + name;
  const [own, shared] = [storage("sessionStorage"), storage("localStorage")];
  try {
    if (!own) throw new Error("it lets no page store anything");
    own.setItem(key, text);
  } catch (error) {
    own?.removeItem(key); // an older text would be taken for the newest
    throw error;
  } finally {
    if (text) shared?.setItem(key, text);
    else shared?.removeItem(key);
  }
}

function initialize({ model }) {
  const stored = found(); // what is in there already is not written again: another tab may have kept something newer
  let before = {};
  let trouble = "";
  function write() {
    const kept = model.get("kept");
    let error = "";
    for (const name of new Set([...Object.keys(before), ...Object.keys(kept)])) {
      const text = kept[name] ?? "";
      if ((stored[name] ?? "") === text) continue;
      try {
        put(name, text);
        stored[name] = text;
      } catch (reason) {
        error = String(reason?.message ?? reason); // the next change tries again
      }
    }
    before = kept;
    if (error !== trouble) model.send({ kind: "trouble", text: (trouble = error) });
  }
  model.send({ kind: "found", texts: { ...stored } });
  model.on("change:kept", write);
  write();
}

export default { initialize };
