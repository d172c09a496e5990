import pytest

import seiswidgets as sw

SECTION = sw.synthetic.planar_fault().section


@pytest.mark.parametrize(
    ("widget", "keywords", "meant"),
    [
        (sw.SectionPane, {"section": SECTION, "colors": "greys"}, "colours"),
        (sw.SectionPane, {"section": SECTION, "exagerration": 2}, "exaggeration"),
        (sw.Picker, {"section": SECTION, "snapp": "peak"}, "snap"),
        (sw.Picker, {"section": SECTION, "workspce": None}, "workspace"),
        (sw.LinkedPanes, {"restoration": SECTION, "heigth": 300}, "height"),
        (sw.LinkedPanes, {"restoration": SECTION, "zoom_link": True}, "zoom_linked"),
        (sw.DeformationHistogram, {"bin": 41}, "bins"),
        (sw.DeformationHistogram, {"bruhs": []}, "brush"),
        (sw.Timeline, {"lables": ["unfault"]}, "labels"),
        (sw.Timeline, {"tme": 1.0}, "time"),
    ],
)
def test_a_misspelt_keyword_is_an_error_that_suggests_the_right_one(widget, keywords, meant):
    (misspelt,) = keywords.keys() - {"section", "restoration"}
    with pytest.raises(TypeError, match=f"^{widget.__name__} has no keyword {misspelt}=; did you mean {meant}="):
        widget(**keywords)


@pytest.mark.parametrize("name", ["children", "keys", "comm", "settings"])
def test_what_a_widget_sets_by_itself_is_no_keyword(name):
    with pytest.raises(TypeError, match=f"Timeline has no keyword {name}=; .*labels"):
        sw.Timeline(**{name: []})


def test_layout_and_time_are_keywords_of_a_timeline():
    timeline = sw.Timeline(["unfault", "flatten"], time=0.5, layout={"width": "300px"})
    assert (timeline.time, timeline.layout.width, timeline.moment) == (0.5, "300px", "unfault 50%")
