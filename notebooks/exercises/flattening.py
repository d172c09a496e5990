"""Questions of notebook 04: bed length, datum, and how to read the deformation."""

from math import cos, radians

from exercises.question import Choice, Number


def longer_than_wide(along: float, across: float, dip: float) -> Number:
    """By how much a folded bed is longer than it is wide, from both (m) and its steepest dip (degrees)."""
    steepest = 1 / cos(radians(dip))
    return Number(
        "By how much is the bed longer than it is wide, as a share of its width?",
        100 * (along / across - 1),
        "%",
        0.5,
        "So much wider was the bed before it was folded, if it kept its length.",
        (
            (
                100 * (steepest - 1),
                f"That would be a bed that dips at {dip:.0f}° everywhere. That is its steepest limb.",
            ),
            (100 * (1 - 1 / steepest), f"That takes {dip:.0f}° for the dip everywhere, and the length for the whole."),
            (0.0, "A line that goes up and down between two places is longer than a level one."),
        ),
        "Take the two numbers printed above: length over width, less 1.",
    )


def what_the_datum_does(spreads: dict[float, float]) -> Choice:
    """What another datum changes, by the spread of the area ratio at each."""
    if max(spreads.values()) - min(spreads.values()) > 1e-6:
        raise ValueError(f"the deformation must be the same at every datum, but its spreads are {spreads}")
    return Choice(
        "What does another datum change?",
        "only how high everything lies",
        "Nothing holds the rock's depth: all of it moves up or down as one, and is not deformed by it.",
        (
            ("the deformation: a higher datum costs more", "Print spread(restored) for each datum, and compare."),
            ("the length of the horizon", "The length is that of the string. Does it matter where you lay it down?"),
            ("the shape of the other beds", "Compare the pictures: lay one over the other, shifted by 200 m."),
        ),
    )


def relief_left(today: float, after: float) -> Number:
    """The share of another bed's relief that is left after flattening, from its relief (m) today and after."""
    return Number(
        "What share of its relief of today does H1 still have after H2 was flattened?",
        100 * after / today,
        "%",
        2.0,
        "The truth is 0%. What is left says that this fold was not made by bending with lengths kept, or that the "
        "picks are wrong: one number cannot say which.",
        (
            (0.0, "That is the truth, and what vertical shear would give. Look at the number printed for H1."),
            (100.0, "It has become flatter; look at the picture of section 1."),
            (100 * (1 - after / today), "That is the share that was taken away. How much is left?"),
            (100 * today / after, "The other way round."),
        ),
        "Divide the second number printed for H1 by the first.",
    )
