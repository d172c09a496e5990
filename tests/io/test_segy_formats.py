"""Samples that are of another format than the header states, and options that correct headers."""

import numpy as np
import pytest

import seiswidgets as sw
from tests.io.segyfiles import ibm, segy_bytes, straight

COUNT, SAMPLES = 40, 120
CODES = {"ibm": 1, "i4": 2, "i2": 3, "f4": 5, "i1": 8, "u4": 10, "u2": 11, "u1": 16}


def waves(kind, size):
    """Traces of some character, of about a size."""
    random = np.random.default_rng(0)
    x, z = np.meshgrid(np.arange(COUNT), np.arange(SAMPLES), indexing="ij")
    if kind == "sine":
        return size * np.sin((z + 0.3 * x) / 4)
    wavelet = np.exp(-((np.arange(-20, 21) / 5) ** 2)) * np.cos(np.arange(-20, 21) / 2.5)
    band = np.array([np.convolve(trace, wavelet, "same") for trace in random.normal(size=(COUNT, SAMPLES))])
    return size * {"band": band, "decay": band * np.exp(-z / 30), "muted": band * (z > 40)}[kind]


@pytest.fixture
def save(tmp_path):
    def save(traces, true, stated, counted=True):
        headers = [header | ({115: traces.shape[1]} if counted else {}) for header in straight(len(traces))]
        content = bytearray(segy_bytes(traces, headers, CODES[true]))
        content[3224:3226] = stated.to_bytes(2, "big") if isinstance(stated, int) else CODES[stated].to_bytes(2, "big")
        (tmp_path / "line.sgy").write_bytes(content)
        return tmp_path / "line.sgy"

    return save


def opened(path, **choices):
    return sw.open_section(path, velocity=2000, **choices)


@pytest.mark.parametrize("kind", ["sine", "band", "decay", "muted"])
@pytest.mark.parametrize(
    "formats",
    ["f4 ibm", "ibm f4", "i4 f4", "i4 ibm", "f4 i4", "ibm i4", "u2 i2", "i2 u2"],
)
def test_a_mislabelled_format_is_questioned(save, kind, formats):
    true, stated = formats.split()
    traces = waves(kind, 1000 if true != "f4" else 3)
    traces = np.rint(traces) + 32_768 * (true == "u2") if true[0] in "iu" and true != "ibm" else traces
    path = save(traces, true, stated)
    with pytest.raises(sw.DataError, match=f"give sample_format='{true}', or, .* sample_format='{stated}'$"):
        opened(path)
    info = sw.preview(path)
    assert info.sample_formats == (true, stated)
    assert "sample_format" in info.needed
    assert info.findings[0].severity == "problem"
    np.testing.assert_allclose(opened(path, sample_format=true).amplitude.T, traces, rtol=1e-6, atol=1e-6)
    if (true, stated) != ("i4", "ibm"):  # which has infinite amplitudes
        assert opened(path, sample_format=stated).shape == (SAMPLES, COUNT)
    assert "sample_format" not in sw.preview(path, sample_format=true).needed


@pytest.mark.parametrize("kind", ["sine", "band", "decay", "muted"])
@pytest.mark.parametrize("size", [1e-4, 0.5, 100, 30_000])
@pytest.mark.parametrize("code", ["ibm", "f4"])
def test_a_right_format_is_not_questioned(save, kind, size, code):
    path = save(waves(kind, size), code, code)
    np.testing.assert_allclose(opened(path).amplitude.T, waves(kind, size), rtol=1e-6, atol=size * 1e-6)
    assert sw.preview(path).findings == ()


@pytest.mark.parametrize("code", ["i4", "i2", "i1", "u1", "u2", "u4"])
@pytest.mark.parametrize("kind", ["sine", "band"])
def test_right_integers_are_not_questioned(save, code, kind):
    middle = 128 * (code == "u1") + 32_768 * (code == "u2") + 2**31 * (code == "u4")
    traces = np.clip(np.rint(waves(kind, 100)), -127, 127) + middle
    np.testing.assert_array_equal(opened(save(traces, code, code)).amplitude.T, traces)


