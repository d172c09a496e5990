import dataclasses
import json
import os
import re
import subprocess
import sys
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest
import xarray

import seiswidgets as sw
from seiswidgets import __main__ as command
from seiswidgets.errors import Keyword, Text
from seiswidgets.io.session import replay
from seiswidgets.io.session.replay import output_names
from tests.executors import InThisThread

ROOT = Path(__file__).parents[2]
PLAN = sw.Plan(spacing=90.0)


@pytest.fixture
def saved(tmp_path):
    """The file of a session, alone in a folder."""
    case = sw.synthetic.faulted_fold()
    source = sw.SectionSource("synthetic", "faulted_fold")
    path = tmp_path / "in" / "session.json"
    path.parent.mkdir()
    sw.Session.of(case.section, source, case.interpretation, case.fixed, PLAN).save(path)
    return path


def run(*arguments, code=None):
    """The command in a process of its own, warnings being errors."""
    call = ["-c", code, *arguments] if code else ["-m", "seiswidgets", *arguments]
    return subprocess.run(
        [sys.executable, "-W", "error", *map(str, call)], cwd=ROOT, capture_output=True, text=True, check=False
    )


def test_it_restores_without_jupyter(saved, tmp_path):
    code = (
        "import sys; from seiswidgets.__main__ import main; status = main(sys.argv[1:]); "
        "loaded = {name.partition('.')[0] for name in sys.modules}; "
        "print(*loaded & {'IPython', 'anywidget', 'ipycanvas', 'ipywidgets', 'traitlets', 'matplotlib'}); "
        "sys.exit(status)"
    )
    result = run("restore", saved, "--out", tmp_path / "out", code=code)
    assert (result.returncode, result.stdout.strip()) == (0, "")
    assert result.stderr == f"{saved}: 2 steps, in {tmp_path / 'out' / 'session-report.txt'}\n"


def test_it_writes_the_section_and_the_reports(saved, tmp_path, capsys):
    assert command.main(["restore", str(saved), "--out", str(tmp_path / "new" / "out")]) == 0
    restored = sw.open_session(saved).restore()
    out = tmp_path / "new" / "out"
    source = sw.SectionSource("file", str(out / "session-restored.npz"))
    np.testing.assert_array_equal(source.open().amplitude, restored.section.amplitude)
    assert source.open().extent == restored.section.extent
    report = json.loads((out / "session-report.json").read_text())
    assert [stage["kind"] for stage in report["stages"]] == ["unfault", "flatten"]
    assert report["stages"][0]["vertices"] == restored.stages[0].report.vertices
    assert report["session"] == str(saved)
    assert report["left_out"] == []
    text = (out / "session-report.txt").read_text()
    assert "unfault F1" in text
    assert "bed length" in text


def test_it_writes_a_handout_in_the_colours_of_the_session(saved, tmp_path, capsys):
    document = json.loads(saved.read_text())
    document["picks"]["faults"][0]["colour"] = "#123456"
    saved.write_text(json.dumps(document))
    assert command.main(["restore", str(saved), "--out", str(tmp_path / "out"), "--handout"]) == 0
    assert '"colour":"#123456"' in (tmp_path / "out" / "session-handout.html").read_text("utf-8")


def test_results_in_the_same_folder_leave_the_session_and_its_section(tmp_path, capsys):
    case = sw.synthetic.tilt()
    sw.save_section(case.section, tmp_path / "line.npz")
    source = sw.SectionSource("file", str(tmp_path / "line.npz"))
    sw.Session.of(case.section, source, case.interpretation, None, PLAN).save(tmp_path / "line.json")
    before = {file: file.read_bytes() for file in tmp_path.iterdir()}
    assert command.main(["restore", str(tmp_path / "line.json"), "--out", str(tmp_path)]) == 0
    assert {file: file.read_bytes() for file in before} == before
    assert len(list(tmp_path.iterdir())) == 5


def test_errors_are_words_and_the_other_sessions_go_on(saved, tmp_path):
    damaged = tmp_path / "damaged.json"
    damaged.write_text(saved.read_text().replace('"version": 2', '"version": 77'))
    result = run("restore", damaged, tmp_path / "none.json", saved, "--out", tmp_path / "out")
    assert result.returncode == 1
    first, second, third = result.stderr.splitlines()
    assert first.startswith(f"{damaged} is a session in version 77")
    assert second.startswith(f"there is no file {tmp_path / 'none.json'}") or "none.json" in second
    assert third.startswith(f"{saved}: 2 steps")
    assert "Traceback" not in result.stderr
    assert len(os.listdir(tmp_path / "out")) == 3


def test_a_fault_of_ours_does_not_keep_the_others_from_theirs(saved, tmp_path, capsys, monkeypatch):
    def replay_session(path, *arguments, **choices):
        if path.stem == "bad":
            raise ZeroDivisionError("by zero")
        return replay.replay_session(path, *arguments, **choices)

    monkeypatch.setattr(command, "replay_session", replay_session)
    assert command.main(["restore", "bad.json", str(saved), "--out", str(tmp_path / "out")]) == 1
    told = capsys.readouterr().err
    assert told.startswith("bad.json: ZeroDivisionError('by zero'), which is a bug in seiswidgets; please report it")
    assert told.endswith(f"{saved}: 2 steps, in {tmp_path / 'out' / 'session-report.txt'}\n")


