import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import segyio

import seiswidgets as sw
from seiswidgets.io.segy.layout import decoded
from seiswidgets.io.segy.reading import line_on_map
from tests.io.segyfiles import ibm, numbered, segy_bytes, straight, volume_headers

RAMP = np.arange(-6, 6).reshape(3, 4)
INLINES, CROSSLINES = [10, 11, 12], [201, 203, 205, 207]


@pytest.fixture
def save(tmp_path):
    def save(*args, **choices):
        path = tmp_path / "line.sgy"
        path.write_bytes(segy_bytes(*args, **choices))
        return path

    return save


def alaska():
    folder = os.environ.get("SEISWIDGETS_DATA_DIR")
    if not folder:
        if os.environ.get("CI"):
            pytest.fail("CI must set SEISWIDGETS_DATA_DIR")
        pytest.skip("the real SEG-Y is not here; set SEISWIDGETS_DATA_DIR")
    return Path(folder) / "31_81_PR.sgy"


def test_the_real_line_is_segyios_own_to_the_bit():
    section = sw.open_section(alaska(), dx=33.5, velocity=3000)
    with segyio.open(alaska(), ignore_geometry=True) as file:
        np.testing.assert_array_equal(section.amplitude.view(np.uint32), file.trace.raw[:].T.view(np.uint32))
    assert section.extent == (0, 533 * 33.5, 0, 6000)
    assert np.ptp(section.amplitude) > 0


def test_the_real_line_says_what_it_needs():
    info = sw.preview(alaska())
    assert info.shape == (1501, 534)
    assert info.needed == ("dx", "z_unit or velocity")
    assert (info.dz, info.z0, info.format) == (4, 0, "IBM float, 4 bytes, big-endian")
    assert info.header.splitlines()[1] == "C02 LINE    L31"
    with pytest.raises(sw.DataError, match=r"31_81_PR.sgy has no trace positions: bytes 181 and 185 .* dx="):
        sw.open_section(alaska(), velocity=3000)


@pytest.mark.parametrize("endian", ["big", "little"])
@pytest.mark.parametrize("code", [1, 2, 3, 5, 6, 8])
def test_samples_of_every_format_and_byte_order(save, code, endian):
    section = sw.open_section(save(RAMP, straight(3), code, endian), z_unit="m")
    np.testing.assert_array_equal(section.amplitude, RAMP.T)
    assert section.amplitude.dtype.isnative
    assert (section.dx, section.dz, section.x0, section.z0) == (25, 4, 0, 0)


@pytest.mark.parametrize("code", [10, 11, 16])
def test_samples_without_a_sign(save, code):
    np.testing.assert_array_equal(
        sw.open_section(save(RAMP + 200, straight(3), code), z_unit="m").amplitude, RAMP.T + 200
    )


def test_large_integers_keep_all_their_digits(save):
    large = RAMP + 2**31 - 10
    np.testing.assert_array_equal(sw.open_section(save(large, straight(3), 2), z_unit="m").amplitude, large.T)


def test_ibm_floats_as_in_their_definition(save):
    assert ibm([1.0, -118.625, 0.0]).tolist() == [0x41100000, 0xC276A000, 0]
    values = np.random.default_rng(0).normal(size=(3, 50)) * 10.0 ** np.arange(-3, 0).reshape(3, 1)
    section = sw.open_section(save(values, straight(3), 1), z_unit="m")
    np.testing.assert_allclose(section.amplitude.T, values, rtol=16 * 2.0**-24)


def test_samples_beyond_32767_are_counted(save):
    path = save(np.ones((2, 40_000)), straight(2), 8)
    assert sw.open_section(path, z_unit="m").shape == (40_000, 2)


def test_a_revision_2_file_counts_its_samples_elsewhere(save, tmp_path):
    content = bytearray(save(RAMP, straight(3), binary={3501: 0x200, 3221: 7}).read_bytes())
    content[3268:3272] = (4).to_bytes(4, "big")
    (tmp_path / "line.sgy").write_bytes(content)
    np.testing.assert_array_equal(sw.open_section(tmp_path / "line.sgy", z_unit="m").amplitude, RAMP.T)


