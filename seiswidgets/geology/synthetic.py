"""Known answers: synthetic sections whose true restoration is known in closed form.

Level beds are deposited, folded, then cut by faults, whose blocks slip: see `History`. All sections are in metres and
take the keywords of `Survey` besides their own. Dips and tilts are in degrees.
"""

from typing import Unpack

import numpy as np

from seiswidgets.geology.basins import SyntheticBasin, compacted_basin, folded_unconformity, growth_fault, half_graben
from seiswidgets.geology.forward_model import Depths, Synthetic, make_synthetic
from seiswidgets.geology.kinematics import (
    STILL,
    BlindSlip,
    Circular,
    Deformation,
    History,
    RigidMotion,
    ShearFold,
    Straight,
    Survey,
    SurveyKeywords,
    check_range,
)
from seiswidgets.geology.parallel_flow import FlexuralSlip, ThrustSequence, check_fold_fits, ramp_thrust, rounded_fold

__all__ = [
    "Synthetic",
    "SyntheticBasin",
    "blind_fault",
    "compacted_basin",
    "domino",
    "fault_bend_fold",
    "faulted_fold",
    "flexural_fold",
    "folded_unconformity",
    "graben",
    "growth_fault",
    "half_graben",
    "listric_fault",
    "planar_fault",
    "sine_fold",
    "thrust",
    "tilt",
]


