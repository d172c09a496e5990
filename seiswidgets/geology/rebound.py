"""The rise of the crust after rock was taken away, and its fall under rock that was put back."""

import time
from dataclasses import dataclass

import numpy as np

from seiswidgets.core.solver import Progress
from seiswidgets.geology.closed_form import ClosedForm
from seiswidgets.geology.decompaction import ColumnCompaction
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.flexure import GRAVITY, Isostasy
from seiswidgets.geology.report import Observations
from seiswidgets.geology.stage import ISOSTASY, Stage
from seiswidgets.geology.stratified_rock import StratifiedRock

CELLS, QUICK_CELLS = 512, 128  # along the section, in which loads are weighed; for a preview


@dataclass(frozen=True, eq=False)
class Weighing:
    """Weight of the rock and the water above it, in cells along a section.

    Attributes
    ----------
    model : Isostasy
    x_min, x_max, bottom : float
        Ends of the section, and the depth down to which it is weighed, in metres of rock.
    cells : int
    """

    model: Isostasy
    x_min: float
    x_max: float
    bottom: float
    cells: int

    @property
    def step(self) -> float:
        """Width of a cell, in metres."""
        return (self.x_max - self.x_min) / self.cells

    @property
    def x(self) -> np.ndarray:
        """Middles of the cells, shape (n,)."""
        return self.x_min + (np.arange(self.cells) + 0.5) * self.step

    def load(self, rock: StratifiedRock) -> np.ndarray:
        """Weight of what lies in each cell, in Pa; that of the nearest cells where much of the rock is missing."""
        columns = rock.layers.columns(self.x).down_to(self.bottom)
        compaction = ColumnCompaction.of(columns, rock.memory, rock.stratigraphy)
        grains = np.array([*(layer.rock.grain_density for layer in rock.stratigraphy.layers), 0.0])[columns.layer]
        pores, is_rock = compaction.pores(), columns.layer >= 0
        mass = (grains * (columns.thickness - pores) + self.model.water_density * pores * is_rock).sum(axis=1)
        if self.model.sea_level is not None:
            level = self.model.sea_level * float(rock.picks.original.metres[1])
            mass += self.model.water_density * np.maximum(columns.surface - level, 0)
        known = columns.is_whole & (is_rock & (columns.thickness > 0)).any(axis=1)
        if not known.any():
            return GRAVITY * mass
        return np.asarray(GRAVITY * np.interp(self.x, self.x[known], mass[known]))


def isostasy_stage(
    domain: RestorationDomain,
    model: Isostasy,
    before: StratifiedRock,
    after: StratifiedRock,
    beyond: str,
    progress: Progress | None = None,
) -> Stage:
    """Move each column as far as the crust sinks under the change of load between two states.

    Parameters
    ----------
    domain : RestorationDomain
    model : Isostasy
    before, after : StratifiedRock
        Before rock was taken away or put back, and now.
    beyond : str
        See `Isostasy.deflection`.
    progress : callable, optional
    """
    began = time.perf_counter()
    x_min, _, x_max, bottom = domain.outline.bounds
    bottom = max(bottom, before.picks.domain.outline.bounds[3])
    weighing = Weighing(model, x_min, x_max, bottom, QUICK_CELLS if domain.quick else CELLS)
    sunk = model.deflection(weighing.load(after) - weighing.load(before), weighing.step, beyond)
    mesh = domain.mesh({})
    vertices = mesh.vertices + np.outer(np.interp(mesh.vertices[:, 0], weighing.x, sunk), (0, 1))

    def observe() -> Observations:
        rises = f"from {-sunk.max():.4g} to {-sunk.min():.4g} m, {-sunk.mean():.4g} m on average"
        kind = f"elastic thickness {model.elastic_thickness:g} m" if model.elastic_thickness else "Airy"
        return Observations(details=(("rise of the crust", f"{rises} ({kind}, beyond the section {beyond})"),))

    return ClosedForm(ISOSTASY, (), domain, progress).stage(mesh, vertices, observe, (), began)
