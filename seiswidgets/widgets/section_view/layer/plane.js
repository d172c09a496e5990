// Where things lie. A place is {x, z} on the section or {x, y} in css pixels from the plot area's upper left corner. The
// kernel may know another size of the plot area than this view has: what it tells and is told is in its own pixels.

class Plane {
  constructor(model, plot) {
    this.model = model;
    this.plot = plot;
    this.width = this.height = 0;
  }

  // Take the size that the plot area has now; false if it is not shown.
  measure() {
    const { width, height } = this.plot.getBoundingClientRect();
    if (width < 1 || height < 1) return false;
    [this.width, this.height] = [width, height];
    return true;
  }

  get isReady() {
    return this.width > 0 && this.model.get("window").length === 4;
  }

  toPixels(x, z) {
    const [left, right, top, bottom] = this.model.get("window");
    return { x: ((x - left) / (right - left)) * this.width, y: ((z - top) / (bottom - top)) * this.height };
  }

  toSection(at) {
    const [left, right, top, bottom] = this.model.get("window");
    return { x: left + (at.x / this.width) * (right - left), z: top + (at.y / this.height) * (bottom - top) };
  }

  // The kernel's pixels in one of this view's, along x and along y.
  get share() {
    const [width, height] = this.model.get("size");
    return width && this.width ? { x: width / this.width, y: height / this.height } : { x: 1, y: 1 };
  }

  forKernel(at) {
    const share = this.share;
    return { x: at.x * share.x, y: at.y * share.y };
  }

  holds(at) {
    return at.x >= 0 && at.x <= this.width && at.y >= 0 && at.y <= this.height;
  }

  // Where a mouse or finger is.
  under(event) {
    const box = this.plot.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
}
