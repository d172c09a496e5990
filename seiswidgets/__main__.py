"""Command line ``python -m seiswidgets``: restores sessions, studies how certain they are, and grades classes."""

import argparse
import shutil
import sys
import traceback
from pathlib import Path
from typing import Any

from seiswidgets import __version__
from seiswidgets.errors import SeiswidgetsError, Text
from seiswidgets.geology.findings import worst_first
from seiswidgets.io.session.replay import Replay, output_names, replay_session
from seiswidgets.io.teaching import add_teaching_commands

BAR_WIDTH = 24
HALF = 5  # iterations after which half of a step is shown as done: nobody knows how many it will take
OPTIONS = {"allow_outside": "--allow-outside", "allow_changed": "--allow-changed"}  # as errors name them
DEVIATIONS = {  # defaults and meanings of the options of the command ensemble
    "horizon": (1.0, "standard deviation of the picks of horizons, in samples (%(default)g)"),
    "fault": (1.0, "standard deviation of the picks of faults, in traces (%(default)g)"),
    "correlation-length": (500.0, "distance along a line over which errors are alike, in metres (%(default)g)"),
    "dip": (0.0, "standard deviation of the faults' dips, in degrees (%(default)g)"),
    "velocity": (0.0, "standard deviation of the velocity, as a share of it (%(default)g)"),
}

DESCRIPTION = """Restores the section of each session as its plan says, and writes into a folder:
<name>-restored.npz (the section), <name>-report.txt and <name>-report.json (a report of each step),
and with --handout <name>-handout.html (a web page to look at without Python).
Existing files of these names are replaced."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return 0 if all went well, 1 if a session could not be restored, 2 if it was called wrongly."""
    options = _parser().parse_args(arguments)
    try:
        return int(options.run(options))
    except SeiswidgetsError as error:
        sys.stderr.write(f"{error.text.rendered(OPTIONS)}\n")
        return 1


