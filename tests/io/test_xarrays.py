import numpy as np
import pytest
import xarray

import seiswidgets as sw
from tests.io.restored import restored

FIELDS = ("dx", "dz", "x0", "z0")
WORDS = ("x_unit", "z_unit", "velocity", "name", "credit")


@pytest.mark.parametrize("time", [False, True])
def test_a_section_goes_there_and_back(time):
    section = restored(time).section
    again = sw.from_xarray(sw.to_xarray(section))
    np.testing.assert_array_equal(again.amplitude, section.amplitude)
    np.testing.assert_allclose([getattr(again, name) for name in FIELDS], [getattr(section, name) for name in FIELDS])
    assert [getattr(again, name) for name in WORDS] == [getattr(section, name) for name in WORDS]


def test_a_section_goes_through_netcdf(tmp_path):
    section = restored(True).section
    sw.to_xarray(section).to_netcdf(tmp_path / "line.nc")
    again = sw.from_xarray(xarray.load_dataarray(tmp_path / "line.nc"))
    np.testing.assert_array_equal(again.amplitude, section.amplitude)
    assert [getattr(again, name) for name in WORDS] == [getattr(section, name) for name in WORDS]


@pytest.mark.parametrize("dims", [("z", "x"), ("x", "z"), ("depth", "distance"), ("trace", "z"), ("x", "depth")])
def test_the_samples_run_along_z_or_the_first_dimension(dims):
    down = 1 if dims[0] == "x" or dims[1] == "z" else 0
    shape = (4, 3) if down == 1 else (3, 4)
    array = xarray.DataArray(np.arange(12.0).reshape(shape), dims=dims)
    array = array.assign_coords({dims[down]: [10, 15, 20], dims[1 - down]: [0, 25, 50, 75]})
    section = sw.from_xarray(array, x_unit="m", z_unit="m")
    assert section.extent == (0, 75, 10, 20)
    np.testing.assert_array_equal(section.amplitude, array.values.T if down else array.values)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda array: array.values, "DataArray of 2 dimensions, not from a ndarray"),
        (lambda array: array[0], "DataArray of 2 dimensions"),
        (lambda array: array.drop_vars("x"), "no coordinate 'x'"),
        (lambda array: array[::-1], "'z' must rise in even steps"),
        (lambda array: array[[0, 1, 3]], "'z' must rise in even steps"),
        (lambda array: array.isel(x=[0]), "'x' must rise in even steps"),
        (lambda array: array.assign_coords(x=[f"at {x}" for x in range(array.shape[1])]), "'x' must be numbers"),
        (lambda array: array.assign_coords(z=array.z.values), "each need an attribute 'units'"),
        (lambda array: array.assign_coords(x=np.arange(array.shape[1]).astype("m8[ns]")), "'x' must be numbers"),
        (lambda array: array.assign_coords(z=array.z.assign_attrs(positive="up")), "'z' grows upwards"),
        (lambda array: array.to_dataset(), "not from a Dataset"),
        (lambda array: array * np.inf, "infinite"),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
def test_arrays_that_make_no_section(change, message):
    with pytest.raises(sw.SectionError, match=message):
        sw.from_xarray(change(sw.to_xarray(restored().original)))


def test_a_misspelt_field_is_an_error():
    with pytest.raises(TypeError, match="has no keyword velocty=; did you mean velocity="):
        sw.from_xarray(sw.to_xarray(restored().original), velocty=2000)


@pytest.mark.parametrize("time", [False, True])
def test_the_displacement_is_where_points_go(time):
    done = restored(time)
    field = sw.displacement(done)
    x, z = np.meshgrid(field.x, field.z)
    points = np.column_stack([x.ravel(), z.ravel()])
    moved = points + np.column_stack([field.displacement_x.values.ravel(), field.displacement_z.values.ravel()])
    np.testing.assert_allclose(moved, done.to_restored(points), atol=1e-9)
    assert field.displacement_z.attrs["units"] == done.original.z_unit
    assert np.isfinite(field.displacement_x).mean() > 0.99


def test_the_deformation_is_that_of_all_stages():
    """Along a small circle about a point, lengths change between the two stretches, and both make up the area."""
    done, section = restored(True), restored(True).original
    field = sw.displacement(done)
    angles = np.linspace(0, np.pi, 91)
    arms = 0.01 * np.column_stack([np.cos(angles), np.sin(angles)])
    random, checked = np.random.default_rng(0), 0
    for row, column in zip(random.integers(20, 380, 40), random.integers(20, 300, 40), strict=True):
        centre = section.to_rock([[section.x[column], section.z[row]]])
        ends = [section.to_rock(done.to_restored(section.from_rock(centre + sign * arms))) for sign in (1, -1)]
        lengths = np.hypot(*(ends[0] - ends[1]).T) / 0.02
        here = field.isel(z=row, x=column)
        larger, smaller = float(here.larger_stretch), float(here.smaller_stretch)
        assert float(here.area_ratio) == pytest.approx(1 / (larger * smaller))
        if np.ptp(lengths) < 0.5:  # no fault or edge of a triangle runs through the circle
            assert lengths.max() == pytest.approx(larger, abs=2e-3)
            assert lengths.min() == pytest.approx(smaller, abs=2e-3)
            checked += 1
    assert checked > 30


def test_the_displacement_before_any_stage_is_none():
    field = sw.displacement(sw.Restoration(restored().original))
    assert not field.displacement_x.values.any()
    assert not field.displacement_z.values.any()
    assert (field.area_ratio == 1).all()


def test_the_displacement_goes_through_netcdf(tmp_path):
    field = sw.displacement(restored())
    field.to_netcdf(tmp_path / "field.nc")
    assert xarray.load_dataset(tmp_path / "field.nc").identical(field)
