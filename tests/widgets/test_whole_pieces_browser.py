"""Whole pieces under a real mouse: dragged, slid along their fault, in either pane, and by the context menu."""

import numpy as np

from tests.widgets.appscreen import FEW, PICKS, RESTORED

PIECE = "np.array(editor.drawing.pick('horizon', 'H1').pieces[{}])"
HANDLE = "next(mark.inside for mark in editor.cutoffs() if mark.horizon == 'H1' and mark.wall == 'hanging wall')"
FROM_FAULT = (
    "float(__import__('shapely').LineString(drawn.faults[0].points[[0, 10, 20, 30]])"
    ".distance(__import__('shapely').Point({})))"
)


def test_a_piece_is_dragged_and_slides_along_its_fault(open_app):
    screen = open_app(FEW)
    before = screen.ask(PICKS)
    screen.button("Move").click()
    piece = screen.points(PIECE.format(0))
    screen.drag(piece[2], piece[2] + [0, 60])
    screen.nears(f"{PIECE.format(0)}[2]", piece[2] + [0, 60], 8)
    screen.shoot("pieces-moved")
    screen.press("Control+z")
    screen.becomes(PICKS, before)
    handle = screen.points(HANDLE)
    old = screen.points("editor.drawing.pick('fault', 'F1').pieces[0]")
    share = old[1] if abs(old[1][1] - handle[1]) > abs(old[2][1] - handle[1]) else old[2]
    screen.drag(handle, handle + 0.4 * (share - handle))
    screen.becomes("editor.history.next_undo.label", "slide H1 along F1")
    screen.until(f"{FROM_FAULT.format(f'tuple({HANDLE})')} < 5")
    moved = [np.array(new) - np.array(was) for new, was in zip(*_pieces(screen, before), strict=True)]
    (slid,) = [shift for shift in moved if np.abs(shift).max() > 1]
    assert np.ptp(slid[1:-1], axis=0).max() < 1e-6  # between the fault and the border it keeps its shape
    screen.shoot("pieces-slid")
    at = screen.pixels([screen.points(HANDLE) + [40, 0]])
    screen.page.mouse.click(*at[0], button="right")
    screen.page.get_by_role("menuitem", name="Move this piece").wait_for()
    screen.shoot("pieces-menu")
    screen.press("Escape")


def test_a_piece_is_dragged_in_the_restored_pane(open_app):
    screen = open_app(RESTORED)
    screen.until("app.wait(30)")
    screen.button("Live").click()
    screen.button("Move").click()
    piece = screen.points(PIECE.format(0))
    middle = screen.points(f"app.restoration.to_restored([{piece[len(piece) // 2].tolist()}])[0]")
    screen.drag(middle, middle + [0, 50], number=1)
    screen.until("editor.history.next_undo and editor.history.next_undo.label == 'move a piece of H1'")
    after = screen.points(PIECE.format(0))
    rise = np.median(np.interp(after[:, 0], *piece[np.argsort(piece[:, 0])].T) - after[:, 1])
    assert -80 < rise < -25


def _pieces(screen, before):
    after = dict(screen.ask(PICKS))["H1"]
    return after, dict(before)["H1"]
