import numpy as np
import pytest

from seiswidgets.core.trust_region import truncated_newton

SIZES = np.array([1.0, 2.0, 5.0, 40.0])
GRADIENT = np.array([3.0, -1.0, 2.0, 4.0])


def found(curvatures, radius, gradient=GRADIENT):
    return truncated_newton(gradient, lambda x: curvatures * x, lambda x: x / SIZES, radius)


def norm(step):
    return np.sqrt(np.sum(SIZES * step**2))


def test_a_convex_model_is_minimised():
    curvatures = SIZES * [1.0, 0.2, 3.0, 0.7]
    step = found(curvatures, np.inf)
    np.testing.assert_allclose(step.step, -GRADIENT / curvatures, rtol=0.02)
    assert not step.limited
    assert step.norm == pytest.approx(norm(step.step))


@pytest.mark.parametrize("curvatures", [SIZES, SIZES * [1, 1, -0.5, 1]])
def test_the_step_ends_at_the_border(curvatures):
    step = found(curvatures, 0.5)
    assert step.limited
    assert norm(step.step) == pytest.approx(0.5)
    assert step.norm == pytest.approx(0.5)
    assert GRADIENT @ step.step < 0


def test_without_a_border_it_stops_before_negative_curvature():
    step = found(SIZES * [1, 1, -0.5, 1], np.inf)
    assert step.limited
    assert GRADIENT @ step.step < 0
    assert step.norm == pytest.approx(norm(step.step))


@pytest.mark.parametrize("radius", [1.0, np.inf])
def test_at_rest_it_stays(radius):
    assert not found(SIZES, radius, 0 * GRADIENT).step.any()
