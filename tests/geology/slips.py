"""Synthetic sections whose slip varies along a fault, with noise in the signal's band; shared with the benchmarks."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import convolve1d

import seiswidgets as sw
from seiswidgets.geology.forward_model import WAVELENGTH, make_synthetic
from seiswidgets.geology.kinematics import History, Straight, Survey

PIECES = (0.0, 0.3, 0.7, 1.0)  # ends of intervals of piecewise slip, as shares of a fault's length


@dataclass(frozen=True)
class VaryingSlip:
    """Half of a slip on one side of a straight fault, as a function of the position along it, at any distance."""

    fault: Straight
    profile: sw.SlipProfile
    top: float  # of the fault, along it
    side: int

    def moved(self, t):
        return t + self.side * self.profile.at(t - self.top) / 2

    def apply(self, points):
        t, _ = self.fault.local(points)
        return points + np.outer(self.moved(t) - t, self.fault.direction)

    def undo(self, points):
        moved, _ = self.fault.local(points)
        grid = np.linspace(-5000, 5000, 10_001)
        return points + np.outer(np.interp(moved, self.moved(grid), grid) - moved, self.fault.direction)


def slipped(kind, slip, seed=0, noise=0.5, dip=60.0):
    """A straight fault across a section, or a blind one, and its true slip profile; the largest slip is in metres."""
    survey = Survey(seed=seed, noise=0.0)
    if kind == "blind":
        case = sw.synthetic.blind_fault(abs(slip), dip if slip > 0 else 180 - dip, 800.0, seed=seed, noise=0.0)
        profile = _elliptic(slip, 800.0)
    else:
        fault = Straight((survey.width / 2, survey.depth / 2), dip)
        ends = fault.polyline(survey)
        length = float(np.hypot(*(ends[1] - ends[0])))
        profile = {
            "constant": sw.SlipProfile([0], [slip]),
            "linear": sw.SlipProfile([0, length], [slip / 2, slip]),
            "elliptic": _elliptic(slip, length),
            "piecewise": sw.SlipProfile(np.array(PIECES) * length, [slip / 2, slip / 2, slip, slip]),
        }[kind]
        slips = [VaryingSlip(fault, profile, -length / 2, side) for side in (-1, 1)]
        case = make_synthetic(kind, survey, (), History(faults=(fault,), slips=tuple(slips)))
    return replace(case, section=with_noise(case.section, noise, seed)), profile


def _elliptic(slip, length):
    share = np.linspace(-1, 1, 801)
    return sw.SlipProfile((1 + share) * length / 2, slip * np.sqrt(np.maximum(1 - share**2, 0)))


def with_noise(section, share, seed):
    """Add white noise, filtered by the signal's wavelet, to a section; its RMS is a share of the signal's."""
    phase = (np.pi * np.arange(-2 * WAVELENGTH, 2 * WAVELENGTH + 1, section.dz) / WAVELENGTH) ** 2
    white = np.random.default_rng(seed + 1000).standard_normal(section.shape)
    noise = convolve1d(white, (1 - 2 * phase) * np.exp(-phase), axis=0, mode="wrap")
    amplitude = section.amplitude + share * section.amplitude.std() * noise / noise.std()
    return replace(section, amplitude=amplitude.astype(np.float32))


def throw_errors(case, found, truth, profile=None):
    """Errors of a scan's throw along the fault, in samples."""
    s = np.linspace(0, found.traces.length, 200)
    return (found.throw(s, profile) - found.throw(s, truth)) / case.section.dz
