"""Arguments of another kind than a public function takes: our errors, in a user's words."""

import numpy as np
import pytest

import seiswidgets as sw
from tests.io.restored import restored
from tests.io.segyfiles import segy_bytes, straight

SECTION = sw.Section(np.ones((2, 3)), 1, 1)
NONE_DRAWN = sw.Interpretation()
FAULT = sw.Fault([(0, 0), (1, 1)], "F1")
SOURCE = sw.SectionSource("synthetic", "tilt")


NO_PATHS = [None, 5, b"line.sgy", "", ["line.sgy"], SECTION]


@pytest.mark.parametrize(
    ("act", "path"),
    [
        *((sw.open_section, path) for path in NO_PATHS),
        (sw.preview, None),
        (sw.open_session, ""),
        (sw.Session.of(SECTION, SOURCE, NONE_DRAWN).save, 5),
        (lambda path: sw.read_picks(path, SECTION), ["line.sgy"]),
        (lambda path: sw.write_picks(NONE_DRAWN, path, SECTION), b"line.sgy"),
        (lambda path: sw.save_section(SECTION, path), SECTION),
        (lambda path: sw.SectionSource("file", path), ""),
        (sw.Autosave, None),
    ],
)
def test_what_is_no_path_is_told(act, path):
    with pytest.raises(sw.DataError, match="a path must be a string or a Path that names a file, but is "):
        act(path)


@pytest.mark.parametrize(
    ("act", "message"),
    [
        (lambda path: sw.read_picks(path / "a.csv", np.ones((2, 3))), "section must be a Section, but is a ndarray"),
        (lambda path: sw.read_picks(path / "a.csv", SECTION, z_up="no"), "z_up= must be True or False, but is 'no'"),
        (lambda path: sw.write_picks([FAULT], path / "a.csv", SECTION), "must be an Interpretation, but is a list"),
        (lambda path: sw.write_picks(NONE_DRAWN, path / "a.csv", None), "section must be a Section"),
        (lambda path: sw.save_mesh(SECTION, path / "a.vtu"), "restored must be a Restoration, but is a Section"),
        (lambda path: sw.save_mesh(restored(), path / "a.vtu", "last"), "there is no stage 'last' to save"),
        (lambda path: sw.save_report(SECTION, path / "a.html"), "restored must be a Restoration"),
        (lambda path: sw.save_section(SECTION, path / "a.sgy", x0="left"), "x0 must be a finite number"),
        (
            lambda path: sw.save_section(SECTION, path / "a.sgy", inline=3),
            "inline= selects a line of the file like=; give that file",
        ),
        (lambda path: sw.displacement(SECTION), "restored must be a Restoration"),
        (lambda path: sw.to_xarray(restored()), "section must be a Section, but is a Restoration"),
        (lambda path: sw.SectionSource("synthetic", None), "must be one of .*planar_fault.*, but is None"),
        (lambda path: sw.SectionSource("file", path, ["dx"]), "choices must be a Mapping, but is a list"),
        (lambda path: sw.Session("line.sgy", None), "source must be a SectionSource, but is a str"),
        (lambda path: sw.Session(SOURCE, None, plan=["unfault"]), "plan must be a Plan, but is a list"),
        (lambda path: sw.Session.of(SOURCE, SECTION, NONE_DRAWN), "section must be a Section"),
        (lambda path: sw.Session.of(SECTION, SOURCE, [FAULT]), "interpretation must be an Interpretation"),
        (
            lambda path: sw.Session.of(
                SECTION, SOURCE, sw.Interpretation([FAULT]), looks={("fault", "F1"): {"color": "red"}}
            ),
            "the looks of 'F1' may be colour and visible, but not color",
        ),
    ],
)
def test_arguments_of_another_kind_are_told(tmp_path, act, message):
    with pytest.raises(sw.SettingError, match=message):
        act(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_the_name_of_a_pick_may_stand_alone_in_a_step():
    assert sw.Step("flatten", "H1").picks == ("H1",)
    with pytest.raises(sw.SettingError, match=r"weights must be a seiswidgets\.Weights, but is "):
        sw.Plan(weights={"slide": 1})


@pytest.mark.parametrize("fixed", [5, (1, 2, 3), ("left", "top")])
def test_a_point_held_must_be_one(fixed):
    with pytest.raises(sw.PickError, match=r"fixed must be a point \(x, z\) of two finite numbers, but is "):
        sw.Session.of(SECTION, SOURCE, NONE_DRAWN, fixed)


def test_the_source_of_a_session_may_lie_in_the_home_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("USERPROFILE", str(tmp_path))
    (tmp_path / "line.sgy").write_bytes(segy_bytes(np.ones((2, 3)), straight(2)))
    assert sw.SectionSource("file", "~/line.sgy", {"z_unit": "m"}).open().shape == (3, 2)
