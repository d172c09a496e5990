// A map in colours over the section, as one stretched picture.

/**
 * @param {SVGImageElement} image
 * @param {Partial<import("./types.js").Shade> | undefined} shade
 * @param {import("./plot_area.js").PlotArea} plotArea
 */
export function drawShade(image, shade, plotArea) {
  if (!shade?.href || !shade.window) {
    image.removeAttribute("href");
    return;
  }
  const [left, right, top, bottom] = shade.window;
  const [first, last] = [plotArea.toPixels(left, top), plotArea.toPixels(right, bottom)];
  if (image.getAttribute("href") !== shade.href) image.setAttribute("href", shade.href);
  const place = { x: first.x, y: first.y, width: last.x - first.x, height: last.y - first.y, opacity: shade.opacity };
  for (const [name, value] of Object.entries(place)) image.setAttribute(name, String(value));
}
