import json
import os
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.errors import DataError, PickError, SettingError
from seiswidgets.io.session.saved_picks import SavedHypothesis, SavedPick
from seiswidgets.io.session.sources import section_sha256
from tests.io.segyfiles import numbered, segy_bytes, volume_headers
from tests.sections import real_section

SYNTHETIC = sw.SectionSource("synthetic", "faulted_fold", {"throw": 120.0, "horizons": [700.0, 1000.0], "seed": 3})
PLAN = sw.Plan(
    (
        sw.Step("unfault", ("F1",), slip={"F2": sw.SlipProfile([0, 90.5], [20, -1 / 3])}),
        sw.Step("flatten", ("H2",), datum=950.0, beyond="trend"),
        sw.Step("flatten", on=False),
    ),
    sw.Weights(stitch=7.5, edge=1 / 3),
    spacing=70.0,
    max_iterations=40,
    weighting="rows",
)
BODY = sw.Body([(3300.0, 1500.0), (3700.0, 1500.0), (3500.0, 1800.0)], kind="no data", name="B1")
LOOKS = {
    ("body", "B1"): {"colour": "#123456"},
    ("fault", "F1"): {"colour": "#e69f00"},
    ("horizon", "H2"): {"colour": "teal", "visible": False},
}
CROSSED = ((0.0, 0.0), (20.0, 20.0), (20.0, 0.0), (0.0, 20.0))


@pytest.fixture(scope="module")
def case():
    """A section and its picks, a body among them."""
    case = sw.synthetic.faulted_fold(throw=120.0, horizons=[700.0, 1000.0], seed=3)
    return replace(case, interpretation=replace(case.interpretation, bodies=[BODY]))


@pytest.fixture(scope="module")
def session(case):
    return sw.Session.of(case.section, SYNTHETIC, case.interpretation, case.fixed, PLAN, LOOKS)


@pytest.fixture
def saved(session, tmp_path):
    """A session's file, and what it holds."""
    session.save(tmp_path / "session.json")
    return tmp_path / "session.json", json.loads((tmp_path / "session.json").read_text())


def changed(saved, change):
    """The session's file after a change of what it holds."""
    path, document = saved
    change(document)
    path.write_text(json.dumps(document))
    return path


def with_file(tmp_path, section):
    """A session whose section is a file in its folder."""
    (tmp_path / "data").mkdir()
    sw.save_section(section, tmp_path / "data" / "line.npz")
    return sw.SectionSource("file", str(tmp_path / "data" / "line.npz"))


def assert_same(one, other):
    assert len(one.stages) == len(other.stages)
    for stage, again in zip(one.stages, other.stages, strict=True):
        np.testing.assert_allclose(again.vertices, stage.vertices, rtol=0, atol=1e-9)
    np.testing.assert_allclose(other.section.amplitude, one.section.amplitude, rtol=0, atol=1e-9)


def test_a_session_comes_back_as_it_was(case, session, saved):
    again = sw.open_session(saved[0])
    assert again == session
    assert again.plan == replace(PLAN, fixed=case.fixed)
    assert again.faults[0].colour == "#e69f00"
    assert [(pick.colour, pick.visible) for pick in again.horizons] == [(None, True), ("teal", False)]
    assert again.written_by == f"seiswidgets {sw.__version__}"


def test_a_line_of_a_volume_is_opened_again_with_its_choices(tmp_path):
    headers = volume_headers([10, 11], [1, 2, 3, 4])
    path = tmp_path / "volume.sgy"
    path.write_bytes(segy_bytes(numbered(headers), headers))
    section = sw.open_section(path, traces=slice(5, 8), z_unit="m")
    source = sw.SectionSource("file", str(path), {"traces": slice(5, 8), "z_unit": "m"})
    sw.Session.of(section, source, sw.Interpretation()).save(tmp_path / "session.json")
    again = sw.open_session(tmp_path / "session.json").open_section()
    np.testing.assert_array_equal(again.amplitude, section.amplitude)


