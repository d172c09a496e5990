"""Questions of notebook 04: bed length, datum, and how to read the deformation."""

from math import cos, radians

from exercises.question import Choice, Number


def shortening(along: float, across: float, dip: float) -> Number:
    """The share of its former length that a fold has taken from a bed, from its length and width of today (m).

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
                "That is how much longer it was, as a share of today's width. Shortening counts from what was before.",
            ),
            (
                100 * (1 - everywhere),
                f"That would be a bed that dips at {dip:.0f}° everywhere. It is its steepest limb.",
            ),
            (100 * across / along, "That is the share that is left."),
            (0.0, "A line that goes up and down between two places is longer than a level one."),
        ),
        "Before: the length of the bed. Today: its width. Take the difference, over the length before.",
    )


def what_the_datum_does(spreads: dict[float, float]) -> Choice:
    """What another datum changes, by the spread of the area ratio at each."""
    if max(spreads.values()) - min(spreads.values()) > 1e-6:
        raise ValueError(f"the deformation must be the same at every datum, but its spreads are {spreads}")
    return Choice(
        "What does another datum change?",
        "only how high everything lies",
        "Nothing holds the rock's depth: all of it moves up or down as one, and is not deformed by it. Which datum is "
        "right the section does not say: it is the depth at which the bed was laid down.",
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
        "The truth is 0%. What is left says that this fold was not made by bending with lengths kept, or that the two "
        "beds were never parallel, or that the picks are wrong: one number cannot say which.",
        (
            (0.0, "That is the truth, and what vertical shear would give. Look at the number printed for H1."),
            (100.0, "It has become flatter; look at the picture of section 1."),
            (100 * (1 - after / today), "That is the share that was taken away. How much is left?"),
            (100 * today / after, "The other way round."),
        ),
        "Divide the second number printed for H1 by the first.",
    )
