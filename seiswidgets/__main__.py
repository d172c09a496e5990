"""Command line ``python -m seiswidgets``: restores sessions without a notebook."""

import argparse
import shutil
import sys
import traceback
from pathlib import Path

from seiswidgets import __version__
from seiswidgets.errors import SeiswidgetsError, Text
from seiswidgets.geology.findings import worst_first
from seiswidgets.io.session.replay import Replay, output_names, replay_session

BAR_WIDTH = 24
HALF = 5  # iterations after which half of a step is shown as done: nobody knows how many it will take
OPTIONS = {"allow_outside": "--allow-outside", "allow_changed": "--allow-changed"}  # as errors name them

DESCRIPTION = """Restores the section of each session as its plan says, and writes into a folder:
<name>-restored.npz (the section), <name>-report.txt and <name>-report.json (a report of each step),
and with --handout <name>-handout.html (a web page to look at without Python).
Existing files of these names are replaced."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return 0 if all went well, 1 if a session could not be restored, 2 if it was called wrongly."""
    options = _parser().parse_args(arguments)
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
    restore.add_argument("sessions", nargs="+", type=Path, metavar="session.json", help="a saved session")
    restore.add_argument(
        "--out", type=Path, required=True, metavar="DIR", help="folder for the results; created if necessary"
    )
    restore.add_argument("--handout", action="store_true", help="write a web page with both sections, too")
    restore.add_argument(
        OPTIONS["allow_outside"],
        action="store_true",
        help="allow a session to open a section that lies outside the session's folder",
    )
    restore.add_argument(
        OPTIONS["allow_changed"],
        action="store_true",
        help="restore even if the section is not the one that the session was made on",
    )
    return parser


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
        message = error.text.rendered(OPTIONS)
        bar.end(message if message.startswith(str(path)) else f"{path}: {message}")
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


class ProgressBar:
    """A line on stderr that fills while a session is restored; without a terminal only its end is written."""

    def __init__(self, label: str) -> None:
        self.label, self._shown = label, 0

    def show(self, step: int, steps: int, iteration: int) -> None:
        """Show that an iteration of a step is done; both are counted from 1."""
        if not sys.stderr.isatty():
            return
        filled = round(BAR_WIDTH * (step - 1 + iteration / (iteration + HALF)) / steps)
        bar = f" [{'#' * filled:<{BAR_WIDTH}}] step {step} of {steps}, iteration {iteration}"
        room = max(0, shutil.get_terminal_size().columns - len(bar) - 1)  # a wrapped line could not be overwritten
        self._write(self.label[max(0, len(self.label) - room) :] + bar)

    def end(self, message: str) -> None:
        """Replace the bar with a message."""
        self._write(message)
        sys.stderr.write("\n")
        sys.stderr.flush()

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
