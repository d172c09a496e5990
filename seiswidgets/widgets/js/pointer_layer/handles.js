// Handles, vertices and cut-offs: small, so that they hide little of the section, until the pointer comes near one.

import { append, appendText, togglePale } from "../shared/svg.js";

const REACH = 12; // css pixels within which the pointer is near

/** @typedef {import("./types.js").Pixel & { colour: string, text?: string }} Handle with the number of a cut-off */

/**
 * The handle nearest to the pointer; undefined if none is near.
 *
 * @param {Handle[]} handles
 * @param {import("./types.js").Pixel | null} pointer
 */
export function nearestHandle(handles, pointer) {
  let [nearest, least] = [/** @type {Handle | undefined} */ (undefined), REACH];
  for (const handle of pointer ? handles : []) {
    const distance = Math.hypot(handle.x - (pointer?.x ?? 0), handle.y - (pointer?.y ?? 0));
    if (distance <= least) [nearest, least] = [handle, distance];
  }
  return nearest;
}

/**
 * @param {SVGGElement} group
 * @param {Handle | undefined} handle
 */
export function drawGrown(group, handle) {
  group.replaceChildren();
  if (!handle) return;
  const { x, y, colour, text } = handle;
  const disc = append(group, "circle", "disc", { cx: x, cy: y, r: text ? 8 : 5.5, fill: colour });
  if (text) togglePale(appendText(group, "number", { x, y: y + 3.5 }, text), disc, colour);
}
