import base64
from io import BytesIO

import numpy as np
from PIL import Image

import seiswidgets as sw
from seiswidgets.interaction.overlay import Stroke
from seiswidgets.widgets import linked_panes
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.section_view.still import LEFT, SIZE, TOP


def test_both_panes_are_seen_with_their_lines():
    amplitude = np.ones((40, 60))
    amplitude[:, 30:] = -1
    panes = LinkedPanes(sw.Section(amplitude, dx=10, dz=10))
    panes.original.clip = 100.0
    panes.original.draw_lines([Stroke([(0, 200), (600, 200)], "#ff0000"), Stroke([(0, 0), (np.nan, 0)], "#00ff00")])
    picture = np.asarray(Image.open(BytesIO(base64.b64decode(panes.still()))))
    rows, columns = TOP + SIZE[1] // 4, [LEFT + SIZE[0] // 4, LEFT + 3 * SIZE[0] // 4]
    for offset in (0, picture.shape[1] // 2):
        np.testing.assert_array_equal(picture[rows, np.add(columns, offset)], [[255] * 3, [0] * 3])
    red = (picture == (255, 0, 0)).all(axis=2)
    assert set(np.flatnonzero(red.any(axis=1))) <= set(range(TOP + SIZE[1] // 2 - 5, TOP + SIZE[1] // 2 + 12))
    assert red[:, : picture.shape[1] // 2].any(axis=0).sum() > 0.9 * SIZE[0]
    assert not red[:, picture.shape[1] // 2 :].any()


def test_its_right_side_says_whether_it_is_restored(monkeypatch):
    case, titles = sw.synthetic.planar_fault(), []
    panes = LinkedPanes(case.section)
    monkeypatch.setattr(linked_panes, "still", lambda sides: titles.append([title for title, _ in sides]))
    panes.still()
    panes.restoration = sw.Restoration(case.section, spacing=400).flatten(sw.Horizon([(100, 500), (3900, 500)]))
    panes.still()
    assert titles == [["Today", "Not restored yet"], ["Today", "Restored"]]