def test_a_revision_2_file_may_say_its_interval_more_finely(save):
    headers = [header | {117: 2500} for header in straight(3)]  # whole microseconds
    path = save(RAMP, headers, interval=2500, binary={3501: 0x200})
    content = bytearray(path.read_bytes())
    content[3272:3280] = np.array(2500.5, ">f8").tobytes()
    path.write_bytes(content)
    assert sw.open_section(path, z_unit="m").dz == 2.5005


@pytest.mark.parametrize("revision", [0x100, 0x200, 1])  # the last is what some programs write for revision 1
def test_extended_textual_headers_are_passed_over(save, tmp_path, revision):
    content = save(RAMP, straight(3), binary={3501: revision, 3505: 2}).read_bytes()
    (tmp_path / "line.sgy").write_bytes(content[:3600] + bytes(6400) + content[3600:])
    np.testing.assert_array_equal(sw.open_section(tmp_path / "line.sgy", z_unit="m").amplitude, RAMP.T)


@pytest.mark.parametrize("count", [0, 1, 3, 20])
def test_an_unknown_number_of_textual_headers_is_found_by_the_trace_headers(save, tmp_path, count):
    headers = [header | {115: 4} for header in straight(3)]
    content = save(RAMP, headers, binary={3501: 0x100, 3505: -1}).read_bytes()
    (tmp_path / "line.sgy").write_bytes(content[:3600] + b"C" * 3200 * count + content[3600:])
    np.testing.assert_array_equal(sw.open_section(tmp_path / "line.sgy", z_unit="m").amplitude, RAMP.T)


@pytest.mark.parametrize(("unit", "dz", "z0"), [("ms", 4, 100), ("s", 0.004, 0.1)])
def test_time_starts_at_the_delay(save, unit, dz, z0):
    headers = [header | {109: 100} for header in straight(3)]
    section = sw.open_section(save(RAMP, headers), z_unit=unit, velocity=2000)
    assert (section.z_unit, section.velocity) == (unit, 2000)
    assert (section.dz, section.z0) == pytest.approx((dz, z0))


def test_the_delay_has_a_scalar(save):
    headers = [header | {109: 105, 215: -10} for header in straight(3)]
    assert sw.open_section(save(RAMP, headers, binary={3501: 0x100}), z_unit="m").z0 == pytest.approx(10.5)


def test_what_is_chosen_counts_over_the_headers(save):
    chosen = {"dx": 10, "dz": 2, "x0": 5, "z0": 7, "x_unit": "ft", "name": "mine", "credit": "us"}
    section = sw.open_section(save(RAMP, straight(3)), z_unit="ft", **chosen)
    assert {name: getattr(section, name) for name in chosen} == chosen


@pytest.mark.parametrize(("scalar", "dx"), [(0, 50), (1, 50), (-100, 0.5), (-10, 5), (-1, 50)])
def test_a_negative_scalar_divides_positions_and_a_positive_one_multiplies_them(save, scalar, dx):
    headers = [{181: 30 * n, 185: 40 * n, 71: scalar} for n in range(3)]
    assert sw.open_section(save(RAMP, headers, interval=500), z_unit="m").dx == pytest.approx(dx)
    assert sw.preview(save(RAMP, [{181: 3 * n, 185: 4 * n, 71: 10} for n in range(3)])).dx == 50


def test_feet_are_said_by_the_binary_header(save):
    assert sw.open_section(save(RAMP, straight(3), binary={3255: 2}), z_unit="ft").x_unit == "ft"


def test_rounded_positions_of_a_slanted_line_give_the_true_spacing(save):
    way = 12.5 * np.arange(400)
    headers = [{181: x, 185: y} for x, y in zip(np.rint(0.8 * way), np.rint(0.6 * way), strict=True)]
    assert sw.open_section(save(np.ones((400, 4)), headers), z_unit="m").dx == pytest.approx(12.5, rel=1e-4)


def test_a_crooked_line_is_measured_along_its_way(save):
    angle = np.linspace(0, np.pi, 101)
    headers = [{181: x, 185: y} for x, y in np.rint(1000 * np.column_stack([np.cos(angle), np.sin(angle)])).astype(int)]
    assert sw.open_section(save(np.ones((101, 4)), headers), z_unit="m").dx == pytest.approx(10 * np.pi, rel=2e-3)