@pytest.mark.parametrize(
    "velocity",
    [
        sw.ConstantVelocity(2200),
        sw.LinearVelocity(1800, 0.6, source="regional trend"),
        sw.TimeDepthTable([0, 900], [0, 1000], source="well 1"),
        sw.LayerCake([sw.Horizon([(0, 300), (4000, 350)], name="top")], [1800, 2600]),
    ],
    ids=str,
)
def test_the_velocities_of_a_converted_section_are_saved(tmp_path, velocity):
    recorded = sw.synthetic.tilt().section.to_time(sw.ConstantVelocity(2000))
    sw.save_section(recorded, tmp_path / "line.npz")
    source = sw.SectionSource("file", str(tmp_path / "line.npz"), velocity=velocity, dz=6.0)
    section = source.open()
    sw.Session.of(section, source, sw.Interpretation()).save(tmp_path / "session.json")
    again = sw.open_session(tmp_path / "session.json").open_section()
    np.testing.assert_array_equal(again.amplitude, section.amplitude)
    assert again.velocity_text == section.velocity_text


def test_damaged_velocities_are_refused_with_their_location(tmp_path, saved):
    path, text = saved
    text["section"]["source"]["velocity"] = {"model": "linear", "v0": 1800}
    path.write_text(json.dumps(text))
    with pytest.raises(sw.DataError, match=r"section\.source\.velocity lacks 'k'"):
        sw.open_session(path)


def test_it_gives_the_same_restoration(case, saved):
    restored = PLAN.restore(case.section, case.interpretation, case.fixed)
    assert_same(restored, sw.open_session(saved[0]).restore())


@pytest.mark.parametrize("name", ["f3", "teapot"])
def test_real_sections_give_the_same_restoration(tmp_path, name):
    section, picks = real_section(name)
    session = sw.Session.of(section, sw.SectionSource("dataset", name), picks, plan=sw.Plan(spacing=80.0))
    session.save(tmp_path / "session.json")
    assert_same(session.plan.restore(section, picks), sw.open_session(tmp_path / "session.json").restore())


def test_progress_is_told_and_can_cancel(session):
    with pytest.raises(sw.Cancelled, match="cancel"):
        session.restore(lambda step, iteration, energy: False)


def test_the_file_can_be_read_by_a_person(saved):
    text = saved[0].read_text()
    assert '"format": "seiswidgets session"' in text
    assert '"version": 2' in text
    x, z = saved[1]["picks"]["faults"][0]["points"][0]
    assert f"[{x!r}, {z!r}]" in text


def test_lines_that_cannot_be_used_are_kept_and_told_of(session, tmp_path):
    drawn = replace(
        session,
        faults=(*session.faults, SavedPick("F2", (CROSSED,))),
        horizons=(replace(session.horizons[0], pieces=(*session.horizons[0].pieces, CROSSED)), session.horizons[1]),
    )
    drawn.save(tmp_path / "session.json")
    again = sw.open_session(tmp_path / "session.json")
    assert again == drawn
    assert [fault.constrains for fault in again.interpretation.faults] == [True, False]
    assert [bool(flaw) for flaw in again.interpretation.horizons[0].flaws] == [False, False, True]
    assert [problem[:40] for problem in again.problems] == [
        "fault 'F2' crosses itself near x=10, z=1",
        "piece 3 of horizon 'H1' crosses itself n",
    ]


def test_the_ends_of_faults_are_kept(session, tmp_path):
    drawn = replace(session, faults=(replace(session.faults[0], ends=("tip", "extend")), *session.faults[1:]))
    drawn.save(tmp_path / "session.json")
    assert sw.open_session(tmp_path / "session.json") == drawn
    assert drawn.interpretation.faults[0].ends == ("tip", "extend")
    text = (tmp_path / "session.json").read_text()
    for worse, message in (('"bend"', "ends must be 'auto', 'tip' or 'extend'"), ('"tip", "tip"', "two texts")):
        (tmp_path / "worse.json").write_text(text.replace('"tip"', worse))
        with pytest.raises(DataError, match=rf"picks.faults\[0\].*{message}"):
            sw.open_session(tmp_path / "worse.json")


