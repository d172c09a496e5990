"""Numbers of SEG-Y headers that cannot be, or that contradict each other: read right or refused."""

import re

import numpy as np
import pytest

import seiswidgets as sw
from tests.io.segyfiles import ibm, segy_bytes, straight

COUNT = 60
NUMBERS = np.arange(COUNT)
EAST, NORTH = 434_000, 6_478_000  # where most lines below begin


@pytest.fixture
def save(tmp_path):
    def save(headers, samples=8, **choices):
        path = tmp_path / "line.sgy"
        traces = np.sin(np.arange(len(headers) * samples)).reshape(len(headers), samples)
        path.write_bytes(segy_bytes(traces, headers, **choices))
        return path

    return save


def ieee(value):
    return int(np.array(value, ">f4").view(">i4"))


def ibm_bits(value):
    return int(ibm(value).view(np.int32))


def line(step=25, x=EAST, y=NORTH, *, up=0, scalar=0):
    return [{181: x + step * n, 185: y + up * n, 71: scalar} for n in range(COUNT)]


def opened(path, **choices):
    return sw.open_section(path, **({"velocity": 2000} | choices))


def refused(path, match, name="dx", **value):
    """Check that a number is refused by the preview too, and that the user's own opens the file."""
    with pytest.raises(sw.DataError, match=match):
        opened(path)
    info = sw.preview(path)
    assert name in info.needed
    assert getattr(info, name) is None
    assert any(f.severity == "problem" and name + "=" in f.text for f in info.findings)
    assert getattr(opened(path, **value), name) == value[name]


@pytest.mark.parametrize("scalar", [0, 1, -100])
@pytest.mark.parametrize("endian", ["big", "little"])
@pytest.mark.parametrize(("stored", "words"), [(ieee, "IEEE"), (ibm_bits, "IBM")])
@pytest.mark.parametrize(
    ("x", "y", "step", "up", "dx"),
    [
        (434_000, 6_478_000, 25, 0, 25),
        (605_835, 6_073_556, 24, 32, 40),
        (-3_434_000, 500_000, 0, 25, 25),
        (71_000.5, 98_000.5, 12.5, 0, 12.5),
    ],
)
def test_positions_stored_as_floats_are_recognised(save, stored, words, scalar, endian, x, y, step, up, dx):
    headers = [{181: stored(x + step * n), 185: stored(y + up * n), 71: scalar} for n in range(COUNT)]
    path = save(headers, endian=endian)
    assert opened(path).dx == pytest.approx(dx, rel=1e-3)
    info = sw.preview(path)
    assert info.dx == pytest.approx(dx, rel=1e-3)
    assert any(f"bytes 181 and 185) are read as {words} floats" in finding.text for finding in info.findings)


def test_floats_of_either_kind_are_told_apart_by_their_evenness(save):
    for stored, step in ((ibm_bits, 25), (ieee, 6.25), (ibm_bits, 6.25)):
        headers = [{181: stored(1000 + step * n), 185: stored(500)} for n in range(200)]
        assert opened(save(headers)).dx == step


def test_floats_that_may_be_of_either_kind_are_refused(save):
    headers = [{181: ibm_bits(1000 + 25 * n), 185: ibm_bits(500)} for n in range(20)]
    refused(save(headers), r"25 apart as IBM floats; give the distance that is right: dx=", dx=25)
    headers = [{181: ieee(EAST + 50 * n), 185: ieee(NORTH), 71: -100} for n in range(COUNT)]
    refused(save(headers), "50 apart as IEEE floats or 0.5 apart as IEEE floats with their scalar", dx=50)


def test_floats_are_checked_as_integers_are(save):
    uneven = [{181: ieee(EAST + 25 * n + 30 * (n > 9)), 185: ieee(NORTH)} for n in range(COUNT)]
    refused(save(uneven), r"unevenly spaced traces \(read as IEEE floats\): most are 25 .* 55", dx=25)
    degrees = [{181: ieee(5.3 + 0.0003 * n), 185: ieee(53.9)} for n in range(COUNT)]
    refused(save(degrees), "seem to be degrees", dx=25)
    mixed = [{181: ieee(EAST + 25 * n), 185: NORTH} for n in range(COUNT)]
    refused(save(mixed), "beyond every map", dx=25)


