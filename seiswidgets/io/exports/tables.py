"""Tables of measured values as CSV, JSON and NetCDF."""

import csv
import json
from io import StringIO
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np

from seiswidgets.geology.tables import Table, Value
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.files import atomic_write, import_optional, output_path, write_file
from seiswidgets.io.picks.table import guarded
from seiswidgets.signatures import strict_keywords

if TYPE_CHECKING:
    import xarray

SUFFIXES = (".csv", ".json", ".nc")


@strict_keywords
def save_table(table: Table, path: str | PathLike) -> None:
    """Write a table as CSV (.csv), with units in its headings, as JSON (.json), or as NetCDF (.nc).

    Raises
    ------
    SettingError
        If the path has another suffix, or ``table`` is not a Table.
    DataError
        If the file cannot be written, or xarray is not installed for NetCDF.
    """
    path = output_path(path, SUFFIXES)
    checked_kind(table, Table, "table")
    if path.suffix.lower() == ".csv":
        write_file(path, _csv(table).encode())
    elif path.suffix.lower() == ".json":
        content = {"title": table.title, "units": dict(table.units), "rows": list(table)}
        write_file(path, json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False).encode())
    else:
        dataset = table_dataset(table)
        with atomic_write(path) as draft:
            dataset.to_netcdf(draft)


def table_dataset(table: Table) -> "xarray.Dataset":
    """A dataset with a variable of dimension "row" for each column, NaN or "" where there is no value."""
    xarray = import_optional("xarray", "to make an xarray.Dataset")
    variables = {}
    for name, unit in table.units.items():
        values = table.column(name)
        if unit:
            array = np.array([np.nan if value is None else value for value in values], float)
        else:
            array = np.array(["" if value is None else value for value in values], str)
        variables[name.replace(" ", "_")] = ("row", array, {"units": unit, "long_name": name})
    return xarray.Dataset(variables, attrs={"title": table.title})


def _csv(table: Table) -> str:
    file = StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(table.headings)
    writer.writerows([_cell(value) for value in row] for row in table.rows)
    return file.getvalue()


def _cell(value: Value) -> str | float:
    return "" if value is None else guarded(value) if isinstance(value, str) else value
