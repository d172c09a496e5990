"""All gestures and keys of the panes, in the user's words; the app shows them as its help."""

GESTURES: dict[str, tuple[tuple[str, str], ...]] = {
    "Drawing, in the modes Fault, Horizon and Body": (
        (
            "Click",
            "adds a vertex to the line being drawn, or begins one; while a horizon is selected, another piece of it",
        ),
        ("Click on a line", "inserts a vertex, unless a line is being drawn"),
        (
            "Drag",
            "moves a vertex; a numbered cut-off slides along its fault. Horizons snap to the event that is chosen, "
            "and ends of faults to the border and to other faults within ten pixels",
        ),
        ("Shift", "while clicking: begins a line whatever lies there; while dragging: no snapping, and off the fault"),
        ("Ctrl+click", "removes a vertex"),
        ("Double click, Enter", "finishes the line; the ends of a fault snap, and a body is closed"),
        ("Escape", "cancels a drag; else the line; else the selection; else goes back to Look"),
        ("Ctrl+Z; Ctrl+Y, Ctrl+Shift+Z", "undo, a finished line by its last edits; redo. Anywhere in the app"),
    ),
    "Looking and holding": (
        ("L, F, H, S, B", "modes Look, Fault, Horizon, Body (salt), Hold"),
        ("Click, in Look", "selects a line, whose vertices can then be dragged"),
        ("Click, in Hold", "holds the block at the pointer; on the pin, releases it"),
        ("Shift+click, in Hold", "pins the point at the pointer; a click on a pin releases it"),
        ("Click on a flag", "shows its finding and selects its pick"),
        ("Right click, long press, menu key", "shows what can be done there"),
    ),
    "Moving the picture": (
        ("Wheel, two fingers, + and -", "zoom at the pointer"),
        ("Drag, in Look; middle button; Space and drag", "pan, the last two in every mode"),
        ("0; double click, in Look", "fit the whole section"),
        ("Tab, Shift+Tab", "to the next control, or the one before"),
    ),
    "By keyboard alone": (
        ("Enter", "shows a cursor; at the cursor, puts a vertex; on the last vertex, finishes the line"),
        ("Space", "puts a vertex at the cursor"),
        (
            "Arrows",
            "move the cursor, Shift ten times as far, Ctrl by one trace or sample; they move a selected vertex by one "
            "trace or sample, with Shift by ten",
        ),
        ("Page Up, Page Down", "select the vertex before, after"),
        ("Insert, I", "insert a vertex after the selected one"),
        (
            "Delete, Backspace",
            "remove the selected vertex; else the last one of the line being drawn; else the selected piece; in Look, "
            "the selected pick; in Hold, the pin",
        ),
    ),
    "Histogram": (
        ("Drag, click, Shift+click", "brush a range of area ratios, one bar, extend the range"),
        ("Arrows, Home, End; with Shift", "brush one bar; extend the range"),
        ("Double click, Escape", "clear the brush"),
    ),
}
