import inspect

import pytest

import seiswidgets as sw


@pytest.mark.parametrize(
    ("function", "misspelt", "meant"),
    [
        (sw.open_section, "velocty", "velocity"),
        (sw.open_section, "header_byte", "header_bytes"),
        (sw.preview, "header_byte", "header_bytes"),
        (sw.read_picks, "formt", "format"),
        (sw.write_picks, "formt", "format"),
        (sw.save_section, "xlike", "like"),
        (sw.save_section, "crosslines", "crossline"),
        (sw.save_mesh, "stages", "stage"),
        (sw.open_session, "allow_outsid", "allow_outside"),
        (sw.plot.section, "exageration", "exaggeration"),
        (sw.plot.workflow, "windw", "window"),
    ],
)
def test_a_misspelt_keyword_suggests_the_right_one(function, misspelt, meant):
    with pytest.raises(TypeError, match=f"^{function.__name__} has no keyword {misspelt}=; did you mean {meant}="):
        function("a", "b", **{misspelt: 1})


def test_a_keyword_like_no_other_lists_those_that_there_are():
    with pytest.raises(TypeError, match="preview has no keyword qqq=; it takes path, header_bytes"):
        sw.preview("line.sgy", qqq=1)


@pytest.mark.parametrize(
    ("function", "keywords"),
    [
        (sw.open_section, {"dx", "extent", "velocity", "traces", "header_bytes", "progress"}),
        (sw.save_section, {"like", "inline", "crossline", "x0"}),
    ],
)
def test_users_see_every_keyword_in_the_signature(function, keywords):
    parameters = inspect.signature(function).parameters
    assert keywords <= {name for name, each in parameters.items() if each.kind is each.KEYWORD_ONLY}
    assert not any(each.kind is each.VAR_KEYWORD for each in parameters.values())
