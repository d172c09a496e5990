"""Questions of notebook 04: bed length, datum, and how to read the deformation."""

from math import cos, radians

import numpy as np

from exercises.question import Choice, Code, Number


def shortening(along: float, across: float, dip: float) -> Number:
    """The shortening of a bed by a fold (%), from its length and its present width (m).

    The dip (degrees) is that of its steepest limb.
    """
    everywhere = cos(radians(dip))
    return Number(
        "By what share of its former width did the fold shorten the section, if the bed kept its length?",
        100 * (1 - across / along),
        "%",
        0.2,
        "The width before was the length of the bed: what is missing of it today is the shortening.",
        (
            (
                100 * (along / across - 1),
                "That is how much longer it was, relative to today's width. Shortening is relative to the width "
                "before folding.",
            ),
            (
                100 * (1 - everywhere),
                f"That would be a bed that dips at {dip:.0f}° everywhere. It is its steepest limb.",
            ),
            (100 * across / along, "That is the share that is left."),
            (0.0, "A line that goes up and down between two points is longer than a straight one."),
        ),
        "Before folding, the bed was as wide as it is long today.",
        "Take the length of the bed minus its present width, over the length.",
    )


def _percent_shortened(points):
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    return 100 * (1 - np.ptp(np.asarray(points)[:, 0]) / length)


def _longer(points):
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    return 100 * (length / np.ptp(np.asarray(points)[:, 0]) - 1)


def _from_ends(points):
    return 100 * (1 - np.ptp(np.asarray(points)[:, 0]) / np.linalg.norm(np.subtract(points[-1], points[0])))


def shortening_function() -> Code:
    """A function for the shortening of any bed."""
    x = np.linspace(0, 1000, 101)
    wave = np.column_stack([x, 50 * np.sin(x / 100)])
    return Code(
        "Write the line that makes shortening return the shortening (%) of any bed, given by its points (x, z).",
        _percent_shortened,
        "return 100 * (1 - np.ptp(points[:, 0]) / length_of(points))",
        ((np.array([(0.0, 0.0), (400.0, 300.0), (800.0, 0.0)]),), (wave,), (wave[::-1] + 7,)),
        "Try it on H1 and H3. Vertical shear gave all beds the same shape, so all three numbers are nearly alike.",
        (
            (_longer, "Shortening is relative to the width before folding, which is the length of the bed."),
            (lambda points: 100 - _percent_shortened(points), "That is the share that is left."),
            (_from_ends, "That is the length from end to end. Add up the lengths of all segments."),
        ),
        "length_of(points) is the length of the bed, and np.ptp(points[:, 0]) its present width.",
        "The length minus the width, over the length, times 100.",
    )


def what_the_datum_does(spreads: dict[float, float]) -> Choice:
    """The effect of another datum, by the spread of the area ratio at each."""
    if max(spreads.values()) - min(spreads.values()) > 1e-6:
        raise ValueError(f"the deformation must be the same at every datum, but its spreads are {spreads}")
    return Choice(
        "What does another datum change?",
        "only how high everything lies",
        "Nothing holds the rock at its depth: all of it moves up or down together and is not deformed. The section "
        "does not say which datum is right: it is the depth at which the bed was deposited.",
        (
            ("the deformation: a higher datum costs more", "Print spread(restored) for each datum, and compare."),
            ("the length of the horizon", "The length is that of the string. Does it matter where you lay it down?"),
            ("the shape of the other beds", "Compare the pictures: lay one over the other, shifted by 200 m."),
        ),
        "Lay the three pictures over each other in your mind.",
        "Print spread(restored) for each restored in by_datum.values().",
    )


def relief_left(today: float, after: float) -> Number:
    """The share of another bed's relief that is left after flattening, from its relief (m) today and after."""
    return Number(
        "What share of its present relief does H1 still have after H2 was flattened?",
        100 * after / today,
        "%",
        2.0,
        "The truth is 0%. What is left says that this fold was not made by bending with lengths kept, or that the two "
        "beds were never parallel, or that the picks are wrong: one number cannot say which.",
        (
            (0.0, "That is the truth, and what vertical shear would give. Look at the number printed for H1."),
            (100.0, "It has become flatter; look at the picture of section 1."),
            (100 * (1 - after / today), "That is the share that was taken away. How much is left?"),
            (100 * today / after, "The other way round."),
        ),
        "Both numbers are printed above, in the line of H1.",
        "Divide the second number printed for H1 by the first.",
    )
