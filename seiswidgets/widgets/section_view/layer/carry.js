// Carries a point from this pane to another by maps that are affine in each triangle, one after the other.

const TOLERANCE = 1e-6; // of a triangle: so far outside still counts as inside

class AffinePieces {
  constructor({ source, target, triangles }) {
    this.source = numbers(source, Float64Array);
    this.target = numbers(target, Float64Array);
    this.corners = numbers(triangles, Uint32Array);
    this.sortIntoBuckets();
  }

  // A grid over the triangles, a quarter as many buckets as triangles; each lists those whose box reaches into it.
  sortIntoBuckets() {
    const count = this.corners.length / 3;
    const boxes = this.boxes(count);
    const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
    boxes.forEach((value, i) => {
      if (i % 4 < 2) low[i % 4] = Math.min(low[i % 4], value);
      else high[(i % 4) - 2] = Math.max(high[(i % 4) - 2], value);
    });
    this.low = low;
    this.across = Math.max(1, Math.ceil(Math.sqrt(count) / 2));
    this.step = [0, 1].map((axis) => (high[axis] - low[axis]) / this.across || 1);
    this.buckets = Array.from({ length: this.across ** 2 }, () => []);
    for (let triangle = 0; triangle < count; triangle++) {
      const [left, top, right, bottom] = boxes.subarray(4 * triangle, 4 * triangle + 4);
      const lastRow = this.cell(bottom, 1);
      const lastColumn = this.cell(right, 0);
      for (let row = this.cell(top, 1); row <= lastRow; row++)
        for (let column = this.cell(left, 0); column <= lastColumn; column++)
          this.buckets[row * this.across + column].push(triangle);
    }
  }

  // Left, top, right and bottom of each triangle, with what is outside by rounding only.
  boxes(count) {
    const boxes = new Float64Array(4 * count);
    for (let i = 0; i < count; i++) {
      for (const axis of [0, 1]) {
        const [a, b, c] = [0, 1, 2].map((k) => this.source[2 * this.corners[3 * i + k] + axis]);
        const [low, high] = [Math.min(a, b, c), Math.max(a, b, c)];
        const margin = 2 * TOLERANCE * (high - low);
        [boxes[4 * i + axis], boxes[4 * i + 2 + axis]] = [low - margin, high + margin];
      }
    }
    return boxes;
  }

  cell(value, axis) {
    const at = Math.floor((value - this.low[axis]) / this.step[axis]);
    return Math.max(0, Math.min(at, this.across - 1));
  }

  // The first triangle that holds a point, else the one that it lies outside of by rounding only; and its weights.
  find(x, z) {
    let [nearest, outside] = [null, -TOLERANCE];
    for (const triangle of this.buckets[this.cell(z, 1) * this.across + this.cell(x, 0)]) {
      const weights = this.weights(triangle, x, z);
      const least = Math.min(...weights);
      if (least >= 0) return { triangle, weights };
      if (least >= outside) [nearest, outside] = [{ triangle, weights }, least];
    }
    return nearest;
  }

  weights(triangle, x, z) {
    const [a, b, c] = this.corners.subarray(3 * triangle, 3 * triangle + 3);
    const at = this.source;
    const [bx, bz] = [at[2 * b] - at[2 * a], at[2 * b + 1] - at[2 * a + 1]];
    const [cx, cz] = [at[2 * c] - at[2 * a], at[2 * c + 1] - at[2 * a + 1]];
    const [px, pz] = [x - at[2 * a], z - at[2 * a + 1]];
    const area = bx * cz - bz * cx;
    const [second, third] = [(px * cz - pz * cx) / area, (bx * pz - bz * px) / area];
    return [1 - second - third, second, third];
  }

  carry({ x, z }) {
    const found = this.find(x, z);
    if (!found) return null;
    const carried = { x: 0, z: 0 };
    found.weights.forEach((weight, k) => {
      const corner = this.corners[3 * found.triangle + k];
      carried.x += weight * this.target[2 * corner];
      carried.z += weight * this.target[2 * corner + 1];
    });
    return carried;
  }
}

function carryAlong(pieces, place) {
  return pieces.reduce((at, one) => at && one.carry(at), place);
}
