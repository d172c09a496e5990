"""Questions of notebook 05: picking in one domain, reading in the other."""

from math import hypot

import seiswidgets as sw
from exercises.question import Code, Number


def channel_today(restored: float, today: float, heave: float, throw: float) -> Number:
    """The present width of a torn channel, from its two widths, and the fault's heave and throw (all in m)."""
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
        "What did the fault do to the section, sideways?",
        "Add the heave to the restored width; or take np.ptp of around_today[:, 0].",
    )


def present_day_function(restored: sw.Restoration) -> Code:
    """A function that maps a point of the restored section to the present-day one."""
    return Code(
        "Write the line that makes present_day return the present-day position (x, z) of a point of the restored "
        "section.",
        lambda x, z: restored.to_original([(x, z)])[0],
        "return restored.to_original([(x, z)])[0]",
        ((500.0, 900.0), (2100.0, 1150.0), (2700.0, 1130.0), (3300.0, 700.0)),
        "The mapping takes many points at once, as rows (x, z). So it takes a list, and returns an array of rows.",
        (
            (lambda x, z: restored.to_restored([(x, z)])[0], "That maps the other way: from today to restored."),
            (lambda x, z: (x, z), "That leaves the point where it is. Which method of restored maps points?"),
        ),
        "Which method did the cells above use to map the picks?",
        "restored.to_original takes rows of points: give it [(x, z)], and take the first row of what it returns.",
    )


def missing_section(above: float, below: float, throw: float, heave: float) -> Number:
    """The thickness of the beds that a well misses at a fault, from restored depths, throw and heave (all in m)."""
    return Number(
        "How many metres of beds, measured in the restored section, did the well not pass through?",
        below - above,
        "m",
        4.0,
        "This is called the vertical separation. It is a little less than the throw because the beds dip with the "
        "fault here; only in level beds are both the same.",
        (
            (throw, "That is the throw. They are the same only in level beds, and here the beds dip."),
            (heave, "That is the heave, which is horizontal. The well is vertical."),
            (0.0, "The well goes on without a break, but the beds do not: look at its restored path."),
        ),
        "Look at the two dots in the right picture.",
        "Subtract the two restored depths printed above.",
    )


def mispick(error: float, torn: float, throw: float, heave: float) -> Number:
    """The present-day error of a pick that came to the other side of a fault; errors, throw and heave in m."""
    slip = hypot(throw, heave)
    return Number(
        f"Just above the fault a pick is {error:.0f} m too deep in the restored section, and so lies on the other side "
        "of it. How far off is it in the present-day section?",
        torn,
        "m",
        3.0,
        f"The two sides are {slip:.0f} m apart today, most of it downwards. The {error:.0f} m go down as well, but on "
        "the side that stayed up.",
        (
            (error, "So it is away from the fault. Here the pick and its true position lie on either side of it."),
            (throw, "That is the vertical part of the distance between the two sides. There is a horizontal part."),
            (heave, "That is the horizontal part of the distance between the two sides. There is a vertical part."),
            (
                slip,
                f"Nearly: that is the slip. But the pick also went down by {error:.0f} m, which brings it nearer to "
                "the side that slid down.",
            ),
            (
                slip + error,
                "Lengths in different directions do not add up; and the hanging wall slid down, in the direction of "
                "the error.",
            ),
        ),
        "Draw both sides of the fault, and the two positions of the pick on them.",
        f"Take the throw less {error:.0f} m as one leg of a triangle, and the heave as the other; or print "
        "np.median(shift[torn]).",
    )
