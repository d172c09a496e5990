"""Questions of notebook 05: picking in the one domain, reading in the other."""

from math import hypot

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
        "It is called the vertical separation, and is a little less than the throw: the beds dip with the fault here, "
        "and only in level beds both are the same.",
        (
            (throw, "That is the throw. They are the same only in level beds, and here the beds dip."),
            (heave, "That is the heave, which is horizontal. The well is vertical."),
            (0.0, "The well goes on without a break, but the beds do not: look at its restored path."),
        ),
        "Subtract the two restored depths printed above.",
    )


def mispick(error: float, torn: float, throw: float, heave: float) -> Number:
    """How far off a pick is today that came to the other side of a fault; errors, throw and heave in m."""
    slip = hypot(throw, heave)
    return Number(
        f"Just above the fault a pick is {error:.0f} m too deep in the restored section, and comes to the other side "
        "of it. How far off is it today?",
        torn,
        "m",
        3.0,
        f"The two sides are {slip:.0f} m apart today, most of it downwards; the {error:.0f} m go down as well, but on "
        "the side that stayed up.",
        (
            (error, "So it is away from the fault. Here the pick and where it should be lie on either side of it."),
            (throw, "That is the vertical part of what parts the two sides. There is a horizontal one."),
            (heave, "That is the horizontal part of what parts the two sides. There is a vertical one."),
            (
                slip,
                f"Nearly: that is the slip. But the pick went down by {error:.0f} m besides, which brings it nearer to "
                "the side that slid down.",
            ),
            (
                slip + error,
                "Lengths in different directions do not add up; and the hanging wall slid down, to where the error is.",
            ),
        ),
        f"Take the throw less {error:.0f} m as one leg of a triangle, and the heave as the other; or print the median "
        "of shift[torn].",
    )
