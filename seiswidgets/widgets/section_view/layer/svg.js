// The files of this folder are joined, in the order that pointer.py names, into one ES module: they share one scope.
// This one makes SVG elements.

const SVG = "http://www.w3.org/2000/svg";
const RIM = 1.5; // css pixels of the pale rim on either side of a line

function element(name, className, parent, attributes = {}) {
  const made = document.createElementNS(SVG, name);
  made.setAttribute("class", className);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  parent.append(made);
  return made;
}

function text(className, parent, attributes, content) {
  element("text", className, parent, attributes).textContent = content; // never HTML: names come from users
  return parent.lastChild;
}

// Mark a text whose colour, or that of what it lies on, is so pale that white beside it could not be told from it.
function markPale(label, coloured) {
  const [red, green, blue] = getComputedStyle(coloured).fill.match(/\d+/g) ?? [0, 0, 0];
  label.classList.toggle("pale", 0.299 * red + 0.587 * green + 0.114 * blue > 170);
}

// The d of a path through pixels; null interrupts it.
function path(pixels) {
  let command = "M";
  let d = "";
  for (const at of pixels) {
    if (at) d += `${command}${at.x.toFixed(2)},${at.y.toFixed(2)}`;
    command = at ? "L" : "M";
  }
  return d;
}
