"""The web page of a handout: one file with its data, its script and its style sheet."""

import json
from base64 import b64encode
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any
from zlib import compress

from seiswidgets.core.deformation import USUAL_SPAN
from seiswidgets.geology.pick_colours import PickColours
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.validation import checked_kind
from seiswidgets.interaction.colour import Colouring, RatioColouring, checked_span
from seiswidgets.io.exports.reports import origin_line, stage_tables
from seiswidgets.io.files import output_path, write_file
from seiswidgets.plot.frame import plot_frame
from seiswidgets.plot.panels import amplitude_limit
from seiswidgets.signatures import strict_keywords
from seiswidgets.widgets.assets import asset
from seiswidgets.widgets.handout.state import handout_state, rock_frame
from seiswidgets.widgets.severity import label
from seiswidgets.widgets.verdict import Verdict

SUFFIXES = (".html", ".htm")
PAGE = Path(__file__).with_name("page.html")
NOTHING_YET = Verdict("note", "Not restored", "Nothing has been restored yet.")


@strict_keywords
def save_html(
    restored: Restoration,
    path: str | PathLike,
    interpretation: Interpretation | None = None,
    *,
    title: str | None = None,
    colours: PickColours | None = None,
    clip: float = 99.0,
    cmap: str = "gray",
    span: float = USUAL_SPAN,
) -> None:
    """Write a restoration as a handout: one web page that works without a server, a network or Python.

    It shows the present-day and the restored section with linked cursors, zoom and pan, the time between the two with
    Play, the picks, the deformation with its histogram, and the verdict and the report. An existing file is replaced
    once the new one is complete. Large sections are averaged to 2 million samples, so that the file stays below about
    4 MB.

    Parameters
    ----------
    restored : Restoration
        Without stages, the page shows the section.
    path : path
        Ending in .html or .htm.
    interpretation : Interpretation, optional
        Picks to show; by default those that the stages were given.
    title : str, optional
        By default made from the section's name.
    colours : dict, optional
        Of the picks, as for ``plot.section``.
    clip : float
        Percentile of the absolute amplitudes at which the colours end, symmetrically about 0.
    cmap : str
        A matplotlib colour map.
    span : float
        The colours of the area ratio run from 1 / span to span.

    Raises
    ------
    SettingError
        If the path has another suffix, or an argument is out of its range.
    DataError
        If the file cannot be written.
    """
    path = output_path(path, SUFFIXES)
    checked_kind(restored, Restoration, "restored")
    picks = restored.interpretation if interpretation is None else interpretation
    checked_kind(picks, Interpretation, "interpretation")
    colouring = Colouring(cmap, amplitude_limit(restored.original, clip))
    state = handout_state(restored, picks, colours, colouring, RatioColouring(checked_span(span)))
    write_file(path, _page(restored, state, title).encode())


def _page(restored: Restoration, state: dict[str, Any], title: str | None) -> str:
    """Fill the template, which has a place in double braces for each part."""
    section = restored.original
    text, data = _packed(state)
    parts = {
        "title": escape(title or f"Restoration of {section.name or 'a section'}"),
        "credit": escape(f"Data: {section.credit}" if section.credit else ""),
        "verdict": _verdict(restored),
        "report": "\n".join(stage_tables(restored)) or "<p>There is no report before a restoration.</p>",
        "section": escape(repr(section)),
        "origin": escape(origin_line()),
        "ratio": f"{1 / plot_frame(section, [section], None, rock_frame(restored)).height_over_width:.4f}",
        "style": asset("handout.css"),
        "script": asset("handout.js"),
        "state": text,
        "data": data,
    }
    first, *rest = PAGE.read_text("utf-8").split("{{")
    return first + "".join(parts[name] + after for name, after in (part.split("}}", 1) for part in rest))


def _verdict(restored: Restoration) -> str:
    verdict = Verdict.of(restored) if restored.stages else NOTHING_YET
    rest = verdict.rest.replace("see Report", "see the report below")
    return f"{label(verdict.severity, verdict.title)} <span>{escape(f'{verdict.text} {rest}'.strip())}</span>"


def _packed(state: dict[str, Any]) -> tuple[str, str]:
    """JSON in which bytes are replaced by their position in one block, and the block, deflated, in base 64."""
    block = bytearray()

    def replaced(value: bytes) -> dict[str, list[int]]:
        block.extend(value)
        return {"bytes": [len(block) - len(value), len(value)]}

    text = json.dumps(state, allow_nan=False, default=replaced, separators=(",", ":")).replace("<", "\\u003c")
    return text, b64encode(compress(bytes(block), 9)).decode()
