"""Tables in files."""

import csv
import json

import numpy as np
import pytest
import xarray

import seiswidgets as sw

TABLE = sw.Table("Throw", {"fault": "", "throw": "m", "index": "1"}, (("F1", 12.5, None), ("=cmd()", -3.0, 1.25)))


def test_csv_has_units_in_its_headings_and_no_formula(tmp_path):
    sw.save_table(TABLE, tmp_path / "throw.csv")
    rows = list(csv.reader((tmp_path / "throw.csv").read_text().splitlines()))
    assert rows == [["fault", "throw (m)", "index"], ["F1", "12.5", ""], ["'=cmd()", "-3.0", "1.25"]]


def test_json_keeps_units_and_missing_values(tmp_path):
    sw.save_table(TABLE, tmp_path / "throw.json")
    content = json.loads((tmp_path / "throw.json").read_text())
    assert content["units"] == {"fault": "", "throw": "m", "index": "1"}
    assert content["rows"] == list(TABLE)


def test_netcdf_and_xarray_hold_a_variable_for_each_column(tmp_path):
    sw.save_table(TABLE, tmp_path / "throw.nc")
    with xarray.open_dataset(tmp_path / "throw.nc") as read:
        xarray.testing.assert_equal(read.load(), sw.to_xarray(TABLE))
        assert read["throw"].attrs["units"] == "m"
        np.testing.assert_array_equal(read["index"], [np.nan, 1.25])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [((TABLE, "throw.xls"), "must end in .csv or .json or .nc"), (("table", "t.csv"), "table must be a Table")],
)
def test_bad_arguments_are_named(tmp_path, arguments, message):
    with pytest.raises(sw.SettingError, match=message):
        sw.save_table(arguments[0], tmp_path / arguments[1])
