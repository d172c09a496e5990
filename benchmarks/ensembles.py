"""Ensembles: how often intervals contain the truth, linear error propagation, and the use of two processes."""

import os
from functools import partial

import numpy as np
from timing import at_most, seconds, told

import seiswidgets as sw

SHARE, PERCENTS = 0.9, (5, 95)
THROWS, EXTENSIONS = int(os.environ.get("CASES", 1000)), int(os.environ.get("CASES", 1000)) // 10
HYPOTHESES = int(os.environ.get("CASES", 1000))
THROW, DIP = 100.0, 60.0
PICKS = sw.Uncertainty(horizon=1, fault=1, correlation_length=500)
NO_MESH = sw.Plan(steps=())


def rows():
    yield throw_coverage()
    yield from propagation()
    yield extension_coverage()
    yield efficiency()


def in_words(cases):
    return f"{SHARE:.0%} intervals with the truth, of {cases}"


def coverage_row(what, hits, tolerance):
    share = np.mean(hits)
    return at_most(what, f"{share:.1%}", f"{SHARE:.0%} ± {tolerance:.0%}", abs(share - SHARE) / tolerance, 1, len(hits))


def contains(label, truth, case, seed, plan, members, **choices):
    """Pick a section with errors of the seed's own, and ask an ensemble around these picks for the truth."""
    only = sw.ensemble(case.section, case.interpretation, NO_MESH, PICKS, 1, 10_000 + seed)
    drawn = only.study.perturbation.hypothesis(0).interpretation
    ensemble = sw.ensemble(case.section, drawn, plan, PICKS, members, **choices)
    low, high = ensemble.percentiles(PERCENTS)[label]
    return low <= truth <= high


def throw_coverage():
    case = sw.synthetic.planar_fault(throw=THROW, dip=DIP, horizons=(1000.0,))
    hits = [contains(("throw", "H1 at F1"), THROW, case, seed, NO_MESH, 59) for seed in range(THROWS)]
    return coverage_row(f"throw: {in_words(THROWS)}", hits, 0.04)


def propagation():
    """A level bed's throw has the errors of two pieces; its heave has these over the dip's tangent, and the dip's."""
    case = sw.synthetic.planar_fault(throw=THROW, dip=DIP, horizons=(1000.0,))
    deviations = sw.Uncertainty(horizon=1, dip=1, correlation_length=500)
    ensemble = sw.ensemble(case.section, case.interpretation, NO_MESH, deviations, 2 * THROWS)
    spread = dict(zip(ensemble.labels, np.std(ensemble.values, axis=0, ddof=1), strict=True))
    throw, angle = np.sqrt(2) * case.section.dz, np.radians(DIP)
    heave = np.hypot(throw / np.tan(angle), THROW / np.sin(angle) ** 2 * np.radians(1))
    for name, expected in (("throw", throw), ("heave", heave)):
        found = spread[name, "H1 at F1"]
        what = f"spread of {name} of {2 * THROWS:,} members, linear propagation"
        yield at_most(what, f"{found:.3g} m", f"{expected:.3g} m ± 5%", abs(found / expected - 1) / 0.05, 1, 1)


def extension_coverage():
    case = sw.synthetic.planar_fault(throw=THROW, dip=DIP)
    x = np.array([piece[end, 0] for piece, end in zip(case.interpretation.horizons[1].pieces, (0, -1), strict=True)])
    truth = np.ptp(x) / (np.ptp(x) - THROW / np.tan(np.radians(DIP))) - 1
    plan = sw.Plan((sw.Step("unfault"),), fixed=case.fixed, spacing=spacing_for(case, 600))
    hits = [contains(("extension", "H2"), truth, case, seed, plan, 39, workers=2) for seed in range(EXTENSIONS)]
    return coverage_row(f"extension, 600 vertices: {in_words(EXTENSIONS)}", hits, 0.08)


def efficiency():
    case = sw.synthetic.faulted_fold()
    plan = sw.Plan((sw.Step("unfault"),), fixed=case.fixed)
    run = partial(sw.ensemble, case.section, case.interpretation, plan, PICKS, HYPOTHESES)
    one, two = (seconds(partial(run, workers=workers)) for workers in (1, 2))
    what = f"{HYPOTHESES:,} hypotheses of 2,500 vertices on two processes, and on one"
    return at_most(what, told(two), told(one), 0.9 * two / (one / 2), 1, 1)


def spacing_for(case, vertices):
    return float(np.sqrt(np.ptp(case.section.x) * np.ptp(case.section.z) * 1.15 / vertices))
