"""Sections and deformation as labelled arrays of xarray, which writes them as NetCDF."""

from typing import TYPE_CHECKING

import numpy as np

from seiswidgets.errors import SectionError, SettingError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import METRES, SECONDS, Section
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.exports.reports import stages_in_words
from seiswidgets.io.files import required

if TYPE_CHECKING:
    import xarray

EVEN = 1e-3  # of a spacing: what a coordinate may be off the lattice
OF_SECTION = ("velocity", "name", "credit")


def to_xarray(section: Section) -> "xarray.DataArray":
    """A section as an array of dimensions ("z", "x"), whose coordinates and attributes hold its units and the rest.

    Raises
    ------
    SettingError
        If it is no section.
    DataError
        If xarray is not installed.
    """
    checked_kind(section, Section, "section")
    attributes = {name: getattr(section, name) for name in OF_SECTION if getattr(section, name)}
    array = required("xarray", "to make an xarray.DataArray").DataArray
    return array(
        section.amplitude,
        coords=_coordinates(section),
        dims=("z", "x"),
        name="amplitude",
        attrs={"long_name": "amplitude", **attributes},
    )


def from_xarray(array: "xarray.DataArray", **fields) -> Section:
    """A section from an array of two dimensions with even coordinates, as from ``to_xarray``.

    The dimension "z" or, where none is called so, the first is that of the samples. Units are the attribute "units" of
    the coordinates; velocity, name and credit are attributes of the array.

    Parameters
    ----------
    array : xarray.DataArray
    **fields
        Of the section, over those of the array: x_unit, z_unit, velocity, name, credit.

    Raises
    ------
    SectionError
        If the array has other dimensions, or coordinates that are missing or uneven, or does not make a section.
    SettingError
        If a keyword is none of these.
    """
    known = ("x_unit", "z_unit", *OF_SECTION)
    if unknown := set(fields) - set(known):
        raise SettingError(f"from_xarray takes {', '.join(known)}, but not {', '.join(sorted(unknown))}")
    if not isinstance(array, required("xarray", "to read an xarray.DataArray").DataArray) or array.ndim != 2:
        raise SectionError(f"a section is made from an xarray.DataArray of 2 dimensions, not from {_short(array)}")
    if array.dims[1] == "z" or array.dims[0] == "x":
        array = array.transpose(*array.dims[::-1])
    z, x = array.dims
    found = {name: array.attrs[name] for name in OF_SECTION if name in array.attrs}
    found |= {name: str(found[name]) for name in ("name", "credit") if name in found}
    for letter, dimension in zip("zx", array.dims, strict=True):
        found |= _axis(array, letter, dimension)
    if not {"x_unit", "z_unit"} <= {**found, **fields}.keys():
        raise SectionError(
            f"the coordinates {z!r} and {x!r} need an attribute 'units' each, one of {', '.join(METRES)} or for z "
            f"{', '.join(SECONDS)}; or give x_unit= and z_unit="
        )
    return Section(array.values, **found | fields)


def _short(array):
    return f"a {type(array).__name__} of dimensions {tuple(getattr(array, 'dims', ()))}"


def _axis(array, letter, dimension):
    """Origin, spacing and unit along one dimension, as fields of a section."""
    if dimension not in array.coords:
        raise SectionError(f"the array has no coordinate {dimension!r}; give it one, with the places along it")
    coordinate = array.coords[dimension]
    if coordinate.dtype.kind not in "iuf":
        raise SectionError(
            f"the coordinate {dimension!r} must be numbers, but is {coordinate.dtype}; make them so, in a unit that "
            "its attribute 'units' names"
        )
    if letter == "z" and coordinate.attrs.get("positive") == "up":
        raise SectionError(f"the coordinate {dimension!r} grows upwards; turn its sign, and the array along it")
    places = coordinate.values.astype(float)
    spacing = (places[-1] - places[0]) / max(len(places) - 1, 1)
    if not (spacing > 0 and (np.abs(places - places[0] - spacing * np.arange(len(places))) < EVEN * spacing).all()):
        raise SectionError(f"the coordinate {dimension!r} must rise in even steps; sort it, and resample the array")
    unit = coordinate.attrs.get("units")
    return {f"{letter}0": places[0], f"d{letter}": spacing} | ({f"{letter}_unit": unit} if unit else {})


def _coordinates(section):
    down = "two-way time" if section.is_time else "depth"
    return {
        "z": ("z", section.z, {"units": section.z_unit, "long_name": down, "positive": "down"}),
        "x": ("x", section.x, {"units": section.x_unit, "long_name": "distance"}),
    }


def displacement(restored: Restoration) -> "xarray.Dataset":
    """What all stages together have done at each sample of the original section; NaN where nothing maps.

    Variables of dimensions ("z", "x"): ``displacement_x`` and ``displacement_z``, from the original place to the
    restored one, in the section's units; ``area_ratio``, initial over final area, and ``larger_stretch`` and
    ``smaller_stretch``, length after over before along the principal directions, all in rock.
    ``.to_netcdf(path)`` writes them.

    Raises
    ------
    SettingError
        If it is no restoration.
    DataError
        If xarray is not installed.
    """
    checked_kind(restored, Restoration, "restored")
    dataset = required("xarray", "to make an xarray.Dataset").Dataset
    section = restored.original
    places = np.stack(np.meshgrid(section.x, section.z), axis=-1).reshape(-1, 2)
    moved, gradient = _carried(restored, section.to_rock(places))
    shift = section.from_rock(moved) - places
    ratio, stretches = np.full(len(places), np.nan), np.full((len(places), 2), np.nan)
    here = np.isfinite(gradient).all(axis=(1, 2))
    ratio[here] = 1 / np.linalg.det(gradient[here])
    stretches[here] = np.linalg.svd(gradient[here], compute_uv=False)
    described = {
        "displacement_x": (shift[:, 0], section.x_unit, "displacement along the section"),
        "displacement_z": (shift[:, 1], section.z_unit, "displacement downwards"),
        "area_ratio": (ratio, "1", "initial area over final area"),
        "larger_stretch": (stretches[:, 0], "1", "length after over before, along the direction of most"),
        "smaller_stretch": (stretches[:, 1], "1", "length after over before, along the direction of least"),
    }
    variables = {
        name: (("z", "x"), values.reshape(section.shape), {"units": unit, "long_name": words})
        for name, (values, unit, words) in described.items()
    }
    about = {name: getattr(section, name) for name in OF_SECTION if getattr(section, name)}
    return dataset(variables, _coordinates(section), about | {"stages": stages_in_words(restored)})


def _carried(restored, points):
    """Where points of rock come to lie after all stages, and the Jacobian of that; shapes (n, 2) and (n, 2, 2)."""
    gradient = np.broadcast_to(np.eye(2), (len(points), 2, 2))
    for stage in restored.stages:
        triangle = stage.map.source_finder(points)
        points = stage.map.forward(points, triangle)
        step = np.where((triangle >= 0)[:, None, None], stage.map.gradient[triangle], np.nan)
        gradient = step @ gradient
    return points, gradient
