// Throttled messages to the kernel.

const DRAG_PAUSE = 50; // ms between two messages
const HOVER_PAUSE = 200;
const HOVER_MOVES = 18; // moves per message while the pointer keeps moving, however slow the browser is
const LOST = 5000; // ms without an answer after which a message counts as lost with its connection
const STILL = 100; // ms without a move after which the pointer has stopped

/** @typedef {Record<string, any>} Message */

/**
 * Sends messages of one kind: the next when the kernel has answered the last, and not before a pause. Messages that
 * arrive meanwhile are merged into one. While more keep arriving, at least `batch` are merged. Over a link that takes
 * longer than the kernel, two may be on their way.
 */
export class MessageThrottle {
  /**
   * @param {(message: Message) => void} send
   * @param {object} [options]
   * @param {number} [options.pause] ms
   * @param {(waiting: any, newest: any) => Message} [options.merge] keeps the newest by default
   * @param {number} [options.batch]
   * @param {boolean} [options.isPrompt] true to send at once rather than in the next frame
   */
  constructor(send, { pause = 0, merge = (_, newest) => newest, batch = 1, isPrompt = false } = {}) {
    this.send = send;
    this.pause = pause;
    this.merge = merge;
    this.batch = batch;
    this.isPrompt = isPrompt;
    /** @type {Message | null} */
    this.waiting = null;
    this.merged = 0; // messages in the one that is waiting
    this.addedAt = -Infinity;
    this.sentAt = -Infinity;
    /** @type {number[]} */
    this.unanswered = []; // times at which they were sent
    this.limit = 1; // of those
    this.isScheduled = false;
  }

  /** @param {Message} message */
  add(message) {
    this.waiting = this.waiting ? this.merge(this.waiting, message) : message;
    this.merged += 1;
    this.addedAt = performance.now();
    if (this.isScheduled) return;
    if (this.isPrompt) {
      this.trySending();
      return;
    }
    this.isScheduled = true;
    requestAnimationFrame(() => this.trySending());
  }

  /** Forget the message that is waiting. */
  drop() {
    this.waiting = null;
    this.merged = 0;
  }

  /**
   * Note that the kernel has answered the oldest message.
   *
   * @param {number} [took] ms that it worked on it
   */
  answer(took = Number.POSITIVE_INFINITY) {
    const sentAt = this.unanswered.shift();
    if (sentAt !== undefined) this.limit = performance.now() - sentAt > 2 * took ? 2 : 1;
    if (!this.isScheduled) this.trySending();
  }

  trySending() {
    const now = performance.now();
    this.isScheduled = false;
    if (now - this.sentAt >= LOST) this.unanswered = [];
    if (!this.waiting || this.unanswered.length >= this.limit) return;
    const due = Math.max(this.sentAt + this.pause, this.merged < this.batch ? this.addedAt + STILL : 0);
    if (due - now > 1) {
      this.isScheduled = true;
      setTimeout(() => this.trySending(), due - now);
      return;
    }
    const message = this.waiting;
    this.sentAt = now;
    this.unanswered.push(now);
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
    drag: new MessageThrottle(sender("drag"), { pause: DRAG_PAUSE, isPrompt: true }),
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

/** @typedef {Record<keyof ReturnType<typeof createThrottles>, Pick<MessageThrottle, "add" | "drop" | "answer">>} Throttles */
