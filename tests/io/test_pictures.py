import json
import logging
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest
import tifffile
from PIL import ExifTags, Image

import seiswidgets as sw
from seiswidgets.io.rasters import images

GREY = np.array([[0, 255, 51], [102, 153, 204]], np.uint8)
EXTENT = (100, 300, 500, 540)


def opened(path):
    return sw.open_section(path, extent=EXTENT, z_unit="m")


def tiff(path, samples, **choices):
    tifffile.imwrite(path, samples, **{"photometric": "minisblack", **choices})
    return path


def no_data(value):
    return [(42113, "s", 0, value, True)]


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def png(path, samples, depth, colour, *before, after=(), width=None):
    """A PNG of rows of bytes, or of samples of 16 bits, none of which Pillow can write."""
    rows = samples.astype(">u2") if samples.dtype == np.uint16 else samples
    header = struct.pack(">IIBBBBB", width or samples.shape[1], len(samples), depth, colour, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row.tobytes() for row in rows))
    chunks = [(b"IHDR", header), *before, (b"IDAT", pixels), *after, (b"IEND", b"")]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*parts) for parts in chunks))
    return path


def with_data(path, data, **tags):
    """A TIFF whose only strip is replaced by other bytes, and some of whose tags are."""
    tags |= {"StripOffsets": path.stat().st_size, "StripByteCounts": len(data)}
    path.write_bytes(path.read_bytes() + data)
    with tifffile.TiffFile(path, mode="r+b") as file:
        for name, value in tags.items():
            file.pages[0].tags[name].overwrite(value)
    return path


def packed(values, bits):
    """Integers of so few bits, the highest first, each row from a new byte on."""
    each = np.unpackbits(values.astype(">u2").view(np.uint8).reshape(*values.shape, 2), axis=2)[:, :, 16 - bits :]
    return np.packbits(each.reshape(len(values), -1), axis=1)


def lzw(data):
    """TIFF's LZW without any string: its table is cleared before the codes would take more than 9 bits."""
    codes = []
    for place in range(0, len(data), 200):
        codes += [256, *data[place : place + 200]]
    return packed(np.array([[*codes, 257]]), 9).tobytes()


def packbits(data):
    return b"".join(bytes([len(run) - 1]) + run for run in (data[i : i + 128] for i in range(0, len(data), 128)))


def saved(path, pixels, **choices):
    Image.fromarray(pixels).save(path, **choices)
    return path


@pytest.mark.parametrize("suffix", [".png", ".tif"])
def test_grey_counts_from_the_middle(tmp_path, suffix):
    section = sw.open_section(saved(tmp_path / f"scan{suffix}", GREY), extent=EXTENT, z_unit="m")
    np.testing.assert_array_equal(section.amplitude, GREY - 127.5)
    assert section.amplitude.dtype == np.float32
    assert section.extent == EXTENT
    assert (section.dx, section.dz, section.name) == (100, 40, "scan")


def test_the_content_tells_the_kind_before_the_suffix(tmp_path):
    path = saved(tmp_path / "scan.png", GREY).rename(tmp_path / "scan.sgy")
    assert sw.preview(path).kind == "picture"


def test_a_jpeg_is_nearly_as_it_was(tmp_path):
    pixels = np.repeat(np.repeat(GREY, 16, axis=0), 16, axis=1)
    section = sw.open_section(saved(tmp_path / "scan.jpg", pixels, quality=95), extent=EXTENT, velocity=2000)
    assert np.abs(section.amplitude + 127.5 - pixels).max() <= 3
    assert section.z_unit == "ms"


@pytest.mark.parametrize("suffix", [".png", ".tif"])
def test_grey_of_16_bits_keeps_them(tmp_path, suffix):
    deep = GREY.astype(np.uint16) * 257
    section = sw.open_section(saved(tmp_path / f"scan{suffix}", deep), extent=EXTENT, z_unit="m")
    np.testing.assert_array_equal(section.amplitude, deep - 32767.5)


def test_a_tiff_of_floats_is_taken_as_it_is(tmp_path):
    amplitude = np.array([[0.5, -2], [3, np.nan]], np.float32)
    section = sw.open_section(saved(tmp_path / "scan.tif", amplitude), extent=EXTENT, z_unit="m")
    np.testing.assert_array_equal(section.amplitude, amplitude)


