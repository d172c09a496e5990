"""Position and scale of a scanned picture, from two points with known values on each of its axes; and cropping."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.ndimage import map_coordinates

from seiswidgets.errors import Keyword, SettingError
from seiswidgets.geology.validation import finite_number

AXES = {"x": "horizontal", "z": "vertical"}
ROTATED = 1.0  # degrees of an axis that are worth a word
EXAMPLE = '{"x": [(120, 40, 0), (1480, 40, 10000)], "z": [(118, 60, 0), (118, 800, 2000)]}'

Window = tuple[int, int, int, int]  # first and last column, first and last row
AxisPoint = tuple[float, float, float]  # column, row, value


@dataclass(frozen=True)
class Calibration:
    """Two points on each axis of a picture.

    Parameters
    ----------
    x, z : pair of (column, row, value)
        Pixels count from 0, at their centres, from the upper left corner; values are in the section's units.
    deskew : bool
        True to rotate and shear the picture until its axes are level and upright.

    Raises
    ------
    SettingError
        If two points or their values coincide, depths do not increase downwards, or the axes are parallel.
    """

    x: tuple[AxisPoint, AxisPoint]
    z: tuple[AxisPoint, AxisPoint]
    deskew: bool = False

    def __post_init__(self) -> None:
        for index, (name, axis) in enumerate(AXES.items()):
            first, last = getattr(self, name)
            if first[2] == last[2]:
                raise _refusal(f"two different values on the {axis} axis, but both are {first[2]:g}")
            if first[index] == last[index]:
                side = "left of" if name == "x" else "above"
                raise _refusal(f"two points on the {axis} axis, one {side} the other")
        (_, top, low), (_, bottom, high) = self.z
        if (high - low) / (bottom - top) < 0:
            raise _refusal("values on the vertical axis that increase downwards; enter heights with the other sign")
        if abs(np.linalg.det(self._units)) < 1e-6 * np.prod(np.hypot(*self._units)):
            raise _refusal("axes that cross, but they are parallel")

    @classmethod
    def of(cls, option: Mapping[str, Any]) -> "Calibration":
        """Make a calibration from the option of `open_section`; SettingError if it is none."""
        try:
            pairs = [(_axis_point(first), _axis_point(last)) for first, last in (option[name] for name in AXES)]
        except (KeyError, TypeError, ValueError):
            pairs = []
        if not pairs or set(option) - {*AXES, "deskew"}:
            raise SettingError(
                Keyword("calibration"),
                f" must have two points (column, row, value) on each axis, as in {EXAMPLE}, and may have "
                f'"deskew": True, but is {dict(option)!r}',
            )
        return cls(pairs[0], pairs[1], bool(option.get("deskew", False)))

    @property
    def rotation(self) -> float:
        """Largest angle between an axis and the picture's edge, in degrees, positive clockwise."""
        (across, down), (aside, depth) = self._units.T
        level = np.degrees(np.arctan2(down, across))
        upright = np.degrees(np.arctan2(-aside, depth))
        angles = [float((angle + 90) % 180 - 90) for angle in (level, upright)]
        return max(angles, key=abs)

    @property
    def spacing(self) -> tuple[float, float]:
        """Units of x for each column, and of z for each row; of x negative if it decreases to the right."""
        dx, dz = (1 / np.diag(self._units)).tolist()
        return dx, dz

    @property
    def _units(self) -> np.ndarray:
        """Columns and rows for each unit of x, and of z: the columns of a matrix of shape (2, 2)."""
        pairs = (np.array(getattr(self, name)) for name in AXES)
        return np.column_stack([(last - first)[:2] / (last - first)[2] for first, last in pairs])

    @property
    def _origin(self) -> np.ndarray:
        """Column and row at which x and z are 0, shape (2,)."""
        (p, v), (q, w) = ((np.array(pair[0][:2]), pair[0][2]) for pair in (self.x, self.z))
        along_x, along_z = self._units.T
        at_x, at_z = p - v * along_x, q - w * along_z
        shares = np.linalg.solve(np.column_stack([along_z, -along_x]), at_x - at_z)
        return np.asarray(at_x - shares[0] * along_z)

    def grid(self, window: Window) -> tuple[dict[str, float], tuple[int, int]]:
        """Spacing and origin by name, and the shape (nz, nx), of a window of a picture."""
        left, right, top, bottom = window
        if self.deskew:
            return self._level_grid(window)
        dx, dz = self.spacing
        (column, _, x), (_, row, z) = self.x[0], self.z[0]
        first = left if dx > 0 else right
        axes = {"x0": x + (first - column) * dx, "dx": abs(dx), "z0": z + (top - row) * dz, "dz": dz}
        return axes, (bottom - top + 1, right - left + 1)

    def _level_grid(self, window: Window) -> tuple[dict[str, float], tuple[int, int]]:
        """Level lines and upright traces, as far apart as the pixels along the axes, between the middles of edges."""
        left, right, top, bottom = window
        middle, centre = (left + right) / 2, (top + bottom) / 2
        edges = np.array([(left, centre), (right, centre), (middle, top), (middle, bottom)])
        values = np.linalg.solve(self._units, (edges - self._origin).T)
        (x_min, x_max), (z_min, z_max) = np.sort(values[0, :2]).tolist(), np.sort(values[1, 2:]).tolist()
        dx, dz = (1 / np.hypot(*self._units)).tolist()
        shape = round((z_max - z_min) / dz) + 1, round((x_max - x_min) / dx) + 1
        return {"x0": x_min, "dx": dx, "z0": z_min, "dz": dz}, shape

    def calibrated(self, amplitude: np.ndarray, window: Window) -> tuple[np.ndarray, dict[str, float]]:
        """Amplitudes of a window of a picture, and their spacing and origin by name."""
        left, right, top, bottom = window
        axes, (nz, nx) = self.grid(window)
        if not self.deskew:
            part = amplitude[top : bottom + 1, left : right + 1]
            return part if self.spacing[0] > 0 else part[:, ::-1], axes
        x, z = np.meshgrid(axes["x0"] + axes["dx"] * np.arange(nx), axes["z0"] + axes["dz"] * np.arange(nz))
        columns, rows = self._origin[:, None] + self._units @ np.stack([x.ravel(), z.ravel()])
        moved = map_coordinates(amplitude, [rows, columns], order=1, cval=np.nan, output=np.float32)
        return moved.reshape(nz, nx), axes


def checked_window(crop: Sequence[float] | None, shape: tuple[int, int]) -> Window:
    """The columns and rows of a picture that are kept; all of them if ``crop`` is None.

    Raises
    ------
    SettingError
        If it is not two columns and two rows of the picture, each smaller one first.
    """
    rows, columns = shape
    if crop is None:
        return 0, columns - 1, 0, rows - 1
    wrong = SettingError(
        Keyword("crop"),
        f" must be the first and last column and the first and last row to keep, counted from 0, of {columns} columns "
        f"and {rows} rows, at least two of each, but is {crop!r}",
    )
    try:
        left, right, top, bottom = (int(pixel) for pixel in crop)
        is_whole = [left, right, top, bottom] == [float(pixel) for pixel in crop]
    except (TypeError, ValueError, OverflowError):
        raise wrong from None
    if not (is_whole and 0 <= left < right < columns and 0 <= top < bottom < rows):
        raise wrong
    return left, right, top, bottom


def _axis_point(point: Sequence[float]) -> AxisPoint:
    column, row, value = (finite_number("calibration", part) for part in point)
    return column, row, value


def _refusal(wanted: str) -> SettingError:
    return SettingError(Keyword("calibration"), f" needs {wanted}")
