"""Sections and deformation as labelled arrays of xarray, which can write NetCDF."""

from collections.abc import Hashable
from typing import TYPE_CHECKING, Any, TypedDict, Unpack, overload

import numpy as np

from seiswidgets.errors import Keyword, SectionError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import METRES, SECONDS, Section
from seiswidgets.geology.tables import Table
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.exports.reports import stages_as_line
from seiswidgets.io.exports.tables import table_dataset
from seiswidgets.io.files import import_optional
from seiswidgets.signatures import strict_keywords

if TYPE_CHECKING:
    import xarray

    from seiswidgets.geology.ensembles.ensemble import Ensemble

EVEN = 1e-3  # of a spacing: tolerance of a coordinate
ATTRIBUTES = ("velocity", "name", "credit")


class SectionKeywords(TypedDict, total=False):
    """Keywords of ``from_xarray``: fields of a Section."""

    x_unit: str | None
    z_unit: str | None
    velocity: float | None
    name: str | None
    credit: str | None


@overload
def to_xarray(section: Section) -> "xarray.DataArray": ...


@overload
def to_xarray(section: "Ensemble | Table") -> "xarray.Dataset": ...


@strict_keywords
def to_xarray(section: "Section | Ensemble | Table") -> "xarray.DataArray | xarray.Dataset":
    """Convert a section to an array of dimensions ("z", "x"), with units and the rest in coordinates and attributes.

    An ensemble becomes a Dataset: each quantity by ``member``, with its percentiles and its shares of variance, the
    depths of restored horizons, and the area ratios. What restoring gives is NaN in members with a ``problem``. A table
    becomes a Dataset with a variable for each column.

    Raises
    ------
    SettingError
        If ``section`` is none of these.
    DataError
        If xarray is not installed.
    """
    if isinstance(section, Table):
        return table_dataset(section)
    if not isinstance(section, Section):
        return _of_ensemble(section)
    return import_optional("xarray", "to make an xarray.DataArray").DataArray(
        section.amplitude,
        coords=_coordinates(section),
        dims=("z", "x"),
        name="amplitude",
        attrs={"long_name": "amplitude", **_attributes(section)},
    )


def _of_ensemble(ensemble: "Ensemble") -> "xarray.Dataset":
    from seiswidgets.geology.ensembles.ensemble import Ensemble  # slow to import: the app appears sooner without it
    from seiswidgets.io.exports.ensembles import ensemble_dataset

    if not isinstance(ensemble, Ensemble):
        checked_kind(ensemble, Section, "section")
    return ensemble_dataset(ensemble)


@strict_keywords
def from_xarray(array: "xarray.DataArray", **fields: Unpack[SectionKeywords]) -> Section:
    """Make a section from an array of two dimensions with evenly spaced coordinates, as ``to_xarray`` returns it.

    The samples are along the dimension "z" or, if there is none, along the first one. Units are the attribute "units"
    of the coordinates; velocity, name and credit are attributes of the array.

    Parameters
    ----------
    array : xarray.DataArray
    x_unit, z_unit, velocity, name, credit : optional
        Fields of the section; they take precedence over those of the array.

    Raises
    ------
    SectionError
        If the array has other dimensions, or coordinates that are missing or uneven, or does not make a section.
    DataError
        If xarray is not installed.
    """
    if not isinstance(array, import_optional("xarray", "to read an xarray.DataArray").DataArray) or array.ndim != 2:
        raise SectionError(
            f"a section is made from an xarray.DataArray of 2 dimensions, not from a {type(array).__name__} of "
            f"dimensions {tuple(getattr(array, 'dims', ()))}"
        )
    if array.dims[1] == "z" or array.dims[0] == "x":
        array = array.transpose(*array.dims[::-1])
    z, x = array.dims
    values: dict[str, Any] = {name: array.attrs[name] for name in ATTRIBUTES if name in array.attrs}
    values |= {name: str(values[name]) for name in ("name", "credit") if name in values}
    values |= _axis(array, "z", z) | _axis(array, "x", x)
    values |= fields
    if not {"x_unit", "z_unit"} <= values.keys():
        raise SectionError(
            f"the coordinates {z!r} and {x!r} each need an attribute 'units', one of {', '.join(METRES)} or for z "
            f"{', '.join(SECONDS)}; or give ",
            Keyword("x_unit"),
            " and ",
            Keyword("z_unit"),
        )
    return Section(array.values, **values)


