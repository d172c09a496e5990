"""Reports of a restoration, as JSON for programs and as a web page for people."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from html import escape
from math import isfinite
from os import PathLike
from typing import Any

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.files import output_path, write_file
from seiswidgets.signatures import strict_keywords

SUFFIXES = (".json", ".html")
STYLE = "body { font-family: sans-serif; max-width: 60em; margin: 2em auto } th { padding-right: 1em }"
SECTION_FIELDS = ("name", "credit", "shape", "extent", "x_unit", "z_unit", "velocity")


@strict_keywords
def save_report(restored: Restoration, path: str | PathLike) -> None:
    """Write the reports of all stages, as JSON (.json) or as a web page that needs no network (.html).

    Raises
    ------
    SettingError
        If the path has another suffix, or ``restored`` is not a Restoration.
    DataError
        If the file cannot be written.
    """
    path = output_path(path, SUFFIXES)
    checked_kind(restored, Restoration, "restored")
    if path.suffix.lower() == ".json":
        text = json.dumps(report_as_dict(restored), indent=2, allow_nan=False, ensure_ascii=False)
    else:
        text = report_as_html(restored)
    write_file(path, text.encode())


def report_as_dict(restored: Restoration) -> dict[str, Any]:
    """The section and the report of each stage, as dictionaries, lists, numbers and strings only.

    The keys are the names of the fields of ``Report``, and "verdict"; numbers that are not finite become None.
    """
    section = {name: getattr(restored.original, name) for name in SECTION_FIELDS}
    stages = [{"verdict": stage.report.verdict, **asdict(stage.report)} for stage in restored.stages]
    report: dict[str, Any] = _plain({"section": section, "verdict": restored.verdict, "stages": stages})
    return report


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return float(value) if isfinite(value) else None
    return value


def report_as_html(restored: Restoration) -> str:
    """A web page with a table for each stage; names of picks and files are escaped."""
    section = restored.original
    title = escape(section.name or "section")
    reports = (stage.report._repr_html_() for stage in restored.stages)
    tables = [f"<h2>Stage {count}</h2>\n{report}" for count, report in enumerate(reports, 1)]
    return "\n".join(
        [
            '<!DOCTYPE html>\n<html lang="en">\n<meta charset="utf-8">',
            f"<title>Restoration of {title}</title>",
            f"<style>{STYLE}</style>",
            f"<h1>Restoration of {title}</h1>\n<p>{escape(restored.verdict)}</p>",
            f"<p>{escape(repr(section))}</p>",
            *tables,
            "<p>Restored with seiswidgets: an interpretation, not a measurement.</p>\n</html>\n",
        ]
    )


def stages_as_line(restored: Restoration) -> str:
    """All stages in one line, each with its picks."""
    return "; ".join(f"{stage.kind} {', '.join(stage.report.picks)}" for stage in restored.stages)
