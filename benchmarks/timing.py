"""Times, and the rows that they make."""

import time

import numpy as np


def seconds(function):
    began = time.perf_counter()
    function()
    return time.perf_counter() - began


def in_turns(functions, runs):
    """The median time of each function, all of them called in turns."""
    return np.median([[seconds(function) for function in functions] for _ in range(runs)], axis=0)


def told(time):
    return f"{time:.3g} s" if time >= 1 else f"{1000 * time:.3g} ms"


def faster(what, ours, peer, target, runs):
    """A row: ours is to be so many times faster than the peer, or no target."""
    ratio = peer / ours
    goal, met = ("", "") if target is None else (f">= {target:g}", "yes" if ratio >= target else "NO")
    return what, told(ours), told(peer), f"{ratio:.3g}", goal, met, runs


def at_most(what, ours, bound, ratio, target, runs):
    """A row: a ratio is to be no larger than a target."""
    return what, ours, bound, f"{ratio:.3g}", f"<= {target:g}", "yes" if ratio <= target else "NO", runs
