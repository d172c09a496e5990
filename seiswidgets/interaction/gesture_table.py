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
    "Whole lines and pieces, in the mode Move, or with Alt in the others": (
        (
            "Drag a line",
            "moves the piece, or all that are selected; with Ctrl the whole line. Horizons go on ending at faults",
        ),
        (
            "Drag a cut-off",
            "slides its piece along the fault: the cut-off stays on the fault, and the rest moves with it; if it is "
            "selected, so do the others that are selected and end there",
        ),
        ("Shift+click; drag a rectangle", "select several; Delete deletes them. Shift+click works in Look, too"),
        ("Arrows", "move the selection by one trace or sample, with Shift by ten"),
        ("Ctrl+Up, Ctrl+Down", "slide the selected piece along its fault by the height of a sample, with Shift of ten"),
        (
            "C, Shift+C",
            "copy the selected horizon down, up; the copy has a name of its own, and can be dragged at once",
        ),
        ("J", "joins the selected pieces, or one piece of a horizon to the nearest other one"),
        ("X", "splits a line at the selected vertex; a fault becomes two"),
        ("E", "extends the selected line, or its selected end, straight to the first fault or the border"),
        ("R", "reverses the line, which can then be drawn on from its other end"),
    ),
    "Looking and holding": (
        ("L, F, H, S, M, B", "modes Look, Fault, Horizon, Body (salt), Move, Hold"),
        ("Click, in Look", "selects a line, whose vertices can then be dragged"),
        ("Click, in Hold", "holds the block at the pointer; on the pin, releases it"),
        ("Shift+click, in Hold", "pins the point at the pointer; a click on a pin releases it"),
        ("N, Shift+N", "show the next hypothesis, the one before; anywhere in the app"),
        ("Click on a flag", "shows its finding and selects its pick"),
        (
            "Right click, long press, menu key",
            "shows what can be done there; a regional level, and whether an end of a fault dies out, are chosen so",
        ),
    ),
    "On the curve of the tab Match": (
        ("Drag; Left, Right, with Shift by ten", "prescribe the slip of the fault; Shift+drag passes peaks by"),
        ("Click on a peak; Page Up, Page Down; Enter", "take a peak's profile; the next one; the likeliest"),
    ),
    "Moving the picture": (
        ("Wheel, two fingers, + and -", "zoom at the pointer"),
        ("Drag, in Look; middle button; Space and drag", "pan, the last two in every mode"),
        ("0; double click, in Look", "fit the whole section"),
        ("V, held", "hides all picks and the deformation map, to see the section alone"),
        ("Tab, Shift+Tab", "to the next control, or the one before"),
    ),
    "Room for the panes": (
        ("Drag the handle below them", "gives them more or less height; on the handle, the arrows do, Home and End"),
        ("Double click on it, Enter", "goes back to the usual height"),
        ("Button at the upper right", "fills the window; there, Escape goes back to the page once nothing is selected"),
    ),
    "By keyboard alone": (
        ("Enter", "shows a cursor; at the cursor, puts a vertex; on the last vertex, finishes the line"),
        ("Space", "puts a vertex at the cursor"),
        (
            "Arrows",
            "move the cursor, Shift ten times as far, Ctrl by one trace or sample; they move a selected vertex by one "
            "trace or sample, with Shift by ten",
        ),
        ("Page Up, Page Down", "select the vertex before, after; in Move, the piece"),
        ("Insert, I", "insert a vertex after the selected one"),
        (
            "Delete, Backspace",
            "remove the selected vertex; else the last one of the line being drawn; else the selected piece; in Look, "
            "the selected pick; in Move, the selected pieces; in Hold, the pin",
        ),
    ),
    "Histogram": (
        ("Drag, click, Shift+click", "brush a range of area ratios, one bar, extend the range"),
        ("Arrows, Home, End; with Shift", "brush one bar; extend the range"),
        ("Double click, Escape", "clear the brush"),
    ),
}
