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


@pytest.mark.parametrize("name", SOUND)
def test_damaged_files_open_or_say_what_is_wrong(tmp_path, name):
    SOUND[name](tmp_path / name)
    program = Path(__file__).with_name("mutations.py")
    seed = str(list(SOUND).index(name))
    run = [sys.executable, "-W", "error", str(program), str(tmp_path / name), str(COUNT), seed]
    done = subprocess.run(run, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    print(name, found)
    assert found["refused"] > 0
    assert found["slowest"] < 2
    assert found["memory"] < 200 * 1024
