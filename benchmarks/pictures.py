"""A picture carried through a mesh, beside scikit-image's and, given the finished map, OpenCV's."""

import cv2
import numpy as np
from skimage.transform import PiecewiseAffineTransform, warp
from timing import faster, in_turns

import seiswidgets as sw
from seiswidgets.core.mapping import PiecewiseAffineMap
from seiswidgets.core.resampling import resample

NX, NZ = 1000, 600
TARGETS = {1: 200, 3: 50}
RUNS = 3


def rows():
    case = sw.synthetic.sine_fold(width=3996.0, depth=2396.0, dx=4.0, dz=4.0)
    stage = sw.Restoration(case.section, spacing=73.0).flatten(case.interpretation.horizons[1]).stages[0]
    source, target, picture = stage.mesh.vertices / 4, stage.vertices / 4, case.section.amplitude
    x, z = np.arange(NX), np.arange(NZ)

    def mapped():
        return np.moveaxis(PiecewiseAffineMap(source, target, stage.mesh.triangles).inverse_on_grid(x, z), -1, 0)

    def ours(order):
        return resample(picture, *mapped(), order)

    def theirs(order):
        return warp(picture, PiecewiseAffineTransform.from_estimate(target, source), order=order)

    def bound(order):
        return cv2.remap(picture, *places, cv2.INTER_LINEAR if order == 1 else cv2.INTER_CUBIC)

    places = [part.astype(np.float32) for part in mapped()]
    for order, target_ratio in TARGETS.items():
        kind = "linear" if order == 1 else "cubic"
        difference = np.nanmedian(np.abs(ours(order) - theirs(order))) / picture.std()
        if not difference < 0.01:
            raise RuntimeError(f"the two pictures differ by {difference:.2g} of their deviation; nothing was compared")
        functions = [lambda order=order, make=make: make(order) for make in (ours, theirs, bound)]
        times = in_turns(functions, RUNS)
        what = f"{NX} x {NZ} through {len(source):,} vertices, {kind}"
        yield faster(f"{what} / scikit-image", times[0], times[1], target_ratio, RUNS)
        yield faster("  the same / OpenCV's remap, given the map (a bound)", times[0], times[2], None, RUNS)
