// The data in the page: JSON, and a block of bytes that it refers to.

/**
 * @typedef {object} State as made by widgets/handout/state.py
 * @property {import("../picture/types.js").Grid} grid
 * @property {{ shape: [number, number], data: DataView }} texture
 * @property {import("../picture/live_chain.js").StageState[]} stages
 * @property {import("../picture/live_chain.js").TrianglesState[]} triangles
 * @property {string[]} names of the stages
 * @property {{ palette: DataView, factor: number }} colours
 * @property {{ palette: DataView, span: number, axis: import("./ratios.js").Axis }} ratios
 * @property {import("./viewport.js").Window} frame
 * @property {[string, string]} titles of the axes
 * @property {[string, string]} units
 * @property {string} height
 * @property {string} label
 * @property {import("../stage_strip/strip.js").Scene[]} scenes
 * @property {import("../pointer_layer/types.js").StrokeState[][]} strokes as they are after each number of stages
 */

/**
 * Read the page's data.
 *
 * @returns {Promise<State>}
 */
export async function readState() {
  const packed = Uint8Array.from(atob(contentOf("data")), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const block = await new Response(stream).arrayBuffer();
  return JSON.parse(contentOf("state"), (_, value) =>
    Array.isArray(value?.bytes) ? new DataView(block, ...value.bytes) : value,
  );
}

/** @param {string} id */
function contentOf(id) {
  return document.getElementById(id)?.textContent ?? "";
}
