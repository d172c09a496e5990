"""Export of a stage's mesh, with its deformation, to VTK files for ParaView and others."""

from numbers import Integral
from os import PathLike

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.files import atomic_write, import_optional, output_path
from seiswidgets.signatures import strict_keywords

SUFFIXES = (".vtu", ".vtk")


@strict_keywords
def save_mesh(restored: Restoration, path: str | PathLike, stage: int = -1) -> None:
    """Write the mesh before a stage, with the deformation by the stage, as VTK's .vtu or .vtk (with meshio).

    Points are (x, -z, 0) in metres of rock, so that the mesh is upright. Each has its ``displacement`` by the stage,
    in the same axes; warping the mesh by it shows the restored mesh. Each triangle has its ``area_ratio`` (area
    before over after), ``larger_stretch`` and ``smaller_stretch`` (length after over before).

    Parameters
    ----------
    restored : Restoration
    path : str or Path
        An existing file is replaced once the new one is complete.
    stage : int
        Index of the stage; the last one if left out.

    Raises
    ------
    SettingError
        If there is no such stage, the path has another suffix, or ``restored`` is not a Restoration.
    DataError
        If the file cannot be written, or meshio is not installed.
    """
    path = output_path(path, SUFFIXES)
    checked_kind(restored, Restoration, "restored")
    count = len(restored.stages)
    if not (isinstance(stage, Integral) and -count <= int(stage) < count):
        raise SettingError(f"there is no stage {stage!r} to save; there are {count}, counted from 0")
    meshio = import_optional("meshio", f"to write {path}")
    saved = restored.stages[stage]
    larger, smaller = saved.principal_stretches.T
    mesh = meshio.Mesh(
        _upright(saved.mesh.vertices),
        [("triangle", saved.mesh.triangles)],
        point_data={"displacement": _upright(saved.vertices - saved.mesh.vertices)},
        cell_data={"area_ratio": [saved.area_ratio], "larger_stretch": [larger], "smaller_stretch": [smaller]},
    )
    with atomic_write(path) as draft:
        mesh.write(draft)


def _upright(points: np.ndarray) -> np.ndarray:
    """Points (x, z), z down, in three dimensions with the second axis upwards; shape (n, 3)."""
    return np.column_stack([points[:, 0], 0 - points[:, 1], np.zeros(len(points))])