def planar_fault(
    dip: float = 60.0,
    throw: float = 150.0,
    horizons: Depths = (600.0, 1000.0, 1400.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A straight normal fault from top to bottom; its hanging wall slid down dip by a throw (m)."""
    check_range("dip", dip, 20, 90, " degrees")
    survey = Survey(**keywords)
    fault = Straight((0.45 * survey.width, survey.depth / 2), dip)
    slip = RigidMotion(shift=throw / fault.direction[1] * fault.direction)
    return make_synthetic("planar fault", survey, horizons, History(faults=(fault,), slips=(STILL, slip)))


def listric_fault(
    turn: float = 0.1,
    radius: float = 3500.0,
    dip: float = 65.0,
    horizons: Depths = (300.0, 600.0, 900.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A circular fault, with a dip at its top; its hanging wall turned about the circle's centre by radians."""
    check_range("turn", turn, 0, 0.4, " radians")
    check_range("dip", dip, 20, 85, " degrees")
    survey = Survey(**keywords)
    fault = Circular((survey.width / 4, 0.0), dip, radius)
    return make_synthetic("listric fault", survey, horizons, _turned_wall(fault, turn))


def faulted_fold(
    throw: float = 150.0,
    amplitude: float = 200.0,
    horizons: Depths = (750.0, 1050.0, 1400.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A gentle dome cut by a gently curved normal fault, as in the paper's fig. 2; amplitude and throw in m."""
    survey = Survey(**keywords)
    fault = Circular((0.58 * survey.width, survey.depth / 2), 60.0, 4.0 * survey.depth)
    dome = ShearFold(lambda x: -amplitude * np.exp(-(((x / survey.width - 0.45) / 0.19) ** 2)))
    turn = throw / np.sin(np.deg2rad(fault.dip)) / fault.radius
    return make_synthetic("faulted fold", survey, horizons, _turned_wall(fault, turn, dome))


def graben(
    throw: float = 120.0,
    dip: float = 60.0,
    floor: float = 600.0,
    horizons: Depths = (600.0, 1000.0, 1400.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """Two straight faults dipping towards each other; the block between slid down both by a throw (m).

    It is ``floor`` m wide at the bottom. The left block is held, so the right one moves sideways, by twice the heave.
    """
    check_range("dip", dip, 20, 89, " degrees")
    check_range("floor", floor, 10, 1e4, " m")
    survey = Survey(**keywords)
    left, right = (Straight((survey.width / 2 + s * floor / 2, survey.depth), 90 + s * (90 - dip)) for s in (-1, 1))
    sunk = throw / left.direction[1] * left.direction
    aside = sunk - throw / right.direction[1] * right.direction
    slips = STILL, RigidMotion(shift=sunk), RigidMotion(shift=aside)
    return make_synthetic("graben", survey, horizons, History(faults=(left, right), slips=slips))


def domino(
    faults: int = 5,
    turn: float = 8.0,
    dip: float = 60.0,
    spacing: float = 500.0,
    horizons: Depths = (750.0, 1000.0, 1250.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """Parallel straight faults, ``spacing`` m apart, between blocks that turned together by an angle (degrees).

    Neighbours slid so far that the centres of the blocks kept their depth. The dip is the present-day one; the section
    is as wide as the faults need, unless a width is given. Unfaulting leaves the beds straight, but tilted by the turn.
    """
    check_range("faults", faults, 1, 15)
    check_range("turn", turn, 0, 15, " degrees")
    check_range("dip", dip, 30, 90, " degrees")
    check_range("spacing", spacing, 100, 1e4, " m")
    apart, angle, down = spacing / np.sin(np.deg2rad(dip)), np.deg2rad(turn), np.deg2rad(dip)
    depth = keywords.get("depth", Survey.depth)
    keywords.setdefault("width", max(2000.0, (faults - 1) * apart + depth / np.tan(down) + 600))
    survey = Survey(**keywords)
    middle = survey.width / 2 + apart * (np.arange(faults) - (faults - 1) / 2)
    lines = tuple(Straight((x, survey.depth / 2), dip) for x in middle)
    slip = apart * np.sin(angle) / np.sin(down + angle) * lines[0].direction
    tilt = RigidMotion(-angle, centre=(middle[0] - apart / 2, survey.depth / 2))
    slips = tuple(RigidMotion(shift=block * slip) for block in range(faults + 1))
    return make_synthetic("domino", survey, horizons, History(tilt, lines, slips))


def tilt(
    dip: float = 10.0, horizons: Depths = (750.0, 1000.0, 1250.0), **keywords: Unpack[SurveyKeywords]
) -> Synthetic:
    """Beds turned rigidly about the section's centre, to dip to the right (to the left if negative)."""
    check_range("dip", dip, -45, 45, " degrees")
    survey = Survey(**keywords)
    turned = RigidMotion(np.deg2rad(dip), centre=(survey.width / 2, survey.depth / 2))
    return make_synthetic("tilt", survey, horizons, History(turned))


def sine_fold(
    dip: float = 30.0,
    wavelength: float = 2000.0,
    horizons: Depths = (750.0, 1000.0, 1250.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """Sine folds by vertical shear; dip (degrees) is the steepest of their limbs, the wavelength in m."""
    check_range("dip", dip, 0, 75, " degrees")
    check_range("wavelength", wavelength, 100, 1e5, " m")
    wavenumber = 2 * np.pi / wavelength
    amplitude = np.tan(np.deg2rad(dip)) / wavenumber
    fold = ShearFold(lambda x: amplitude * np.sin(wavenumber * x))
    return make_synthetic("sine fold", Survey(**keywords), horizons, History(fold))


def blind_fault(
    slip: float = 40.0,
    dip: float = 60.0,
    length: float = 500.0,
    horizons: Depths = (850.0, 1000.0, 1150.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A straight normal fault in the middle that dies out at both tips; slip (m) is the largest, at its centre.

    The slip is elliptic along the fault, and the rock around bends as about a crack: see `BlindSlip`.
    """
    check_range("dip", dip, 20, 160, " degrees")
    check_range("length", length, 100, 1e4, " m")
    check_range("slip", slip, 0, 0.25 * length, " m, a quarter of the length")
    survey = Survey(**keywords)
    fault = Straight((survey.width / 2, survey.depth / 2), dip, length / 2)
    slips = BlindSlip(fault, slip, -1), BlindSlip(fault, slip, 1)
    return make_synthetic("blind fault", survey, horizons, History(faults=(fault,), slips=slips, blind=True))


def thrust(
    slip: float = 300.0,
    faults: int = 1,
    dip: float = 30.0,
    floor: float = 1500.0,
    spacing: float = 1200.0,
    horizons: Depths = (600.0, 900.0, 1200.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """Thrust sheets that slid to the left along a level floor (at a depth in m), then up straight ramps to the top.

    Several are imbricates: parallel ramps, ``spacing`` m apart, rise from the floor that they share. The rightmost
    slipped first, each by the same slip (m), and was then carried by the others. Sheets flow parallel to the thrust
    below and bend above its foot. The section is as wide as the sheets need, unless a width is given.
    """
    check_range("slip", slip, 0, 2e3, " m")
    check_range("faults", faults, 1, 8)
    check_range("dip", dip, 15, 60, " degrees")
    check_range("spacing", spacing, 1.25 * slip, 1e4, " m, at least 1.25 of the slip")
    check_range("floor", floor, 100, keywords.get("depth", Survey.depth) - 50, " m, inside the section")
    run = floor / np.tan(np.deg2rad(dip))
    keywords.setdefault("width", 800 + run + (faults - 1) * (spacing - slip) + slip + 1000)
    survey = Survey(**keywords)
    feet = 800 + run + spacing * np.arange(faults)
    lines = ([(x - 3 * run, -2 * floor), (x, floor), (10 * survey.width, floor)] for x in feet)
    return make_synthetic("thrust", survey, horizons, ThrustSequence(tuple(ramp_thrust(line, slip) for line in lines)))


def fault_bend_fold(
    slip: float = 400.0,
    dip: float = 25.0,
    top: float = 800.0,
    floor: float = 1400.0,
    horizons: Depths = (500.0, 1000.0, 1200.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A thrust sheet that slid to the left by a slip (m) along a level floor, up a ramp, and along an upper flat.

    The sheet flows parallel to the fault, which folds it above both bends of the ramp; ``top`` and ``floor`` are the
    depths (m) of the flats. Horizons above the upper flat are folded but not cut.
    """
    check_range("slip", slip, 0, 2e3, " m")
    check_range("dip", dip, 10, 60, " degrees")
    survey = Survey(**keywords)
    check_range("floor", floor, top + 100, survey.depth - 50, " m, below the upper flat and inside the section")
    foot, head = survey.width / 2 + np.array([0.5, -0.5]) * (floor - top) / np.tan(np.deg2rad(dip)) + slip / 4
    far = 10 * survey.width
    line = [(-far, top), (head, top), (foot, floor), (far, floor)]
    return make_synthetic("fault-bend fold", survey, horizons, ThrustSequence((ramp_thrust(line, slip),)))


def flexural_fold(
    dip: float = 30.0,
    radius: float = 1600.0,
    limb: float = 200.0,
    horizons: Depths = (750.0, 1000.0, 1250.0),
    **keywords: Unpack[SurveyKeywords],
) -> Synthetic:
    """A parallel anticline by flexural slip: beds slip past each other, and keep their lengths and thicknesses.

    Straight limbs of a dip, ``limb`` m long, are joined by arcs of a radius (m) in the bed at mid-depth. The crest in
    the middle is the pin: each bed slipped away from it. The section is as wide as the fold, unless a width is given.
    """
    check_range("dip", dip, 1, 70, " degrees")
    check_range("limb", limb, 10, 1e4, " m")
    depth = Survey(depth=keywords.get("depth", Survey.depth)).depth
    height = check_fold_fits(dip, radius, limb, depth)
    angle = np.deg2rad(dip)
    keywords.setdefault("width", 4 * radius * np.sin(angle) + 2 * limb * np.cos(angle) + 800)
    survey = Survey(**keywords)
    line = rounded_fold(dip, radius, limb, (survey.width / 2, (depth - height) / 2))
    fold = FlexuralSlip(line, survey.width / 2, depth / 2)
    return make_synthetic("flexural fold", survey, horizons, History(fold))


def _turned_wall(fault: Circular, turn: float, fold: Deformation = STILL) -> History:
    """Turn the hanging wall of a circular fault about the circle's centre."""
    return History(fold, (fault,), (STILL, RigidMotion(-turn, fault.centre)))