@pytest.mark.parametrize(
    ("headers", "said"),
    [
        (
            line(250, 6_201_972, 60_742_328, up=8),
            r"in decimetres, the traces are 25.01 apart: dx=25.01",
        ),
        (line(125, 10 * EAST, 10 * NORTH), "in decimetres, the traces are 12.5 apart: dx=12.5"),
        (line(1250, 100 * EAST, 100 * NORTH), "in centimetres, the traces are 12.5 apart: dx=12.5"),
        (line(2500, 100 * EAST, 100 * NORTH, scalar=100), "scalar should be -100, the traces are 25 apart: dx=25"),
        (line(250, 10 * EAST, NORTH, scalar=10), "scalar should be -10, the traces are 25 apart: dx=25"),
        (line(12_500, 1000 * EAST, 0), "in millimetres, the traces are 12.5 apart: dx=12.5"),
        (line(82, 1_800_000, 10_400_000), "if they are in feet: x_unit='ft'"),
    ],
)
def test_positions_beyond_every_map_are_refused(save, headers, said):
    refused(save(headers), f"beyond every map.*{said}", dx=7)


@pytest.mark.parametrize(
    ("headers", "said"),
    [
        (line(250, 1000, 0), "250 m apart .* in decimetres, the traces are 25 apart: dx=25"),
        (line(2500, 1000, 0), "2500 m apart .* in centimetres, the traces are 25 apart: dx=25"),
        (line(25, scalar=-100), "0.25 m apart .* scalar does not apply, the traces are 25 apart: dx=25"),
        (line(25, 1000, 0, scalar=10), "250 m apart .* scalar should be -10, the traces are 2.5 apart: dx=2.5"),
        (line(12, 1000, 0, scalar=-1000), "0.012 m apart .* scalar does not apply, the traces are 12 apart: dx=12"),
    ],
)
def test_spacings_that_no_survey_has_are_refused(save, headers, said):
    refused(save(headers), said, dx=12.5)


@pytest.mark.parametrize(
    ("headers", "interval", "dx", "said"),
    [
        (line(25, scalar=-10), 4000, 2.5, "the scalar does not apply, the traces are 25 apart: dx=25"),
        (line(12, scalar=-10), 2000, 1.2, "the traces are 12 apart: dx=12"),
        (line(50, scalar=-10), 4000, 5, "the traces are 50 apart: dx=50"),
        (line(50, 1000, 500, scalar=-100), 4000, 0.5, "the traces are 50 apart: dx=50"),
    ],
)
def test_scalars_that_make_traces_too_close_are_questioned(save, headers, interval, dx, said):
    path = save(headers, interval=interval)
    refused(path, rf"{said};.* If it does apply, give dx={dx:g}$", dx=dx)


@pytest.mark.parametrize(
    ("headers", "choices", "dx"),
    [
        (line(50), {}, 50),  # regional
        (line(32, 10 * EAST, 10 * NORTH, scalar=-10), {"interval": 1000}, 3.2),
        (line(250, 1000, 500, scalar=-100), {"interval": 2000}, 2.5),
        (line(62, 10 * 71_000, 10 * 398_000, scalar=-10), {}, 6.2),  # of a small country's map
        (line(100), {}, 100),
        (line(50, 100 * EAST, 100 * NORTH, scalar=-100), {"interval": 250}, 0.5),  # of a boomer
        (line(100, 1000 * EAST, 1_478_000_000, scalar=-1000), {"interval": 100}, 0.1),  # ultra-high resolution
        (line(250, 10 * EAST, 10 * NORTH, scalar=-10), {}, 25),
        (line(3, 100, 500, scalar=10), {}, 30),
        (line(25, 39_434_000, 4_200_000), {}, 25),  # eastings that begin with their zone
        (line(12, 32_434_000, 5_900_000), {}, 12),
        (line(82, 1_800_000, 10_400_000), {"binary": {3255: 2}}, 82),
        (line(440, 1_800_000, 400_000), {"binary": {3255: 2}}, 440),
        (line(25, EAST, 9_990_000), {}, 25),  # just south of the equator
    ],
)
def test_positions_of_ordinary_surveys_are_believed(save, headers, choices, dx):
    path = save(headers, **choices)
    assert opened(path).dx == pytest.approx(dx)
    assert sw.preview(path).needed == ("z_unit or velocity",)


