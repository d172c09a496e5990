"""The browser draws pictures as the kernel does: within a grey level, at any zoom, at faults, and at any time."""

import json
import sys
from base64 import b64encode
from dataclasses import replace
from pathlib import Path
from subprocess import run

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.core.resampling import resample
from seiswidgets.interaction.colour import Colouring, RatioColouring, clip_limit
from seiswidgets.interaction.live_state import (
    TextureSource,
    colours_state,
    deformation_state,
    grid_state,
    stage_state,
    triangles_state,
)

NODE = Path(sys.executable).with_name("node")  # of the wheel in the extra "test"
SCRIPT = Path(__file__).with_name("js") / "draw_scene.js"
SIZE = 300, 200  # pixels
WHOLE = (0.0, 1.0, 0.0, 1.0)
ZOOMED = (0.45, 0.55, 0.3, 0.45)  # over the fault


@pytest.fixture(scope="module")
def restored():
    case = sw.synthetic.faulted_fold()
    return sw.Plan(spacing=120.0).restore(case.section, case.interpretation, fixed=case.fixed)


def window_of(section, shares):
    """Left, right, top and bottom in samples, from shares of the section."""
    nz, nx = section.shape
    return [shares[0] * (nx - 1), shares[1] * (nx - 1), shares[2] * (nz - 1), shares[3] * (nz - 1)]


