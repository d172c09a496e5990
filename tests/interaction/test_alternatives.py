from dataclasses import replace

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.interaction.alternatives import (
    alternatives,
    changed_alike,
    duplicated,
    free_name,
    moved,
    removed,
    renamed,
    switched,
)
from seiswidgets.interaction.document import Document, EditHistory
from seiswidgets.interaction.drawing import Drawing


@pytest.fixture
def document():
    """Three hypotheses A, B and C, each with its own fault; B is shown."""
    section = sw.Section(np.ones((4, 5)), 10, 5)
    document = Document(section, drawing("F1"))
    document = replace(duplicated(document), drawing=drawing("F2"))
    document = replace(duplicated(document), drawing=drawing("F3"))
    return switched(document, 1)


def drawing(name):
    return Drawing().with_pick("fault", name, [[(0, 0), (20, 10)]])


def names(document):
    return "".join(one.name for one in alternatives(document))


def test_each_keeps_its_picks_and_its_plan(document):
    assert names(document) == "ABC"
    assert [switched(document, index).drawing.names("fault") for index in range(3)] == [("F1",), ("F2",), ("F3",)]
    plan = sw.Plan(spacing=7.0)
    other = replace(switched(document, 2), plan=plan)
    assert [one.plan.spacing for one in alternatives(switched(other, 0))] == [None, None, 7.0]


def test_they_are_reordered_and_removed(document):
    assert (names(moved(document, -1)), names(moved(document, 1)), names(moved(document, 5))) == ("BAC", "ACB", "ACB")
    assert moved(document, -1).name == document.name == "B"
    assert (names(removed(document)), removed(document).name) == ("AC", "C")
    alone = removed(removed(removed(document)))
    assert len(alternatives(alone)) == 1


def test_names_are_their_own(document):
    assert names(renamed(document, " X ")) == "AXC"
    with pytest.raises(sw.SettingError, match="a hypothesis called 'C' already"):
        renamed(document, "C")
    with pytest.raises(sw.SettingError, match="must not be empty"):
        renamed(document, " ")
    assert free_name([*"ABCDEFGHIJKLMNOPQRSTUVWXYZ"]) == "A2"


def test_undo_goes_back_through_a_switch(document):
    history = EditHistory(document)
    history.edit("draw", drawing=drawing("F9"))
    history.edit("show C", **vars(switched(history.document, 2)))
    history.edit("delete", drawing=Drawing())
    shown = []
    while history.undo():
        shown.append((history.document.name, *history.document.drawing.names("fault")))
    assert shown == [("C", "F3"), ("B", "F9"), ("B", "F2")]


def test_all_are_changed_alike(document):
    shifted = changed_alike(document, lambda one, plan: (one.mapped(lambda line: line + 5), plan))
    assert [one.drawing.picks[0].pieces[0][0] for one in alternatives(shifted)] == [(5.0, 5.0)] * 3
    assert shifted.name == "B"
