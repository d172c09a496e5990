"""Questions of notebook 03: cut-offs, matches, blind faults, several faults."""

from math import cos, radians, sin, sqrt, tan

from exercises.question import Choice, Number


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
            (throw, "It would be, at a dip of 45°."),
        ),
        "Draw the triangle: the throw upright, the heave level, the slip along the fault.",
    )


def misplaced_by(shift: float, dip: float) -> Number:
    """How far a wrong match puts the hanging wall off, from the beds' distance (m) and the dip (degrees)."""
    angle = radians(dip)
    return Number(
        f"You match a bed with one {shift:.0f} m below the right one. How far off does the hanging wall end, measured "
        "along the fault?",
        shift / sin(angle),
        "m",
        1.0,
        "The block can only slide along the fault; to come up by the beds' distance it goes farther than that.",
        (
            (shift, "That is only the vertical part of the way, and the fault is not upright."),
            (shift / tan(angle), "That is only the horizontal part of the way."),
            (shift * sin(angle), "The way along the fault is longer than the vertical one, not shorter."),
        ),
        "It is the slip that belongs to a throw of so many metres.",
    )


def what_tells(by_match: dict[str, list[float]]) -> Choice:
    """Which number tells matches apart, by how much each varies between them."""
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
        "It alone looks at the picture. The others only say whether what you asked for could be done.",
        tuple((name, hint) for name, hint in hints.items() if name != answer),
    )


def half_the_slip(half_length: float) -> Number:
    """Where on an elliptic fault half of its slip is left."""
    return Number(
        f"The slip along this fault is half an ellipse, {2 * half_length:.0f} m from tip to tip. How far from its "
        "centre is it half of its largest?",
        half_length * sqrt(0.75),
        "m",
        5.0,
        "An ellipse stays high and falls steeply at its ends: most of the fault slips by more than half of that.",
        (
            (half_length / 2, "That would be right if the slip fell in a straight line from the centre to the tip."),
            (half_length * sqrt(0.5), "That would be a parabola. An ellipse is fuller."),
            (half_length * (1 - sqrt(0.75)), "Measured from the tip, yes. How far is it from the centre?"),
        ),
        "Solve (t / a)² + (slip / largest)² = 1 for t, a being half of the length.",
    )


def graben_widened(throw: float, dip: float) -> Number:
    """How far the far side of a graben moves when its near side is held."""
    heave = throw / tan(radians(dip))
    return Number(
        f"Both faults of the graben dip at {dip:.0f}° and have a throw of {throw:.0f} m. The left block is held. "
        "How far to the left does the right block move?",
        2 * heave,
        "m",
        2.0,
        "Each fault has opened the section by its heave. That sum is the extension of the whole.",
        (
            (heave, "That closes one fault. The middle block moves too, and takes the other fault along."),
            (0.0, "If it stayed, the middle block would have to fill a gap that is wider than itself."),
            (2 * throw, "Those are the throws: the vertical parts. Sideways it is the heaves that count."),
        ),
        "First close the left fault with everything to its right, then the right one.",
    )
