// The parts of a line near some points and away from them.

/** @typedef {import("./types.js").Pixel} Pixel */
/** @typedef {(Pixel | null)[]} Line interrupted by nulls */

/**
 * Split a line where it enters and leaves circles. Stretches that are short and lie between two circles count as near.
 *
 * @param {Line} line
 * @param {Pixel[]} centres
 * @param {number} radius
 * @returns {{ near: Line, far: Line }}
 */
export function splitNear(line, centres, radius) {
  if (!centres.length) return { near: [], far: line };
  /** @type {{ near: Line, far: Line }} */
  const parts = { near: [], far: [] };
  for (let i = 1; i < line.length; i++) {
    const [from, to] = [line[i - 1], line[i]];
    if (from && to) addSegment(parts, from, to, centres, radius);
    else for (const part of [parts.near, parts.far]) part.push(null);
  }
  return withoutShort(parts, 2 * radius);
}

/**
 * @param {{ near: Line, far: Line }} parts
 * @param {number} least length
 * @returns {{ near: Line, far: Line }}
 */
function withoutShort({ near, far }, least) {
  const runs = runsOf(far);
  const isShort = (/** @type {Pixel[]} */ run) =>
    lengthOf(run) < least && [run[0], run[run.length - 1]].every((end) => near.some((one) => isSame(one, end)));
  const join = (/** @type {Pixel[][]} */ kept) => kept.flatMap((run) => [...run, null]);
  return { near: [...near, null, ...join(runs.filter(isShort))], far: join(runs.filter((run) => !isShort(run))) };
}

/**
 * The stretches between the gaps of a line.
 *
 * @param {Line} line
 */
function runsOf(line) {
  /** @type {Pixel[][]} */
  const runs = [];
  line.forEach((point, i) => {
    if (point && line[i - 1]) runs[runs.length - 1].push(point);
    else if (point) runs.push([point]);
  });
  return runs;
}

/** @param {Pixel[]} run */
const lengthOf = (run) =>
  run.reduce((sum, { x, y }, i) => sum + (i ? Math.hypot(x - run[i - 1].x, y - run[i - 1].y) : 0), 0);

/**
 * @param {Pixel | null} one
 * @param {Pixel} other
 */
const isSame = (one, other) => one !== null && one.x === other.x && one.y === other.y;

/**
 * @param {{ near: Line, far: Line }} parts
 * @param {Pixel} from
 * @param {Pixel} to
 * @param {Pixel[]} centres
 * @param {number} radius
 */
function addSegment({ near, far }, from, to, centres, radius) {
  const at = (/** @type {number} */ share) => ({
    x: from.x + share * (to.x - from.x),
    y: from.y + share * (to.y - from.y),
  });
  const shares = [0, ...centres.flatMap((centre) => crossings(from, to, centre, radius)), 1].sort((a, b) => a - b);
  for (let i = 1; i < shares.length; i++) {
    const middle = at((shares[i - 1] + shares[i]) / 2);
    const isNear = centres.some(({ x, y }) => Math.hypot(x - middle.x, y - middle.y) < radius);
    const [part, other] = isNear ? [near, far] : [far, near];
    if (!part.at(-1)) part.push(at(shares[i - 1]));
    part.push(at(shares[i]));
    if (other.at(-1)) other.push(null);
  }
}

/**
 * The shares of a segment, between 0 and 1, at which it crosses a circle.
 *
 * @param {Pixel} from
 * @param {Pixel} to
 * @param {Pixel} centre
 * @param {number} radius
 */
function crossings(from, to, centre, radius) {
  const [dx, dy, x, y] = [to.x - from.x, to.y - from.y, from.x - centre.x, from.y - centre.y];
  const [a, b, c] = [dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - radius * radius];
  const root = Math.sqrt(b * b - a * c); // NaN if it misses the circle
  return [(-b - root) / a, (-b + root) / a].filter((share) => share > 0 && share < 1);
}
