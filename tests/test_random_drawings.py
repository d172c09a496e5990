"""Whatever is drawn: a restoration in which no triangle is turned over, or one of our errors, and soon."""

from datetime import timedelta

import numpy as np
from hypothesis import HealthCheck, event, given, note, settings
from hypothesis import strategies as st

import seiswidgets as sw
from seiswidgets.core.mesh import triangle_areas

SOON = settings(
    deadline=timedelta(seconds=20),
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example],
)
SHARE = st.floats(0, 1)
TINY = st.sampled_from([0.0, 0.0, 1e-12, -1e-12, 1e-9, 1e-6, -1e-6, 1e-4, -1e-4, 1e-3, 0.01, -0.01, 0.03, -0.03, 0.1])


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
def plausible_drawings(draw):
    """Steep faults, side by side or crossing, and beds in each block that end at them or nearly so."""
    section = draw(sections())
    tops = sorted(draw(st.lists(st.floats(0.1, 0.9), min_size=1, max_size=3)))
    faults = [draw(fault_lines(top)) for top in tops]
    depths = draw(st.lists(st.floats(0.1, 0.9), min_size=1, max_size=2))
    slope = draw(st.sampled_from([0.0, 0.0, 0.2, -0.4]))
    throws = [draw(st.sampled_from([0.0, 0.02, 0.05, 0.1, 0.2, -0.05, -0.1])) for _ in faults]
    beds = [draw(bed_pieces(faults, throws, depth, slope)) for depth in depths]
    return (
        section,
        [sw.Fault(placed(section, draw(retouched(line))), name=f"F{k}") for k, line in enumerate(faults)],
        [
            sw.Horizon(*(placed(section, draw(retouched(piece))) for piece in pieces), name=f"H{k}")
            for k, pieces in enumerate(beds)
            if pieces
        ],
    )


@st.composite
def fault_lines(draw, top):
    """A fault across the section, or one that dies out above, below or both; shares of width and height."""
    z = draw(st.sampled_from([(0, 1), (0, 1), (0, 1), (0, 0.7), (0.3, 1), (0.25, 0.75), (0.003, 0.997), (0, 0.97)]))
    lean, bend = draw(st.sampled_from([0, 0.01, 0.1, -0.1, 0.3, -0.3])), draw(st.sampled_from([0, 0, 0.03, -0.03, 0.1]))
    line = [(top + lean * w + bend * 4 * w * (1 - w), z[0] + (z[1] - z[0]) * w) for w in (0, 0.25, 0.5, 0.75, 1)]
    return np.clip(line, 0, 1)


@st.composite
def bed_pieces(draw, faults, throws, depth, slope):
    """The pieces of a bed between faults, each block lower than the one before by a throw."""
    met = [(line, throw) for line, throw in zip(faults, throws, strict=True) if line[0, 1] < depth < line[-1, 1]]
    levels = depth + np.cumsum([0.0, *(throw for _, throw in met)]) - sum(throw for _, throw in met) / 2
    walls = [0.0, *(line for line, _ in met), draw(st.sampled_from([1.0, 1.0, 0.95]))]
    pieces = []
    for level, left, right in zip(levels, walls[:-1], walls[1:], strict=True):
        ends = [_wall_at(wall, level) for wall in (left, right)]
        start, stop = ends[0] + draw(TINY), ends[1] - draw(TINY)
        x = np.linspace(start, stop, draw(st.integers(2, 5)))
        wave = draw(st.sampled_from([0, 0, 0.01, 0.05])) * np.sin(7 * x)
        pieces.append(np.clip(np.column_stack([x, level + slope * (x - 0.5) + wave]), 0, 1))
    return draw(st.permutations(pieces))


def _wall_at(wall, level):
    return wall if isinstance(wall, float) else float(np.interp(level, wall[:, 1], wall[:, 0]))


@st.composite
def retouched(draw, line):
    """A line as an unsteady hand draws it: turned round, with a point twice, or one a little off."""
    line = np.array(line[::-1] if draw(st.booleans()) else line)
    number = draw(st.integers(0, len(line) - 1))
    if draw(st.booleans()):
        line = np.insert(line, number, line[number] + (draw(TINY), draw(TINY)), axis=0)
    if draw(st.booleans()):
        line[number] += draw(TINY), draw(TINY)
    return np.clip(line, 0, 1)


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


def check(data, drawings):
    """Draw, and restore; only our own errors may come out, with something to say."""
    try:
        word = outcome(*data.draw(drawings), **data.draw(choices()))
    except sw.SeiswidgetsError as error:
        note(str(error))
        if len(str(error)) < 20:
            raise
        word = type(error).__name__
    event(word)


@settings(SOON, max_examples=20)
@given(st.data())
def test_wild_drawings(data):
    check(data, wild_drawings())


@settings(SOON, max_examples=40)
@given(st.data())
def test_plausible_drawings(data):
    check(data, plausible_drawings())
