"""Questions of notebook 01: slip, how a block moves along an arc, and where rock gives way."""

from exercises.question import Choice, Number


def slip(throw: float, heave: float) -> Number:
    """How far a horizon slipped, from its throw and heave (m)."""
    return Number(
        "How far has H2 slipped, straight from one cut-off to the other?",
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
    )


def motion(slips: list[float]) -> Choice:
    """How the hanging wall moved, from the slip (m) of each horizon."""
    if max(slips) - min(slips) > 0.01 * max(slips):
        raise ValueError(f"the horizons must have slipped equally far, but they slipped by {slips} m")
    return Choice(
        "The fault is an arc of a circle, and nearly no rock was deformed. How did the hanging wall move?",
        "it turned about the centre of the arc",
        f"A turn keeps every triangle, and slides an arc along itself. So all horizons slipped by {slips[0]:.0f} m.",
        (
            (
                "it was shifted along the mean dip",
                "An arc that is shifted leaves the other one: here a gap, there rock on rock.",
            ),
            ("it dropped", "Then there would be no heave."),
            (
                "it was sheared along the beds",
                "Shear changes the angles of triangles. Which motion changes nothing in them?",
            ),
        ),
    )


def narrowed(top: float, base: float) -> Choice:
    """Where rock is pushed together, from the width at the top and at the base of a dome, as shares of that today."""
    if not top < 1 < base:
        raise ValueError(f"the top must get narrower and the base wider, but their widths are {top:g} and {base:g}")
    return Choice(
        "Which part of the dome is pushed together, sideways, when H2 is levelled?",
        "the top of the section",
        f"The section unbends like a plate. What lies outside the arch is squeezed, here to {top:.0%} of its width.",
        (
            (
                "the base of the section",
                f"It lies inside the arch, and is pulled apart when that opens: to {base:.0%} of its width.",
            ),
            (
                "all of it alike",
                "H2 keeps its length. Rock above and below it cannot: it goes round the same bend, farther out or in.",
            ),
            ("the rock along the fault", "Look at the report of the unfaulting: it deformed nearly nothing."),
        ),
    )