def drawn(restoration, window, *, is_restored=True, time=None, colouring=None, span=2.0, opacity=0.0):
    """Red, green, blue and alpha of each pixel, shape (height, width, 4)."""
    section, source = restoration.original, TextureSource(restoration.original)
    colouring = colouring or Colouring("greys", clip_limit(section, 99.0))
    task = {
        "grid": grid_state(section),
        "stages": [stage_state(section, stage, restoration.quick) for stage in restoration.stages],
        "triangles": [triangles_state(stage) for stage in restoration.stages],
        "texture": {
            "shape": source.shape,
            "data": b"".join(source.tile(index) for index in range(source.tiles)),
        },
        "time": len(restoration.stages) if time is None else time,
        "size": dict(zip(("width", "height"), SIZE, strict=True)),
        "window": window,
        "isRestored": is_restored,
        "colours": colours_state(colouring, source.scale),
        "deformation": deformation_state(RatioColouring(span), RatioColouring(span).palette(), opacity),
    }
    done = run([NODE, SCRIPT], input=json.dumps(task, default=packed).encode(), capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()
    return np.frombuffer(done.stdout, np.uint8).reshape(SIZE[1], SIZE[0], 4)


def packed(value):
    return {"bytes": b64encode(value).decode()}


def pixel_samples(window):
    """Column and row of the section at the centre of each pixel."""
    (left, right, top, bottom), (width, height) = window, SIZE
    return np.meshgrid(
        left + (np.arange(width) + 0.5) * (right - left) / width,
        top + (np.arange(height) + 0.5) * (bottom - top) / height,
    )


def expected(restoration, window, colouring=None):
    """The kernel's linear picture at the centres of the pixels."""
    section = restoration.original
    columns, rows = pixel_samples(window)
    points = np.column_stack([section.x0 + section.dx * columns.ravel(), section.z0 + section.dz * rows.ravel()])
    origins = (restoration.to_original(points) - (section.x0, section.z0)) / (section.dx, section.dz)
    amplitude = resample(section.amplitude, *origins.T.reshape(2, *columns.shape), order=1)
    colouring = colouring or Colouring("greys", clip_limit(section, 99.0))
    return colouring.palette[colouring.levels(amplitude)]


def assert_alike(picture, reference):
    """At most one pixel in a hundred differs by more than a grey level."""
    difference = np.abs(picture.astype(int) - reference.astype(int)).max(axis=2)
    assert np.mean(difference > 1) <= 0.01


@pytest.mark.parametrize("shares", [WHOLE, ZOOMED, (-0.1, 1.1, -0.2, 1.1)])
def test_the_restored_section_is_drawn_as_by_the_kernel(restored, shares):
    window = window_of(restored.original, shares)
    assert_alike(drawn(restored, window), expected(restored, window))


@pytest.mark.parametrize("time", [0.0, 0.35, 1.0, 1.6])
def test_so_is_every_moment(restored, time):
    window = window_of(restored.original, WHOLE)
    assert_alike(drawn(restored, window, time=time), expected(restored.at(time), window))


def test_a_preview_is_drawn_as_well_though_its_vertices_are_sent_in_half_the_bytes(restored):
    preview = replace(restored, quick=True)
    window = window_of(restored.original, WHOLE)
    assert_alike(drawn(preview, window), expected(preview, window))


def test_colours_gain_and_polarity_are_applied_where_it_is_drawn(restored):
    window = window_of(restored.original, ZOOMED)
    colouring = Colouring("red-white-blue", -clip_limit(restored.original, 99.0) / 8)
    assert_alike(drawn(restored, window, colouring=colouring), expected(restored, window, colouring))


def test_a_spike_does_not_coarsen_the_other_amplitudes(restored):
    amplitude = restored.original.amplitude.copy()
    amplitude[5, 5] = 1e9
    spiked = sw.Restoration(sw.Section(amplitude, dx=restored.original.dx, dz=restored.original.dz))
    window = window_of(spiked.original, (0.1, 1, 0.1, 1))
    assert_alike(drawn(spiked, window), expected(spiked, window))


def test_gaps_in_the_data_stay_gaps():
    amplitude = np.add.outer(np.arange(40.0), np.arange(60.0)) - 50
    amplitude[10:20, 15:40] = np.nan
    section = sw.Section(amplitude, dx=10, dz=10)
    bare = sw.Restoration(section)
    window = window_of(section, WHOLE)
    picture, reference = drawn(bare, window), expected(bare, window)
    assert np.mean(picture[..., 3] != reference[..., 3]) < 0.01
    assert_alike(picture[picture[..., 3] > 0][None], reference[picture[..., 3] > 0][None])


@pytest.mark.parametrize("is_restored", [True, False])
def test_the_area_ratio_is_laid_over_it(restored, is_restored):
    window = window_of(restored.original, (0.05, 0.95, 0.05, 0.95))
    colouring = RatioColouring(1.2)
    plain, tinted = (
        drawn(restored, window, is_restored=is_restored, span=1.2, opacity=opacity) for opacity in (0.0, 0.7)
    )
    section = restored.original
    points = np.column_stack(
        [
            first + step * at.ravel()
            for first, step, at in zip(
                (section.x0, section.z0), (section.dx, section.dz), pixel_samples(window), strict=True
            )
        ]
    )
    origins = restored.to_original(points) if is_restored else points
    colours = colouring.palette()[colouring.levels(restored.area_ratio_at(origins))].reshape(tinted.shape)
    share = 0.7 * colours[..., 3:] / 255
    wanted = plain[..., :3] * (1 - share) + colours[..., :3] * share
    difference = np.abs(tinted[..., :3] - wanted).max(axis=2)
    assert np.mean(difference[plain[..., 3] > 0] > 2) < 0.02


def test_a_large_section_is_averaged_in_tiles():
    amplitude = np.zeros((3000, 100), np.float32)
    amplitude[1::2] = 1
    source = TextureSource(sw.Section(amplitude, dx=1, dz=1))
    assert source.tiles > 1
    integers = np.frombuffer(b"".join(source.tile(index) for index in range(source.tiles)), "<i2")
    np.testing.assert_allclose(integers.reshape(source.shape) * source.scale, amplitude, atol=1e-4)
    overview = source.overview
    assert np.prod(overview["shape"]) <= 40_000
    assert np.frombuffer(overview["data"], "<i2").mean() * source.scale == pytest.approx(0.5, abs=0.01)