def test_colours_become_grey_and_what_is_transparent_no_data(tmp_path):
    pixels = np.dstack([GREY, GREY, GREY, np.full_like(GREY, 255)])
    pixels[0, 0, 3] = 0
    section = sw.open_section(saved(tmp_path / "scan.png", pixels), extent=EXTENT, z_unit="m")
    expected = GREY - 127.5
    expected[0, 0] = np.nan
    np.testing.assert_array_equal(section.amplitude, expected)


@pytest.mark.parametrize("orientation", range(1, 9))
@pytest.mark.parametrize("suffix", [".png", ".tif"])
def test_a_picture_stands_as_its_metadata_say(tmp_path, suffix, orientation):
    exif = Image.Exif()
    exif[ExifTags.Base.Orientation] = orientation
    path = tmp_path / f"scan{suffix}"
    Image.fromarray(GREY).save(path, exif=exif, **({"compression": "tiff_lzw"} if suffix == ".tif" else {}))
    upright = [GREY, GREY[:, ::-1], GREY[::-1, ::-1], GREY[::-1]]
    upright += [grey.T for grey in (GREY, GREY[::-1], GREY[::-1, ::-1], GREY[:, ::-1])]
    np.testing.assert_array_equal(opened(path).amplitude + 127.5, upright[orientation - 1])
    assert sw.preview(path).shape == upright[orientation - 1].shape


def test_clear_pixels_of_16_bits_leave_the_others_theirs(tmp_path):
    deep = np.array([[0, 1, 256], [65_535, 300, 2]], np.uint16)
    Image.fromarray(deep).save(tmp_path / "scan.png", transparency=256)
    expected = np.where(deep == 256, np.nan, deep - 32_767.5)
    np.testing.assert_array_equal(opened(tmp_path / "scan.png").amplitude, expected)


def test_a_tiff_in_which_white_is_zero(tmp_path):
    deep = np.array([[0, 1, 256], [65_535, 300, 2]], np.uint16)
    path = tmp_path / "scan.tif"
    Image.fromarray(deep).save(path)
    tag = bytes.fromhex("0601 0300 01000000 01000000")  # PhotometricInterpretation: 1, black is zero
    path.write_bytes(path.read_bytes().replace(tag, tag[:8] + bytes(4)))
    np.testing.assert_array_equal(opened(path).amplitude, 32_767.5 - deep)


def test_of_several_pages_the_first_is_taken(tmp_path):
    first = Image.fromarray(GREY)
    first.save(tmp_path / "scan.tif", save_all=True, append_images=[Image.fromarray(255 - GREY)])
    with pytest.warns(UserWarning, match=r"scan.tif has 2 pages, of which only the first is read"):
        section = opened(tmp_path / "scan.tif")
    np.testing.assert_array_equal(section.amplitude + 127.5, GREY)
    assert sw.preview(tmp_path / "scan.tif").format == "TIFF, 8-bit grey, page 1 of 2"


def test_axes_are_asked_for(tmp_path):
    path = saved(tmp_path / "scan.png", GREY)
    with pytest.raises(sw.SettingError, match=r"scan.png does not say how wide and how deep it is: give extent="):
        sw.open_section(path, z_unit="m")
    with pytest.raises(sw.SettingError, match=r"scan.png does not say whether it is in time or in depth"):
        sw.open_section(path, extent=EXTENT)
    assert sw.preview(path).needed == ("extent", "z_unit or velocity")
    assert sw.preview(path).shape == (2, 3)
    with pytest.raises(sw.SettingError, match="header_bytes= has no meaning for a picture"):
        sw.preview(path, header_bytes={"x": 73})


@pytest.mark.parametrize("extent", [(300, 100, 0, 1), (0, 1, 2), "wide", (0, np.inf, 0, 1)])
def test_an_extent_that_is_none(tmp_path, extent):
    with pytest.raises(sw.SettingError, match="extent= must be"):
        sw.open_section(saved(tmp_path / "scan.png", GREY), extent=extent, z_unit="m")


@pytest.mark.parametrize("choice", [{"inline": 1}, {"traces": slice(4)}, {"header_bytes": {}}])
def test_choices_of_segy_have_no_meaning(tmp_path, choice):
    (name,) = choice
    with pytest.raises(sw.SettingError, match=f"{name}= has no meaning for a picture"):
        sw.open_section(saved(tmp_path / "scan.png", GREY), extent=EXTENT, z_unit="m", **choice)


