import zlib

import numpy as np
import pytest
from PIL import ExifTags, Image

import seiswidgets as sw
from seiswidgets.io.rasters import images

GREY = np.array([[0, 255, 51], [102, 153, 204]], np.uint8)
EXTENT = (100, 300, 500, 540)


def opened(path):
    return sw.open_section(path, extent=EXTENT, z_unit="m")


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
    np.testing.assert_array_equal(opened(tmp_path / "scan.tif").amplitude + 127.5, GREY)
    assert sw.preview(tmp_path / "scan.tif").format == "TIFF, mode L, the first of 2 pages"


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
    with pytest.raises(sw.DataError, match=r"scan.png is a picture of 3 x 2 pixels; there may be 5"):
        sw.preview(path)


def test_a_png_that_claims_a_thousand_million_pixels_is_refused(tmp_path):
    content = bytearray(saved(tmp_path / "scan.png", GREY).read_bytes())
    content[16:24] = (40_000).to_bytes(4, "big") * 2
    content[29:33] = zlib.crc32(content[12:29]).to_bytes(4, "big")
    (tmp_path / "scan.png").write_bytes(content)
    with pytest.raises(sw.DataError, match=r"scan.png is too large a picture"):
        sw.preview(tmp_path / "scan.png")


def test_half_a_picture_is_an_error(tmp_path):
    path = saved(tmp_path / "scan.png", np.random.default_rng(0).integers(0, 255, (50, 50), np.uint8))
    path.write_bytes(path.read_bytes()[:1000])
    with pytest.raises(sw.DataError, match=r"scan.png is a damaged picture.*save it anew as PNG"):
        sw.open_section(path, extent=EXTENT, z_unit="m")


def test_a_picture_that_lacks_its_lower_part_is_refused(tmp_path):
    path = saved(tmp_path / "scan.tif", GREY)
    content = path.read_bytes()
    height = content.index((257).to_bytes(2, "little")) + 8
    path.write_bytes(content[:height] + (1_000_000).to_bytes(4, "little") + content[height + 4 :])
    with pytest.raises(sw.DataError, match=r"scan.tif says that it has 3 x 1000000 pixels, but holds 3 x 2"):
        sw.preview(path)