def test_positions_at_other_bytes_are_pointed_out(save):
    path = save(RAMP, straight(3, x=73, y=77))
    with pytest.raises(sw.DataError, match=r"no trace positions.* give header_bytes=.*'x': 73, 'y': 77"):
        sw.open_section(path, z_unit="m")
    assert sw.open_section(path, z_unit="m", header_bytes={"x": 73, "y": 77}).dx == 25
    with pytest.raises(sw.DataError, match=r"bytes 81 and 85 .* give header_bytes=.*'x': 73, 'y': 77"):
        sw.open_section(path, z_unit="m", header_bytes={"x": 81, "y": 85})


def test_uneven_spacing_says_where(save):
    headers = straight(4)
    headers[3][181] += 30
    with pytest.raises(sw.DataError, match=r"most are 25 apart, but traces 2 and 3 \(counted from 0\) are 55.*dx="):
        sw.open_section(save(np.ones((4, 4)), headers), z_unit="m")


def test_traces_at_the_same_place_are_told_of(save):
    headers = [header for header in straight(3) for _ in range(2)]
    with pytest.raises(sw.DataError, match=r"traces 1 and 2 \(counted from 0\) are 25 apart; some are at the same"):
        sw.open_section(save(np.ones((6, 4)), headers), z_unit="m")


def test_angles_are_no_distances(save):
    headers = [header | {89: 2} for header in straight(3)]
    with pytest.raises(sw.DataError, match=r"seconds of arc .* dx="):
        sw.open_section(save(RAMP, headers), z_unit="m")


def test_angles_that_do_not_say_so_are_no_distances(save):
    degrees = [{181: 51_234 + 3 * trace, 185: 539_876, 71: -10_000} for trace in range(3)]
    with pytest.raises(sw.DataError, match=r"positions 0.0003 apart, .* seem to be degrees.* dx="):
        sw.open_section(save(RAMP, degrees), z_unit="m")


@pytest.mark.parametrize("scalar", [31_072, -32_768, 7])  # the first is -100,000 in a field too small for it
def test_a_scalar_that_is_none_is_not_taken(save, scalar):
    headers = [{181: 300 * trace, 71: scalar} for trace in range(3)]
    path = save(RAMP, headers)
    with pytest.raises(sw.DataError, match=rf"has {scalar} as the scalar of its positions \(byte 71 .* dx="):
        sw.open_section(path, z_unit="m")
    assert sw.open_section(path, z_unit="m", dx=25).dx == 25
    assert sw.preview(path).needed == ("dx", "z_unit or velocity")


def test_time_or_depth_is_asked_for(save):
    with pytest.raises(sw.SettingError, match=r"line.sgy does not say whether .* velocity= .* z_unit='m'"):
        sw.open_section(save(RAMP, straight(3)))


@pytest.mark.parametrize(
    ("interval", "own", "message"),
    [(0, 0, "states no sample interval"), (4000, 2000, "states several sample intervals")],
)
def test_an_unclear_interval_is_asked_for(save, interval, own, message):
    path = save(RAMP, [header | {117: own} for header in straight(3)], interval=interval)
    with pytest.raises(sw.DataError, match=f"line.sgy {message}.* dz="):
        sw.open_section(path, z_unit="m")
    assert sw.open_section(path, z_unit="m", dz=5).dz == 5


def test_traces_that_start_at_different_times_are_refused(save):
    headers = [header | {109: 4 * number} for number, header in enumerate(straight(3))]
    with pytest.raises(sw.DataError, match=r"from 0 to 8 .* z0="):
        sw.open_section(save(RAMP, headers), z_unit="m")