def test_an_extent_and_a_spacing_are_one_too_many(tmp_path):
    with pytest.raises(sw.SettingError, match="dx= has no meaning for a file whose extent is given"):
        sw.open_section(saved(tmp_path / "scan.png", GREY), extent=EXTENT, dx=1, z_unit="m")


def test_a_picture_with_too_many_pixels_is_refused_undecoded(tmp_path, monkeypatch):
    path = saved(tmp_path / "scan.png", GREY)
    monkeypatch.setattr(images, "MOST_PIXELS", 5)
    monkeypatch.setattr(Image.Image, "load", lambda image: pytest.fail("decoded"))
    with pytest.raises(sw.DataError, match=r"scan.png is an image of 3 x 2 pixels; the limit is 5"):
        sw.preview(path)


def test_a_png_that_claims_a_thousand_million_pixels_is_refused(tmp_path):
    content = bytearray(saved(tmp_path / "scan.png", GREY).read_bytes())
    content[16:24] = (40_000).to_bytes(4, "big") * 2
    content[29:33] = zlib.crc32(content[12:29]).to_bytes(4, "big")
    (tmp_path / "scan.png").write_bytes(content)
    with pytest.raises(sw.DataError, match=r"scan.png is too large an image"):
        sw.preview(tmp_path / "scan.png")


def test_half_a_picture_is_an_error(tmp_path):
    path = saved(tmp_path / "scan.png", np.random.default_rng(0).integers(0, 255, (50, 50), np.uint8))
    path.write_bytes(path.read_bytes()[:1000])
    with pytest.raises(sw.DataError, match=r"scan.png is a damaged image.*save it again as PNG"):
        sw.open_section(path, extent=EXTENT, z_unit="m")


def test_a_picture_that_lacks_its_lower_part_is_refused(tmp_path):
    path = saved(tmp_path / "scan.tif", GREY)
    content = path.read_bytes()
    height = content.index((257).to_bytes(2, "little")) + 8
    path.write_bytes(content[:height] + (1_000_000).to_bytes(4, "little") + content[height + 4 :])
    with pytest.raises(
        sw.DataError, match=r"scan.tif claims to have 3 x 1000000 pixels, but holds 1 of the 500,000 strips"
    ):
        sw.preview(path)


KINDS = ["i1", "i2", "i4", "i8", "u4", "u8", "f2", "f4", "f8"]


def numbers(kind):
    """Samples from one end of a kind's range to the other, shape (3, 5)."""
    dtype = np.dtype(kind)
    if dtype.kind == "f":
        return np.linspace(-np.pi, 1e4, 15).astype(dtype).reshape(3, 5)
    ends = np.iinfo(dtype)
    return np.array([ends.min, ends.max, *range(13)], dtype).reshape(3, 5)


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize("kind", KINDS)
def test_numbers_in_a_tiff_are_amplitudes(tmp_path, kind, order):
    samples = numbers(kind)
    section = opened(tiff(tmp_path / "line.tif", samples, byteorder=order, bigtiff=order == ">", rowsperstrip=2))
    np.testing.assert_array_equal(section.amplitude, samples.astype(float))
    assert section.amplitude.dtype == (np.float32 if samples.itemsize <= 2 or kind == "f4" else np.float64)
    words = {"i": "signed integers", "u": "unsigned integers", "f": "floats"}[kind[0]]
    assert sw.preview(tmp_path / "line.tif").format == f"TIFF, {8 * samples.itemsize}-bit {words}"


@pytest.mark.parametrize("compression", ["zlib", "lzma", "packbits", "lzw"])
@pytest.mark.parametrize("kind", ["i1", "u2", "f4", "f8"])
def test_a_compressed_tiff(tmp_path, kind, compression):
    samples = numbers(kind)
    path = tmp_path / "line.tif"
    if compression in ("packbits", "lzw"):
        data, number = {"packbits": (packbits, 32773), "lzw": (lzw, 5)}[compression]
        with_data(tiff(path, samples), data(samples.tobytes()), Compression=number)
    else:
        tiff(path, samples, compression=compression, rowsperstrip=2)
    np.testing.assert_array_equal(opened(path).amplitude, samples.astype(float) - (32_767.5 if kind == "u2" else 0))


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize("kind", ["i1", "i2", "i4", "u4"])
def test_integers_stored_as_differences(tmp_path, kind, order):
    path = tiff(tmp_path / "line.tif", numbers(kind), predictor=2, compression="zlib", byteorder=order)
    np.testing.assert_array_equal(opened(path).amplitude, numbers(kind).astype(float))


