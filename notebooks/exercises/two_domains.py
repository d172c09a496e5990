"""Questions of notebook 05: picking in the one domain, reading in the other."""

from exercises.question import Number


def channel_today(restored: float, today: float, heave: float, throw: float) -> Number:
    """How wide a torn channel is today, from its two widths, and the fault's heave and throw (all in m)."""
    return Number(
        f"The channel is {restored:.0f} m wide in the restored section. How wide is it today, from its left end to its "
        "right end?",
        today,
        "m",
        15.0,
        "The fault has pulled its halves apart by about the heave.",
        (
            (restored, "That would be right without the fault. Did its two halves stay side by side?"),
            (restored - heave, "A normal fault lengthens the section. Beds that it cut are apart, not on each other."),
            (restored + throw, "You added the throw, which is vertical."),
        ),
        "Add what the fault did to the section sideways; or take np.ptp of the outline's x today.",
    )


def missing_section(above: float, below: float, throw: float, heave: float) -> Number:
    """The thickness of the beds that a well misses at a fault, from restored depths, throw and heave (all in m)."""
    return Number(
        "How many metres of beds, measured in the restored section, did the well not see?",
        below - above,
        "m",
        4.0,
        "It is a little less than the throw: the beds dip with the fault here, and it is in level beds that both are "
        "the same.",
        (
            (throw, "That is the throw. They are the same only in level beds, and here the beds dip."),
            (heave, "That is the heave, which is horizontal. The well is vertical."),
            (0.0, "The well goes on without a break, but the beds do not: look at its restored path."),
        ),
        "Subtract the two restored depths printed above.",
    )


def mispick(error: float, today: float, torn: float) -> Number:
    """How far off a misplaced pick is today, away from faults, and next to one (all in m)."""
    return Number(
        f"A pick is {error:.0f} m too deep in the restored section. How far off is it today, away from the fault?",
        today,
        "m",
        1.0,
        f"Rock that was hardly deformed hands errors on as they are. Next to the fault it is another matter: where a "
        f"pick slips to the other side, it is off by {torn:.0f} m in the median.",
        (
            (0.0, "Mapping a point moves it; it does not know where you meant to pick."),
            (2 * error, "The way through two stages does not add the error twice."),
            (torn, "So far it is where the pick comes to the other side of the fault, which few do."),
        ),
        "The median is printed above.",
    )