@pytest.mark.parametrize("inline_fast", [False, True])
@pytest.mark.parametrize("bytes_", [None, {"inline": 9, "crossline": 21}])
def test_lines_of_a_volume(save, inline_fast, bytes_):
    at = {"il": 9, "xl": 21} if bytes_ else {}
    headers = volume_headers(INLINES, CROSSLINES, inline_fast, **at)
    path = save(numbered(headers, **at), headers)
    inline = sw.open_section(path, inline=11, z_unit="m", header_bytes=bytes_)
    np.testing.assert_allclose(inline.amplitude[0], [1301, 1303, 1305, 1307])
    assert inline.dx == 50
    crossline = sw.open_section(path, crossline=205, z_unit="m", header_bytes=bytes_)
    np.testing.assert_allclose(crossline.amplitude[0], [1205, 1305, 1405])
    assert crossline.dx == 50


def test_a_volume_that_is_not_full_is_searched(save):
    headers = volume_headers(INLINES, CROSSLINES)
    del headers[0]
    path = save(numbered(headers), headers)
    np.testing.assert_allclose(sw.open_section(path, inline=11, z_unit="m").amplitude[0], [1301, 1303, 1305, 1307])
    np.testing.assert_allclose(sw.open_section(path, crossline=201, z_unit="m").amplitude[0], [1301, 1401])


def test_a_volume_that_is_not_full_is_no_line(save):
    headers = volume_headers(INLINES, CROSSLINES)
    del headers[5]
    path = save(numbered(headers), headers)
    with pytest.raises(sw.SettingError, match=r"3 inlines \(10 to 12\) and 4 crosslines \(201 to 207\); choose"):
        sw.open_section(path, z_unit="m", dx=25)
    info = sw.preview(path)
    assert (info.inlines, info.crosslines, info.dx) == ((10, 12, 3), (201, 207, 4), 50)
    assert info.needed == ("inline, crossline or traces", "z_unit or velocity")
    assert sw.open_section(path, z_unit="m", dx=25, traces=slice(None)).shape == (4, 11)