@pytest.mark.parametrize("kind", ["f2", "f4", "f8"])
def test_floats_stored_as_differences_of_their_bytes(tmp_path, kind):
    samples = numbers(kind)
    by_place = samples.astype(f">{kind}").view(np.uint8).reshape(3, 5, -1).swapaxes(1, 2).reshape(3, -1)
    data = zlib.compress(np.diff(by_place, axis=1, prepend=np.uint8(0)).tobytes())
    path = tiff(tmp_path / "line.tif", samples.view(kind.replace("f", "i")), compression="zlib", predictor=2)
    np.testing.assert_array_equal(opened(with_data(path, data, Predictor=3, SampleFormat=3)).amplitude, samples)


@pytest.mark.parametrize("tile", [None, (16, 32)])
@pytest.mark.parametrize("compression", [None, "zlib"])
def test_tiles_and_strips(tmp_path, tile, compression):
    samples = np.arange(40 * 70, dtype=np.int32).reshape(40, 70)
    layout = {"tile": tile} if tile else {"rowsperstrip": 7}
    path = tiff(tmp_path / "line.tif", samples, compression=compression, **layout)
    np.testing.assert_array_equal(opened(path).amplitude, samples)


@pytest.mark.parametrize("bits", [1, 2, 3, 4, 6, 10, 12, 14, 15])
@pytest.mark.parametrize("white", ["minisblack", "miniswhite"])
def test_grey_of_fewer_bits_than_its_bytes(tmp_path, bits, white):
    shades = np.random.default_rng(bits).integers(0, 2**bits, (4, 13))
    shades[0, :2] = 0, 2**bits - 1
    path = tmp_path / "scan.tif"
    tiff(path, np.zeros(shades.shape, np.uint8 if bits <= 8 else np.uint16), photometric=white)
    with_data(path, packed(shades, bits).tobytes(), BitsPerSample=bits)
    largest = 255 if bits < 8 else 2**bits - 1
    expected = shades * (largest / (2**bits - 1)) - largest / 2
    amplitude = opened(path).amplitude
    np.testing.assert_allclose(amplitude, -expected if white == "miniswhite" else expected, atol=1e-4)
    assert sw.preview(path).format.startswith(f"TIFF, {bits}-bit grey")


@pytest.mark.parametrize("compression", ["tiff_ccitt", "group3", "group4", "packbits", "tiff_lzw"])
def test_black_and_white(tmp_path, compression):
    black = np.random.default_rng(0).random((30, 41)) < 0.4
    path = saved(tmp_path / "scan.tif", black, compression=compression)
    np.testing.assert_array_equal(opened(path).amplitude, black * 255 - 127.5)
    assert sw.preview(path).format.startswith("TIFF, 1-bit grey")


@pytest.mark.parametrize("samples", [GREY, np.dstack([GREY] * 3), np.dstack([GREY, 255 - GREY, GREY])])
def test_a_tiff_of_jpeg(tmp_path, samples):
    pixels = np.repeat(np.repeat(samples, 16, axis=0), 16, axis=1)
    path = saved(tmp_path / "scan.tif", pixels, compression="jpeg", quality=95)
    expected = luma(pixels) if samples.ndim == 3 else pixels
    assert np.abs(opened(path).amplitude + 127.5 - expected).max() <= 3
    assert sw.preview(path).format == f"TIFF, 8-bit {'colour' if samples.ndim == 3 else 'grey'}"


def luma(colours):
    """Grey of 8 or 16 bits as ITU-R BT.601 has it, in 65536ths."""
    return (colours[:, :, :3].astype(np.int64) @ [19595, 38470, 7471] + 2**15) >> 16


def colours(kind, count, seed=0):
    samples = np.random.default_rng(seed).integers(0, np.iinfo(kind).max, (5, 7, count), kind, endpoint=True)
    if count in (2, 4):
        samples[1, 2:4, -1] = 0
        samples[2, 2, -1] = 1  # nearly clear is not clear
    return samples


