// Throttled messages to the kernel.

const DRAG_PAUSE = 50; // ms between two messages
const HOVER_PAUSE = 200;
const HOVER_MOVES = 18; // moves per message while the pointer keeps moving, however slow the browser is
const LOST = 5000; // ms without an answer after which a message counts as lost with its connection
const STILL = 100; // ms without a move after which the pointer has stopped

/** @typedef {Record<string, any>} Message */

/**
 * Sends messages of one kind: the next when the kernel has answered the last, and not before a pause. Messages that
 * arrive meanwhile are merged into one. While more keep arriving, at least `batch` are merged.
 */
export class MessageThrottle {
  /**
   * @param {(message: Message) => void} send
   * @param {object} [options]
   * @param {number} [options.pause] ms
   * @param {(waiting: any, newest: any) => Message} [options.merge] keeps the newest by default
   * @param {number} [options.batch]
   */
  constructor(send, { pause = 0, merge = (_, newest) => newest, batch = 1 } = {}) {
    this.send = send;
    this.pause = pause;
    this.merge = merge;
    this.batch = batch;
    /** @type {Message | null} */
    this.waiting = null;
    this.merged = 0; // messages in the one that is waiting
    this.addedAt = -Infinity;
    this.sentAt = -Infinity;
    this.isAnswered = true;
    this.isScheduled = false;
  }

  /** @param {Message} message */
  add(message) {
    this.waiting = this.waiting ? this.merge(this.waiting, message) : message;
    this.merged += 1;
    this.addedAt = performance.now();
    if (this.isScheduled) return;
    this.isScheduled = true;
    requestAnimationFrame(() => this.trySending());
  }

  /** Forget the message that is waiting. */
  drop() {
    this.waiting = null;
    this.merged = 0;
  }

  /** Note that the kernel has answered the last message. */
  answer() {
    this.isAnswered = true;
    if (!this.isScheduled) this.trySending();
  }

  trySending() {
    const now = performance.now();
    this.isScheduled = false;
    if (!this.waiting || (!this.isAnswered && now - this.sentAt < LOST)) return;
    const due = Math.max(this.sentAt + this.pause, this.merged < this.batch ? this.addedAt + STILL : 0);
    if (due - now > 1) {
      this.isScheduled = true;
      setTimeout(() => this.trySending(), due - now);
      return;
    }
    const message = this.waiting;
    this.sentAt = now;
    this.isAnswered = false;
    this.drop();
    this.send(message);
  }
}

/**
 * The throttles of a pointer layer, by the kind of message.
 *
 * @param {{ send: (message: Message) => void }} model
 */
export function createThrottles(model) {
  /** @param {string} kind */
  const sender = (kind) => (/** @type {Message} */ message) => model.send({ kind, ...message });
  return {
    drag: new MessageThrottle(sender("drag"), { pause: DRAG_PAUSE }),
    hover: new MessageThrottle(sender("hover"), { pause: HOVER_PAUSE, batch: HOVER_MOVES }),
    wheel: new MessageThrottle(sender("wheel"), {
      merge: (waiting, newest) => ({ ...newest, steps: waiting.steps + newest.steps }),
    }),
    pinch: new MessageThrottle(sender("pinch"), {
      merge: (waiting, newest) => ({
        ...newest,
        factor: waiting.factor * newest.factor,
        dx: waiting.dx + newest.dx,
        dz: waiting.dz + newest.dz,
      }),
    }),
  };
}

/** @typedef {ReturnType<typeof createThrottles>} Throttles */