def test_a_line_across_a_grid_is_no_volume(save):
    headers = [{189: 10 + n // 2, 193: 200 + n, 181: 30 * n, 185: 40 * n} for n in range(6)]
    assert sw.open_section(save(np.ones((6, 4)), headers), z_unit="m").dx == 50


def test_a_line_of_an_unsorted_volume_comes_in_order(save):
    headers = volume_headers(INLINES, CROSSLINES)
    headers = [headers[place] for place in np.random.default_rng(1).permutation(12)]
    path = save(numbered(headers), headers)
    np.testing.assert_allclose(sw.open_section(path, inline=11, z_unit="m").amplitude[0], [1301, 1303, 1305, 1307])


def test_a_volume_whose_lines_differ_in_length_by_turns_is_searched(save):
    rows = [(1, 3), (2, 4), (3, 2)]
    headers = [{189: i, 193: c, 181: 25 * c, 185: 50 * i} for i, length in rows for c in range(1, length + 1)]
    path = save(numbered(headers), headers)
    for inline, length in rows:
        expected = [100 * inline + c for c in range(1, length + 1)]
        np.testing.assert_allclose(sw.open_section(path, inline=inline, z_unit="m").amplitude[0], expected)


def test_a_volume_asks_which_line(save):
    headers = volume_headers(INLINES, CROSSLINES)
    path = save(numbered(headers), headers)
    with pytest.raises(sw.SettingError, match=r"3 inlines \(10 to 12\) and 4 crosslines \(201 to 207\)"):
        sw.open_section(path, z_unit="m")
    with pytest.raises(sw.SettingError, match=r"0 traces of inline 13 .* first trace has 10 there, its last one 12"):
        sw.open_section(path, z_unit="m", inline=13)
    with pytest.raises(sw.SettingError, match="not inline and crossline"):
        sw.open_section(path, z_unit="m", inline=11, crossline=201)
    info = sw.preview(path)
    assert (info.inlines, info.crosslines, info.shape) == ((10, 12, 3), (201, 207, 4), (4, 12))
    assert info.needed == ("inline, crossline or traces", "z_unit or velocity")
    assert info.dx == 50


@pytest.mark.parametrize("traces", [slice(4, 8), range(4, 8), slice(7, 3, -1)])
def test_a_range_of_traces(save, traces):
    headers = volume_headers(INLINES, CROSSLINES)
    section = sw.open_section(save(numbered(headers), headers), traces=traces, z_unit="m")
    np.testing.assert_allclose(sorted(section.amplitude[0]), [1301, 1303, 1305, 1307])


@pytest.mark.parametrize("traces", [range(4), range(-1, 2), range(10**12), slice(1, 2), slice(0.5)])
def test_a_range_of_traces_that_are_not_there(save, traces):
    with pytest.raises(sw.SettingError, match="slice or a range of two or more of the 3 traces in"):
        sw.open_section(save(RAMP, straight(3)), traces=traces, z_unit="m")


@pytest.mark.parametrize(
    "chosen", [{"inline": 11.0}, {"crossline": "201"}, {"inline": True}, {"traces": [0, 1]}, {"header_bytes": [73]}]
)
def test_choices_of_another_kind(save, chosen):
    (name,) = chosen
    with pytest.raises(sw.SettingError, match=f"{name}= must be a .*, but is"):
        sw.open_section(save(RAMP, straight(3)), z_unit="m", **chosen)


def test_a_preview_reads_the_bytes_that_are_chosen(save):
    headers = volume_headers(INLINES, CROSSLINES, il=9, xl=21)
    path = save(numbered(headers, il=9, xl=21), headers)
    assert sw.preview(path).inlines is None
    assert sw.preview(path, header_bytes={"inline": 9, "crossline": 21}).inlines == (10, 12, 3)
    with pytest.raises(sw.SettingError, match="no number starts"):
        sw.preview(path, header_bytes={"x": 182})


@pytest.mark.parametrize(
    ("headers", "match"),
    [
        ([{181: x} for x in (0, 25, 50, 110)], "unevenly spaced traces: most are 25 apart"),
        ([{73: x} for x in (0, 25, 50, 75)], "no trace positions.*Other positions are at bytes 73 and 77"),
        ([{181: x, 89: 2} for x in (0, 25, 50, 75)], "positions in degrees"),
    ],
)
def test_a_preview_says_why_positions_are_of_no_use(save, headers, match):
    info = sw.preview(save(np.arange(16).reshape(4, 4), headers))
    assert info.dx is None
    (finding,) = info.findings
    assert finding.severity == "problem"
    assert re.search(match, finding.text)


def test_a_line_on_the_map_runs_through_its_traces(save):
    headers = volume_headers(INLINES, CROSSLINES)
    path = save(numbered(headers), headers)
    np.testing.assert_array_equal(line_on_map(path, crossline=203), [[5075, 500], [5075, 600]])
    bent = [(0, 0), (30, 40), (60, 80), (110, 80), (160, 80)]
    path = save(np.arange(20).reshape(5, 4), [{181: x, 185: y} for x, y in bent])
    np.testing.assert_array_equal(line_on_map(path), bent)
    assert sw.open_section(path, z_unit="m").dx == 50


@pytest.mark.parametrize(("chosen", "message"), [({"x": 182}, "byte 182 .* no number starts"), ({"cdp": 21}, "'cdp'")])
def test_header_bytes_that_are_none(save, chosen, message):
    with pytest.raises(sw.SettingError, match=message):
        sw.open_section(save(RAMP, straight(3)), header_bytes=chosen, z_unit="m")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda content: content[:3000], "ends after 3000 bytes, within the 3600"),
        (lambda content: content[:-1], r"traces of 4 samples take 256 bytes each.* 2 fit, and 255 bytes are left"),
        (lambda content: content[:3600], "0 fit"),
        (lambda content: content[: 3600 + 256], "at least 2 samples by 2 traces"),
        (lambda content: content[:3220] + b"\0\0" + content[3222:], r"no samples \(bytes 3221-3222, and 115-116"),
        (lambda content: content[:3224] + b"\0\4" + content[3226:], "bytes 3225-3226 must be .* but are 0 and 4"),
    ],
)
def test_a_file_that_is_not_as_its_headers_say(save, change, message):
    path = save(RAMP, straight(3))
    path.write_bytes(change(path.read_bytes()))
    with pytest.raises(sw.DataError, match=f"line.sgy.*{message}"):
        sw.open_section(path, z_unit="m")
    with pytest.raises(sw.DataError, match=f"line.sgy.*{message}"):
        sw.preview(path)


