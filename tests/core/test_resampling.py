import numpy as np
import pytest

from seiswidgets.core.resampling import resampled
from seiswidgets.errors import SettingError


def fractional(rng, shape, count=2000):
    return rng.uniform(0, shape[1] - 1, count), rng.uniform(0, shape[0] - 1, count)


@pytest.mark.parametrize("order", [1, 3])
@pytest.mark.parametrize(
    ("kind", "shape"), [(np.float32, (40, 60)), (np.float64, (1, 9)), (np.float32, (9, 1)), (np.float64, (2, 2))]
)
def test_samples_come_back_in_their_own_kind(order, kind, shape):
    amplitude = np.random.default_rng(12).normal(size=shape).astype(kind)
    rows, columns = np.indices(shape).astype(float)
    values = resampled(amplitude, columns, rows, order)
    assert values.dtype == kind
    np.testing.assert_allclose(values, amplitude, atol=20 * np.finfo(kind).eps)


@pytest.mark.parametrize("kind", [np.uint8, np.int16])
def test_whole_numbers_are_interpolated_as_fractions(kind):
    amplitude = np.array([[200, 100], [0, 40]], kind)
    assert resampled(amplitude, [0.5, 0.0], [0.0, 0.5], 1).tolist() == [150, 100]


def test_linear_is_exact_on_a_bilinear_function():
    rng = np.random.default_rng(13)
    z, x = np.indices((30, 50)).astype(float)
    columns, rows = fractional(rng, x.shape)
    values = resampled(2 * x - 3 * z + 0.5 * x * z, columns, rows, 1)
    np.testing.assert_allclose(values, 2 * columns - 3 * rows + 0.5 * columns * rows, atol=1e-10)


@pytest.mark.parametrize(("order", "rate"), [(1, 2), (3, 4)])
def test_error_falls_with_the_order_of_the_interpolation(order, rate):
    def wave(x, z):
        return np.cos(3 * np.pi * x) * np.cos(2 * np.pi * z)  # with no slope at the border, as its mirror image

    places = np.random.default_rng(14).random((2, 3000))
    errors = []
    for count in (32, 64, 128):
        axis = np.linspace(0, 1, count + 1)
        values = resampled(wave(*np.meshgrid(axis, axis)), *(places * count), order)
        errors.append(np.abs(values - wave(*places)).max())
    np.testing.assert_allclose(-np.diff(np.log2(errors)), rate, atol=0.25)


@pytest.mark.parametrize("order", [1, 3])
def test_positions_that_are_nan_or_off_the_samples_are_nan(order):
    amplitude = np.ones((5, 8))
    columns = np.array([np.nan, 1, -0.1, 7.1, 3, 3, -1e-9, 7 + 1e-9, np.inf])
    rows = np.array([1, np.nan, 1, 1, -0.1, 4.1, 4 + 1e-9, -1e-9, 1])
    np.testing.assert_allclose(resampled(amplitude, columns, rows, order), [np.nan] * 6 + [1, 1, np.nan])


@pytest.mark.parametrize("order", [1, 3])
def test_missing_samples_stay_missing_and_do_not_spread(order):
    amplitude = np.full((20, 30), 4.0, np.float32)
    amplitude[5:9, 10:14] = np.nan
    rows, columns = np.indices(amplitude.shape).astype(float)
    np.testing.assert_allclose(resampled(amplitude, columns, rows, order), amplitude, rtol=1e-6)
    near = resampled(amplitude, np.array([9.4, 9.6, 11.5]), np.array([7.0, 7.0, 6.5]), order)
    np.testing.assert_allclose(near, [4, np.nan, np.nan], rtol=1e-6)
    assert np.isnan(resampled(np.full((3, 3), np.nan), np.ones(4), np.ones(4), order)).all()


@pytest.mark.parametrize("order", [0, 2, "cubic"])
def test_other_orders_are_refused(order):
    with pytest.raises(SettingError, match=r"must be 1 \(linear\) or 3 \(cubic\)"):
        resampled(np.ones((3, 3)), np.ones(1), np.ones(1), order)
