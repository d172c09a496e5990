// How two boxes share a height.

const LEAST = { upper: 200, lower: 110 }; // css pixels
const STEP = 0.05; // of the whole height

/**
 * The share nearest to a wanted one that leaves room for both boxes.
 *
 * @param {number} share of the upper box
 * @param {number} total height of both, in css pixels
 */
export function nearestShare(share, total) {
  const [low, high] = [LEAST.upper / total, 1 - LEAST.lower / total];
  return low < high ? Math.min(high, Math.max(low, share)) : 0.5;
}

/**
 * The share after a key; null for the usual one, undefined if the key means nothing here.
 *
 * @param {string} key
 * @param {number} share
 * @param {number} total
 */
export function keyedShare(key, share, total) {
  if (key === "Enter") return null;
  const wanted = { ArrowUp: share - STEP, ArrowDown: share + STEP, Home: 0, End: 1 }[key];
  return wanted === undefined ? undefined : nearestShare(wanted, total);
}
