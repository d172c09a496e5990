"""A restoration in two stages, for what is written of it."""

from functools import cache

import seiswidgets as sw

NAUGHTY = "<img src=x onerror=alert(1)>"


@cache
def restored(time=False):
    """A fold with a fault, unfaulted and flattened; in depth or in two-way time, of 2,000 m/s."""
    case = sw.synthetic.faulted_fold()
    section, picks = case.section, case.interpretation
    if time:  # so many milliseconds as metres: 1 ms is 1 m of rock
        fields = {name: getattr(section, name) for name in ("dx", "dz", "x0", "z0")}
        section = sw.Section(section.amplitude, **fields, z_unit="ms", velocity=2000, name=NAUGHTY, credit="<b>us</b>")
    faults = [sw.Fault(fault.points, name=NAUGHTY) for fault in picks.faults]
    unfaulted = sw.Restoration(section, spacing=150).unfault(faults, picks.horizons, fixed=case.fixed)
    return unfaulted.flatten(picks.horizons[0])
