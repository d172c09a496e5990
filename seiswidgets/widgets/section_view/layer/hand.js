// What a mouse, a pen or fingers do: hover, press, drag and release, the wheel, a double click or tap, and a pinch.

const STEP = 100; // css pixels of scrolling in one step of a wheel
const LINE = 16; // css pixels in a line, for wheels that count lines
const MIDDLE = 1; // a button
const TAP = { time: 300, reach: 12 }; // ms and css pixels within which a finger that comes and goes has tapped
const TWICE = { time: 400, reach: 30 }; // between the two taps of a double one
const ECHO = 800; // ms after a double tap in which a browser's own double click is the same one

const apart = (one, other) => Math.hypot(one.x - other.x, one.y - other.y);

// tell(kind, event, more) sends at once, lanes[kind].add(...) soon; moveTo(at) says where the pointer is.
class Hand {
  constructor(plot, plane, keys, lanes, { tell, moveTo, restSoon }) {
    Object.assign(this, { plot, plane, keys, lanes, tell, moveTo, restSoon });
    this.held = null; // what is down: {id, at, from, since, button, pan}
    this.fingers = new Map(); // where those that are down are, by their ids
    this.pinch = null; // middle and spread of two fingers
    this.tapped = null; // the last tap: {at, time, isDouble}
  }

  listenTo(listen) {
    listen("pointerdown", (event) => this.press(event));
    listen("pointermove", (event) => this.move(event));
    listen("pointerup", (event) => this.lift(event));
    listen("pointercancel", (event) => this.lift(event));
    listen("pointerleave", (event) => this.leave(event));
    listen("dblclick", (event) => this.doubleClick(event));
    listen("wheel", (event) => this.scroll(event));
    listen("contextmenu", (event) => event.preventDefault());
  }

  press(event) {
    event.preventDefault();
    const at = this.plane.under(event);
    this.plot.classList.add("by-pointer"); // without the ring that shows the keyboard's focus
    this.plot.focus({ preventScroll: true });
    this.plot.setPointerCapture(event.pointerId);
    if (event.pointerType === "touch") this.fingers.set(event.pointerId, at);
    if (this.fingers.size > 1) this.beginPinch(event);
    else if (!this.held) this.take(event, at);
  }

  take(event, at) {
    const pan = this.keys.takeSpace() || event.button === MIDDLE;
    this.held = { id: event.pointerId, at, from: at, since: event.timeStamp, button: event.button, pan };
    this.plot.classList.toggle("pans", pan);
    this.moveTo(at);
    this.lanes.hover.drop();
    this.tell("press", event, this.about());
  }

  about() {
    const { button, pan } = this.held;
    return pan ? { button, pan } : { button };
  }

  move(event) {
    const at = this.plane.under(event);
    const { pan } = this.held ?? {};
    if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, at);
    if (this.pinch) this.spread();
    else if (event.pointerId === this.held?.id) this.go("drag", event, at, pan ? { pan } : {});
    else if (!this.held && event.pointerType !== "touch") this.go("hover", event, at, {});
  }

  go(kind, event, at, more) {
    if (this.held) this.held.at = at;
    this.moveTo(at);
    this.lanes[kind].add({ ...this.plane.forKernel(at), modifiers: modifiers(event), ...more });
  }

  lift(event) {
    this.fingers.delete(event.pointerId);
    if (this.pinch) this.pinch = this.fingers.size > 1 ? this.middle() : null;
    if (event.pointerId !== this.held?.id) return;
    const isTouch = event.pointerType === "touch";
    const isTap = isTouch && event.type === "pointerup" && !this.held.pan && this.isTap(event);
    this.letGo(event, event.type === "pointercancel");
    if (isTouch) this.moveTo(null);
    if (isTap) this.tap(event);
  }

  letGo(event, cancelled, at = this.plane.under(event)) {
    this.lanes.drag.drop();
    this.tell("release", event, { ...this.about(), cancelled, ...this.plane.forKernel(at) });
    this.held = null;
    this.plot.classList.remove("pans");
    this.restSoon();
  }

  leave(event) {
    if (this.held || this.pinch) return;
    this.moveTo(null);
    this.lanes.hover.drop();
    this.tell("leave", event);
  }

  isTap(event) {
    const { since, from } = this.held;
    return event.timeStamp - since < TAP.time && apart(this.plane.under(event), from) < TAP.reach;
  }

  // Not every browser makes a double click of two taps.
  tap(event) {
    const [at, time, last] = [this.plane.under(event), event.timeStamp, this.tapped];
    const isDouble = Boolean(last) && !last.isDouble && time - last.time < TWICE.time && apart(at, last.at) < TWICE.reach;
    this.tapped = { at, time, isDouble };
    if (isDouble) this.tell("double", event, { touch: true });
  }

  doubleClick(event) {
    if (this.tapped?.isDouble && event.timeStamp - this.tapped.time < ECHO) return;
    this.tell("double", event);
  }

  scroll(event) {
    event.preventDefault();
    const unit = [1, LINE, this.plane.height][event.deltaMode];
    const steps = (-event.deltaY * unit) / STEP; // towards the section
    this.lanes.wheel.add({ ...this.plane.forKernel(this.plane.under(event)), steps, modifiers: modifiers(event) });
    this.restSoon();
  }

  // The second finger takes away what the first one did.
  beginPinch(event) {
    if (this.held) this.letGo(event, true, this.held.at);
    this.moveTo(null);
    this.tapped = null;
    this.pinch = this.middle();
  }

  middle() {
    const [one, other] = this.fingers.values();
    return { x: (one.x + other.x) / 2, y: (one.y + other.y) / 2, spread: Math.max(1, apart(one, other)) };
  }

  spread() {
    const [old, now, share] = [this.pinch, this.middle(), this.plane.share];
    const [dx, dz] = [(now.x - old.x) * share.x, (now.y - old.y) * share.y];
    this.lanes.pinch.add({ ...this.plane.forKernel(now), factor: now.spread / old.spread, dx, dz, touch: true });
    this.pinch = now;
    this.restSoon();
  }
}
