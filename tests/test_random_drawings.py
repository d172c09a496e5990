"""Whatever is drawn: a restoration in which no triangle is turned over, or one of our errors, and soon."""

from datetime import timedelta

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, note, settings
from hypothesis import strategies as st

import seiswidgets as sw
from seiswidgets.core.mesh import triangle_areas
from tests.drawings import hand_drawing
from tests.drawings import outcome as hand_outcome

SOON = settings(
    deadline=timedelta(seconds=20),
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example],
)
SHARE = st.floats(0, 1)


@st.composite
def sections(draw):
    """Sections in depth or time, five times as wide as high to five times as high as wide, with dx/dz of 0.1 to 100."""
    proportion, aspect = draw(st.sampled_from([0.2, 0.5, 1, 2, 5])), draw(st.sampled_from([0.1, 0.5, 1, 5, 100]))
    nx = max(6, round(proportion * draw(st.sampled_from([10, 30, 60])) / aspect))
    nz = max(6, round(aspect * nx / proportion))
    dz, *origin = draw(st.sampled_from([(10.0, 0.0, 0.0), (4.0, 6e5, -300.0), (0.001, 0.0, 0.0)]))
    time = draw(st.sampled_from([{}, {"z_unit": "ms", "velocity": 2000.0}]))
    return sw.Section(np.ones((nz, nx), np.float32), aspect * dz, dz, *origin, **time)


def placed(section, shares):
    """Points from shares of the section's width and height."""
    x_min, x_max, z_min, z_max = section.extent
    return np.array(shares, float) * (x_max - x_min, z_max - z_min) + (x_min, z_min)


def spacing(section, count):
    x_min, x_max, z_min, z_max = section.extent
    width, height = section.metres * (x_max - x_min, z_max - z_min)
    return float(np.sqrt(width * height / count))


@st.composite
def points(draw):
    """Two to five points anywhere in a section, now and then a little outside it; shares of its width and height."""
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    line = rng.uniform(0, 1, (draw(st.integers(2, 5)), 2))
    if draw(st.booleans()):
        line = line[np.argsort(line[:, rng.integers(2)])]
    line = line + draw(st.sampled_from([0.0] * 9 + [0.3]))
    line[draw(st.integers(0, len(line) - 1))] = draw(SHARE), draw(SHARE)
    return line


@st.composite
def wild_drawings(draw):
    section = draw(sections())
    faults = [sw.Fault(placed(section, draw(points())), name=f"F{k}") for k in range(draw(st.integers(1, 3)))]
    horizons = [
        sw.Horizon(*(placed(section, draw(points())) for _ in range(draw(st.integers(1, 3)))), name=f"H{k}")
        for k in range(draw(st.integers(1, 2)))
    ]
    return section, faults, horizons


@st.composite
def choices(draw):
    return {
        "vertices": draw(st.sampled_from([100, 200, 400])),
        "fixed": draw(st.none() | st.tuples(SHARE, SHARE)),
        "flattened": draw(st.booleans()),
        "most": draw(st.sampled_from([1, 10, 50])),
    }


def outcome(section, faults, horizons, vertices, fixed, flattened, most):
    """Restore a drawing and name the outcome; an AssertionError if a triangle is turned over."""
    start = sw.Restoration(section, spacing=spacing(section, vertices))
    fixed = None if fixed is None else placed(section, fixed)
    restored = start.unfault(faults, horizons, fixed=fixed, max_iterations=most)
    if flattened:
        restored = restored.flatten(horizons[0], max_iterations=most)
    for stage in restored.stages:
        assert triangle_areas(stage.mesh.vertices, stage.mesh.triangles).min() > 0
        assert triangle_areas(stage.vertices, stage.mesh.triangles).min() > 0
    assert restored.section.shape
    return "restored" if all(stage.report.converged for stage in restored.stages) else "restored, not settled"


@settings(SOON, max_examples=20)
@given(st.data())
def test_wild_drawings(data):
    """Draw, and restore; only our own errors may come out, with something to say."""
    try:
        word = outcome(*data.draw(wild_drawings()), **data.draw(choices()))
    except sw.SeiswidgetsError as error:
        note(str(error))
        if len(str(error)) < 20:
            raise
        word = type(error).__name__
    event(word)


@pytest.mark.parametrize("seed", range(40))
def test_drawings_by_hand(seed):
    """Restored without a flip, or refused; all that is said names a pick, in the section's units, and helps."""
    drawing = hand_drawing(seed)
    hand_outcome(drawing, spacing=spacing(drawing.section, 200), max_iterations=10)