def test_the_use_of_picks_is_kept_and_older_files_have_none(session, tmp_path):
    drawn = replace(session, horizons=(replace(session.horizons[0], use="carry"), *session.horizons[1:]))
    drawn.save(tmp_path / "session.json")
    assert sw.open_session(tmp_path / "session.json") == drawn
    assert drawn.interpretation.horizons[0].use == "carry"
    text = (tmp_path / "session.json").read_text()
    (tmp_path / "older.json").write_text(re.sub(r',\s*"use": "\w+"', "", text))
    assert sw.open_session(tmp_path / "older.json").interpretation.horizons[0].use == "constrain"
    (tmp_path / "worse.json").write_text(text.replace('"carry"', '"cut"'))
    with pytest.raises(
        DataError, match=r"picks.horizons\[0\].*the use of 'H1' must be one of constrain, carry, ignore"
    ):
        sw.open_session(tmp_path / "worse.json")


def test_what_could_not_be_opened_again_is_not_made(session, tmp_path):
    with pytest.raises(PickError, match="two picks are called 'H1'"):
        replace(session, horizons=session.horizons[:1] * 2)
    with pytest.raises(PickError, match="contains an unpaired surrogate"):
        SavedPick("\ud800", (CROSSED,))
    with pytest.raises(SettingError, match="the colour of 'F' must be #rrggbb or the name of a colour, but is 'url"):
        SavedPick("F", (CROSSED,), colour="url(x)")
    with pytest.raises(DataError, match=r"session.json cannot hold this session: .*; correct its numbers"):
        replace(session, plan=sw.Plan(spacing=float("nan"))).save(tmp_path / "session.json")
    assert not list(tmp_path.iterdir())


def test_numbers_of_numpy_are_kept(session, tmp_path):
    plan = sw.Plan(weights=sw.Weights(edge=np.float32(0.1)), spacing=np.float64(60))
    replace(session, plan=plan).save(tmp_path / "session.json")
    assert sw.open_session(tmp_path / "session.json").plan == plan


def test_a_fault_is_one_line(session):
    with pytest.raises(PickError, match="fault 'F' must be one line, but has 2"):
        replace(session, faults=(SavedPick("F", (CROSSED, CROSSED)),))


# --- the section


def test_a_section_from_a_file_is_found_where_the_folder_goes(case, tmp_path):
    source = with_file(tmp_path, case.section)
    session = sw.Session.of(case.section, source, case.interpretation, case.fixed, PLAN)
    session.save(tmp_path / "session.json")
    assert json.loads((tmp_path / "session.json").read_text())["section"]["source"]["path"] == "data/line.npz"
    moved = tmp_path.rename(tmp_path.with_name("elsewhere"))
    again = sw.open_session(moved / "session.json")
    assert section_sha256(again.open_section()) == session.sha256
    assert again.source.name == str(moved / "data" / "line.npz")


def test_a_link_to_a_session_is_the_session(case, tmp_path):
    folder = tmp_path / "real"
    folder.mkdir()
    (tmp_path / "link.json").symlink_to(folder / "session.json")
    sw.save_section(case.section, folder / "line.npz")
    session = sw.Session.of(case.section, sw.SectionSource("file", str(folder / "line.npz")), case.interpretation)
    session.save(tmp_path / "link.json")
    assert json.loads((folder / "session.json").read_text())["section"]["source"]["path"] == "line.npz"
    assert sw.open_session(tmp_path / "link.json") == sw.open_session(folder / "session.json") == session


def test_a_section_that_differs_is_told_of(case, tmp_path):
    source = with_file(tmp_path, case.section)
    session = sw.Session.of(case.section, source, case.interpretation, case.fixed, PLAN)
    amplitude = case.section.amplitude.copy()
    amplitude[3, 4] += 1e-3
    other = replace(case.section, amplitude=amplitude)
    sw.save_section(other, tmp_path / "data" / "line.npz")
    with pytest.raises(DataError, match=r"line.npz' is not the one that the session was made on.*allow_changed=True"):
        session.restore()
    assert session.restore(allow_changed=True).stages


@pytest.mark.parametrize(
    "change", [{"dx": 13.0}, {"z0": 1.0}, {"x_unit": "ft"}, {"z_unit": "ms", "velocity": 2000.0}, {"amplitude": None}]
)
def test_the_hash_holds_shape_geometry_and_amplitudes(case, change):
    if "amplitude" in change:
        change = {"amplitude": case.section.amplitude[:-1]}
    assert section_sha256(replace(case.section, **change)) != section_sha256(case.section)


