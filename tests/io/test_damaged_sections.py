"""Damaged files, by the hundred: each opens, or gives an error of ours that names it; none crashes or hangs."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import tifffile
from PIL import Image

from tests.io.segyfiles import numbered, segy_bytes, straight, volume_headers

COUNT = 110
WAVES = np.sin(np.arange(24 * 30).reshape(24, 30) / 5).astype(np.float32)


def segy(code, endian):
    return lambda path: path.write_bytes(segy_bytes(np.rint(WAVES.T * 100), straight(30), code, endian))


def volume(path):
    headers = volume_headers([10, 11, 12], [201, 203, 205])
    path.write_bytes(segy_bytes(numbered(headers), headers))


def picture(**choices):
    return lambda path: Image.fromarray(np.uint8(127 + 100 * WAVES)).save(path, **choices)


def tiff(samples, **choices):
    return lambda path: tifffile.imwrite(path, samples, **choices)


SOUND = {
    "ibm.sgy": segy(1, "big"),
    "ieee.sgy": segy(5, "little"),
    "volume.inline": volume,
    "scan.png": picture(),
    "scan.jpg": picture(),
    "scan.tif": picture(),
    "packed.tif": picture(compression="tiff_lzw"),
    "line.npy": lambda path: np.save(path, WAVES),
    "line.npz": lambda path: np.savez(path, amplitude=WAVES, dx=5.0, dz=1.0),
    "packed.npz": lambda path: np.savez_compressed(path, amplitude=WAVES, dx=5.0, dz=1.0, z_unit="m", name="a"),
    "line.txt": lambda path: np.savetxt(path, WAVES),
    "line.csv": lambda path: np.savetxt(path, WAVES, delimiter=","),
    "floats.tif": tiff(WAVES.astype(float), byteorder=">", bigtiff=True, extratags=[(42113, "s", 0, "-9999", True)]),
    "tiles.tif": tiff(np.int16(1000 * WAVES), tile=(16, 16), compression="zlib", predictor=2),
    "fax.tif": lambda path: Image.fromarray(WAVES > 0).save(path, compression="group4"),
}


PICTURES = {name for name in SOUND if name.endswith((".png", ".jpg", ".tif"))}
KINDS = {"pictures": PICTURES, "others": SOUND.keys() - PICTURES}


@pytest.mark.parametrize("kind", KINDS)
def test_damaged_files_open_or_say_what_is_wrong(tmp_path, kind):
    files = [tmp_path / name for name in SOUND if name in KINDS[kind]]
    for path in files:
        SOUND[path.name](path)
    program = Path(__file__).with_name("mutations.py")
    run = [sys.executable, "-W", "error", str(program), str(COUNT), *map(str, files)]
    done = subprocess.run(run, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    print(found)
    assert [Path(name) for name in found] == files
    assert min(each["refused"] for each in found.values()) > 0
    assert max(each["slowest"] for each in found.values()) < 2
    assert sum(each["memory"] for each in found.values()) < 200 * 1024
