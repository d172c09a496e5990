// The amplitudes of a section, as whole numbers.

export const NO_DATA = -32768;

/** Amplitudes on a regular grid, each the mean of some samples of the section. */
export class Texture {
  /**
   * @param {Int16Array} data row by row; NO_DATA where there is none
   * @param {number} width
   * @param {number} height
   * @param {{ width: number, height: number }} section number of its traces and samples
   */
  constructor(data, width, height, section) {
    this.data = data;
    this.width = width;
    this.height = height;
    this.section = section;
    this.stepX = section.width / width; // samples in a cell
    this.stepZ = section.height / height;
    this.hasGaps = data.includes(NO_DATA);
    /** @type {Map<string, Texture>} */
    this.reductions = new Map();
  }

  /**
   * The texture with its cells averaged where a pixel covers many of them, as in a view of a large section: two remain.
   *
   * @param {number} samplesX in a pixel
   * @param {number} samplesZ
   */
  reducedTo(samplesX, samplesZ) {
    const across = Math.max(1, Math.floor(Math.min(samplesX / this.stepX, this.width) / 2));
    const down = Math.max(1, Math.floor(Math.min(samplesZ / this.stepZ, this.height) / 2));
    if (across === 1 && down === 1) return this;
    const key = `${across},${down}`;
    const reduced = this.reductions.get(key) ?? reduce(this, across, down);
    this.reductions.clear(); // zooming passes through many
    this.reductions.set(key, reduced);
    return reduced;
  }
}

/**
 * Average blocks of cells.
 *
 * @param {Texture} texture
 * @param {number} across cells of a block
 * @param {number} down
 */
function reduce({ data, width, height, section }, across, down) {
  const [columns, rows] = [Math.ceil(width / across), Math.ceil(height / down)];
  const result = new Int16Array(columns * rows);
  for (let row = 0; row < rows; row++) {
    const [sums, counts] = [new Float32Array(columns), new Uint32Array(columns)];
    for (let from = row * down; from < Math.min((row + 1) * down, height); from++)
      addRow(data.subarray(from * width, (from + 1) * width), across, sums, counts);
    for (let i = 0; i < columns; i++) result[row * columns + i] = counts[i] ? Math.round(sums[i] / counts[i]) : NO_DATA;
  }
  // the last cell of a row or column may be cut off: it stands for fewer samples than the others
  const covered = {
    width: (columns * across * section.width) / width,
    height: (rows * down * section.height) / height,
  };
  return new Texture(result, columns, rows, covered);
}

/**
 * @param {Int16Array} row
 * @param {number} across
 * @param {Float32Array} sums
 * @param {Uint32Array} counts
 */
function addRow(row, across, sums, counts) {
  for (let i = 0; i < row.length; i++) {
    if (row[i] === NO_DATA) continue;
    const cell = Math.floor(i / across);
    sums[cell] += row[i];
    counts[cell]++;
  }
}