@pytest.mark.parametrize(("true", "stated"), [("i2", "f4"), ("f4", "i2"), ("i1", "ibm"), ("ibm", "i1")])
def test_a_format_of_another_size_is_named(save, true, stated):
    traces = np.clip(np.rint(waves("band", 60)), -99, 99)
    path = save(traces, true, stated)
    with pytest.raises(sw.DataError, match=rf"fit samples of \d bytes?: give sample_format=.*'{true}'"):
        opened(path)
    np.testing.assert_array_equal(opened(path, sample_format=true).amplitude.T, traces)


@pytest.mark.parametrize(("true", "stated"), [("f4", "i2"), ("ibm", "i1"), ("i2", "f4")])
@pytest.mark.parametrize("samples", [100, 120])
def test_a_format_of_another_size_is_named_without_counts_in_trace_headers(save, true, stated, samples):
    traces = (np.rint if true == "i2" else np.array)(waves("band", 60)[:, :samples])
    with pytest.raises(sw.DataError, match=rf"fit samples of \d bytes?: give sample_format=.*'{true}'"):
        opened(save(traces, true, stated, counted=False))


@pytest.mark.parametrize("given", ["ieee", "f4", 5, ">f4"])
def test_a_format_that_the_header_does_not_state_is_asked_for(save, given):
    path = save(waves("band", 1), "f4", 0)
    with pytest.raises(sw.DataError, match="states no format: give sample_format="):
        sw.preview(path)
    np.testing.assert_allclose(opened(path, sample_format=given).amplitude.T, waves("band", 1), rtol=1e-6)


def test_the_byte_order_of_samples_may_be_given(save):
    traces = np.rint(waves("band", 500))
    path = save(traces, "i2", "i2")
    content = np.frombuffer(path.read_bytes(), np.uint8).copy()
    samples = content[3600:].reshape(COUNT, -1)[:, 240:]
    samples[:] = samples.reshape(COUNT, -1, 2)[:, :, ::-1].reshape(COUNT, -1)
    path.write_bytes(content.tobytes())
    with pytest.raises(sw.DataError, match=r"in the other byte order.* give sample_format='<i2'"):
        opened(path)
    np.testing.assert_array_equal(opened(path, sample_format="<i2").amplitude.T, traces)


@pytest.mark.parametrize("label", [b"   1SY1.0RECORD  8192", b"SY2.0"])
def test_a_tape_label_is_passed_over(tmp_path, label):
    content = segy_bytes(waves("band", 1), straight(COUNT), binary={3203: 7})
    for name in ("line.sgy", "line"):
        (tmp_path / name).write_bytes(label.ljust(128) + content)
        np.testing.assert_allclose(opened(tmp_path / name).amplitude.T, waves("band", 1), rtol=1e-6)
    assert sw.preview(tmp_path / "line").header.startswith("C01 A LINE")
    sw.save_section(opened(tmp_path / "line"), tmp_path / "out.sgy", like=tmp_path / "line")
    assert (tmp_path / "out.sgy").read_bytes()[3202:3204] == b"\0\7"


@pytest.mark.parametrize("order", ["big", "little"])
def test_the_byte_order_of_a_file_may_be_given(tmp_path, order):
    content = bytearray(segy_bytes(waves("band", 1), straight(COUNT), endian=order))
    content[3224:3226] = b"\0\0"
    (tmp_path / "line.sgy").write_bytes(content)
    for choices in ({"byte_order": order}, {}):
        again = opened(tmp_path / "line.sgy", sample_format="f4", **choices)
        np.testing.assert_allclose(again.amplitude.T, waves("band", 1), rtol=1e-6)