def test_results_do_not_replace_the_section_that_they_are_made_from(tmp_path, capsys):
    case = sw.synthetic.tilt()
    sw.save_section(case.section, tmp_path / "line-restored.npz")
    source = sw.SectionSource("file", str(tmp_path / "line-restored.npz"))
    sw.Session.of(case.section, source, case.interpretation, None, PLAN).save(tmp_path / "line.json")
    before = (tmp_path / "line-restored.npz").read_bytes()
    assert command.main(["restore", str(tmp_path / "line.json"), "--out", str(tmp_path)]) == 1
    assert "line-restored.npz is the section of the session; choose another folder" in capsys.readouterr().err
    assert (tmp_path / "line-restored.npz").read_bytes() == before


def test_picks_that_cannot_be_restored_name_the_session(saved, tmp_path, capsys):
    document = json.loads(saved.read_text())
    document["picks"]["fixed"] = [1e6, 0]
    saved.write_text(json.dumps(document))
    assert command.main(["restore", str(saved), "--out", str(tmp_path)]) == 1
    assert capsys.readouterr().err.startswith(f"{saved}: fixed lies outside the section")


def test_lines_left_out_are_told(saved, tmp_path, capsys):
    document = json.loads(saved.read_text())
    document["picks"]["faults"].append({"name": "F2", "points": [[0, 0], [2, 2], [2, 0], [0, 2]]})
    saved.write_text(json.dumps(document))
    assert command.main(["restore", str(saved), "--out", str(tmp_path / "out")]) == 0
    assert f"{saved}: left out: fault 'F2' crosses itself" in capsys.readouterr().err
    assert "left out: fault 'F2' crosses itself" in (tmp_path / "out" / "session-report.txt").read_text()


def test_findings_of_the_stages_are_shown_worst_first(saved, tmp_path, capsys, monkeypatch):
    def replay_session(*arguments, **options):
        done = replay.replay_session(*arguments, **options)
        for stage in done.restored.stages:
            warning = sw.Finding("warning", "contact", f"{stage.kind} gave way", pick="F1")
            monkeypatch.setitem(vars(stage), "report", dataclasses.replace(stage.report, findings=(warning,)))
        problem = sw.Finding("problem", "cut-off", Text("allow it with ", Keyword("allow_changed", True)))
        last = done.restored.stages[-1]
        findings = (*last.report.findings, problem)
        monkeypatch.setitem(vars(last), "report", dataclasses.replace(last.report, findings=findings))
        return done

    monkeypatch.setattr(command, "replay_session", replay_session)
    assert command.main(["restore", str(saved), "--out", str(tmp_path / "out")]) == 0
    assert capsys.readouterr().err.splitlines()[1:] == [
        f"{saved}: problem: allow it with --allow-changed",
        f"{saved}: warning: unfault gave way",
        f"{saved}: warning: flatten gave way",
    ]


def test_a_problem_that_a_plan_leaves_is_shown(saved, tmp_path, capsys):
    document = json.loads(saved.read_text())
    document["plan"]["weights"]["flatten"] = 0.001  # too weak to bring the horizon to its datum
    saved.write_text(json.dumps(document))
    assert command.main(["restore", str(saved), "--out", str(tmp_path / "out")]) == 0
    assert re.search(rf"^{re.escape(str(saved))}: problem: horizon H1 .* datum", capsys.readouterr().err, re.MULTILINE)


def test_a_section_outside_or_changed_must_be_allowed(saved, tmp_path, capsys):
    document = json.loads(saved.read_text())
    sw.save_section(sw.synthetic.faulted_fold(seed=1).section, tmp_path / "line.npz")
    document["section"]["source"] = {"kind": "file", "path": "../line.npz"}
    saved.write_text(json.dumps(document))
    call = ["restore", str(saved), "--out", str(tmp_path / "out")]
    for allowed, status, told in [
        ([], 1, "lies outside the session's folder"),
        ([], 1, "or open the session with --allow-outside if you trust it"),
        (["--allow-outside"], 1, "is not the one that the session was made on"),
        (["--allow-outside"], 1, "find the original one, or allow it with --allow-changed"),
        (["--allow-outside", "--allow-changed"], 0, "2 steps"),
    ]:
        assert command.main([*call, *allowed]) == status
        assert told in capsys.readouterr().err


