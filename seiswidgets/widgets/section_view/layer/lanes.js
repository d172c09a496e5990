// Messages to the kernel, no more of them than it needs.

const DRAG_PAUSE = 50; // ms between two messages
const HOVER_PAUSE = 200;
const HOVER_MOVES = 18; // to a message while the pointer keeps moving, however slow the browser is
const LOST = 5000; // ms without an answer after which a message counts as lost with its connection
const STILL = 100; // ms without a move after which the pointer does not keep moving

// A line of messages of one kind. The next is sent when the kernel has answered the last, and not before a pause; what
// comes meanwhile is merged into one, of so many at least, unless no more come.
function lane(model, kind, pause, merge = (_, newest) => newest, many = 1) {
  let waiting = null;
  let merged = 0;
  let newest = -Infinity;
  let answered = true;
  let timer = null;
  let last = -Infinity;
  const pump = () => {
    timer = null;
    if (!waiting || (!answered && performance.now() - last < LOST)) return;
    const left = Math.max(last + pause, merged < many ? newest + STILL : 0) - performance.now();
    if (left > 1) {
      timer = setTimeout(pump, left);
      return;
    }
    [last, answered] = [performance.now(), false];
    model.send({ kind, ...waiting });
    [waiting, merged] = [null, 0];
  };
  return {
    add(message) {
      waiting = waiting ? merge(waiting, message) : message;
      [merged, newest] = [merged + 1, performance.now()];
      if (timer === null) timer = requestAnimationFrame(() => pump());
    },
    drop() {
      [waiting, merged] = [null, 0];
    },
    answer() {
      answered = true;
      if (timer === null) pump();
    },
  };
}

function lanes(model) {
  return {
    drag: lane(model, "drag", DRAG_PAUSE),
    hover: lane(model, "hover", HOVER_PAUSE, undefined, HOVER_MOVES),
    wheel: lane(model, "wheel", 0, (old, newest) => ({ ...newest, steps: old.steps + newest.steps })),
    pinch: lane(model, "pinch", 0, (old, newest) => ({
      ...newest,
      factor: old.factor * newest.factor,
      dx: old.dx + newest.dx,
      dz: old.dz + newest.dz,
    })),
  };
}

// The model of ipywidgets itself writes what jslink sets to the kernel, at every move of the pointer. Where the pointer
// is concerns other panes, not the kernel: leave it out of what is written. Nothing is sent if nothing else is left.
function keepFromKernel(model, names) {
  const mended = new WeakSet();
  const leaveOut = (own) => {
    if (mended.has(own) || typeof own?.serialize !== "function") return;
    mended.add(own);
    const serialize = own.serialize.bind(own);
    own.serialize = (state) => {
      for (const name of names) delete state[name];
      return serialize(state);
    };
  };
  model.on(names.map((name) => `change:${name}`).join(" "), leaveOut);
}
