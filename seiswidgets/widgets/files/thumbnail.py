"""A small picture of what a file holds, for who is about to open it."""

from base64 import b64encode
from collections.abc import Mapping

import numpy as np

from seiswidgets.errors import Cancelled, SeiswidgetsError
from seiswidgets.interaction.colour import Colouring, clip_limit, encode_png, resampled
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.opening import open_section
from seiswidgets.io.options import Progress

WIDEST, HIGHEST = 360, 160  # pixels
CLIP = 99  # percentile of the amplitudes at which the greys end
LARGEST = 32 * 2**20  # bytes of a file that must be read whole for its picture
FRAME = (
    f'<img alt="{{0}}" title="{{0}}" width="{WIDEST}" height="{HIGHEST}" style="max-width: 100%; display: block" '
    'src="data:image/png;base64,{1}">'
)


def thumbnail(info: SectionInfo, header_bytes: Mapping[str, int] | None, progress: Progress) -> str:
    """HTML of a picture, in greys without axes; empty where reading takes long, or something is wrong with the file.

    Of SEG-Y some traces of all are read, or a volume's middle inline, which is also offered first to be opened.

    Raises
    ------
    Cancelled
        If ``progress`` returned False.
    """
    if info.kind != "SEG-Y" and info.size > LARGEST:
        return ""
    shown, some = _some_of(info, header_bytes)
    try:
        section = open_section(info.path, dx=1, dz=1, z0=0, z_unit="m", progress=progress, **some)
    except Cancelled:
        raise
    except SeiswidgetsError:  # it is told when the file is opened, with the choices that this takes
        return ""
    size = np.minimum((WIDEST, HIGHEST), section.shape[::-1]).tolist()
    colouring = Colouring("greys", clip_limit(section, CLIP))
    picture = encode_png(colouring.levels(resampled(section.amplitude, tuple(size))), colouring.palette)
    return FRAME.format(shown, b64encode(picture).decode())


def _some_of(info, header_bytes):
    """What is shown of a file, in words, and the choices for that."""
    if info.kind != "SEG-Y":
        return "All of it", {}
    if info.inlines:
        inline = info.middle("inline")
        return f"Inline {inline}", {"inline": inline, "header_bytes": header_bytes}
    traces = info.shape[1]
    return "All of it", {"traces": range(0, traces, max(1, traces // WIDEST))}
