"""Picks snap to what was put there: sines, wavelets, and the reflector at each horizon of a synthetic section."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.interaction.snapping import EVENTS, follow_event, snap_to_event

PERIOD = 14.0  # samples
PHASE = {"peak": 0.25, "trough": 0.75, "zero-up": 0.0, "zero-down": 0.5}  # of a sine's period
FOLDED = sw.synthetic.sine_fold(dip=20, noise=0.05)
FAULTED = sw.synthetic.faulted_fold(noise=0.05)


def sines(dx=25.0, dz=4.0, dip=0.4, period=PERIOD, traces=60):
    """A sine down each trace, a little lower from trace to trace; phase 0 at the first sample of the first."""
    samples, columns = np.arange(150.0)[:, None], np.arange(traces)
    amplitude = np.sin(2 * np.pi * (samples - dip * columns) / period)
    return sw.Section(amplitude, dx, dz, x0=1000.0, z0=200.0, z_unit="ms", velocity=2000.0)


def event_depth(section, x, z, event, dip=0.4, period=PERIOD):
    """Position of the event nearest to a point, in closed form."""
    column, row = (x - section.x0) / section.dx, (z - section.z0) / section.dz
    first = PHASE[event] * period + dip * column
    return section.z0 + section.dz * (first + period * np.round((row - first) / period))


@pytest.mark.parametrize(
    ("event", "period"), [*((event, PERIOD) for event in EVENTS), ("peak", 6.3), ("zero-up", 31.0)]
)
def test_snapped_to_a_tenth_of_a_sample(event, period):
    section = sines(period=period)
    rng = np.random.default_rng(3)
    for x, z in rng.uniform((1000, 300), (2475, 700), (60, 2)):
        point = snap_to_event(section, (x, z), event, window=period / 2 + 0.3)
        assert point[0] == x
        true = event_depth(section, x, z, event, period=period)
        away = min(abs(point[1] - true + shift * period * section.dz) for shift in (-1, 0, 1))
        assert away < 0.1 * section.dz
        assert abs(point[1] - z) <= (period / 2 + 0.3) * section.dz


def test_the_nearest_is_taken():
    section = sines(dip=0.0)
    for event in EVENTS:
        for z in np.arange(320.0, 420.0, 1.7):
            true = event_depth(section, 1500.0, z, event, dip=0.0)
            if abs(abs(true - z) - PERIOD * section.dz / 2) > 0.5:
                assert snap_to_event(section, (1500.0, z), event, 9)[1] == pytest.approx(true, abs=0.1 * section.dz)


def test_snapping_again_changes_nothing():
    section = sines()
    for event in EVENTS:
        once = snap_to_event(section, (1234.0, 432.0), event, 8)
        assert snap_to_event(section, once, event, 8) == pytest.approx(once, abs=1e-9)


@pytest.mark.parametrize("event", EVENTS)
def test_nothing_in_the_window(event):
    section = sines()
    z = event_depth(section, 1500.0, 400.0, event) + 4.0 * section.dz
    assert snap_to_event(section, (1500.0, z), event, 3.5) == (1500.0, z)
    assert snap_to_event(section, (1500.0, z), event, 4.5) != (1500.0, z)


@pytest.mark.parametrize("point", [(999.0, 400.0), (2476.0, 400.0), (1500.0, -9e9), (1500.0, 9e9)])
def test_off_the_section(point):
    assert [snap_to_event(sines(), point, event, 5) for event in EVENTS] == [point] * 4


@pytest.mark.parametrize("event", EVENTS)
def test_without_data(event):
    section = sines(dip=0.0)
    amplitude = section.amplitude.copy()
    amplitude[:, 20:30], amplitude[40:60] = np.nan, np.nan
    holes = sw.Section(amplitude, 25.0, 4.0, 1000.0, 200.0, z_unit="ms", velocity=2000.0)
    for point in [(1550.0, 300.0), (1490.0, 300.0), (1200.0, 400.0)]:  # no trace; half a trace; no samples
        assert snap_to_event(holes, point, event, 5) == point
    edge = (1475.0, 300.0)  # the last trace with data
    assert snap_to_event(holes, edge, event, 8) == snap_to_event(section, edge, event, 8) != edge


@pytest.mark.parametrize("flat", [0.0, 3.0])
def test_a_flat_trace_has_no_event(flat):
    section = sw.Section(np.full((30, 5), flat), 1.0, 1.0)
    for event in EVENTS:
        assert snap_to_event(section, (2.0, 10.0), event, 5) == (2.0, 10.0)


def test_a_clipped_peak_has_a_middle():
    section = sines(dip=0.0)
    clipped = sw.Section(np.clip(section.amplitude, -0.6, 0.6), 25.0, 4.0, 1000.0, 200.0, z_unit="ms", velocity=2000.0)
    for event in ("peak", "trough"):
        true = event_depth(section, 1500.0, 400.0, event, dip=0.0)
        assert snap_to_event(clipped, (1500.0, 400.0), event, 9)[1] == pytest.approx(true, abs=0.51 * section.dz)


def test_noise_on_a_flank_is_no_peak():
    amplitude = np.cos(2 * np.pi * np.arange(120.0) / 40)
    amplitude[50] += 0.17 * 0.2  # a wiggle on the flank between the trough at 60 and the peak at 40
    section = sw.Section(np.repeat(amplitude[:, None], 4, axis=1), 1.0, 1.0)
    assert snap_to_event(section, (1.0, 51.0), "peak", 15)[1] == pytest.approx(40, abs=0.1)


@pytest.mark.parametrize("case", [FOLDED, FAULTED], ids=["fold", "fault"])
def test_the_reflector_of_a_horizon_is_found(case):
    for horizon in case.interpretation.horizons:
        for piece in horizon.pieces:
            inner = piece[(piece[:, 0] > piece[0, 0] + 60) & (piece[:, 0] < piece[-1, 0] - 60)]
            inner = inner[case.section.contains(inner)]
            for x, z in inner[::7]:
                point = snap_to_event(case.section, (x, z + 1.7 * case.section.dz), "peak", 5)
                assert abs(point[1] - z) < 0.5 * case.section.dz  # of the true bed, under noise


@pytest.mark.parametrize("event", EVENTS)
def test_a_line_follows_a_dipping_sine(event):
    section = sines(dip=-0.6)
    ends = [(x, event_depth(section, x, z, event, -0.6)) for x, z in [(1010.0, 600.0), (2430.0, 450.0)]]
    ends[1] = ends[1][0], ends[0][1] - 0.6 * section.dz * (ends[1][0] - ends[0][0]) / section.dx
    line = follow_event(section, *ends, event, 6)
    x = np.linspace(1010.0, 2430.0, 200)
    true = ends[0][1] - 0.6 * section.dz * (x - 1010.0) / section.dx
    assert abs(np.interp(x, *line.T) - true).max() < 0.4 * section.dz
    assert len(line) < 8


@pytest.mark.parametrize("case", [FOLDED, FAULTED], ids=["fold", "fault"])
@pytest.mark.parametrize("back", [False, True])
def test_a_line_follows_a_horizon(case, back):
    section = case.section
    for horizon in case.interpretation.horizons:
        for piece in horizon.pieces:
            inner = piece[(piece[:, 0] > piece[0, 0] + 60) & (piece[:, 0] < piece[-1, 0] - 60)]
            start, end = (tuple(inner[place]) for place in ((-1, 0) if back else (0, -1)))
            line = follow_event(section, start, end, "peak", 80)
            assert tuple(line[0]) == start
            assert tuple(line[-1]) == end
            assert (np.diff(line[:, 0]) * (-1 if back else 1) > 0).all()
            found = np.interp(inner[:, 0], *(line[::-1] if back else line).T)
            assert np.quantile(abs(found - inner[:, 1]), 0.9) < 0.6 * section.dz
            assert abs(found - inner[:, 1]).max() < 2 * section.dz
            assert len(line) < 0.6 * np.ptp(inner[:, 0]) / section.dx


def test_a_followed_line_is_the_same_both_ways():
    section, piece = FOLDED.section, FOLDED.interpretation.horizons[0].pieces[0]
    there, back = (follow_event(section, *ends, "peak", 60) for ends in [piece[[3, -4]], piece[[-4, 3]]])
    x = np.linspace(*piece[[3, -4], 0], 300)
    assert np.interp(x, *there.T) == pytest.approx(np.interp(x, *back[::-1].T), abs=0.6 * section.dz)


@pytest.mark.parametrize(
    ("start", "end"),
    [
        ((1500.0, 300.0), (1500.0, 500.0)),  # upright
        ((1501.0, 300.0), (1509.0, 305.0)),  # between two traces
        ((900.0, 300.0), (1700.0, 305.0)),  # from outside
        ((1500.0, np.nan), (1700.0, 305.0)),
    ],
)
def test_a_line_that_cannot_follow_is_straight(start, end):
    assert np.array_equal(follow_event(sines(), start, end), [start, end], equal_nan=True)


def test_a_line_across_a_hole_goes_on():
    section = sines(dip=0.0)
    amplitude = section.amplitude.copy()
    amplitude[:, 20:30] = np.nan
    holes = sw.Section(amplitude, 25.0, 4.0, 1000.0, 200.0, z_unit="ms", velocity=2000.0)
    z = float(event_depth(section, 1100.0, 400.0, "peak", 0.0))
    line = follow_event(holes, (1100.0, z), (2300.0, z), "peak", 8)
    assert np.isfinite(line).all()
    assert abs(line[:, 1] - z).max() < 2 * section.dz


def test_what_cannot_be_snapped_to():
    with pytest.raises(sw.SettingError, match="event must be one of peak, trough, zero-up, zero-down, but is 'ridge'"):
        snap_to_event(sines(), (1500.0, 400.0), "ridge")
    with pytest.raises(sw.SettingError, match="window must be a number of samples above 0, but is -1"):
        follow_event(sines(), (1500.0, 400.0), (1600.0, 400.0), window=-1)