@pytest.mark.parametrize(("revision", "z0"), [(0, 1000), (1, 100), (2, 100)])
def test_the_revision_says_what_bytes_mean(tmp_path, revision, z0):
    headers = [header | {109: 1000, 215: -10} for header in straight(COUNT)]
    stated = {3501: 0 if revision else 0x100}
    (tmp_path / "line.sgy").write_bytes(segy_bytes(waves("band", 1), headers, binary=stated))
    if revision:
        assert opened(tmp_path / "line.sgy", revision=revision).z0 == z0
    else:
        with pytest.raises(sw.DataError, match=r"at 1000 ms.* or at 100 if bytes 215-216 hold a scalar"):
            opened(tmp_path / "line.sgy", revision=0)


@pytest.mark.parametrize(
    "choice",
    [{"sample_format": "i3"}, {"sample_format": 4}, {"byte_order": "middle"}, {"revision": 3}, {"revision": True}],
)
def test_corrections_that_do_not_exist_are_refused(save, choice):
    (name,) = choice
    with pytest.raises(sw.SettingError, match=f"{name}= must be one of"):
        sw.preview(save(waves("band", 1), "f4", "f4"), **choice)


def stored(value, kind):
    number = ibm([value]).astype(">u4") if kind == "ibm" else np.array([value], f">{kind}")
    return number.tobytes()


@pytest.mark.parametrize("kind", ["i2", "u2", "i4", "u4", "f4", "f8", "ibm"])
def test_header_numbers_may_have_any_width_and_kind(tmp_path, kind):
    headers = [{71: 1} for _ in range(COUNT)]
    content = bytearray(segy_bytes(waves("band", 1), headers))
    length = 240 + 4 * SAMPLES
    for trace in range(COUNT):
        for byte, value in ((17, 100 + trace // 10), (183, 25 * (trace % 10)), (193, trace % 10)):
            number = stored(value, kind)
            start = 3600 + length * trace + byte - 1
            content[start : start + len(number)] = number
    (tmp_path / "volume.sgy").write_bytes(content)
    at = {"inline": (17, kind), "x": (183, kind), "y": (1, "i4"), "crossline": [193, kind]}
    assert sw.preview(tmp_path / "volume.sgy", header_bytes=at).inlines == (100, 103, 4)
    section = opened(tmp_path / "volume.sgy", header_bytes=at, inline=102)
    assert (section.shape, section.dx) == ((SAMPLES, 10), 25)


@pytest.mark.parametrize(
    ("value", "match"),
    [
        ((181, "f3"), "takes x as one of i2, .* but has 'f3'"),
        ((238, "i4"), "where no number starts"),
        ((0, "i2"), "where no number starts"),
        (182, "Other numbers need their kind, as in {'x': "),
    ],
)
def test_header_numbers_that_cannot_be_are_refused(save, value, match):
    path = save(waves("band", 1), "f4", "f4")
    with pytest.raises(sw.SettingError, match=match):
        sw.preview(path, header_bytes={"x": value})
    with pytest.raises(sw.SettingError, match="takes scalar as one of i2, u2, i4, u4, but has 'f4'"):
        sw.preview(path, header_bytes={"scalar": (71, "f4")})


def test_positions_of_a_given_kind_are_not_guessed(tmp_path):
    bits = [int(np.array(434_000 + 25 * n, ">f4").view(">i4")) for n in range(COUNT)]
    headers = [{181: value, 185: int(np.array(6_478_000, ">f4").view(">i4"))} for value in bits]
    (tmp_path / "line.sgy").write_bytes(segy_bytes(waves("band", 1), headers))
    kinds = {"x": (181, "f4"), "y": (185, "f4")}
    assert opened(tmp_path / "line.sgy", header_bytes=kinds).dx == 25
    with pytest.raises(sw.DataError, match="beyond every map"):
        opened(tmp_path / "line.sgy", header_bytes={"x": (181, "i4"), "y": (185, "i4")})