@pytest.mark.parametrize("planar", ["contig", "separate"])
@pytest.mark.parametrize("count", [3, 4])
@pytest.mark.parametrize("kind", ["u1", "u2"])
def test_colour_in_a_tiff_keeps_its_bits(tmp_path, kind, count, planar):
    samples = colours(kind, count)
    stored = samples if planar == "contig" else np.moveaxis(samples, 2, 0)
    extra = {"extrasamples": ["unassalpha"]} if count == 4 else {}
    path = tiff(tmp_path / "scan.tif", stored, photometric="rgb", planarconfig=planar, **extra)
    expected = luma(samples) - np.iinfo(kind).max / 2
    if count == 4:
        expected[samples[:, :, 3] == 0] = np.nan
    np.testing.assert_array_equal(opened(path).amplitude, expected)
    bits, alpha = 8 * samples.itemsize, " with alpha" if count == 4 else ""
    assert sw.preview(path).format == f"TIFF, {bits}-bit colour{alpha}"


@pytest.mark.parametrize("kind", ["u1", "u2", "f4"])
def test_grey_and_alpha_in_a_tiff(tmp_path, kind):
    samples = colours("u2", 2) if kind == "u2" else colours("u1", 2)
    path = tiff(tmp_path / "scan.tif", samples.astype(kind), planarconfig="contig", extrasamples=["unassalpha"])
    middle = 0 if kind == "f4" else np.iinfo(kind).max / 2
    np.testing.assert_array_equal(
        opened(path).amplitude, np.where(samples[:, :, 1] == 0, np.nan, samples[:, :, 0] - middle)
    )


@pytest.mark.parametrize("kind", ["u1", "u2", "f4"])
def test_premultiplied_colours_are_undone(tmp_path, kind):
    largest = 1.0 if kind == "f4" else np.iinfo(kind).max
    grey, opacity = np.array([[0.2, 0.4], [0.6, 0.8]]), np.array([[1, 0.5], [0.75, 0]])
    samples = np.dstack([*[grey * opacity * largest] * 3, opacity * largest])
    samples = samples.astype(kind) if kind == "f4" else np.rint(samples).astype(kind)
    amplitude = opened(tiff(tmp_path / "scan.tif", samples, photometric="rgb", extrasamples=["assocalpha"])).amplitude
    expected = grey * largest - (0 if kind == "f4" else largest / 2)
    assert np.isnan(amplitude[1, 1])
    np.testing.assert_allclose(amplitude[:, 0], expected[:, 0], atol=1e-6 if kind == "f4" else 1)
    np.testing.assert_allclose(amplitude[0], expected[0], atol=1e-6 if kind == "f4" else 1)


@pytest.mark.parametrize(
    ("palette", "expected"),
    [
        (np.arange(256) * 257, np.arange(256) - 127.5),
        (np.arange(256) * 256, np.arange(256) - 127.5),
        (30_000 + np.arange(256), 30_000 + np.arange(256) - 32_767.5),
    ],
)
def test_a_palette_in_a_tiff(tmp_path, palette, expected):
    indices = np.random.default_rng(0).integers(0, 256, (5, 7), np.uint8)
    colormap = np.tile(palette.astype(np.uint16), (3, 1))
    path = tiff(tmp_path / "scan.tif", indices, photometric="palette", colormap=colormap)
    np.testing.assert_array_equal(opened(path).amplitude, expected[indices])
    assert sw.preview(path).format == "TIFF, 8-bit palette"


def test_a_palette_of_16_bits(tmp_path):
    shades = np.random.default_rng(0).integers(0, 2**16, 2**16, np.uint16)
    indices = np.array([[0, 1, 65_535], [300, 301, 40_000]], np.uint16)
    path = tiff(tmp_path / "scan.tif", indices, photometric="palette", colormap=np.tile(shades, (3, 1)))
    np.testing.assert_array_equal(opened(path).amplitude, shades[indices] - 32_767.5)


