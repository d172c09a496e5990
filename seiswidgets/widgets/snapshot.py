"""The state of a restoration that two linked panes show, computed before anything is drawn."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.interaction.viewport import Viewport
from seiswidgets.widgets.verdict import Verdict

RATIO_NODES, RATIO_NODES_PREVIEW = 60_000, 2_000  # nodes at which the area ratio is computed


@dataclass(frozen=True, eq=False)
class Snapshot:
    """A restoration as it is shown.

    Attributes
    ----------
    restoration : Restoration
    verdict : Verdict or None
        None for a preview, which is not checked, and if nothing has been restored.
    """

    restoration: Restoration
    verdict: Verdict | None = None

    @classmethod
    def of(cls, restoration: Restoration) -> "Snapshot":
        """Check a restoration, unless it is a preview, and compute its section."""
        if restoration.quick or not restoration.stages:
            return cls(restoration)
        snapshot = cls(restoration, Verdict.of(restoration))
        _ = snapshot.section  # here, and not when it is drawn
        return snapshot

    @property
    def is_preview(self) -> bool:
        """True for a restoration on a coarse mesh, which others follow in quick succession."""
        return self.restoration.quick

    @property
    def section(self) -> Section:
        """The restored section."""
        return self.restoration.section

    @cached_property
    def ratio(self) -> np.ndarray:
        """Area ratios of all stages together, at the nodes of a lattice over the present-day section; NaN outside."""
        section = self.restoration.original
        x_min, x_max, z_min, z_max = Viewport(section).whole
        cells = np.array(section.shape[::-1])
        nodes = RATIO_NODES_PREVIEW if self.is_preview else RATIO_NODES
        nx, nz = np.maximum(2, np.rint(cells * min(1.0, np.sqrt(nodes / cells.prod())))).astype(int).tolist()
        x = x_min + (np.arange(nx) + 0.5) * (x_max - x_min) / nx
        z = z_min + (np.arange(nz) + 0.5) * (z_max - z_min) / nz
        return self.restoration.area_ratio_at(np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2))
