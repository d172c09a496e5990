"""Questions of notebook 03: cut-offs, matches, blind faults, several faults."""

from math import cos, radians, sin, sqrt, tan

from exercises.question import Choice, Code, Number


def heave_of(throw: float, dip: float) -> Number:
    """The heave of a straight fault, from its throw (m) and dip (degrees)."""
    angle = radians(dip)
    return Number(
        f"A straight fault dips at {dip:.0f}° and has a throw of {throw:.0f} m. How large is its heave?",
        throw / tan(angle),
        "m",
        1.0,
        "Throw and heave are the two legs of a triangle whose long side lies on the fault.",
        (
            (throw * tan(angle), "The other way round: the steeper a fault, the smaller its heave."),
            (throw * cos(angle), "This takes the throw for the slip. The throw is the vertical leg of the triangle."),
            (throw / sin(angle), "That is the slip, measured along the fault. The heave is its horizontal part."),
            (throw, "That would be right at a dip of 45°."),
        ),
        "Draw the triangle: the throw vertical, the heave horizontal, the slip along the fault.",
        "In that triangle, the tangent of the dip is throw over heave.",
    )


def heave_function() -> Code:
    """A function for the heave of any straight fault."""
    return Code(
        "Write the line that makes heave_of return the heave (m) for any throw (m) and dip (degrees).",
        lambda throw, dip: throw / tan(radians(dip)),
        "return throw / np.tan(np.radians(dip))",
        ((120.0, 70.0), (150.0, 60.0), (100.0, 45.0), (80.0, 25.0)),
        "Compare: sw.heave measures it between picks, without assuming that the fault is straight.",
        (
            (lambda throw, dip: throw / tan(dip), "NumPy's tangent takes radians. Convert the dip first: np.radians."),
            (lambda throw, dip: throw * tan(radians(dip)), "The other way round: steep faults have small heaves."),
            (lambda throw, dip: throw * cos(radians(dip)), "This takes the throw for the slip."),
        ),
        "It is the formula of the exercise before.",
        "Divide the throw by the tangent of the dip; np.tan takes radians.",
    )


def misplaced_by(shift: float, dip: float) -> Number:
    """The error of the hanging wall's position by a wrong match, from the beds' distance (m) and the dip (degrees)."""
    angle = radians(dip)
    return Number(
        f"You match a bed with one {shift:.0f} m below the right one. By how much is the hanging wall misplaced, "
        "measured along the fault?",
        shift / sin(angle),
        "m",
        1.0,
        "The block can only slide along the fault. To rise by the distance of the beds, it has to slide farther.",
        (
            (shift, "That is only the vertical part of the motion, and the fault is not vertical."),
            (shift / tan(angle), "That is only the horizontal part of the motion."),
            (shift * sin(angle), "The distance along the fault is longer than the vertical one, not shorter."),
        ),
        f"It is the slip of a fault whose throw is {shift:.0f} m.",
        "Divide the vertical distance by the sine of the dip.",
    )


def what_tells(by_match: dict[str, list[float]]) -> Choice:
    """The number that tells matches apart, by its values for each match."""
    hints = {
        "the deformation": "All triangles kept their areas with every match: the block slid as a whole each time.",
        "how far the cut-offs are apart": "The solver brings together whatever you call cut-offs, the wrong ones too.",
        "whether the solver settled": "It settled each time. That says the question was clear, not that it was right.",
        "the correlation": "Look at the figure again: this is the one that changes.",
    }
    answer = max(by_match, key=lambda name: max(by_match[name]) - min(by_match[name]))
    return Choice(
        "One horizon on a straight fault: which number told the right match from the wrong ones?",
        answer,
        "Only this number looks at the picture. The others say whether your instructions could be carried out.",
        tuple((name, hint) for name, hint in hints.items() if name != answer),
        "Which of the four numbers uses the amplitudes?",
        "In the figure, find the curve that changes with the guess and has its peak at 0.",
    )


def half_the_slip(half_length: float) -> Number:
    """The distance from the centre of an elliptic fault at which half of its slip is left."""
    return Number(
        f"The slip along this fault is half an ellipse, {2 * half_length:.0f} m from tip to tip. How far from its "
        "centre is the slip half of its maximum?",
        half_length * sqrt(0.75),
        "m",
        5.0,
        "An ellipse stays high and falls steeply at its ends: most of the fault slips by more than half the maximum.",
        (
            (half_length / 2, "That would be right if the slip fell in a straight line from the centre to the tip."),
            (half_length * sqrt(0.5), "That would be a parabola. An ellipse is fuller."),
            (half_length * (1 - sqrt(0.75)), "Measured from the tip, yes. How far is it from the centre?"),
        ),
        "Look at the grey curve in the figure: where does it cross 20 m?",
        f"Solve (t / {half_length:.0f} m)² + (slip / maximum)² = 1 for t.",
    )


def graben_widened(throw: float, dip: float) -> Number:
    """The motion of the far side of a graben when its near side is held."""
    heave = throw / tan(radians(dip))
    return Number(
        f"Both faults of the graben dip at {dip:.0f}° and have a throw of {throw:.0f} m. The left block is held. "
        "How far to the left does the right block move?",
        2 * heave,
        "m",
        2.0,
        "Each fault has opened the section by its heave. The sum is the extension of the whole section.",
        (
            (heave, "That closes one fault. The middle block moves too, and takes the other fault along."),
            (0.0, "If it stayed, the middle block would have to fill a gap that is wider than itself."),
            (2 * throw, "Those are the throws: the vertical parts. Sideways, the heaves count."),
        ),
        "First close the left fault with everything to its right, then the right one.",
        "Compute the heave of one fault, as in the first exercise, and count both faults.",
    )


def well_through_a_thrust() -> Choice:
    """The beds in a vertical well that passes through a thrust."""
    return Choice(
        "A vertical well passes through the thrust between the two cut-offs of H2. How does it meet H2?",
        "twice",
        "The piece in the hanging wall lies over the one in the footwall. A thrust repeats beds in a well; a normal "
        "fault leaves some out.",
        (
            ("not at all", "So it would be at a normal fault, which leaves a gap. Here the heave is negative."),
            ("once", "So it would be beside the fault. Between the cut-offs, the two pieces overlap."),
        ),
        "Draw the well into the left picture, between the two ends of H2 at the fault.",
        "The heave is negative: the pieces overlap sideways by that distance. Count them along a vertical line.",
    )