@pytest.mark.parametrize(
    ("kind", "value"),
    [("f4", "-9999"), ("f4", "-3.4028234663852886e+38"), ("f8", "1e30"), ("i2", "-32768"), ("u1", "0")],
)
def test_a_no_data_value_is_no_amplitude(tmp_path, kind, value):
    samples = np.arange(1, 16).reshape(3, 5).astype(kind)
    samples[1, 2:] = np.dtype(kind).type(float(value))
    section = opened(tiff(tmp_path / "line.tif", samples, extratags=no_data(value)))
    expected = samples.astype(float) - (127.5 if kind == "u1" else 0)
    expected[1, 2:] = np.nan
    np.testing.assert_array_equal(section.amplitude, expected)
    assert "no-data value" in sw.preview(tmp_path / "line.tif").format


@pytest.mark.parametrize(
    ("kind", "value"), [("u1", "-9999"), ("i2", "0.5"), ("f4", "nan"), ("u2", "70000"), ("f4", "")]
)
def test_a_no_data_value_that_no_sample_has(tmp_path, kind, value):
    samples = np.arange(15).reshape(3, 5).astype(kind)
    section = opened(tiff(tmp_path / "line.tif", samples, extratags=no_data(value)))
    assert np.isfinite(section.amplitude).all()


def test_colours_are_no_data_only_if_all_three_are(tmp_path):
    samples = colours("u1", 3)
    samples[0, 0], samples[0, 1] = (7, 7, 7), (7, 7, 8)
    section = opened(tiff(tmp_path / "scan.tif", samples, photometric="rgb", extratags=no_data("7")))
    assert np.argwhere(np.isnan(section.amplitude)).tolist() == [[0, 0]]


def test_a_no_data_value_that_is_no_number(tmp_path):
    path = tiff(tmp_path / "line.tif", GREY, extratags=no_data("none"))
    with pytest.raises(sw.DataError, match=r"line.tif: its no-data value .* must be a number, but is 'none'"):
        sw.preview(path)


def test_a_mask_hides_what_it_leaves_out(tmp_path):
    shown = np.array([[True, False, True], [True, True, False]])
    with tifffile.TiffWriter(tmp_path / "scan.tif") as file:
        file.write(GREY, photometric="minisblack")
        file.write(shown, photometric="mask", subfiletype=4)
    np.testing.assert_array_equal(opened(tmp_path / "scan.tif").amplitude, np.where(shown, GREY - 127.5, np.nan))
    assert sw.preview(tmp_path / "scan.tif").format == "TIFF, 8-bit grey, with a mask"


def test_a_thumbnail_before_the_picture_is_passed_over(tmp_path):
    with tifffile.TiffWriter(tmp_path / "scan.tif") as file:
        file.write(GREY[:, :2], photometric="minisblack", subfiletype=1)
        file.write(GREY, photometric="minisblack")
    np.testing.assert_array_equal(opened(tmp_path / "scan.tif").amplitude, GREY - 127.5)


def test_tiles_that_a_sparse_file_leaves_out_are_no_data(tmp_path):
    samples = np.arange(32 * 32, dtype=np.float32).reshape(32, 32)
    path = tiff(tmp_path / "line.tif", samples, tile=(16, 16))
    with tifffile.TiffFile(path, mode="r+b") as file:
        for name in ("TileOffsets", "TileByteCounts"):
            tag = file.pages[0].tags[name]
            tag.overwrite((*tag.value[:3], 0))
    samples[16:, 16:] = np.nan
    np.testing.assert_array_equal(opened(path).amplitude, samples)


@pytest.mark.parametrize(
    ("samples", "choices", "message"),
    [
        (np.ones((4, 5), np.complex64), {}, "holds complex numbers; save their real part"),
        (np.ones((4, 5), np.complex128), {}, "holds complex numbers; save their real part"),
        (np.ones((4, 5, 4), np.uint8), {"photometric": "separated"}, "has the colours SEPARATED"),
        (np.ones((4, 5, 3), np.uint8), {"photometric": "cielab"}, "has the colours CIELAB"),
        (np.ones((4, 5, 2), np.uint8), {"planarconfig": "contig"}, "has 2 bands, but must have one"),
        (np.ones((5, 4, 6), np.float32), {"planarconfig": "separate"}, "has 5 bands, but must have one"),
        (np.ones((16, 16, 16), np.uint8), {"volumetric": True, "tile": (16, 16, 16)}, "must be a flat image"),
    ],
)
def test_what_is_no_picture_of_a_section_is_refused(tmp_path, samples, choices, message):
    path = tiff(tmp_path / "scan.tif", samples, **choices)
    for read in (sw.preview, opened):
        with pytest.raises(sw.DataError, match=f"scan.tif {message}"):
            read(path)


