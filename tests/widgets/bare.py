"""The pointer layer alone in a page, without a notebook: a model that only notes what the layer sends."""

from base64 import b64encode

from seiswidgets.widgets.section_view.pointer_layer import PointerLayer

SIZE = 600, 400  # css pixels of the plot area
CORNER = 100, 50  # of the page, where it begins
START = {"axes": {}, "window": [0, 300, 0, 100], "size": list(SIZE), "strokes": [], "marks": [], "rubber": []}
START |= {"mesh": {}, "mesh_opacity": 1, "chain": [], "carried": {}, "linked": {}, "hotkeys": [], "label": ""}

PAGE = """async ([script, style, traits, size, corner]) => {
  const sheet = document.createElement("style");
  sheet.textContent = style + `.seiswidgets-layer { position: absolute }`;
  document.head.append(sheet);
  const decode = (value) => {
    if (value?.bytes === undefined) {
      if (value === null || typeof value !== "object") return value;
      if (Array.isArray(value)) return value.map(decode);
      return Object.fromEntries(Object.entries(value).map(([name, one]) => [name, decode(one)]));
    }
    const text = atob(value.bytes); // at an odd address, as in a message
    const view = new DataView(new ArrayBuffer(text.length + 1), 1);
    for (let i = 0; i < text.length; i++) view.setUint8(i, text.charCodeAt(i));
    return view;
  };
  const handlers = {};
  window.sent = [];
  window.model = {
    traits: decode(traits),
    get: (name) => model.traits[name],
    set(name, value) {
      model.traits[name] = value;
      for (const act of handlers[`change:${name}`] ?? []) act({});
    },
    send: (message) => window.sent.push(message),
    on: (names, act) => names.split(" ").forEach((name) => (handlers[name] ??= []).push(act)),
    off() {},
    answer: (to) => handlers["msg:custom"].forEach((act) => act({ kind: "answer", to })),
    receive: (message) => handlers["msg:custom"].forEach((act) => act(message)),
  };
  window.take = (traits) => Object.entries(decode(traits)).forEach(([name, value]) => model.set(name, value));
  window.frame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const el = document.createElement("div");
  [el.style.left, el.style.top] = corner.map((pixels) => `${pixels}px`);
  [el.style.width, el.style.height] = size.map((pixels) => `${pixels}px`);
  document.body.append(el);
  const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  const layer = (await import(url)).default;
  layer.initialize({ model });
  layer.render({ model, el });
  while (!sent.length) await frame();
  await frame();
}"""


class BareLayer:
    """The layer in a page of its own.

    Parameters
    ----------
    chromium
        The fixture.
    size : tuple (width, height)
        Of the plot area, in css pixels.
    touch : bool
        Whether the screen takes fingers.
    traits
        Of the layer, besides the plain ones.
    """

    def __init__(self, chromium, *, size=SIZE, touch=False, **traits):
        self.errors = []
        self.context = chromium.new_context(has_touch=touch)
        self.page = self.context.new_page()
        self.page.on("console", lambda message: message.type == "error" and self.errors.append(message.text))
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.evaluate(PAGE, [str(PointerLayer._esm), str(PointerLayer._css), _plain(START | traits), size, CORNER])

    def set(self, **traits):
        """Set traits as the kernel would, and wait until they are drawn."""
        self.page.evaluate("async (traits) => { take(traits); await frame(); }", _plain(traits))

    def get(self, name):
        """Value of a trait."""
        return self.page.evaluate("(name) => model.get(name)", name)

    def attributes(self, selector, *names):
        """Attributes of all elements that a selector finds."""
        get = "(found, names) => found.map((one) => names.map((name) => one.getAttribute(name)))"
        return self.page.eval_on_selector_all(f".seiswidgets-layer {selector}", get, list(names))

    def move(self, x, y):
        """Put the mouse at a css pixel of the plot area."""
        self.page.mouse.move(CORNER[0] + x, CORNER[1] + y)
        self.page.evaluate("frame()")

    def touch(self, kind, *fingers):
        """Tell the browser where fingers are: start, move or end."""
        points = [{"x": CORNER[0] + x, "y": CORNER[1] + y, "id": number} for number, (x, y) in enumerate(fingers)]
        self.session = getattr(self, "session", None) or self.context.new_cdp_session(self.page)
        kind = {"start": "touchStart", "move": "touchMove", "end": "touchEnd", "cancel": "touchCancel"}[kind]
        self.session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        self.page.evaluate("frame()")

    def sent(self, *kinds):
        """The messages of some kinds to the kernel, or of all."""
        messages = self.page.evaluate("sent")
        return [message for message in messages if not kinds or message["kind"] in kinds]

    def close(self):
        self.context.close()


def _plain(value):
    """Convert a value for a page; bytes are marked as such."""
    if isinstance(value, bytes):
        return {"bytes": b64encode(value).decode()}
    if isinstance(value, dict):
        return {name: _plain(one) for name, one in value.items()}
    return [_plain(one) for one in value] if isinstance(value, list | tuple) else value