def _restore_all(options: argparse.Namespace) -> int:
    try:
        options.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        sys.stderr.write(f"{options.out} cannot be created: {error.strerror}; choose another folder with --out\n")
        return 1
    names = output_names(options.sessions)
    successes = [_restore(path, name, options) for path, name in zip(options.sessions, names, strict=True)]
    return 0 if all(successes) else 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python -m seiswidgets", description="Seismic image restoration.")
    parser.add_argument("--version", action="version", version=f"seiswidgets {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="command")
    restore = commands.add_parser(
        "restore",
        help="restore the sections of saved sessions",
        description=DESCRIPTION,
        epilog="Exit status: 0 if all sessions were restored, 1 if any was not.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    restore.set_defaults(run=_restore_all)
    restore.add_argument("sessions", nargs="+", type=Path, metavar="session.json", help="a saved session")
    restore.add_argument(
        "--out", type=Path, required=True, metavar="DIR", help="folder for the results; created if necessary"
    )
    restore.add_argument("--handout", action="store_true", help="write a web page with both sections, too")
    _add_permissions(restore)
    _add_ensemble(commands)
    _add_scan(commands)
    add_teaching_commands(commands)
    return parser


def _add_permissions(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        OPTIONS["allow_outside"],
        action="store_true",
        help="allow a session to open a section that lies outside the session's folder",
    )
    command.add_argument(
        OPTIONS["allow_changed"],
        action="store_true",
        help="restore even if the section is not the one that the session was made on",
    )


def _add_ensemble(commands: argparse._SubParsersAction) -> None:
    ensemble = commands.add_parser(
        "ensemble",
        help="restore a session many times, with the errors of its picks drawn at random",
        description="Restores a session many times, with the errors of its picks drawn at random, writes the results "
        "as NetCDF, and prints their percentiles. Interrupted, it continues when it is run again.",
    )
    ensemble.set_defaults(run=_study)
    ensemble.add_argument("session", type=Path, metavar="session.json", help="a saved session")
    ensemble.add_argument("--out", type=Path, required=True, metavar="FILE.nc", help="file for the results")
    for name, (default, meaning) in DEVIATIONS.items():
        ensemble.add_argument(f"--{name}", type=float, default=default, metavar="NUMBER", help=meaning)
    ensemble.add_argument("--members", type=int, default=200, metavar="N", help="number of restorations (%(default)s)")
    ensemble.add_argument("--seed", type=int, default=0, metavar="N", help="of the random numbers (%(default)s)")
    ensemble.add_argument(
        "--match",
        action="append",
        default=[],
        metavar="FAULT",
        help="scan this fault, and draw its slip from the peaks",
    )
    _add_workers(ensemble)
    _add_permissions(ensemble)


def _add_scan(commands: argparse._SubParsersAction) -> None:
    scan = commands.add_parser(
        "scan",
        help="find the slip along each fault of a session that makes its two sides match",
        description="Scans each fault of a session: for which slip do its two sides match? Writes the curves and their "
        "peaks as JSON, and prints the likeliest slips.",
    )
    scan.set_defaults(run=_scan)
    scan.add_argument("session", type=Path, metavar="session.json", help="a saved session")
    scan.add_argument("--out", type=Path, required=True, metavar="FILE.json", help="file for the results")
    _add_workers(scan)
    _add_permissions(scan)


def _add_workers(command: argparse.ArgumentParser) -> None:
    command.add_argument("--workers", type=int, metavar="N", help="processes of this computer; one a core if left out")
    command.add_argument("--scheduler", metavar="ADDRESS", help="address of a Dask cluster that does the work instead")


def _study(options: argparse.Namespace) -> int:
    """Compute the ensemble of a session; return the exit status."""
    from seiswidgets.geology.ensembles.uncertainty import Uncertainty  # which the other commands do not need
    from seiswidgets.io.session.studies import study_session

    bar = ProgressBar(str(options.session))
    try:
        result = study_session(
            options.session,
            options.out,
            Uncertainty(**{name.replace("-", "_"): vars(options)[name.replace("-", "_")] for name in DEVIATIONS}),
            options.members,
            options.seed,
            matches=options.match,
            workers=options.workers,
            scheduler=options.scheduler,
            progress=lambda done, members: bar.fill(done / members, f"{done} of {members} members"),
            allow_outside=options.allow_outside,
            allow_changed=options.allow_changed,
        )
    except SeiswidgetsError as error:
        bar.refuse(error)
        return 1
    bar.end(f"{options.session}: {result.summary}, in {options.out}")
    sys.stdout.write(f"{result}\n")
    return 0


def _restore(path: Path, name: str, options: argparse.Namespace) -> bool:
    """Restore one session and report on stderr; return whether it could be restored."""
    bar = ProgressBar(str(path))
    try:
        replay = replay_session(
            path,
            options.out,
            name,
            bar.show,
            allow_outside=options.allow_outside,
            allow_changed=options.allow_changed,
        )
        if options.handout:
            _write_handout(replay, options.out / f"{name}-handout.html")
    except SeiswidgetsError as error:
        bar.refuse(error)
        return False
    except Exception as error:  # noqa: BLE001 - a bug in one session must not stop the others
        bar.end(f"{path}: {error!r}, which is a bug in seiswidgets; please report it with the lines below")
        traceback.print_exc()
        return False
    stages = replay.restored.stages
    settled = "" if all(stage.report.converged for stage in stages) else ", NOT all settled"
    bar.end(f"{path}: {len(stages)} step{'' if len(stages) == 1 else 's'}{settled}, in {replay.files[1]}")
    sys.stderr.writelines(f"{path}: {line}\n" for line in _findings(replay))
    return True


def _write_handout(replay: Replay, path: Path) -> None:
    from seiswidgets.widgets.handout.page import save_html  # imports matplotlib, which takes a while

    save_html(replay.restored, path, replay.session.interpretation, colours=replay.session.colours)


def _findings(replay: Replay) -> list[str]:
    """Lines of picks that were left out, then the findings of all stages, worst first."""
    findings = worst_first(finding for stage in replay.restored.stages for finding in stage.report.findings)
    return [f"left out: {problem}" for problem in replay.session.problems] + [
        f"{finding.severity}: {finding.text.rendered(OPTIONS) if isinstance(finding.text, Text) else finding.text}"
        for finding in findings
    ]


def _scan(options: argparse.Namespace) -> int:
    """Scan the faults of a session; return the exit status."""
    from seiswidgets.io.session.studies import scan_session  # which the other commands do not need

    bar = ProgressBar(str(options.session))
    try:
        found = scan_session(
            options.session,
            options.out,
            workers=options.workers,
            scheduler=options.scheduler,
            progress=lambda done, faults: bar.fill(done / faults, f"{done} of {faults} faults"),
            allow_outside=options.allow_outside,
            allow_changed=options.allow_changed,
        )
    except SeiswidgetsError as error:
        bar.refuse(error)
        return 1
    bar.end(f"{options.session}: {len(found)} fault{'' if len(found) == 1 else 's'}, in {options.out}")
    for fault in found:
        sys.stdout.write(f"{_likeliest(fault)}\n")
        sys.stdout.writelines(f"  {text}\n" for text in fault.get("findings", ()))
    return 0


def _likeliest(fault: dict[str, Any]) -> str:
    """A line on the likeliest match of a fault."""
    if "refused" in fault:
        return f"{fault['fault']}: {fault['refused']}"
    peak = fault["peaks"][0]
    return f"{fault['fault']}: slip {peak['slip']:.1f} m, correlation {peak['correlation']:.2f}"


class ProgressBar:
    """A line on stderr that fills while a session is restored; without a terminal only its end is written."""

    def __init__(self, label: str) -> None:
        self.label, self._shown = label, 0

    def show(self, step: int, steps: int, iteration: int) -> None:
        """Show that an iteration of a step is done; both are counted from 1."""
        share = (step - 1 + iteration / (iteration + HALF)) / steps
        self.fill(share, f"step {step} of {steps}, iteration {iteration}")

    def fill(self, share: float, text: str) -> None:
        """Fill a share of the bar."""
        if not sys.stderr.isatty():
            return
        bar = f" [{'#' * round(BAR_WIDTH * share):<{BAR_WIDTH}}] {text}"
        room = max(0, shutil.get_terminal_size().columns - len(bar) - 1)  # a wrapped line could not be overwritten
        self._write(self.label[max(0, len(self.label) - room) :] + bar)

    def end(self, message: str) -> None:
        """Replace the bar with a message."""
        self._write(message)
        sys.stderr.write("\n")
        sys.stderr.flush()

    def refuse(self, error: SeiswidgetsError) -> None:
        """Replace the bar with an error, which may name the file itself."""
        message = error.text.rendered(OPTIONS)
        self.end(message if message.startswith(self.label) else f"{self.label}: {message}")

    def _write(self, text: str) -> None:
        sys.stderr.write(("\r" if self._shown else "") + text.ljust(self._shown))
        sys.stderr.flush()
        self._shown = len(text)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.stderr.write("\ninterrupted; the results written before are complete\n")
        sys.exit(130)