@pytest.mark.parametrize(
    ("tags", "message"),
    [
        ({"Compression": 34887}, "is compressed with LERC, which requires the package imagecodecs"),
        ({"Compression": 50000}, "is compressed with ZSTD, which requires the package imagecodecs"),
        ({"Compression": 4711}, "is compressed with method 4711"),
        ({"BitsPerSample": 24}, "holds 24-bit signed integers; .* are supported"),
        ({"Compression": 4}, "has 8-bit samples in a compression for 1-bit ones"),
        ({"SampleFormat": 9}, "holds 8-bit samples of unknown format"),
    ],
)
def test_a_tiff_that_cannot_be_read_right_is_refused(tmp_path, tags, message, monkeypatch):
    monkeypatch.setattr("seiswidgets.io.rasters.tiff_layout.find_spec", lambda name: None)
    path = tiff(tmp_path / "scan.tif", GREY.astype(np.int8))
    with tifffile.TiffFile(path, mode="r+b") as file:
        for name, value in tags.items():
            file.pages[0].tags[name].overwrite(value)
    for read in (sw.preview, opened):
        with pytest.raises(sw.DataError, match=f"scan.tif {message}"):
            read(path)


@pytest.mark.parametrize("compress", [bytes, packbits, lzw, zlib.compress])
def test_a_strip_that_is_cut_short_is_refused(tmp_path, compress):
    samples = np.arange(3000, dtype=np.uint16).reshape(50, 60)
    number = {bytes: 1, packbits: 32773, lzw: 5, zlib.compress: 8}[compress]
    path = tiff(tmp_path / "line.tif", samples)
    data = compress(samples.tobytes())
    with_data(path, data[: len(data) // 2], Compression=number)
    with pytest.raises(sw.DataError, match=r"line.tif (is a damaged image|claims to have 60 x 50 pixels)"):
        opened(path)


@pytest.mark.parametrize("orientation", [3, 6, 8])
@pytest.mark.parametrize("kind", ["i2", "f8", "u2"])
def test_numbers_in_a_tiff_are_turned_upright(tmp_path, kind, orientation):
    samples = np.arange(6).reshape(2, 3).astype(kind)
    path = tiff(tmp_path / "line.tif", samples, extratags=[(274, "H", 1, orientation, True)])
    upright = {3: samples[::-1, ::-1], 6: samples[::-1].T, 8: samples[:, ::-1].T}[orientation]
    np.testing.assert_array_equal(opened(path).amplitude + (32_767.5 if kind == "u2" else 0), upright)
    assert sw.preview(path).shape == upright.shape


@pytest.mark.parametrize(("colour", "count"), [(2, 3), (4, 2), (6, 4)])
def test_colour_and_alpha_of_16_bits_in_a_png(tmp_path, colour, count):
    samples = colours("u2", count)
    grey = samples[:, :, 0] if count == 2 else luma(samples)
    expected = grey - 32_767.5
    if count != 3:
        expected[samples[:, :, -1] == 0] = np.nan
    path = png(tmp_path / "scan.png", samples, 16, colour)
    np.testing.assert_array_equal(opened(path).amplitude, expected)
    words = {2: "colour", 4: "grey with alpha", 6: "colour with alpha"}[colour]
    assert sw.preview(path).format == f"PNG, 16-bit {words}"


@pytest.mark.parametrize("clear", [(256, 1, 65_535), (0, 0, 0), (511, 256, 255)])
def test_a_clear_colour_of_16_bits(tmp_path, clear):
    samples = colours("u2", 3)
    samples[3, 4] = clear
    samples[3, 5] = np.array(clear) ^ 1  # which 8 bits could not tell from it
    path = png(tmp_path / "scan.png", samples, 16, 2, (b"tRNS", struct.pack(">HHH", *clear)))
    assert np.argwhere(np.isnan(opened(path).amplitude)).tolist() == [[3, 4]]


@pytest.mark.parametrize("depth", [1, 2, 4, 8])
def test_a_clear_shade_of_few_bits(tmp_path, depth):
    shades = np.random.default_rng(depth).integers(0, 2**depth, (4, 13))
    clear = 2**depth // 2
    path = tmp_path / "scan.png"
    png(path, packed(shades, depth), depth, 0, (b"tRNS", struct.pack(">H", clear)), width=13)
    expected = np.where(shades == clear, np.nan, shades * (255 / (2**depth - 1)) - 127.5)
    np.testing.assert_allclose(opened(path).amplitude, expected, atol=1e-4)


def test_a_palette_with_clear_colours_in_a_png(tmp_path):
    image = Image.fromarray(np.array([[0, 1, 2], [2, 1, 0]], np.uint8), "L").convert("P")
    image.putpalette([10, 10, 10, 20, 20, 20, 90, 90, 90])
    image.save(tmp_path / "scan.png", transparency=bytes([255, 0, 1]))
    expected = np.array([[10, np.nan, 90], [90, np.nan, 10]]) - 127.5
    np.testing.assert_array_equal(opened(tmp_path / "scan.png").amplitude, expected)


@pytest.mark.parametrize("place", ["before", "after"])
def test_a_png_is_turned_wherever_its_metadata_stand(tmp_path, place):
    exif = Image.Exif()
    exif[ExifTags.Base.Orientation] = 6
    parts = [(b"eXIf", exif.tobytes().removeprefix(b"Exif\0\0"))]
    path = tmp_path / "scan.png"
    png(path, GREY, 8, 0, *(parts if place == "before" else []), after=parts if place == "after" else [])
    np.testing.assert_array_equal(opened(path).amplitude, GREY[::-1].T - 127.5)
    assert sw.preview(path).shape == (3, 2)


def test_a_jpeg_in_the_colours_of_print_is_refused(tmp_path):
    Image.new("CMYK", (8, 8)).save(tmp_path / "scan.jpg")
    with pytest.raises(sw.DataError, match=r"scan.jpg is a JPEG in CMYK, but must be in grey or RGB"):
        sw.preview(tmp_path / "scan.jpg")


@pytest.mark.parametrize("suffix", [".gif", ".bmp", ".webp"])
def test_other_pictures_are_refused(tmp_path, suffix):
    path = saved(tmp_path / f"scan{suffix}", GREY)
    with pytest.raises(sw.DataError, match=f"scan{suffix} is in an unsupported file format; convert it to SEG-Y, PNG"):
        sw.preview(path)


def test_nothing_is_logged_of_an_odd_tiff(tmp_path, caplog):
    path = tiff(tmp_path / "scan.tif", GREY, extratags=no_data("-9999"))
    with caplog.at_level(logging.DEBUG):
        opened(path)
    assert not caplog.records
    assert not logging.getLogger("tifffile").filters


def run(code, *arguments):
    done = subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)], capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout)