def test_the_hash_leaves_out_names_and_kinds_of_nan(case):
    assert section_sha256(replace(case.section, name="other", credit="us")) == section_sha256(case.section)
    one, other = (case.section.amplitude.copy() for _ in range(2))
    one[0, 0] = np.nan
    other.view(np.uint32)[0, 0] = 0x7FC00001
    assert np.isnan(other[0, 0])
    hashes = [section_sha256(replace(case.section, amplitude=amplitude)) for amplitude in (one, other)]
    assert hashes[0] == hashes[1]


def test_paths_cannot_leave_the_folder_unless_allowed(case, saved, tmp_path):
    outside = tmp_path.with_name(f"{tmp_path.name}-outside")
    outside.mkdir()
    sw.save_section(case.section, outside / "line.npz")
    (tmp_path / "link.npz").symlink_to(outside / "line.npz")
    (tmp_path / "folder").symlink_to(outside)
    for name in (f"../{outside.name}/line.npz", str(outside / "line.npz"), "link.npz", "folder/line.npz"):
        source = {"kind": "file", "path": name}
        path = changed(saved, lambda document, source=source: document["section"].update(source=source))
        with pytest.raises(
            DataError, match=r"section.source.path: .* lies outside the session's folder .*allow_outside"
        ):
            sw.open_session(path)
        section = sw.open_session(path, allow_outside=True).open_section()
        assert section_sha256(section) == section_sha256(case.section)
    path = changed(saved, lambda document: document["section"]["source"].update(path="a/../not-there.npz"))
    with pytest.raises(DataError, match=r"not-there.npz does not exist; check its name"):
        sw.open_session(path).open_section()


@pytest.mark.parametrize("name", ["a\0b", "\ud800", "x" * 5000])
def test_paths_that_no_file_can_have_are_refused(saved, name):
    path = changed(saved, lambda document: document["section"].update(source={"kind": "file", "path": name}))
    with pytest.raises(DataError, match=r"session.json|cannot be the path"):
        sw.open_session(path).open_section()


def test_nothing_is_unpickled(saved, tmp_path):
    np.savez(tmp_path / "evil.npz", amplitude=np.array([[{}]], dtype=object))
    path = changed(saved, lambda document: document["section"].update(source={"kind": "file", "path": "evil.npz"}))
    with pytest.raises(DataError, match=r"evil.npz: amplitude holds object, not real numbers"):
        sw.open_session(path).open_section()


@pytest.mark.parametrize(
    ("kind", "name", "choices", "error", "match"),
    [
        ("web", "x", {}, SettingError, "source must be 'file', 'synthetic', 'dataset', but is 'web'"),
        (
            "synthetic",
            "__import__",
            {},
            SettingError,
            "the synthetic section must be one of .*planar_fault, .* '__import__'",
        ),
        ("dataset", "find_file", {}, SettingError, "the dataset section must be one of f3, teapot"),
        ("synthetic", "tilt", {"dip": 1j}, SettingError, r"dip must be a finite number, .* but is 1j"),
        ("synthetic", "tilt", {"dip": float("nan")}, SettingError, "dip must be a finite number"),
        ("synthetic", "tilt", {"dip": "steep"}, DataError, "the section cannot be made with {'dip': 'steep'}"),
        (
            "synthetic",
            "tilt",
            {"deep": 3},
            DataError,
            "the section cannot be made with {'deep': 3}.*correct its source",
        ),
        ("synthetic", "tilt", {"seed": -1}, DataError, "the section cannot be made with {'seed': -1}"),
        (
            "synthetic",
            "tilt",
            {"dx": 1, "dz": 1},
            SettingError,
            "of 8000000 samples is too large; make dx= or dz= larger",
        ),
        ("dataset", "f3", {"speed": 3}, DataError, "the section cannot be made with {'speed': 3}"),
        ("file", "line.sgy", {}, DataError, "line.sgy does not exist"),
        ("file", "line.npz", {"traces": {"range": [1, 9, 0]}}, DataError, "the section cannot be made with .*'traces'"),
    ],
)
def test_sources_that_make_no_section(kind, name, choices, error, match):
    with pytest.raises(error, match=match):
        sw.SectionSource(kind, name, choices).open()