def test_an_infinite_sample_says_where(save):
    samples = RAMP.astype(float)
    samples[1, 2] = np.inf
    with pytest.raises(sw.DataError, match="infinite amplitude at sample 2 of trace 1"):
        sw.open_section(save(samples, straight(3)), z_unit="m")


def test_a_line_too_large_for_memory_is_refused_unread(tmp_path):
    content = segy_bytes(np.zeros((2, 60_000), np.int8), straight(2), 8)
    trace = content[3600 : 3600 + 60_240]
    with (tmp_path / "line.sgy").open("wb") as file:
        file.write(content)
        file.truncate(3600 + 6000 * len(trace))  # a file with holes: it takes no room
    with pytest.raises(sw.DataError, match=r"60000 x 6000 amplitudes, 1.34 GiB; the limit is 1 GiB"):
        sw.open_section(tmp_path / "line.sgy", dx=1, dz=1, z_unit="m")


def test_progress_rises_to_one_and_can_cancel(save):
    path, shares = save(np.ones((600, 4)), straight(600)), []
    sw.open_section(path, z_unit="m", progress=shares.append)
    assert shares == sorted(shares)
    assert len(shares) > 2
    assert shares[-1] == 1
    with pytest.raises(sw.Cancelled, match="cancelled"):
        sw.open_section(path, z_unit="m", progress=lambda share: share < 0.5)


@pytest.mark.parametrize("encoding", ["ascii", "cp037"])
def test_textual_headers_in_either_code(encoding):
    lines = decoded(f"{'C01 LINE 7'.ljust(80)}{'C02'.ljust(80)}".encode(encoding)).split("\n")
    assert lines == ["C01 LINE 7", "C02"]


@pytest.mark.parametrize("first", [33, 65, 97])
def test_every_sign_of_a_textual_header_comes_back(tmp_path, first):
    signs = "".join(map(chr, range(first, min(first + 32, 127))))
    sw.save_section(sw.Section(np.ones((2, 2)), 1, 1, name=signs), tmp_path / "line.sgy")
    assert sw.preview(tmp_path / "line.sgy").header.splitlines()[1].endswith(f"SECTION: {signs}")


def test_control_characters_of_a_textual_header_are_not_passed_on():
    assert decoded(b"C01 \x1b[2J\0\r\n".ljust(80)) == "C01 .[2J .."


MEASURED = """
import sys
import numpy as np
from memory import peak
import seiswidgets as sw
import segyio  # so that its own size is not counted
before = peak()
for choice in ({"inline": 70}, {"crossline": 33}):
    section = sw.open_section(sys.argv[1], velocity=2000, **choice)
    assert section.shape == (36_000, 128), section
    assert section.amplitude[100, 33 if "inline" in choice else 70] == 7.5
    assert np.count_nonzero(section.amplitude) == 1
print(peak() - before)
"""


def test_a_line_of_a_volume_of_2_gb_costs_less_than_300_mb(tmp_path):
    path, length = tmp_path / "volume.sgy", 240 + 4 * 36_000
    with path.open("wb") as file:
        file.write(segy_bytes(np.zeros((0, 36_000)), [], code=5))
        for number in range(128 * 128):
            inline, crossline = divmod(number, 128)
            header = {189: inline, 193: crossline, 181: 25 * crossline, 185: 25 * inline}
            file.seek(3600 + number * length)
            file.write(segy_bytes(np.zeros((1, 0)), [header])[3600:])
            if (inline, crossline) == (70, 33):
                file.seek(3600 + number * length + 240 + 4 * 100)
                file.write(np.array(7.5, ">f4").tobytes())
        file.truncate(3600 + 128 * 128 * length)
    assert path.stat().st_size > 2 * 2**30
    run = [sys.executable, "-W", "error", "-c", MEASURED, str(path)]
    printed = subprocess.run(run, cwd=Path(__file__).parent, capture_output=True, text=True, check=False)
    assert printed.returncode == 0, printed.stderr
    print(f"{int(printed.stdout) / 1024:.0f} MB more for two lines of a volume of {path.stat().st_size / 2**30:.2f} GB")
    assert int(printed.stdout) < 300 * 1024