def test_the_users_unit_counts_for_what_is_plausible(save):
    path = save(line(82, 1_800_000, 10_400_000), binary={3255: 1})
    section = opened(path, x_unit="ft")
    assert (section.dx, section.x_unit) == (82, "ft")
    path = save(line(440, 1000, 500))
    assert opened(path, x_unit="ft").dx == 440


def test_wide_spacings_are_believed_but_noted(save):
    (finding,) = sw.preview(save(line(125, 1000, 500))).findings
    assert finding.severity == "warning"
    assert finding.text == "traces are 125 m apart, which is far: if positions are in tenths of that unit, give dx=12.5"


@pytest.mark.parametrize(
    ("other", "factor", "scalar"), [((73, 77), 10, -10), ((81, 85), 100, -100), ((73, 77), 0.1, 1)]
)
def test_positions_that_contradict_others_are_refused(save, other, factor, scalar):
    x, y = other
    headers = [
        {181: 4_340_000 + 50 * n, 185: 6_478_000, x: factor * (4_340_000 + 50 * n), y: factor * 6_478_000, 71: scalar}
        for n in range(COUNT)
    ]
    dx = 50 / max(-scalar, 1)
    match = rf"{dx:g} m apart .* but bytes {x} and {y} hold the same positions, but {dx * factor:g} apart"
    refused(save(headers), match, dx=dx)


@pytest.mark.parametrize("steps", [(0.81, 0), (0, 1), (1.3, 0)])
def test_positions_that_may_be_seconds_of_arc_are_refused(save, steps):
    east, north = (np.rint(100 * step * NUMBERS).astype(int) for step in steps)
    headers = [{181: 1_908_000 + int(e), 185: 19_404_000 + int(n), 71: -100} for e, n in zip(east, north, strict=True)]
    refused(save(headers), "may be seconds of arc", dx=25)
    lengths = [header | {89: 1} for header in headers]
    assert opened(save(lengths)).dx == pytest.approx(sum(steps), rel=1e-2)


@pytest.mark.parametrize(
    ("course", "turn"),
    [
        (np.minimum(NUMBERS, COUNT - NUMBERS), 30),
        (NUMBERS % 2, 1),
        (np.abs(NUMBERS - 20), 20),
    ],
)
def test_lines_that_go_back_and_forth_are_refused(save, course, turn):
    headers = [{181: int(EAST + 25 * place), 185: NORTH} for place in course]
    refused(save(headers), f"go back and forth: the line turns back at trace {turn} ", dx=25)


def test_bends_are_no_turning_back(save):
    corner = [{181: EAST + 25 * min(n, 30), 185: NORTH + 25 * max(n - 30, 0)} for n in range(COUNT)]
    assert opened(save(corner)).dx == 25


@pytest.mark.parametrize(("dx", "scalar"), [(0.5, 1), (1, 1), (2, 1), (5, 10), (0.1, -10), (0.05, -100)])
@pytest.mark.parametrize("angle", [0, 20, 45, 70])
def test_rounded_positions_do_not_make_a_line_longer(save, dx, scalar, angle):
    size = scalar if scalar > 0 else -1 / scalar
    way = dx * np.arange(800) / size
    x, y = (np.rint(way * part(np.radians(angle))).astype(int) for part in (np.cos, np.sin))
    path = save([{181: e, 185: n, 71: scalar} for e, n in zip(x.tolist(), y.tolist(), strict=True)], interval=100)
    assert opened(path).dx == pytest.approx(dx, rel=3e-3)


