// The little of a browser that the tests need: a clock that they advance, and elements that only remember.

import { mock } from "node:test";

const FRAME = 16; // ms

/** Replace the clock; `tick(ms)` advances it. */
export function fakeClock() {
  mock.timers.enable({ apis: ["setTimeout", "Date"], now: 1_000_000 });
  mock.method(performance, "now", () => Date.now());
  globalThis.requestAnimationFrame = (draw) => Number(setTimeout(() => draw(Date.now()), FRAME));
  return {
    /** @param {number} ms */
    tick(ms) {
      for (let i = 0; i < ms; i++) mock.timers.tick(1); // timers that start others run in order
    },
    restore() {
      mock.timers.reset();
      mock.restoreAll();
    },
  };
}

/** An SVG element. */
export class FakeElement {
  /** @param {string} tag */
  constructor(tag) {
    this.tag = tag;
    /** @type {Record<string, string>} */
    this.attributes = {};
    /** @type {FakeElement[]} */
    this.children = [];
    this.textContent = "";
  }

  /**
   * @param {string} name
   * @param {string} value
   */
  setAttribute(name, value) {
    this.attributes[name] = value;
  }

  /** @param {FakeElement} child */
  append(child) {
    this.children.push(child);
  }

  /** @param {FakeElement[]} children */
  replaceChildren(...children) {
    this.children = children;
  }

  /** @param {string} className */
  all(className) {
    return this.children.filter(({ attributes }) => attributes.class === className);
  }
}

/** Create elements without a browser; a group to draw in. */
export function fakeGroup() {
  const fakeDocument = {
    createElementNS: (/** @type {string} */ _, /** @type {string} */ tag) => new FakeElement(tag),
  };
  globalThis.document = /** @type {any} */ (fakeDocument);
  return new FakeElement("g");
}