def test_a_png_is_opened_without_tifffile(tmp_path):
    code = """if True:
        import sys
        import seiswidgets as sw
        sw.open_section(sys.argv[1], dx=1, dz=1, z_unit="m")
        print("1" if "tifffile" in sys.modules else "0")"""
    assert run(code, saved(tmp_path / "scan.png", GREY)) == 0
    assert run(code, saved(tmp_path / "scan.tif", GREY)) == 1


@pytest.mark.parametrize("name", ["scan.png", "scan.tif", "text.png"])
def test_a_preview_decodes_no_pixels(tmp_path, name):
    path, shape = tmp_path / name, (6000, 6000, 3)
    if name.endswith("tif"):
        tiff(path, np.zeros(shape, np.uint8), photometric="rgb", compression="zlib", rowsperstrip=500)
    else:
        after = [(b"tEXt", b"Software\0a scanner's")] if name == "text.png" else []
        png(path, np.zeros((6000, 18_000), np.uint8), 8, 2, after=after, width=6000)
    code = """if True:
        import sys
        sys.path.append(sys.argv[2])
        from memory import peak
        import seiswidgets as sw
        sw.preview(sys.argv[3])
        before = peak()
        assert sw.preview(sys.argv[1]).shape == (6000, 6000)
        print(peak() - before)"""
    small = saved(tmp_path / f"small{path.suffix}", GREY)
    assert run(code, path, Path(__file__).parent, small) < 50 * 1024 + path.stat().st_size / 1024
