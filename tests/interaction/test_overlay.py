from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import seiswidgets as sw
from seiswidgets.interaction.colour import encode_png, resampled
from seiswidgets.interaction.overlay import Mark, Overlay

LEVELS, PALETTE = np.zeros((3, 4), np.uint8), np.zeros((256, 4), np.uint8)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Overlay(LEVELS.astype(float), PALETTE, (0, 1, 0, 1)), r"levels must be uint8 .* float64 .*\(3, 4\)"),
        (lambda: Overlay(LEVELS[0], PALETTE, (0, 1, 0, 1)), r"levels must be uint8 of shape \(h, w\)"),
        (lambda: Overlay(LEVELS[:0], PALETTE, (0, 1, 0, 1)), r"levels must be .* of shape \(0, 4\)"),
        (lambda: Overlay(LEVELS, PALETTE[:, :3], (0, 1, 0, 1)), r"palette must be .*\(256, 4\), but is .*\(256, 3\)"),
        (lambda: Overlay(LEVELS, PALETTE, (0, 0, 0, 1)), "an overlay's window must be"),
        (lambda: Mark((0, 0), "skull"), "kind must be one of cutoff, held, cursor, finding, but is 'skull'"),
    ],
)
def test_what_cannot_be_drawn(make, message):
    with pytest.raises(sw.SettingError, match=message):
        make()


def test_an_overlay_is_frozen():
    overlay = Overlay(LEVELS, PALETTE, (0, 1, 0, 1))
    with pytest.raises(ValueError, match="read-only"):
        overlay.levels[0, 0] = 1


def test_amplitudes_are_averaged_over_what_is_known():
    amplitude = np.array([[1.0, 3.0, np.nan, 5.0, np.nan, np.nan, np.nan, 7.0]] * 2)
    assert resampled(amplitude, (4, 1))[0] == pytest.approx([2, 5, np.nan, 7], nan_ok=True)
    amplitude[0, 3] = np.nan  # three of four
    assert resampled(amplitude, (4, 1))[0] == pytest.approx([2, np.nan, np.nan, 7], nan_ok=True)


def test_a_picture_is_encoded_without_loss():
    rng = np.random.default_rng(0)
    levels, palette = rng.integers(0, 256, (30, 40), np.uint8), rng.integers(0, 256, (256, 4), np.uint8)
    picture = Image.open(BytesIO(encode_png(levels, palette))).convert("RGBA")
    assert (np.asarray(picture) == palette[levels]).all()
