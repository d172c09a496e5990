"""The mesh of a stage, with what was done to it, for ParaView and other readers of VTK's files."""

from numbers import Integral
from os import PathLike

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.files import checked_path, required, written

SUFFIXES = (".vtu", ".vtk")


def save_mesh(restored: Restoration, path: str | PathLike, stage: int = -1):
    """Write the mesh of a stage as it was before it, with the deformation, as VTK's .vtu or .vtk (by meshio).

    Points are (x, -z, 0) in metres of rock, so that it stands upright. Each has its ``displacement`` by the stage, in
    the same axes: to warp the mesh by it shows it restored. Each triangle has its ``area_ratio`` (initial over final),
    ``larger_stretch`` and ``smaller_stretch`` (length after over before).

    Parameters
    ----------
    restored : Restoration
    path : str or Path
        A file that is there is replaced, but only when the new one is whole.
    stage : int
        Which one, counted from 0; the last one if left out.

    Raises
    ------
    SettingError
        If there is no such stage, the path ends otherwise, or it is no restoration.
    DataError
        If the file cannot be written, or meshio is not installed.
    """
    path = checked_path(path, SUFFIXES)
    checked_kind(restored, Restoration, "restored")
    count = len(restored.stages)
    if not (isinstance(stage, Integral) and -count <= stage < count):
        raise SettingError(f"there is no stage {stage!r} to save; there are {count}, counted from 0")
    meshio = required("meshio", f"to write {path}")
    done = restored.stages[stage]
    larger, smaller = done.principal_stretches.T
    mesh = meshio.Mesh(
        _upright(done.mesh.vertices),
        [("triangle", done.mesh.triangles)],
        point_data={"displacement": _upright(done.vertices - done.mesh.vertices)},
        cell_data={"area_ratio": [done.area_ratio], "larger_stretch": [larger], "smaller_stretch": [smaller]},
    )
    with written(path) as draft:
        mesh.write(draft)


def _upright(points):
    """Points of a section, z down, in three dimensions, the second upwards; shape (n, 3)."""
    return np.column_stack([points[:, 0], 0 - points[:, 1], np.zeros(len(points))])
