"""Reports of a restoration, as JSON for programs and as a web page for people."""

import json
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import asdict
from datetime import datetime
from html import escape
from io import BytesIO
from math import isfinite
from os import PathLike
from typing import Any

from seiswidgets import __version__
from seiswidgets.geology.pick_colours import PickColours
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.files import output_path, write_file
from seiswidgets.signatures import strict_keywords

SUFFIXES = (".json", ".html")
STYLE = (
    "body { font-family: sans-serif; margin: 2em auto; max-width: 60em } th { padding-right: 1em } img { width: 100% }"
)
DPI = 130  # of the figure in a page
SECTION_FIELDS = ("name", "credit", "shape", "extent", "x_unit", "z_unit", "velocity")


@strict_keywords
def save_report(
    restored: Restoration,
    path: str | PathLike,
    interpretation: Interpretation | None = None,
    *,
    colours: PickColours | None = None,
    span: float | None = None,
) -> None:
    """Write the reports of all stages, as JSON (.json) or as a web page with a figure that needs no network (.html).

    Both hold the weights, the held point, the date and the version.

    Parameters
    ----------
    restored : Restoration
    path : path
    interpretation : Interpretation, optional
        Picks to draw in the figure.
    colours, span
        As for `plot.workflow`.

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
        text = report_as_html(restored, interpretation, colours, span)
    write_file(path, text.encode())


def report_as_dict(restored: Restoration) -> dict[str, Any]:
    """The section and the report of each stage, as dictionaries, lists, numbers and strings only.

    The keys are the names of the fields of ``Report``, and "verdict"; numbers that are not finite become None.
    """
    section = {name: getattr(restored.original, name) for name in SECTION_FIELDS}
    stages = [
        {
            "verdict": stage.report.verdict,
            **asdict(stage.report),
            "weights": asdict(stage.weights) if stage.weights else None,
            "fixed": stage.fixed,
            "pins": stage.pins,
            "regional": stage.regional,
        }
        for stage in restored.stages
    ]
    origin = {"seiswidgets": __version__, "written": datetime.now().astimezone().isoformat(timespec="seconds")}
    report: dict[str, Any] = _plain({**origin, "section": section, "verdict": restored.verdict, "stages": stages})
    return report


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return float(value) if isfinite(value) else None
    return value


def report_as_html(
    restored: Restoration,
    interpretation: Interpretation | None = None,
    colours: PickColours | None = None,
    span: float | None = None,
) -> str:
    """A web page with a figure, and a table for each stage; names of picks and files are escaped."""
    section = restored.original
    title = escape(section.name or "section")
    figure = [_figure(restored, interpretation, colours, span)] if restored.stages else []
    return "\n".join(
        [
            '<!DOCTYPE html>\n<html lang="en">\n<meta charset="utf-8">',
            f"<title>Restoration of {title}</title>",
            f"<style>{STYLE}</style>",
            f"<h1>Restoration of {title}</h1>\n<p>{escape(restored.verdict)}</p>",
            *figure,
            f"<p>{escape(repr(section))}</p>",
            *stage_tables(restored),
            f"<p>{origin_line()}</p>\n</html>\n",
        ]
    )


def stage_tables(restored: Restoration) -> list[str]:
    """HTML of the report of each stage: a heading, a table, and the choices that it was made with."""
    return [
        f"<h2>Stage {count}</h2>\n{stage.report._repr_html_()}\n<p>{escape(_choices(stage, restored.original))}</p>"
        for count, stage in enumerate(restored.stages, 1)
    ]


def origin_line() -> str:
    """One sentence on the version and the time at which a page was written."""
    return (
        f"Restored with seiswidgets {__version__} and written on {datetime.now():%d %B %Y at %H:%M}: an "
        "interpretation, not a measurement."
    )


def _choices(stage: Stage, section: Section) -> str:
    """Weights of a stage and what it held, in a sentence each."""
    weights = asdict(stage.weights) if stage.weights else {}
    listed = ", ".join(f"{name.replace('_', ' ')} {value:g}" for name, value in weights.items())
    texts = [f"Weights: {listed}."] if listed else []
    if stage.kind == "unfault":
        held = [f"the block at {section.where(stage.fixed)}"] if stage.fixed else []
        held += [f"a pin at {section.where(pin)}" for pin in stage.pins]
        held += ["a regional level"] if stage.regional is not None else []
        texts.append(f"Held: {', '.join(held) or 'nothing'}.")
    return " ".join(texts)


def _figure(
    restored: Restoration, interpretation: Interpretation | None, colours: PickColours | None, span: float | None
) -> str:
    """The figure of the whole restoration, as an image in the page."""
    from matplotlib.figure import Figure  # slow to import, and only a page needs it

    from seiswidgets import plot

    drawing = plot.workflow(restored, interpretation, colours=colours, span=span, figure=Figure())
    file = BytesIO()
    drawing.savefig(file, format="png", dpi=DPI)
    steps = escape(stages_as_line(restored))
    return f'<img src="data:image/png;base64,{b64encode(file.getvalue()).decode()}" alt="The restoration: {steps}">'


def stages_as_line(restored: Restoration) -> str:
    """All stages in one line, each with its picks."""
    return "; ".join(f"{stage.kind} {', '.join(stage.report.picks)}" for stage in restored.stages)
