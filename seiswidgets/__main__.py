"""What ``python -m seiswidgets`` does: restore sessions without a notebook."""

import argparse
import re
import shutil
import sys
import traceback
from pathlib import Path

from seiswidgets import __version__
from seiswidgets.errors import SeiswidgetsError
from seiswidgets.io.session.replay import output_names, replayed

WIDTH = 24  # of the bar
SHARE = 5  # iterations, after which half of a step is shown as done: nobody knows how many it will take
OPTION = re.compile(r"\b(allow_outside|allow_changed)=True\b")  # of a function, in what its errors advise

DESCRIPTION = """Restores the section of each session as its plan says, and writes into a folder:
<name>-restored.npz (the section), <name>-report.txt and <name>-report.json (how each step went).
Files of these names that are there already are replaced."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command; 0 if all went well, 1 if a session could not be restored, 2 if it was called wrongly."""
    asked = _parser().parse_args(arguments)
    try:
        asked.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        sys.stderr.write(f"{asked.out} cannot be made: {error.strerror}; choose another folder by --out\n")
        return 1
    done = [
        _restored(path, name, asked) for path, name in zip(asked.sessions, output_names(asked.sessions), strict=True)
    ]
    return 0 if all(done) else 1


def _parser():
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
        "--out", type=Path, required=True, metavar="DIR", help="folder for the results; made if need be"
    )
    restore.add_argument(
        "--allow-outside", action="store_true", help="let a session open a section that lies outside its own folder"
    )
    restore.add_argument(
        "--allow-changed",
        action="store_true",
        help="restore even if the section is not the one the session was made on",
    )
    return parser


def _restored(path, name, asked):
    """Restore one session; whether that went well."""
    bar = Bar(str(path))
    try:
        replay = replayed(
            path,
            asked.out,
            name,
            bar.show,
            allow_outside=asked.allow_outside,
            allow_changed=asked.allow_changed,
        )
    except SeiswidgetsError as error:
        message = OPTION.sub(lambda match: f"--{match[1].replace('_', '-')}", str(error))
        bar.end(message if message.startswith(str(path)) else f"{path}: {message}")
        return False
    except Exception as error:  # noqa: BLE001 - a fault of ours in one session must not keep the others from theirs
        bar.end(f"{path}: {error!r}, which is a fault of seiswidgets; please report it with the lines below")
        traceback.print_exc()
        return False
    stages = replay.restored.stages
    settled = "" if all(stage.report.converged for stage in stages) else ", NOT all settled"
    bar.end(f"{path}: {len(stages)} step{'' if len(stages) == 1 else 's'}{settled}, in {replay.files[1]}")
    for problem in replay.session.problems:
        sys.stderr.write(f"{path}: left out: {problem}\n")
    return True


class Bar:
    """A line on stderr that fills while a session is restored; where nobody watches, only its end is written."""

    def __init__(self, label):
        self.label, self.shown = label, 0

    def show(self, step: int, steps: int, iteration: int) -> None:
        """Show that an iteration of a step is done; both counted from 1."""
        if not sys.stderr.isatty():
            return
        filled = round(WIDTH * (step - 1 + iteration / (iteration + SHARE)) / steps)
        bar = f" [{'#' * filled:<{WIDTH}}] step {step} of {steps}, iteration {iteration}"
        room = max(0, shutil.get_terminal_size().columns - len(bar) - 1)  # a longer line would not be written over
        self._write(self.label[max(0, len(self.label) - room) :] + bar)

    def end(self, message: str) -> None:
        """Leave a message where the bar was."""
        self._write(message)
        sys.stderr.write("\n")
        sys.stderr.flush()

    def _write(self, text):
        sys.stderr.write(("\r" if self.shown else "") + text.ljust(self.shown))
        sys.stderr.flush()
        self.shown = len(text)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.stderr.write("\nstopped; what was restored before is complete\n")
        sys.exit(130)