def test_rounded_positions_do_not_make_a_crooked_line_longer(save):
    angle = np.linspace(0, np.pi, 1571)  # of a half circle of 500 m
    x, y = np.rint(500 * np.cos(angle)).astype(int), np.rint(500 * np.sin(angle)).astype(int)
    path = save([{181: e, 185: n} for e, n in zip(x.tolist(), y.tolist(), strict=True)])
    assert opened(path).dx == pytest.approx(np.pi * 500 / 1570, rel=5e-3)


@pytest.mark.parametrize(("first", "last"), [(2, 57), (0, 50), (5, 60)])
def test_traces_without_positions_at_the_ends_are_named(save, first, last):
    headers = [{181: (EAST + 25 * n) * (first <= n < last), 185: NORTH * (first <= n < last)} for n in range(COUNT)]
    path = save(headers)
    refused(
        path, rf"{COUNT - last + first} traces at the ends are at \(0, 0\).* traces=range\({first}, {last}\)", dx=25
    )
    assert opened(path, traces=slice(first, last)).dx == 25


@pytest.mark.parametrize(
    ("interval", "match"),
    [
        (0, "states no sample interval"),
        (4, "0.004 ms.* other units than thousandths"),
        (2, "0.002 ms.* other units than thousandths"),
        (61_536, "61.536 ms.* may be negative"),  # -4000
    ],
)
def test_intervals_that_no_survey_has_are_refused(save, interval, match):
    refused(save(straight(3), interval=interval), f"{match}.* dz=", "dz", dz=4)


@pytest.mark.parametrize(("general", "own"), [(4000, 2000), (2000, 4000), (4000, 4)])
def test_intervals_that_contradict_each_other_name_both(save, general, own):
    path = save([header | {117: own} for header in straight(3)], interval=general)
    refused(path, rf"{general} in its binary header .* and {own} in its trace headers", "dz", dz=4)


def test_records_longer_than_any_are_refused(save):
    refused(save(straight(2), samples=10_000, interval=32_000), r"10000 samples 32 ms.* 319.968 s", "dz", dz=0.032)


@pytest.mark.parametrize(
    ("delay", "scalar", "revision", "match"),
    [
        (32_767, 0, 0, "start at 32767 ms"),
        (-20_000, 0, 0, "start at -20000 ms"),
        (-5536, 0, 0, r"start at -5536 ms.* would end far above 0"),
        (3000, 10, 0x100, "start at 30000 ms"),
        (1000, -10, 0, "start at 1000 ms.* or at 100 if bytes 215-216 hold a scalar, -10, which revision 0"),
        (1000, 8224, 0x100, "8224 as the scalar of its delays"),
    ],
)
def test_starts_that_cannot_be_are_refused(save, delay, scalar, revision, match):
    headers = [header | {109: delay, 215: scalar} for header in straight(3)]
    refused(save(headers, binary={3501: revision}), match, "z0", z0=100)


@pytest.mark.parametrize(
    ("delay", "scalar", "revision", "z0"),
    [
        (100, 0, 0, 100),
        (-100, 0, 0, -100),
        (4000, 1, 0, 4000),
        (1000, 8224, 0, 1000),  # blanks, which revision 0 leaves free
        (1005, -10, 0x100, 100.5),
        (100, 10, 0x100, 1000),
        (0, -10, 0, 0),
    ],
)
def test_starts_of_ordinary_surveys_are_believed(save, delay, scalar, revision, z0):
    headers = [header | {109: delay, 215: scalar} for header in straight(3)]
    path = save(headers, binary={3501: revision})
    assert opened(path).z0 == pytest.approx(z0)
    assert sw.preview(path).z0 == pytest.approx(z0)


@pytest.mark.parametrize(
    ("delay", "interval", "said"),
    [
        (4000, 4000, r"start at 4000 ms.* also the number of their sample interval .* give z0="),
        (1001, 2000, r"start at 1001 ms.* no multiple of their sample interval, 2; .* give z0="),
        (1002, 4000, r"no multiple of their sample interval, 4"),
        (1000, 4000, None),
        (-100, 4000, None),
        (0, 3000, None),
    ],
)
def test_starts_are_compared_with_the_sample_interval(save, delay, interval, said):
    path = save([header | {109: delay} for header in straight(3)], interval=interval)
    texts = [finding.text for finding in sw.preview(path).findings if finding.kind == "start"]
    assert len(texts) == (said is not None)
    assert said is None or re.search(said, texts[0])
    assert opened(path).z0 == delay


