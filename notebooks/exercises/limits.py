"""Questions of notebook 07: what geometric restoration cannot know."""

from math import atan, cos, degrees, radians, sin, tan

from exercises.question import Code, Number


def false_throw(aside: float, dip: float) -> Number:
    """The apparent throw by a slip out of the plane (m) where beds dip across it (degrees)."""
    angle = radians(dip)
    return Number(
        f"Rock came {aside:.0f} m from behind the page, and the beds dip away from you at {dip:.0f}°. How much of the "
        "throw in the picture is false?",
        aside * tan(angle),
        "m",
        1.0,
        "The beds lie that much deeper where the rock came from. A section along the slip would not show it.",
        (
            (aside, "That is how far it came. How much deeper are the beds there?"),
            (aside * sin(angle), f"That takes the {aside:.0f} m along the beds. They are measured horizontally."),
            (aside * cos(angle), "That is nearly the whole distance, for beds that are nearly level."),
            (0.0, "It is 0 only where the beds do not dip across the section."),
        ),
        "Draw the beds as seen from the side: how much deeper are they where the rock came from?",
        f"The tangent of the dip, multiplied by a horizontal distance of {aside:.0f} m.",
    )


def salt_grown(came: float, before: float, rise: float, thickness: float) -> Number:
    """The growth of the salt's area (%), from areas (m²), the crest's rise and the thickness (m)."""
    return Number(
        f"{before / 1e6:.2f} km² of salt lay in the section, {came / 1e6:.2f} km² came in. By what share has its area "
        "grown?",
        100 * came / before,
        "%",
        1.0,
        "The method believes that all of that area was there from the beginning.",
        (
            (0.0, "So the method assumes. Salt flows, in and out of the section too."),
            (
                100 * rise / thickness,
                "That is the growth of its thickness at the crest. The pillow is not as wide as the section.",
            ),
            (
                100 * came / (before + came),
                "That is its share of the present-day salt. Growth is relative to what was there before.",
            ),
        ),
        "Growth is relative to what was there before.",
        "Divide the area that came in by the area that was there.",
    )


def _thickness_then(thickness, porosity, then):
    return thickness * (1 - porosity) / (1 - then)


def decompacted(thickness: float, porosity: float, then: float) -> Number:
    """The thickness (m) of a bed when it lay shallower, from its porosity now and then."""
    return Number(
        f"A bed is {thickness:.0f} m thick, with a porosity of {porosity:.2f}. When it lay shallower its porosity was "
        f"{then:.2f}. How thick was it then?",
        _thickness_then(thickness, porosity, then),
        "m",
        4.0,
        "The grains stay and the water leaves: thickness times (1 - porosity) is kept.",
        (
            (thickness, "So says the restoration, which keeps areas. What has been squeezed out since?"),
            (thickness * (1 - then) / (1 - porosity), "The other way round: beds get thinner when they are buried."),
            (
                thickness * (1 + then - porosity),
                "The porosities are shares of two different thicknesses: do not subtract.",
            ),
            (thickness * then / porosity, "The water is not kept; the grains are."),
        ),
        "What stayed the same while the bed was buried?",
        "Thickness times (1 - porosity), the height of the grains alone, is the same now and then.",
    )


def thickness_function() -> Code:
    """A function for the thickness before compaction."""
    return Code(
        "Write the line of thickness_then, for any bed: thickness (m) and porosity now, and porosity then.",
        _thickness_then,
        "return thickness * (1 - porosity) / (1 - then)",
        ((300.0, 0.29, 0.46), (100.0, 0.2, 0.6), (50.0, 0.3, 0.3)),
        "This is decompaction in one line. A real one integrates it over depth, because porosity changes within a bed.",
        (
            (
                lambda thickness, porosity, then: thickness * (1 - then) / (1 - porosity),
                "The other way round: beds get thinner when they are buried.",
            ),
            (lambda thickness, porosity, then: thickness * then / porosity, "The water is not kept; the grains are."),
        ),
        "It is the formula of the exercise before.",
        "The height of the grains now, thickness * (1 - porosity), must equal that of the grains then.",
    )


def dip_in_time(dip: float, velocity: float, assumed: float) -> Number:
    """The apparent dip of a fault (degrees) where the velocity differs from the assumed one (both in m/s)."""
    slope = tan(radians(dip))
    return Number(
        f"At a depth of 1,800 m the velocity is {velocity:.0f} m/s. How steep does the fault of {dip:.0f}° seem there "
        f"if you take {assumed:.0f} m/s for the whole section?",
        degrees(atan(slope * assumed / velocity)),
        "°",
        1.0,
        "Too gentle below and too steep above: a straight fault seems to be listric.",
        (
            (dip, "That would be right if you had taken the velocity of that depth."),
            (degrees(atan(slope * velocity / assumed)), "The other way round: in faster rock a metre takes less time."),
            (dip * assumed / velocity, "It is the slope, the tangent, that is multiplied, not the angle."),
        ),
        "Does a metre of fast rock appear longer or shorter than a metre of slow rock?",
        "A metre down appears as assumed / true velocity of a metre. Multiply the slope by that.",
    )