def test_a_folder_that_cannot_be_made_is_told(saved, tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert command.main(["restore", str(saved), "--out", str(tmp_path / "file" / "out")]) == 1
    assert "cannot be created: Not a directory; choose another folder" in capsys.readouterr().err


def test_sessions_of_the_same_name_keep_apart():
    paths = [Path("ann/session.json"), Path("bob/session.json"), Path("x/bob/session.json"), Path("bob/other.json")]
    assert output_names(paths) == ["ann-session", "bob-session", "bob-session-2", "other"]


def test_the_bar_fills_where_somebody_watches(saved, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    assert command.main(["restore", str(saved), "--out", str(tmp_path / "out")]) == 0
    lines = capsys.readouterr().err.split("\r")
    assert len(lines) > 3
    assert "step 1 of 2, iteration 1" in lines[0]
    filled = [line.count("#") for line in lines[:-1]]
    assert filled == sorted(filled)
    assert filled[-1] > filled[0]
    assert lines[-1].strip() == f"{saved}: 2 steps, in {tmp_path / 'out' / 'session-report.txt'}"


def test_the_bar_fits_a_narrow_terminal(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    bar = command.ProgressBar("a folder/" * 20 + "session.json")
    bar.show(1, 2, 3)
    told = capsys.readouterr().err
    assert len(told) < 80
    assert "session.json [" in told


def test_version_help_and_wrong_calls(capsys):
    assert run("--version").stdout == f"seiswidgets {sw.__version__}\n"

    def stopped(*arguments):
        with pytest.raises(SystemExit, match=r"^[02]$") as stop:
            command.main(arguments)
        return stop.value.code, *capsys.readouterr()

    status, told, complaint = stopped("restore", "--help")
    assert (status, complaint) == (0, "")
    for word in ("session.json", "--out DIR", "--allow-outside", "-restored.npz", "Exit status"):
        assert word in told
    assert stopped()[0] == 2
    assert "--out" in stopped("restore", "x.json")[2]


@pytest.fixture
def quick(saved):
    """A session of which nothing is restored, so that an ensemble has throws and heaves only."""
    case = sw.synthetic.faulted_fold()
    plan = sw.Plan(steps=())
    sw.Session.of(case.section, sw.SectionSource("synthetic", "faulted_fold"), case.interpretation, plan=plan).save(
        saved
    )
    return saved


def test_an_ensemble_of_a_session(quick, tmp_path, capsys):
    out = tmp_path / "ensemble.nc"
    assert command.main(["ensemble", str(quick), "--out", str(out), "--members", "5", "--fault", "0"]) == 0
    printed = capsys.readouterr()
    assert printed.err == f"{quick}: 5 members, seed 0, in {out}\n"
    assert "throw H1 at F1  m  " in printed.out
    data = xarray.load_dataset(out)
    assert (data.sizes["member"], data.attrs["uncertainty_horizon"], data.attrs["uncertainty_fault"]) == (5, 1, 0)
    assert sorted(os.listdir(tmp_path)) == ["ensemble.nc", "in"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--horizon", "-1"], "horizon is a standard deviation, 0 or more, but is -1"),
        (["--members", "0"], "members must be a whole number of 1 or more, but is 0"),
        (["--workers", "0"], "workers must be a whole number of 1 or more, but is 0"),
        (["--out", "ensemble.txt"], "ensemble.txt must end in .nc"),
        (["--out", "/none/ensemble.nc"], "/none/ensemble.nc.part cannot be written: No such file"),
    ],
)
def test_what_an_ensemble_is_not_made_of(quick, tmp_path, capsys, arguments, message):
    assert command.main(["ensemble", str(quick), "--out", str(tmp_path / "ensemble.nc"), *arguments]) == 1
    assert message in capsys.readouterr().err


def test_a_scheduler_that_does_not_answer(quick, tmp_path):
    code = (
        "import sys; from seiswidgets.io.session import studies; studies.PATIENCE = 0.1; "
        "from seiswidgets.__main__ import main; sys.exit(main(sys.argv[1:]))"
    )
    out = tmp_path / "ensemble.nc"
    result = run("ensemble", quick, "--out", out, "--scheduler", "tcp://127.0.0.1:1", code=code)
    assert result.returncode == 1
    assert "no scheduler of Dask answers at tcp://127.0.0.1:1" in result.stderr


def test_a_scan_of_a_session(quick, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("seiswidgets.io.session.studies.dask_executor", lambda address: nullcontext(InThisThread()))
    out = tmp_path / "scan.json"
    assert command.main(["scan", str(quick), "--out", str(out)]) == 0
    case = sw.synthetic.faulted_fold()
    expected = sw.scan(case.section, case.interpretation.faults[0]).peaks[0]
    (fault,) = json.loads(out.read_text())["faults"]
    assert fault["fault"] == "F1"
    assert fault["peaks"][0]["slip"] == pytest.approx(expected.slip)
    assert len(fault["slip"]) == len(fault["correlation"])
    printed = capsys.readouterr()
    assert printed.out == f"F1: slip {expected.slip:.1f} m, correlation {expected.correlation:.2f}\n"
    assert printed.err == f"{quick}: 1 fault, in {out}\n"
    assert command.main(["scan", str(quick), "--out", str(tmp_path / "scan.csv")]) == 1
    assert "scan.csv must end in .json" in capsys.readouterr().err