def test_delay_scalars_are_read_of_each_trace(save):
    headers = [
        header | {109: delay, 215: s}
        for header, delay, s in zip(straight(3), (100, 1000, 10), (1, -10, 10), strict=True)
    ]
    assert opened(save(headers, binary={3501: 0x100})).z0 == 100


@pytest.mark.parametrize("stated", [0, 7, 9, 4, 16])
@pytest.mark.parametrize("code", [1, 3, 5])
def test_trace_headers_and_size_count_over_a_wrong_number_of_samples(save, stated, code):
    headers = [header | {115: 8} for header in straight(COUNT)]
    sound = opened(save(headers, code=code))
    path = save(headers, code=code, binary={3221: stated})
    np.testing.assert_array_equal(opened(path).amplitude, sound.amplitude)
    (finding,) = sw.preview(path).findings
    assert finding.text.startswith(f"the binary header states {stated} samples per trace (bytes 3221-3222); 8 are read")


def test_a_number_of_samples_that_fits_by_chance_does_not_count(save):
    samples, half = 200, 70  # 240 + 4 * 200 is twice 240 + 4 * 70
    path = save([header | {115: samples} for header in straight(COUNT)], samples=samples, binary={3221: half})
    assert opened(path).shape == (samples, COUNT)


def test_the_size_counts_over_trace_headers_that_state_another_number(save):
    path = save([header | {115: 1000} for header in straight(COUNT)])
    assert opened(path).shape == (8, COUNT)
    assert "trace headers state other numbers of samples" in sw.preview(path).findings[0].text


@pytest.mark.parametrize("free", [range(3261, 3600, 2), [3505], [3269, 3271], [3501]])
def test_bytes_that_revision_0_leaves_free_are_not_read(save, free):
    path = save(line(), binary=dict.fromkeys(free, 0x2020))
    assert (opened(path).shape, opened(path).dx, opened(path).dz) == ((8, COUNT), 25, 4)


@pytest.mark.parametrize("tail", [b"\x1a", b"END OF FILE".ljust(80), bytes(range(1, 201)) * 3])
def test_other_bytes_behind_the_last_trace_are_ignored_too(save, tail):
    path = save([header | {115: 2000} for header in straight(3)], samples=2000)
    path.write_bytes(path.read_bytes() + tail)
    assert opened(path).shape == (2000, 3)
    assert sw.preview(path).findings[0].text == f"{len(tail)} bytes of another kind after the last trace are ignored"


@pytest.mark.parametrize("count", [1, 512, 5000])
def test_zeros_behind_the_last_trace_are_ignored_if_trace_headers_confirm(save, count):
    path = save([header | {115: 2000} for header in straight(3)], samples=2000)
    path.write_bytes(path.read_bytes() + bytes(count))
    assert opened(path).shape == (2000, 3)
    assert [f.text for f in sw.preview(path).findings] == [f"{count} zero bytes after the last trace are ignored"]
    path = save(straight(3), samples=2000)
    path.write_bytes(path.read_bytes() + bytes(count))
    with pytest.raises(sw.DataError, match=f"and {count} bytes are left"):
        opened(path)


def test_a_file_cut_short_is_no_file_with_zeros_behind_it(save):
    path = save([header | {115: 2000} for header in straight(3)], samples=2000)
    path.write_bytes(path.read_bytes()[:-100])
    with pytest.raises(sw.DataError, match="2 fit"):
        opened(path)