def test_slices_and_ranges_are_kept(session, tmp_path):
    choices = {"traces": slice(3, None), "lines": range(1, 9, 2), "header_bytes": {"inline": 189}, "extent": (0, 1.5)}
    source = sw.SectionSource("file", str(tmp_path / "line.sgy"), choices)
    replace(session, source=source).save(tmp_path / "session.json")
    assert sw.open_session(tmp_path / "session.json").source == source
    kept = source.keywords
    assert kept == {**choices, "extent": [0, 1.5]}


# --- versions


OLD = {  # version 0: see docs/formats.md
    "format": "seiswidgets session",
    "version": 0,
    "dataset": "teapot",
    "faults": [{"name": "F1", "points": [[100, 600], [200, 700]]}],
    "horizons": [{"name": "H1", "pieces": [[[0, 600], [90, 610]]]}],
    "fixed": [50, 650],
    "steps": ["flatten"],
    "weights": {"edge": 2},
}


def test_sessions_of_version_0_open(tmp_path):
    path = tmp_path / "old.json"
    path.write_text(json.dumps(OLD))
    session = sw.open_session(path)
    assert session == sw.Session(
        sw.SectionSource("dataset", "teapot"),
        None,
        (SavedPick("F1", (((100.0, 600.0), (200.0, 700.0)),)),),
        (SavedPick("H1", ((((0.0, 600.0), (90.0, 610.0))),)),),
        sw.Plan((sw.Step("flatten"),), sw.Weights(edge=2.0), fixed=(50.0, 650.0)),
    )
    session.save(tmp_path / "new.json")
    assert sw.open_session(tmp_path / "new.json") == session


def test_an_old_session_without_steps_has_the_usual_ones(tmp_path):
    path = tmp_path / "old.json"
    path.write_text(json.dumps({key: OLD[key] for key in ("format", "version", "dataset")}))
    assert sw.open_session(path).plan == sw.Plan()


def test_sessions_of_version_1_open(saved, session):
    def age(document):
        document["version"] = 1
        for step in document["plan"]["steps"]:
            del step["slip"], step["beyond"]

    again = sw.open_session(changed(saved, age))
    assert again.plan.steps == tuple(replace(step, slip={}, beyond="free") for step in session.plan.steps)
    assert again.faults == session.faults


@pytest.mark.parametrize("version", [3, 10**3000])
def test_newer_versions_say_so(saved, version):
    path = changed(saved, lambda document: document.update(version=version))
    with pytest.raises(DataError, match=rf"session.json is a session in version \d+, and seiswidgets {sw.__version__}"):
        sw.open_session(path)


def test_the_examples_in_the_docs_open(tmp_path, case):
    text = (Path(__file__).parents[2] / "docs" / "formats.md").read_text()
    picks, document = re.findall(r"```json\n(.*?)```", text, re.DOTALL)
    (tmp_path / "picks.json").write_text(picks)
    section = replace(case.section, z_unit="ms", velocity=2000.0)
    assert len(sw.read_picks(tmp_path / "picks.json", section).horizons[0].pieces) == 2
    (tmp_path / "session.json").write_text(document.replace("64 hexadecimal digits", 64 * "0"))
    session = sw.open_session(tmp_path / "session.json")
    assert session.source == sw.SectionSource("file", str(tmp_path / "data" / "line.npz"))
    slip = {"F2": sw.SlipProfile([0, 400], [25, 40])}
    assert session.plan == sw.Plan((sw.Step("unfault", slip=slip),), fixed=(2000.0, 1600.0))
    session.save(tmp_path / "again.json")
    again, shown = (json.loads((tmp_path / name).read_text()) for name in ("again.json", "session.json"))
    assert again == {**shown, "written_by": f"seiswidgets {sw.__version__}"}


# --- damage


