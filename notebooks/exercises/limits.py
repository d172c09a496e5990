"""Questions of notebook 07: what geometric restoration cannot know."""

from math import atan, cos, degrees, radians, sin, tan

from exercises.question import Number


def false_throw(aside: float, dip: float) -> Number:
    """The throw that a slip out of the plane (m) feigns where beds dip across it (degrees)."""
    angle = radians(dip)
    return Number(
        f"Rock came {aside:.0f} m from behind the page, and the beds dip away from you at {dip:.0f}°. How much of the "
        "throw on the picture is false?",
        aside * tan(angle),
        "m",
        1.0,
        "So much deeper lie the beds where that rock came from. A section along the slip would not see it.",
        (
            (aside, "That is how far it came. What counts is how much deeper the beds are there."),
            (aside * sin(angle), f"That takes the {aside:.0f} m along the beds. They are measured level."),
            (aside * cos(angle), "That is nearly the whole way, for beds that are nearly level."),
            (0.0, "It is 0 only where the beds do not dip across the section."),
        ),
        "The beds' dip, over a level way of so many metres.",
    )


def salt_grown(came: float, before: float, rise: float, thickness: float) -> Number:
    """The share by which the salt's area has grown, from areas (m²), the crest's rise and the thickness (m)."""
    return Number(
        f"{before / 1e6:.2f} km² of salt lay in the section, {came / 1e6:.2f} km² came in. By what share has its area "
        "grown?",
        100 * came / before,
        "%",
        1.0,
        "All of that is area which the method believes was there from the first.",
        (
            (0.0, "So the method assumes. Salt flows, in and out of the section too."),
            (
                100 * rise / thickness,
                "That is the growth of its thickness at the crest. The pillow is not as wide as that.",
            ),
            (
                100 * came / (before + came),
                "That is its share of the salt of today. Growth counts from what was there.",
            ),
        ),
        "What came, over what was there.",
    )


def decompacted(thickness: float, porosity: float, then: float) -> Number:
    """The thickness (m) of a bed when it lay shallower, from its porosity now and then."""
    return Number(
        f"A bed is {thickness:.0f} m thick, with a porosity of {porosity:.2f}. When it lay shallower its porosity was "
        f"{then:.2f}. How thick was it then?",
        thickness * (1 - porosity) / (1 - then),
        "m",
        4.0,
        "The grains stay, the water goes: thickness times (1 - porosity) is kept.",
        (
            (thickness, "That is what the restoration says, which keeps areas. What was squeezed out since?"),
            (thickness * (1 - then) / (1 - porosity), "The other way round: beds get thinner when they are buried."),
            (
                thickness * (1 + then - porosity),
                "The porosities are shares of two different thicknesses: do not subtract.",
            ),
            (thickness * then / porosity, "It is not the water that is kept, but the grains."),
        ),
        "Thickness times (1 - porosity), the height of the grains alone, is the same now and then.",
    )


def dip_in_time(dip: float, velocity: float, assumed: float) -> Number:
    """How steep a fault (degrees) seems where the velocity differs from the one that is assumed (both in m/s)."""
    slope = tan(radians(dip))
    return Number(
        f"At a depth of 1,800 m the rock has {velocity:.0f} m/s. How steep does the fault of {dip:.0f}° seem there, "
        f"if you take {assumed:.0f} m/s for all of the section?",
        degrees(atan(slope * assumed / velocity)),
        "°",
        1.0,
        "Too gentle below and too steep above: a straight fault seems to be listric.",
        (
            (dip, "That would be right if you had taken the velocity of that depth."),
            (degrees(atan(slope * velocity / assumed)), "The other way round: faster rock has less time to the metre."),
            (dip * assumed / velocity, "It is the slope, the tangent, that is multiplied, not the angle."),
        ),
        "A metre down counts for assumed / true velocity of a metre. Multiply the slope by that.",
    )
