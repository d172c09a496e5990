"""Scans of the slip along faults: time on a real section, and accuracy in noise as strong as half the signal."""

from dataclasses import replace
from functools import partial

import numpy as np
from timing import at_most, in_turns, told

import seiswidgets as sw
from tests.geology.slips import slipped, throw_errors
from tests.sections import real_section

SEEDS = 10
HALF_CYCLE = 7.5  # samples
CASES = [(kind, slip) for kind in ("constant", "linear", "elliptic", "blind") for slip in (120, -120)]


def rows():
    section, picks = real_section("f3")
    for fault in picks.faults:
        slips = np.linspace(-150, 150, 200)
        (time,) = in_turns([partial(fresh_scan, section, fault, slips=slips)], 5)
        yield at_most(f"scan of 200 slips on F3, fault {fault.name}", told(time), "1 s", time, 1, 5)
        profile = sw.SlipProfile([0], [30])
        (time,) = in_turns([partial(sw.match, section, fault, profile)], 50)
        yield at_most("  one match of it", told(time), "0.005 s", time / 0.005, 1, 50)
    for kind, slip in CASES:
        yield from accuracy(kind, slip if kind != "blind" else slip // 2)


def fresh_scan(section, fault, **choices):
    return sw.scan(replace(section), fault, **choices)


def accuracy(kind, slip):
    errors = []
    for seed in range(SEEDS):
        case, truth = slipped(kind, slip, seed)
        errors.append(np.abs(throw_errors(case, sw.scan(case.section, case.interpretation.faults[0]), truth)))
    off, wrong = (float(np.mean(np.array(errors) > most)) for most in (1, HALF_CYCLE))
    what = f"{kind} slip of {slip} m, signal to noise 2: over a sample off"
    yield at_most(what, f"{off:.1%}", "5%", off / 0.05, 1, SEEDS)
    yield at_most("  wrong by a cycle", f"{wrong:.1%}", "5%", wrong / 0.05, 1, SEEDS)
