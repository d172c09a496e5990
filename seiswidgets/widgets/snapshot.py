"""Everything that two linked panes draw of a restoration, computed before anything is drawn."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.interaction.viewport import Viewport, Window
from seiswidgets.widgets.verdict import Verdict

MOST_SAMPLES_MOVING = 50_000  # of a moving section
RATIO_NODES, RATIO_NODES_MOVING = 60_000, 5_000  # nodes at which the area ratio is computed


@dataclass(frozen=True, eq=False)
class RatioMap:
    """Area ratios at the nodes of a regular lattice, NaN where there is no rock.

    Attributes
    ----------
    ratio : array, shape (h, w)
    window : tuple (x_min, x_max, z_min, z_max)
        Extent to the outer edges of the lattice's cells, in the section's units.
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
        The restored section.
    moving : bool
        True for a coarse picture, which others follow in quick succession.
    verdict : Verdict or None
        None for a preview, which is not checked, and if nothing has been restored.
    """

    restoration: Restoration
    section: Section
    moving: bool = False
    verdict: Verdict | None = None

    @classmethod
    def of(cls, restoration: Restoration, *, moving: bool = False) -> "Snapshot":
        """Compute the picture of a restoration: cubic, or if moving, linear and with fewer samples."""
        section = restoration.picture(order=1, cells=MOST_SAMPLES_MOVING) if moving else restoration.section
        checked = restoration.stages and not restoration.quick
        return cls(restoration, section, moving, Verdict.of(restoration) if checked else None)

    @cached_property
    def ratio_before(self) -> RatioMap:
        """Area ratios of all stages together on the present-day section, where each node stands for the same area."""
        points, shape, window = self._nodes(self.restoration.original)
        return RatioMap(self.restoration.area_ratio_at(points).reshape(shape), window)

    @cached_property
    def ratio_after(self) -> RatioMap:
        """Area ratios of all stages together on the restored section."""
        points, shape, window = self._nodes(self.section)
        return RatioMap(self.restoration.area_ratio_at(self.restoration.to_original(points)).reshape(shape), window)

    def _nodes(self, section: Section) -> tuple[np.ndarray, tuple[int, int], Window]:
        """Middles of the cells of a lattice that fills a section, with its shape and its window."""
        window = Viewport(section).whole
        spans = np.array([window[1] - window[0], window[3] - window[2]])
        cells = np.array(section.shape[::-1])
        share = min(1.0, np.sqrt((RATIO_NODES_MOVING if self.moving else RATIO_NODES) / cells.prod()))
        nx, nz = np.maximum(2, np.rint(cells * share)).astype(int).tolist()
        x = window[0] + (np.arange(nx) + 0.5) * spans[0] / nx
        z = window[2] + (np.arange(nz) + 0.5) * spans[1] / nz
        return np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2), (nz, nx), window