def _axis(array: "xarray.DataArray", letter: str, dimension: Hashable) -> dict[str, Any]:
    """Origin, spacing and unit along one dimension, as fields of a section."""
    if dimension not in array.coords:
        raise SectionError(f"the array has no coordinate {dimension!r}; give it one, with the positions along it")
    coordinate = array.coords[dimension]
    if coordinate.dtype.kind not in "iuf":
        raise SectionError(
            f"the coordinate {dimension!r} must be numbers, but is {coordinate.dtype}; convert it to numbers in a unit "
            "that its attribute 'units' names"
        )
    if letter == "z" and coordinate.attrs.get("positive") == "up":
        raise SectionError(f"the coordinate {dimension!r} grows upwards; change its sign, and flip the array along it")
    positions = coordinate.values.astype(float)
    count = len(positions)
    spacing = (positions[-1] - positions[0]) / max(count - 1, 1)
    error = np.abs(positions - positions[0] - spacing * np.arange(count))
    if not (spacing > 0 and (error < EVEN * spacing).all()):
        raise SectionError(f"the coordinate {dimension!r} must rise in even steps; sort it, and resample the array")
    unit = coordinate.attrs.get("units")
    return {f"{letter}0": positions[0], f"d{letter}": spacing} | ({f"{letter}_unit": unit} if unit else {})


def _attributes(section: Section) -> dict[str, Any]:
    return {name: getattr(section, name) for name in ATTRIBUTES if getattr(section, name)}


def _coordinates(section: Section) -> dict[str, tuple[str, np.ndarray, dict[str, str]]]:
    z_name = "two-way time" if section.is_time else "depth"
    return {
        "z": ("z", section.z, {"units": section.z_unit, "long_name": z_name, "positive": "down"}),
        "x": ("x", section.x, {"units": section.x_unit, "long_name": "distance"}),
    }


@strict_keywords
def displacement(restored: Restoration) -> "xarray.Dataset":
    """Displacement and strain by all stages together, at each sample of the original section; NaN outside the mesh.

    Variables of dimensions ("z", "x"): ``displacement_x`` and ``displacement_z``, from the original to the restored
    position, in the section's units; ``area_ratio``, present-day over restored area, and ``larger_stretch`` and
    ``smaller_stretch``, length after over before along the principal directions, all in rock.
    ``.to_netcdf(path)`` writes them.

    Raises
    ------
    SettingError
        If ``restored`` is not a Restoration.
    DataError
        If xarray is not installed.
    """
    checked_kind(restored, Restoration, "restored")
    xarray = import_optional("xarray", "to make an xarray.Dataset")
    section = restored.original
    points = np.stack(np.meshgrid(section.x, section.z), axis=-1).reshape(-1, 2)
    moved, gradient = _map_with_gradient(restored, section.to_rock(points))
    shift = section.from_rock(moved) - points
    ratio, stretches = _strain(gradient)
    described = {
        "displacement_x": (shift[:, 0], section.x_unit, "displacement along the section"),
        "displacement_z": (shift[:, 1], section.z_unit, "displacement downwards"),
        "area_ratio": (ratio, "1", "present-day area over restored area"),
        "larger_stretch": (stretches[:, 0], "1", "length after over before, in the direction of largest stretch"),
        "smaller_stretch": (stretches[:, 1], "1", "length after over before, in the direction of smallest stretch"),
    }
    variables = {
        name: (("z", "x"), values.reshape(section.shape), {"units": unit, "long_name": long_name})
        for name, (values, unit, long_name) in described.items()
    }
    attributes = _attributes(section) | {"stages": stages_as_line(restored)}
    return xarray.Dataset(variables, _coordinates(section), attributes)


def _map_with_gradient(restored: Restoration, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Map points of rock through all stages, with the Jacobian of the map; shapes (n, 2) and (n, 2, 2)."""
    gradient = np.broadcast_to(np.eye(2), (len(points), 2, 2))
    for stage in restored.stages:
        triangle = stage.map.source_finder(points)
        points = stage.map.forward(points, triangle)
        step = np.where((triangle >= 0)[:, None, None], stage.map.gradient[triangle], np.nan)
        gradient = step @ gradient
    return points, gradient


def _strain(gradient: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Area ratio, shape (n,), and principal stretches, larger first, shape (n, 2), of Jacobians; NaN where they are."""
    ratio, stretches = np.full(len(gradient), np.nan), np.full((len(gradient), 2), np.nan)
    finite = np.isfinite(gradient).all(axis=(1, 2))
    ratio[finite] = 1 / np.linalg.det(gradient[finite])
    stretches[finite] = np.linalg.svd(gradient[finite], compute_uv=False)
    return ratio, stretches
