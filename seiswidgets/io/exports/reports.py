"""What a restoration has achieved, as JSON for programs and as a page for people."""

import json
from dataclasses import asdict
from html import escape
from math import isfinite
from os import PathLike

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.files import checked_path, written

SUFFIXES = (".json", ".html")
STYLE = "body { font-family: sans-serif; max-width: 60em; margin: 2em auto } th { padding-right: 1em }"


def save_report(restored: Restoration, path: str | PathLike):
    """Write the reports of all stages, as JSON (.json) or as a page that needs no network (.html).

    Raises
    ------
    SettingError
        If the path ends otherwise, or it is no restoration.
    DataError
        If the file cannot be written.
    """
    path = checked_path(path, SUFFIXES)
    checked_kind(restored, Restoration, "restored")
    if path.suffix.lower() == ".json":
        text = json.dumps(report_as_dict(restored), indent=2, allow_nan=False, ensure_ascii=False)
    else:
        text = report_as_html(restored)
    with written(path) as draft:
        draft.write_text(text, encoding="utf-8")


def report_as_dict(restored: Restoration) -> dict:
    """The section and the report of each stage, in dictionaries, lists, numbers and strings alone.

    Names as those of ``Report``; what is not finite is None.
    """
    section = restored.original
    shown = ("name", "credit", "shape", "extent", "x_unit", "z_unit", "velocity")
    about = {name: getattr(section, name) for name in shown}
    return _plain({"section": about, "stages": [asdict(stage.report) for stage in restored.stages]})


def _plain(value):
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return float(value) if isfinite(value) else None
    return value


def report_as_html(restored: Restoration) -> str:
    """A page with a table for each stage; names of picks and files are text in it, whatever they hold."""
    section = restored.original
    title = escape(section.name or "section")
    reports = (stage.report._repr_html_() for stage in restored.stages)
    tables = [f"<h2>Stage {number}</h2>\n{report}" for number, report in enumerate(reports, 1)]
    return "\n".join(
        [
            '<!DOCTYPE html>\n<html lang="en">\n<meta charset="utf-8">',
            f"<title>Restoration of {title}</title>",
            f"<style>{STYLE}</style>",
            f"<h1>Restoration of {title}</h1>\n<p>{escape(repr(section))}</p>",
            *(tables or ["<p>Nothing has been restored yet.</p>"]),
            "<p>Restored by seiswidgets: an interpretation, not a measurement.</p>\n</html>\n",
        ]
    )


def stages_in_words(restored: Restoration) -> str:
    """What was done, in one line."""
    return "; ".join(f"{stage.kind} {', '.join(stage.report.picks)}" for stage in restored.stages)
