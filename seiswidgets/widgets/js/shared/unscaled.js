// Sizes and positions in an element's own css pixels: a page may be scaled around it, for example on a slide.

/** @param {Element} element in the page */
export function unscaledSize(element) {
  const { width, height } = getComputedStyle(element);
  return { width: Number.parseFloat(width), height: Number.parseFloat(height) };
}

/**
 * The position of a mouse or finger, from the element's upper left corner.
 *
 * @param {MouseEvent} event
 * @param {Element} element
 * @param {{ width: number, height: number }} size of the element, unscaled
 */
export function unscaledPosition(event, element, { width, height }) {
  const box = element.getBoundingClientRect();
  return {
    x: ((event.clientX - box.left) * width) / box.width,
    y: ((event.clientY - box.top) * height) / box.height,
  };
}
