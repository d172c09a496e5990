import re
from base64 import b64decode
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import seiswidgets as sw
from seiswidgets.widgets.files import thumbnail as module
from seiswidgets.widgets.files.thumbnail import thumbnail
from tests.io.segyfiles import segy_bytes, straight
from tests.widgets.files import volume


def seen(path, progress=lambda share: True):
    """The grey picture of a file, and what is said of it."""
    html = thumbnail(sw.preview(path), {}, progress)
    said, png = re.fullmatch(r'<img alt="(.*?)" .* src="data:image/png;base64,(.*?)">', html).groups()
    return np.asarray(Image.open(BytesIO(b64decode(png))).convert("L")), said


def halves(samples, traces):
    """The left half dark, the right half light."""
    return np.where(np.arange(traces) < traces / 2, -1.0, 1.0) * np.ones((samples, 1), np.float32)


@pytest.mark.parametrize("shape", [(40, 30), (500, 1700)])
@pytest.mark.parametrize("kind", ["sgy", "npy", "txt", "png"])
def test_a_file_is_seen_as_it_will_open(tmp_path, shape, kind):
    path, amplitude = tmp_path / f"line.{kind}", halves(*shape).astype(np.float32)
    if kind == "sgy":
        path.write_bytes(segy_bytes(amplitude.T, straight(shape[1])))
    elif kind == "npy":
        np.save(path, amplitude)
    elif kind == "txt":
        np.savetxt(path, amplitude, fmt="%g")
    else:
        Image.fromarray(np.where(amplitude > 0, 255, 0).astype(np.uint8)).save(path)
    picture, said = seen(path)
    assert said == "The whole line"
    assert picture.shape == tuple(np.minimum(shape, (module.HIGHEST, module.WIDEST)))
    middle = picture.shape[1] / 2
    assert picture[:, : int(middle) - 1].max() < 10
    assert picture[:, int(middle) + 1 :].min() > 245


def test_of_a_volume_the_inline_in_the_middle_is_seen(tmp_path):
    picture, said = seen(volume(tmp_path / "volume.sgy"))
    assert said == "Inline 11"
    assert picture.shape[1] == 5


def test_what_takes_long_is_not_seen_and_a_user_may_not_want_to_wait(tmp_path, monkeypatch):
    path = tmp_path / "line.npy"
    np.save(path, halves(4, 6))
    with pytest.raises(sw.Cancelled, match="opening the file was cancelled"):
        seen(path, lambda share: False)
    monkeypatch.setattr(module, "LARGEST", path.stat().st_size - 1)
    assert thumbnail(sw.preview(path), {}, lambda share: True) == ""


def test_what_cannot_be_opened_is_not_seen(tmp_path):
    path = tmp_path / "line.npy"
    np.save(path, np.full((4, 6), np.nan))
    assert thumbnail(sw.preview(path), {}, lambda share: True) == ""
