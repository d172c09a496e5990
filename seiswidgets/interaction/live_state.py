"""Conversion of sections and restorations to what the browser draws pictures from: a texture, and a chain of meshes."""

from typing import Any

import numpy as np

from seiswidgets.core.point_location import TOLERANCE
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage
from seiswidgets.interaction.colour import Colouring, RatioColouring, clip_limit, resampled

MOST_SAMPLES = 16_000_000  # of a texture: 32 MB in the browser
OVERVIEW_SAMPLES = 40_000  # of the texture that is sent first
TILE_SAMPLES = 128_000  # sent at a time: 256 kB
NO_DATA = -32768
HEADROOM = 16.0  # amplitudes end at this multiple of their 99th percentile: a spike must not coarsen all others

State = dict[str, Any]  # as JSON, with bytes


class TextureSource:
    """The amplitudes of a section as 16-bit integers, row by row, to be sent in tiles.

    Parameters
    ----------
    section : Section
    most : int
        Largest number of samples.
    scale : float, optional
        Amplitude of the integer 1; by default the finest that holds all amplitudes, but for spikes.

    Attributes
    ----------
    shape : tuple (nz, nx)
        Of the texture: that of the section, unless this is too large.
    rows : int
        Number of rows in a tile.
    """

    def __init__(self, section: Section, most: int = MOST_SAMPLES, scale: float | None = None):
        limit = HEADROOM * clip_limit(section, 99.0)
        self.section, self.scale = section, scale or min(_largest(section.amplitude), limit) / 32767
        self.shape = _reduced(section.shape, most)
        self.rows = max(1, TILE_SAMPLES // self.shape[1])
        self._averaged = section.amplitude if self.shape == section.shape else self._resampled(self.shape)

    @property
    def overview(self) -> State:
        """A coarse texture: its number of samples and traces, and its integers."""
        shape = _reduced(self.section.shape, OVERVIEW_SAMPLES)
        return {"shape": list(shape), "data": self._integers(self._resampled(shape))}

    @property
    def whole(self) -> State:
        """The whole texture, as the overview."""
        return {"shape": list(self.shape), "data": self._integers(self._averaged)}

    @property
    def tiles(self) -> int:
        """Number of tiles."""
        return -(-self.shape[0] // self.rows)

    def tile(self, index: int) -> bytes:
        """The integers of a band of rows."""
        return self._integers(self._averaged[index * self.rows : (index + 1) * self.rows])

    def _resampled(self, shape: tuple[int, int]) -> np.ndarray:
        return self.section.amplitude if shape == self.section.shape else resampled(self.section.amplitude, shape[::-1])

    def _integers(self, amplitude: np.ndarray) -> bytes:
        known = np.isfinite(amplitude)
        scaled = np.clip(np.where(known, amplitude, 0) / self.scale, -32767, 32767)
        return np.where(known, np.rint(scaled), NO_DATA).astype("<i2").tobytes()


def grid_state(section: Section) -> State:
    """The first sample and the distance between samples, in the section's units and in metres, and their number."""
    step = np.array([section.dx, section.dz])
    return {
        "origin": [section.x0, section.z0],
        "step": step.tolist(),
        "metres": (section.metres * step).tolist(),
        "shape": list(section.shape),
        "tolerance": TOLERANCE,
    }


def stage_state(section: Section, stage: Stage, quick: bool = False) -> State:
    """The vertices of a stage's mesh before and after it, in samples of the section.

    Vertices are 32-bit numbers; of a quick preview, 16-bit integers to be scaled and shifted.
    """
    first, step = np.array([section.x0, section.z0]), np.array([section.dx, section.dz])
    shapes = [(section.from_rock(vertices) - first) / step for vertices in (stage.mesh.vertices, stage.vertices)]
    low = np.min(shapes, axis=(0, 1)) if quick else np.zeros(2)
    scale = (np.max(shapes, axis=(0, 1)) - low) / 65535 if quick else np.ones(2)
    before, after = (
        (np.rint((shape - low) / scale).astype("<u2") if quick else shape.astype("<f4")).tobytes() for shape in shapes
    )
    return {
        "before": before,
        "after": after,
        "low": low.tolist(),
        "scale": scale.tolist(),
        "quick": quick,
    }


def triangles_state(stage: Stage) -> State:
    """The triangles of a stage's mesh, which stay the same while its vertices move."""
    bits = 16 if len(stage.vertices) <= 1 << 16 else 32
    return {"triangles": stage.mesh.triangles.astype(f"<u{bits // 8}").tobytes(), "bits": bits}


def colours_state(colouring: Colouring, scale: float) -> State:
    """The colours of integers that stand for multiples of ``scale``."""
    return {"palette": colouring.palette.tobytes(), "factor": 127 * scale / colouring.limit}


def deformation_state(colouring: RatioColouring, palette: np.ndarray, opacity: float) -> State:
    """The colours of area ratios."""
    return {"palette": palette.tobytes(), "span": colouring.span, "opacity": opacity}


def _largest(amplitude: np.ndarray) -> float:
    """The largest absolute amplitude; 1 if all are 0."""
    return float(max(np.nanmax(amplitude), -np.nanmin(amplitude))) or 1.0


def _reduced(shape: tuple[int, int], most: int) -> tuple[int, int]:
    """Shape of the same proportions with ``most`` samples or fewer."""
    share = min(1.0, np.sqrt(most / (shape[0] * shape[1])))
    return max(1, int(shape[0] * share)), max(1, int(shape[1] * share))