@pytest.mark.parametrize("byte", [181, 197, 221, 225, 233])
def test_numbers_may_stand_wherever_revision_0_leaves_room(save, byte):
    other = 237 if byte == 233 else byte + 8
    path = save([{73: 25 * n, 77: 500} for n in range(COUNT)])
    content = bytearray(path.read_bytes())
    for trace in range(COUNT):
        start = 3600 + trace * (240 + 4 * 8) - 1
        content[start + byte : start + byte + 4] = (100 + trace // 10).to_bytes(4, "big")
        content[start + other : start + other + 4] = (300 + trace % 10).to_bytes(4, "big")
    path.write_bytes(content)
    at = {"inline": byte, "crossline": other, "x": 73, "y": 77}
    assert sw.preview(path, header_bytes=at).inlines == (100, 105, 6)
    assert opened(path, inline=102, header_bytes=at).shape == (8, 10)


@pytest.mark.parametrize(
    "lines",
    [
        {36: [58], 37: [58], 38: range(56, 61), 39: range(50, 62), 40: range(46, 70)},  # cut out by a polygon
        {1: range(20, 24), 2: range(20, 24), 3: [20]},
        {5: [7], 4: range(5, 9), 3: range(4, 9), 2: range(3, 9)},
    ],
)
def test_volumes_cut_out_by_a_polygon_are_no_lines(save, lines):
    places = [(i, x) for i, crosslines in lines.items() for x in crosslines]
    path = save([{189: i, 193: x, 181: 25 * x, 185: 25 * i} for i, x in places])
    with pytest.raises(sw.SettingError, match=f"volume of {len(lines)} inlines .* inline=, crossline= or traces="):
        opened(path, dx=25)
    info = sw.preview(path)
    assert (info.inlines, info.dx) == ((min(lines), max(lines), len(lines)), 25)
    longest = max(lines, key=lambda inline: len(lines[inline]))
    assert opened(path, inline=longest).shape == (8, len(lines[longest]))


@pytest.mark.parametrize(("inlines", "crosslines", "fold"), [(3, 4, 3), (2, 10, 2), (5, 5, 24)])
def test_gathers_of_a_volume_are_no_line(save, inlines, crosslines, fold):
    places = [(i, x) for i in range(inlines) for x in range(crosslines) for _ in range(fold)]
    path = save([{189: i, 193: x, 181: 25 * x, 185: 25 * i} for i, x in places])
    with pytest.raises(sw.SettingError, match=f"{inlines} inlines .* and {crosslines} crosslines"):
        opened(path, dx=25)


@pytest.mark.parametrize(
    ("inline", "crossline"),
    [
        (lambda n: n // 2, lambda n: n),
        (lambda n: n, lambda n: 100 - n),
        (lambda n: 7, lambda n: n),
        (lambda n: (37 * n) % 59, lambda n: (23 * n) % 53),  # no numbers of lines at all
    ],
)
def test_a_line_across_a_grid_is_no_volume(save, inline, crossline):
    path = save([header | {189: inline(n), 193: crossline(n)} for n, header in enumerate(line())])
    assert opened(path).dx == 25


def volume_at(inline, crossline):
    return {189: inline, 193: crossline, 181: 400_000 + 25 * crossline, 185: 6_000_000 + 25 * inline, 71: 1}


@pytest.mark.parametrize("missing", [{25}, {25, 26, 30}, {21, 38}])
@pytest.mark.parametrize("step", [1, 3])
def test_missing_traces_of_a_line_of_a_volume_leave_gaps(save, missing, step):
    places = [(i, step * x) for i in (1, 2, 3) for x in range(20, 40) if not (i == 2 and x in missing)]
    path = save([volume_at(*place) for place in places])
    section = opened(path, inline=2)
    assert (section.shape, section.dx) == ((8, 20), 25 * step)
    assert set(20 + np.flatnonzero(np.isnan(section.amplitude).all(axis=0))) == missing
    assert opened(path, inline=1).shape == (8, 20)
    assert not np.isnan(opened(path, crossline=20 * step).amplitude).any()


@pytest.mark.parametrize("numbers", [193, 21])
@pytest.mark.parametrize("missing", [{25}, {25, 26, 40}])
def test_missing_traces_of_a_files_only_line_leave_gaps(save, numbers, missing):
    kept = [n for n in range(COUNT) if n not in missing]
    path = save([{181: EAST + 25 * n, 185: NORTH, numbers: 100 + 2 * n} for n in kept])
    section = opened(path)
    assert (section.shape, section.dx) == ((8, COUNT), 25)
    assert set(np.flatnonzero(np.isnan(section.amplitude).all(axis=0))) == missing
    assert opened(path, dx=20).shape == (8, COUNT)
    sparse = save([{181: EAST + 25 * n, 185: NORTH, numbers: 100 + n + n // 9} for n in range(COUNT)])
    assert not np.isnan(opened(sparse).amplitude).any()


def test_headers_of_a_line_with_gaps_are_continued(save, tmp_path):
    places = [(i, x) for i in (1, 2) for x in range(20, 30) if (i, x) != (2, 25)]
    path = save([volume_at(*place) for place in places])
    sw.save_section(opened(path, inline=2), tmp_path / "out.sgy", like=path, inline=2)
    again = opened(tmp_path / "out.sgy")
    assert (again.shape, again.dx) == ((8, 10), 25)


@pytest.mark.parametrize("slowest", ["place", "offset"])
@pytest.mark.parametrize("offsets", [(100, 200, 300), (-50, 0, 50), range(25, 625, 25)])
@pytest.mark.parametrize("is_volume", [True, False])
def test_traces_before_stack_need_an_offset(save, slowest, offsets, is_volume):
    inlines = (1, 2) if is_volume else (0,)
    places = [(i, x, o) for i in inlines for x in range(20, 30) for o in offsets]
    places.sort(key=(lambda place: place[2]) if slowest == "offset" else lambda place: 0)
    headers = [volume_at(i, x) | {37: o} for i, x, o in places]
    if not is_volume:
        headers = [header | {189: 0, 193: 0, 21: header[193]} for header in headers]
    path, chosen = save(headers), {"inline": 2} if is_volume else {}
    match = f"before stack, of {len(offsets)} offsets: {offsets[0]}, .*choose one with offset="
    for more in ({}, {"dx": 25}):
        with pytest.raises(sw.SettingError, match=match):
            opened(path, **chosen, **more)
    info = sw.preview(path)
    assert info.offsets == (offsets[0], offsets[-1], len(offsets))
    assert "offset" in info.needed
    assert info.dx == 25
    section = opened(path, **chosen, offset=offsets[1])
    assert (section.shape, section.dx) == ((8, 10), 25)
    with pytest.raises(sw.SettingError, match=r"but 0 traces of offset 7; choose one"):
        opened(path, **chosen, offset=7)


def test_offsets_of_a_stacked_line_are_not_asked_for(save):
    path = save([header | {37: 25 * n} for n, header in enumerate(line())])
    assert opened(path).dx == 25
    assert sw.preview(path).offsets is None


def test_several_traces_at_one_place_are_refused(save):
    path = save([volume_at(i, x) for i in (1, 2) for x in range(20, 30) for _ in range(2)])
    with pytest.raises(sw.SettingError, match=r"several traces at one place .* choose them with traces="):
        opened(path, inline=2, dx=25)


@pytest.mark.parametrize(
    "padding", [lambda i, x: {189: i, 193: x, 29: 2}, lambda i, x: {29: 2}, lambda i, x: {189: i, 193: x}]
)
def test_traces_that_pad_a_volume_are_left_out(tmp_path, padding):
    places = [(i, x) for i in (1, 2, 3) for x in range(20, 40)]
    headers = [volume_at(i, x) if 22 <= x < 36 else padding(i, x) for i, x in places]
    traces = np.array([np.ones(8) if header.get(181) else np.zeros(8) for header in headers])
    (tmp_path / "volume.sgy").write_bytes(segy_bytes(traces, headers))
    section = opened(tmp_path / "volume.sgy", inline=2)
    assert (section.shape, section.dx) == ((8, 14), 25)
    info = sw.preview(tmp_path / "volume.sgy")
    assert (info.inlines, info.dx) == ((1, 3, 3), 25)
