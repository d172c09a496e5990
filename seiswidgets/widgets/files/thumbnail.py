"""A small picture of a section file, shown before it is opened."""

from base64 import b64encode
from collections.abc import Mapping
from typing import Any

import numpy as np

from seiswidgets.errors import Cancelled, SeiswidgetsError
from seiswidgets.interaction.colour import Colouring, clip_limit, encode_png, resampled
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.opening import open_section
from seiswidgets.io.options import Progress

WIDEST, HIGHEST = 360, 160  # pixels
CLIP = 99  # percentile of the absolute amplitudes that is shown black or white
LARGEST = 32 * 2**20  # bytes of a file that must be read completely
FRAME = (
    f'<img alt="{{0}}" title="{{0}}" width="{WIDEST}" height="{HIGHEST}" style="max-width: 100%; display: block" '
    'src="data:image/png;base64,{1}">'
)


def thumbnail(info: SectionInfo, corrections: Mapping[str, Any], progress: Progress) -> str:
    """HTML of a picture in greys, without axes; empty if reading takes long or fails.

    ``corrections`` are keywords that correct the headers of SEG-Y.

    A SEG-Y line is decimated; a volume is shown by its middle inline, which is also the one offered for opening.

    Raises
    ------
    Cancelled
        If ``progress`` returned False.
    """
    if info.kind != "SEG-Y" and info.size > LARGEST:
        return ""
    caption, keywords = _selection(info)
    try:
        section = open_section(info.path, dx=1, dz=1, z0=0, z_unit="m", progress=progress, **keywords, **corrections)
    except Cancelled:
        raise
    except SeiswidgetsError:  # shown when the user opens the file
        return ""
    size = np.minimum((WIDEST, HIGHEST), section.shape[::-1]).tolist()
    colouring = Colouring("greys", clip_limit(section, CLIP))
    picture = encode_png(colouring.levels(resampled(section.amplitude, tuple(size))), colouring.palette)
    return FRAME.format(caption, b64encode(picture).decode())


def _selection(info: SectionInfo) -> tuple[str, dict[str, Any]]:
    """Part of a file that is shown: its caption, and the keywords of `open_section` that select it."""
    if info.kind != "SEG-Y":
        return "The whole line", {}
    if info.inlines:
        inline = info.middle("inline")
        return f"Inline {inline}", {"inline": inline, "offset": info.offsets and info.offsets[0]}
    traces = info.shape[1]
    return "The whole line", {"traces": range(0, traces, max(1, traces // WIDEST))}
