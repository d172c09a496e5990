// ipywidgets leaves some controls without a name for screen readers: the handles of sliders, the buttons of Play, the
// choice of a colour, and fields with a tooltip but no label. This gives each the words that a sighted person goes by.

const CONTROLS = ".noUi-handle, .widget-play button, input, select";
const PLAYING = { "fa-play": "Play", "fa-pause": "Pause", "fa-stop": "Stop", "fa-retweet": "Repeat" };

function nameOf(control) {
  if (control.type === "color") return "Colour"; // it takes no tooltip
  const icon = [...(control.querySelector(".fa")?.classList ?? [])].find((name) => name in PLAYING);
  const label = control.closest(".widget-inline-hbox")?.querySelector(".widget-label");
  return PLAYING[icon] || label?.textContent.trim() || control.closest("[title]")?.title;
}

function nameAll(box) {
  for (const control of box.querySelectorAll(CONTROLS)) {
    const name = nameOf(control);
    const isLabelled = [...(control.labels ?? [])].some((label) => label.textContent.trim());
    if (name && !isLabelled) control.setAttribute("aria-label", name);
  }
}

function render({ el }) {
  let box; // which el is a child of
  const observer = new MutationObserver((changes) => {
    if (changes.some(({ target }) => !(target instanceof SVGElement))) nameAll(box); // SVG follows the mouse
  });
  let frame = requestAnimationFrame(function begin() {
    box = el.parentElement;
    if (box) {
      nameAll(box);
      observer.observe(box, { subtree: true, childList: true, attributeFilter: ["class", "title"] });
    } else {
      frame = requestAnimationFrame(begin);
    }
  });
  return () => {
    cancelAnimationFrame(frame);
    observer.disconnect();
  };
}

export default { render };