@pytest.mark.parametrize(
    ("change", "match"),
    [
        (lambda d: d.pop("format"), "is not a session of seiswidgets"),
        (lambda d: d.update(version="1"), "version must be a whole number, but is '1'"),
        (lambda d: d.update(version=True), "version must be a whole number, but is true"),
        (lambda d: d.pop("section"), "lacks 'section'"),
        (lambda d: d["section"].pop("source"), "section lacks 'source'"),
        (lambda d: d["section"]["source"].update(kind="web"), "section.source: a section's source must be"),
        (lambda d: d["section"]["source"].update(name="exec"), "section.source: the synthetic section must be one of"),
        (lambda d: d["section"]["source"].update(arguments={"dip": [[[[[1]]]]]}), "must be nested no more than 4 deep"),
        (lambda d: d["section"].update(sha256="abc"), "section.sha256 must be a SHA-256"),
        (lambda d: d["plan"].update(max_iterations=0), "plan.max_iterations must be a whole number of 1 or more"),
        (lambda d: d["picks"].update(faults={}), r"picks.faults must be a list \[...\], but is an object of 0"),
        (lambda d: d["picks"]["faults"][0]["points"].insert(5, [1]), r"picks.faults\[0\].points\[5\] must be a point"),
        (lambda d: d["picks"]["faults"][0]["points"].insert(5, ["1", 2]), r"points\[5\] must be a point"),
        (
            lambda d: d["picks"]["horizons"][1]["pieces"][1].insert(2, [1, 1e13]),
            r"horizons\[1\].pieces\[1\]\[2\] must be",
        ),
        (lambda d: d["picks"]["faults"][0].update(name=3), r"picks.faults\[0\].name must be text, but is 3"),
        (
            lambda d: d["picks"]["faults"].append(d["picks"]["faults"][0]),
            r"faults\[1\].name must be a name that no other",
        ),
        (
            lambda d: d["picks"]["faults"][0].update(colour="red;x:url(y)"),
            r"faults\[0\]: the colour of 'F1' must be #rrggbb",
        ),
        (lambda d: d["picks"]["faults"][0].update(visible=1), r"faults\[0\].visible must be true or false, but is 1"),
        (lambda d: d["picks"].update(fixed=[1, 2, 3]), "picks.fixed must be a point .* but is a list of 3"),
        (
            lambda d: d["plan"].update(steps=[{"kind": "fold"}]),
            r"plan.steps\[0\]: a step must be one of 'unfault', 'flatten'",
        ),
        (lambda d: d["plan"]["steps"][0].update(picks="F1"), r"plan.steps\[0\].picks must be a list"),
        (lambda d: d["plan"]["weights"].update(edge=-1), "plan.weights: weight edge must be a number of 0 or more"),
        (
            lambda d: d["plan"]["weights"].update(hedge=1),
            "plan.weights has 'hedge', which is not a weight; the weights are mean_value",
        ),
        (lambda d: d["plan"].update(solver="magic"), "plan: solver must be 'gauss-newton' or"),
        (lambda d: d["plan"].update(spacing="wide"), "plan.spacing must be a number"),
    ],
)
def test_damage_is_told_with_file_and_place(saved, change, match):
    path = changed(saved, change)
    with pytest.raises(DataError, match=match) as caught:
        sw.open_session(path)
    assert str(path) in str(caught.value)


@pytest.mark.parametrize(
    ("content", "match"),
    [
        (b"", "is not valid JSON"),
        (b'{"format": ' * 50_000, "nested more deeply"),
        (b"[" * 200_000, "nested more deeply"),
        (b'{"format": "seiswidgets session", "version": NaN}', "NaN is not a number in JSON"),
        ('{"format": "seiswidgets session"}'.encode("utf-16"), "is not UTF-8 text: byte 0xff at 0"),
        (b"[1, 2]", "must be an object"),
    ],
)
def test_what_is_no_session_is_told(tmp_path, content, match):
    path = tmp_path / "session.json"
    path.write_bytes(content)
    with pytest.raises(DataError, match=match):
        sw.open_session(path)


