"""Questions of notebook 01: slip, the motion of a block along an arc, and where rock is compressed."""

from exercises.question import Choice, Number


def slip(throw: float, heave: float) -> Number:
    """The slip of a horizon, from its throw and heave (m)."""
    return Number(
        "How far has H2 slipped, in a straight line from one cut-off to the other?",
        (throw**2 + heave**2) ** 0.5,
        "m",
        2.0,
        "Now do the same for H1 and H3: all three slipped equally far, although neither throw nor heave is the same.",
        (
            (throw, "That is the throw: the vertical part only."),
            (heave, "That is the heave: the horizontal part only."),
            (throw + heave, "Throw and heave are the legs of a right-angled triangle. The slip is its third side."),
        ),
        "Draw the two cut-offs, and the triangle that throw and heave make with them.",
        "Pythagoras: the root of throw squared plus heave squared.",
    )


def motion(slips: list[float]) -> Choice:
    """The motion of the hanging wall, from the slip (m) of each horizon."""
    if max(slips) - min(slips) > 0.01 * max(slips):
        raise ValueError(f"the horizons must have slipped equally far, but they slipped by {slips} m")
    return Choice(
        "The fault is an arc of a circle, and hardly any rock was deformed. How did the hanging wall move?",
        "it turned about the centre of the arc",
        f"A turn keeps every triangle, and slides an arc along itself. So all horizons slipped by {slips[0]:.0f} m.",
        (
            (
                "it was shifted along the mean dip",
                "An arc that is shifted leaves the other arc: here a gap opens, there rock overlaps rock.",
            ),
            ("it dropped", "Then there would be no heave."),
            (
                "it was sheared along the beds",
                "Shear changes the angles of triangles. Which motion changes nothing in them?",
            ),
        ),
        "All three horizons slipped equally far, and no triangle changed its shape.",
        "Look for the rigid motion that slides an arc of a circle along itself.",
    )


def narrowed(top: float, base: float) -> Choice:
    """The part that is pushed together, from the widths at the top and at the base, relative to today's."""
    if not top < 1 < base:
        raise ValueError(f"the top must get narrower and the base wider, but their widths are {top:g} and {base:g}")
    return Choice(
        "Which part of the dome is pushed together, sideways, when H2 is levelled?",
        "the top of the section",
        f"The section unbends like a plate. What lies outside the arch is compressed, here to {top:.0%} of its width.",
        (
            (
                "the base of the section",
                f"It lies inside the arch, and is pulled apart when the arch opens: to {base:.0%} of its width.",
            ),
            (
                "all of it alike",
                "H2 keeps its length. Rock above and below it cannot: its bend has another radius.",
            ),
            ("the rock along the fault", "Look at the report of the unfaulting: it deformed hardly anything."),
        ),
        "Bend a thick book and look at its edges; then unbend it.",
        "H2 keeps its length. Above it the arch is longer than H2, below it shorter; level beds are equally long.",
    )


def widened(before: float, after: float) -> Number:
    """By how much flattening widened H2, from its widths (m) before and after."""
    return Number(
        "By how many metres did flattening widen H2? Write the line that computes it, with span(...).",
        after - before,
        "m",
        0.2,
        "H2 keeps its length. Laid out level, it reaches farther.",
        (
            (before - after, "Subtract the other way round: before from after."),
            (after, "That is its width after flattening. How much wider is that than before?"),
            (0.0, "Did you compare a restoration with itself? One is unfaulted, the other restored."),
        ),
        "You need the width of H2 in two restorations: unfaulted and restored.",
        "Take span(restored) and subtract span(unfaulted).",
    )
