// SVG elements.

const NAMESPACE = "http://www.w3.org/2000/svg";
const PALE = 170; // brightness, 0 to 255, above which white text cannot be read beside a colour

/** @typedef {{ x: number, y: number }} Pixel in css pixels */
/** @typedef {Record<string, string | number>} Attributes */

/**
 * Append a new SVG element to its parent.
 *
 * @template {keyof SVGElementTagNameMap} Tag
 * @param {Element} parent
 * @param {Tag} tag
 * @param {string} className
 * @param {Attributes} [attributes]
 * @returns {SVGElementTagNameMap[Tag]}
 */
export function append(parent, tag, className, attributes = {}) {
  const element = document.createElementNS(NAMESPACE, tag);
  element.setAttribute("class", className);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  parent.append(element);
  return element;
}

/**
 * Append a text, never as HTML: names come from users.
 *
 * @param {Element} parent
 * @param {string} className
 * @param {Attributes} attributes
 * @param {string} content
 */
export function appendText(parent, className, attributes, content) {
  const text = append(parent, "text", className, attributes);
  text.textContent = content;
  return text;
}

/** @type {Map<string, boolean>} */
const paleColours = new Map(); // asking the browser for a style costs milliseconds while something is dragged

/**
 * Set the class "pale" on a text if white would be hard to see beside an element's fill colour.
 *
 * @param {Element} text
 * @param {Element} coloured
 * @param {string} colour that the element is filled with
 */
export function togglePale(text, coloured, colour) {
  let isPale = paleColours.get(colour);
  if (isPale === undefined) {
    const [red, green, blue] = (getComputedStyle(coloured).fill.match(/\d+/g) ?? [0, 0, 0]).map(Number);
    isPale = 0.299 * red + 0.587 * green + 0.114 * blue > PALE;
    paleColours.set(colour, isPale);
  }
  text.classList.toggle("pale", isPale);
}

/**
 * The d attribute of a path through points; a null interrupts the line.
 *
 * @param {(Pixel | null)[]} points
 */
export function pathData(points) {
  let command = "M";
  let data = "";
  for (const point of points) {
    if (point) data += `${command}${point.x.toFixed(2)},${point.y.toFixed(2)}`;
    command = point ? "L" : "M";
  }
  return data;
}