def test_saving_leaves_the_old_file_when_it_fails(session, saved, tmp_path, monkeypatch):
    before = saved[0].read_bytes()
    monkeypatch.setattr(os, "fsync", lambda handle: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(DataError, match=r"session.json cannot be written: No space left on device"):
        replace(session, plan=sw.Plan()).save(saved[0])
    assert saved[0].read_bytes() == before
    assert os.listdir(tmp_path) == ["session.json"]


@pytest.mark.parametrize(
    "name", [r"C:\Users\me\line.npz", r"\\server\share\line.npz", r"data\line.npz", "/home/another/line.npz"]
)
def test_a_session_from_another_system_finds_its_section_beside_it(case, saved, tmp_path, name):
    folder = tmp_path / "data" if name.startswith("data") else tmp_path
    folder.mkdir(exist_ok=True)
    sw.save_section(case.section, folder / "line.npz")
    path = changed(saved, lambda document: document["section"].update(source={"kind": "file", "path": name}))
    assert section_sha256(sw.open_session(path).open_section()) == section_sha256(case.section)


@pytest.mark.parametrize("name", [r"C:\Users\me\line.npz", "D:/data/line.npz", r"\\server\share\line.npz"])
def test_a_path_of_another_system_is_named_as_such(saved, name):
    path = changed(saved, lambda document: document["section"].update(source={"kind": "file", "path": name}))
    with pytest.raises(DataError, match=r"is a path of Windows.*copy line.npz .* A session finds it in its own folder"):
        sw.open_session(path).open_section()
    with pytest.raises(DataError, match="is a path of Windows"):
        sw.preview(name)


def test_all_hypotheses_are_kept_in_their_order(case, session, saved):
    other = SavedHypothesis("steep", session.faults, plan=sw.Plan(spacing=70.0, pins=[(500.0, 100.0)]))
    several = replace(session, name="flat", before=(other,))
    path = saved[0]
    several.save(path)
    again = sw.open_session(path)
    assert again == several
    assert [one.name for one in again.hypotheses(case.section)] == ["steep", "flat"]
    first, second = again.hypotheses(case.section)
    assert (first.plan, len(first.interpretation.horizons)) == (other.plan, 0)
    assert second.plan == session.plan


@pytest.mark.parametrize(
    ("hypotheses", "message"),
    [
        ([], "one has no picks: the session's own"),
        ([{"name": "A"}, {"name": "B"}], "one has no picks: the session's own"),
        ([{"name": "A"}, {"name": "A", "picks": {}}], "each with a name of its own"),
        (
            [{"name": "A"}, {"name": "B", "picks": {"faults": [{"name": "F"}]}}],
            r"hypotheses\[1\].picks.faults\[0\] lacks",
        ),
    ],
)
def test_damaged_hypotheses_are_refused_with_their_location(saved, hypotheses, message):
    path = changed(saved, lambda document: document.update(hypotheses=hypotheses))
    with pytest.raises(sw.DataError, match=message):
        sw.open_session(path)


def test_a_session_keeps_a_sequence(tmp_path):
    case = sw.synthetic.growth_fault(dx=50, dz=20)
    crust = sw.Isostasy(elastic_thickness=5e3, sea_level=None)
    layers = sw.Stratigraphy(
        [
            sw.Layer(None, 0, sw.Lithology(0.5, 0.4, 2600.0, "mudstone", "core 7")),
            sw.Layer("H1", 5, "sand", water_depth=[(0, 20), (4000, 80)]),
            sw.Layer("H2", 9, "salt", water_depth=100),
        ]
    )
    plan = sw.Plan.sequential(layers, case.interpretation, isostasy=crust, unfold="length")
    plan = replace(plan, load_beyond="zero", steps=(*plan.steps, sw.Step("unerode", datum=[(0, -50), (4000, -80)])))
    source = sw.SectionSource("synthetic", "growth_fault", {"dx": 50, "dz": 20})
    sw.Session.of(case.section, source, case.interpretation, plan=plan).save(tmp_path / "basin.json")
    assert sw.open_session(tmp_path / "basin.json").plan == plan


@pytest.mark.parametrize(
    ("layer", "message"),
    [
        ({"age": 3}, "lithology"),
        ({"age": -3, "lithology": {"phi0": 0.5, "c": 0.4, "grain_density": 2600}}, "age of a top must be 0 Ma or more"),
        ({"age": 3, "lithology": {"phi0": 5, "c": 0.4, "grain_density": 2600}}, "porosity phi0"),
    ],
)
def test_a_damaged_stratigraphy_is_refused_in_words(tmp_path, layer, message):
    document = {
        "format": "seiswidgets session",
        "version": 2,
        "section": {"source": {"kind": "synthetic", "name": "growth_fault"}},
        "picks": {},
        "plan": {"stratigraphy": {"layers": [layer]}},
    }
    path = tmp_path / "damaged.json"
    path.write_text(json.dumps(document))
    with pytest.raises(sw.DataError, match=message):
        sw.open_session(path)
