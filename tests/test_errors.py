import pickle

import pytest

import seiswidgets as sw
from seiswidgets.errors import Keyword, Text

LABELS = {"dx": "“traces apart”", "z_unit": "“unit of z”", "allow_outside": "--allow-outside"}


def test_a_message_names_keywords_in_the_terms_of_its_reader():
    error = sw.DataError("line.sgy has no positions; give ", Keyword("dx"), " or ", Keyword("z_unit", "m"), ".")
    assert str(error) == "line.sgy has no positions; give dx= or z_unit='m'."
    assert error.text.rendered(LABELS) == "line.sgy has no positions; give “traces apart” or “unit of z” m."


def test_a_keyword_that_is_only_switched_on_becomes_an_option():
    assert Text("allow it by ", Keyword("allow_outside", True)).rendered(LABELS) == "allow it by --allow-outside"


def test_text_from_elsewhere_is_never_taken_for_a_keyword():
    assert (
        Text("a file named dx=.sgy; give ", Keyword("inline")).rendered(LABELS) == "a file named dx=.sgy; give inline="
    )


def test_a_message_within_a_message_keeps_its_keywords():
    inner = sw.SettingError("give ", Keyword("dx"))
    assert sw.DataError("line.sgy: ", inner.text).text.rendered(LABELS) == "line.sgy: give “traces apart”"


@pytest.mark.parametrize(
    "error", [sw.PickError("F1 crosses itself", pick="F1", where=(3.0, 4.0)), sw.SectionError("no")]
)
def test_errors_keep_their_fields_in_another_process(error):
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), again.pick, again.where) == (type(error), str(error), error.pick, error.where)
    assert again.text.parts == error.text.parts
