/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// maximise.js
var APP = ".seiswidgets-app";
var MAXIMISED = "seiswidgets-maximised";
var FILLS = "seiswidgets-fills";
function render({ model, el }) {
  const controller = new AbortController();
  const { signal } = controller;
  const button = document.createElement("button");
  const icon = document.createElement("i");
  button.className = "jupyter-button";
  button.append(icon);
  el.classList.add("seiswidgets-maximise");
  el.append(button);
  let app = null;
  let wasFilling = false;
  function show() {
    icon.className = `fa fa-${app ? "compress" : "expand"}`;
    button.title = app ? "Back to the page (Escape)" : "Fill the window";
    button.setAttribute("aria-label", button.title);
  }
  function enter() {
    const box = (
      /** @type {HTMLElement | null} */
      el.closest(APP)
    );
    if (!box?.parentElement) return;
    app = box;
    box.parentElement.style.minHeight = `${box.offsetHeight}px`;
    wasFilling = box.classList.contains(FILLS);
    box.classList.add(MAXIMISED, FILLS);
    box.popover = "manual";
    box.showPopover();
    show();
  }
  function leave() {
    if (!app) return;
    const box = app;
    app = null;
    const focused = document.activeElement;
    box.popover = null;
    box.classList.remove(MAXIMISED);
    box.classList.toggle(FILLS, wasFilling);
    if (box.parentElement) box.parentElement.style.minHeight = "";
    if (focused instanceof HTMLElement || focused instanceof SVGElement) focused.focus({ preventScroll: true });
    box.scrollIntoView({ block: "nearest" });
    show();
  }
  button.addEventListener("click", () => app ? leave() : enter());
  window.addEventListener(
    "keydown",
    (event) => {
      if (event.key !== "Escape" || !app?.contains(
        /** @type {Node} */
        event.target
      )) return;
      setTimeout(() => event.defaultPrevented || leave());
    },
    { capture: true, signal }
  );
  const receive = ({ kind }) => kind === "leave" && leave();
  model.on("msg:custom", receive);
  show();
  return () => {
    controller.abort();
    model.off("msg:custom", receive);
    leave();
  };
}
var maximise_default = { render };
export {
  maximise_default as default
};
