"""All that two linked panes draw of a restoration, computed before anything is drawn."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.interaction.viewport import Viewport, Window
from seiswidgets.widgets.verdict import Verdict

PICTURE = 50_000  # samples of a picture while something moves
RATIOS, RATIOS_MOVING = 60_000, 5_000  # places at which the area ratio is taken


@dataclass(frozen=True, eq=False)
class RatioMap:
    """The area ratio at the nodes of a regular lattice, NaN where there is no rock.

    Attributes
    ----------
    ratio : array, shape (h, w)
    window : tuple (x_min, x_max, z_min, z_max)
        To the outer edges of the lattice's cells, in the section's units.
    """

    ratio: np.ndarray
    window: Window


@dataclass(frozen=True, eq=False)
class Snapshot:
    """One picture of a restoration.

    Attributes
    ----------
    restoration : Restoration
    section : Section
        The restored one.
    moving : bool
        Whether it is one of many in quick succession, and coarse.
    verdict : Verdict or None
        None of a quick look, which is not checked, and where nothing has been restored.
    """

    restoration: Restoration
    section: Section
    moving: bool = False
    verdict: Verdict | None = None

    @classmethod
    def of(cls, restoration: Restoration, *, moving: bool = False) -> "Snapshot":
        """The picture of a restoration: cubic, or while something moves, linear and of fewer samples."""
        section = restoration.picture(order=1, cells=PICTURE) if moving else restoration.section
        checked = restoration.stages and not restoration.quick
        return cls(restoration, section, moving, Verdict.of(restoration) if checked else None)

    @cached_property
    def ratio_before(self) -> RatioMap:
        """The area ratio of all stages together, on the section of today; each node stands for the same area."""
        points, shape, window = self._nodes(self.restoration.original)
        return RatioMap(self.restoration.area_ratio_at(points).reshape(shape), window)

    @cached_property
    def ratio_after(self) -> RatioMap:
        """The same on the restored section."""
        points, shape, window = self._nodes(self.section)
        return RatioMap(self.restoration.area_ratio_at(self.restoration.to_original(points)).reshape(shape), window)

    def _nodes(self, section):
        """The middles of cells that fill a section."""
        window = Viewport(section).whole
        spans = np.array([window[1] - window[0], window[3] - window[2]])
        cells = np.array(section.shape[::-1])
        share = min(1.0, np.sqrt((RATIOS_MOVING if self.moving else RATIOS) / cells.prod()))
        nx, nz = np.maximum(2, np.rint(cells * share)).astype(int).tolist()
        x = window[0] + (np.arange(nx) + 0.5) * spans[0] / nx
        z = window[2] + (np.arange(nz) + 0.5) * spans[1] / nz
        return np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2), (nz, nx), window
