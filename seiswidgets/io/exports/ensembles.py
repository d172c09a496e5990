"""Ensembles as datasets of xarray, which can write NetCDF."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seiswidgets.geology.ensembles.ensemble import PERCENTS, Ensemble
from seiswidgets.geology.measures import HEAVE, MEANING, ROTATION, SLIP, THROW, unit_of
from seiswidgets.io.files import atomic_write, import_optional

if TYPE_CHECKING:
    import xarray

HORIZON = "horizon"
DIMENSIONS = {  # what a quantity is about; others: horizons, or all
    THROW: "cutoff",
    HEAVE: "cutoff",
    ROTATION: "block",
    SLIP: "fault",
}
SHARES_METHOD = "first-order shares of variance by linear regression on the numbers that drew each member"

Variable = tuple[tuple[str, ...], np.ndarray, dict[str, str]]


def ensemble_dataset(ensemble: Ensemble) -> "xarray.Dataset":
    """The results of an ensemble, by member; see `to_xarray`."""
    section, frame = ensemble.study.drawn.section, ensemble.frame
    coordinates: dict[str, Any] = {
        "member": [member.index for member in ensemble.members],
        "percent": list(PERCENTS),
        "input": list(ensemble.shares),
    }
    variables: dict[str, Variable] = {}
    for quantity in dict.fromkeys(quantity for quantity, _ in ensemble.labels):
        abouts = [about for name, about in ensemble.labels if name == quantity]
        dimensions = () if abouts == [""] else (DIMENSIONS.get(quantity, HORIZON),)
        if dimensions == (HORIZON,):
            abouts = list(frame.horizons)  # those that were not measured included
        coordinates |= dict.fromkeys(dimensions, abouts)
        variables |= _of_quantity(ensemble, quantity, abouts, dimensions)
    problems = np.array([member.problem for member in ensemble.members], dtype=str)
    variables["problem"] = ("member",), problems, {"long_name": "why a member has no restoration; empty if it has one"}
    if frame.nodes.size:
        unit = {"units": section.z_unit, "long_name": "depth of restored horizons", "positive": "down"}
        variables["restored_depth"] = ("member", HORIZON, "position"), ensemble.depths, unit
        ratio = {"units": "1", "long_name": "present-day area over restored area"}
        variables["area_ratio"] = ("member", "z", "x"), ensemble.ratios, ratio
        coordinates["position"] = "position", frame.x, {"units": section.x_unit, "long_name": "distance"}
        coordinates["x"] = "x", frame.nodes[0, :, 0], {"units": section.x_unit, "long_name": "distance"}
        coordinates["z"] = "z", frame.nodes[:, 0, 1], {"units": section.z_unit, "positive": "down"}
    deviations = {name: value for name, value in asdict(ensemble.study.uncertainty).items() if name != "matches"}
    attributes = {
        "seed": ensemble.study.seed,
        "shares_method": SHARES_METHOD,
        **{f"uncertainty_{name}": value for name, value in deviations.items()},
    }
    xarray = import_optional("xarray", "to make an xarray.Dataset")
    return xarray.Dataset(variables, coordinates, attributes)


def write_ensemble(ensemble: Ensemble, path: Path) -> None:
    """Write an ensemble as NetCDF; DataError if that fails, and an older file stays."""
    dataset = ensemble_dataset(ensemble)
    with atomic_write(path) as draft:
        dataset.to_netcdf(draft)


def _of_quantity(
    ensemble: Ensemble, quantity: str, abouts: list[str], dimensions: tuple[str, ...]
) -> dict[str, Variable]:
    """Values, percentiles and shares of variance of a quantity, NaN for what has none."""
    places = {label: index for index, label in enumerate(ensemble.labels)}
    indices = [places.get((quantity, about), -1) for about in abouts]

    def chosen(results: np.ndarray) -> np.ndarray:
        found = np.pad(results, ((0, 0), (0, 1)), constant_values=np.nan)[:, indices]
        return found if dimensions else found[:, 0]

    name, about = (
        quantity.replace(" ", "_"),
        {"units": "1", "long_name": f"share of the variance of {quantity} by input"},
    )
    described = {"units": unit_of(quantity, ensemble.study.drawn.section), "long_name": MEANING[quantity]}
    percentiles = np.array(list(ensemble.percentiles().values())).T
    variables: dict[str, Variable] = {
        name: (("member", *dimensions), chosen(ensemble.values), described),
        f"{name}_percentile": (("percent", *dimensions), chosen(percentiles), described),
    }
    if ensemble.shares:
        shares = chosen(np.array(list(ensemble.shares.values())))
        variables[f"{name}_share"] = ("input", *dimensions), shares, about
    return variables
