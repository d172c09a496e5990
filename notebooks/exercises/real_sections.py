"""Questions of notebook 06: exaggeration, velocity, and what depends on them."""

from math import atan, degrees, radians, tan

from exercises.question import Choice, Number


def dip_on_the_screen(dip: float, exaggeration: float) -> Number:
    """The apparent steepness of a fault, from its dip (degrees) and the picture's vertical exaggeration."""
    slope = tan(radians(dip))
    return Number(
        f"A fault dips at {dip:.0f}°. How steep does it look in a picture with a vertical exaggeration of "
        f"{exaggeration:g}?",
        degrees(atan(exaggeration * slope)),
        "°",
        1.5,
        "Exaggeration multiplies the slope, not the angle. So all faults look steep, and nearly alike.",
        (
            (dip, "That would be right in true proportions."),
            (exaggeration * dip, "No fault is steeper than 90°: it is the slope, the tangent, that is multiplied."),
            (degrees(atan(slope / exaggeration)), "That would be its dip in a picture that is compressed vertically."),
        ),
        "What does the exaggeration multiply: the angle or the slope?",
        "Multiply the tangent of the dip, and turn it into an angle again.",
    )


def dip_in_rock(ends, velocity: float) -> Number:
    """The dip of a fault from its ends, rows (x in m, z in ms), and the velocity (m/s)."""
    (x_top, time_top), (x_bottom, time_bottom) = ends
    along, time = abs(x_bottom - x_top), abs(time_bottom - time_top)

    def dip(down):
        return degrees(atan(down / along))

    return Number(
        f"From one end to the other, Teapot's fault goes {along:.0f} m sideways and {time:.0f} ms down. What is "
        f"its dip at {velocity:.0f} m/s?",
        dip(time * velocity / 2000),
        "°",
        1.0,
        f"{time:.0f} ms of two-way time are {time * velocity / 2000:.0f} m.",
        (
            (dip(time), "You took milliseconds for metres; that is right at 2,000 m/s only."),
            (dip(time * velocity / 1000), "The time is two-way. The depth is half of the time multiplied by velocity."),
            (
                90 - dip(time * velocity / 2000),
                "That is the angle with the vertical. Dip is measured from the horizontal.",
            ),
        ),
        "Before you can compute an angle, both sides of the triangle must be in metres.",
        "Depth in metres is half of the time, in seconds, multiplied by velocity; the tangent of the dip is depth over "
        "distance.",
    )


def throw_in_metres(throw: float, velocity: float) -> Number:
    """A throw in metres, from that in ms and the velocity (m/s)."""
    return Number(
        f"The throw of mid is {throw:.1f} ms. How many metres is that at {velocity:.0f} m/s?",
        throw * velocity / 2000,
        "m",
        1.0,
        "Half the two-way time, multiplied by the velocity.",
        (
            (throw * velocity / 1000, "The time is two-way: take half."),
            (throw, "That is the number of milliseconds."),
            (throw * 2000 / velocity, "Faster rock has more metres to the millisecond, not fewer."),
        ),
        "The time is that of the way down and back up.",
        "Take half of the time, in seconds, and multiply by the velocity.",
    )


def bed_made(made: float, heave: float, closed: float) -> Number:
    """The length (m) that unfaulting added to a horizon, beside the heave of its fault and what closed of it (m)."""
    return Number(
        "The report gives the change of lower's bed length in percent, relative to the bed before unfaulting. Write a "
        "line of code with bed_length(f3, unfaulted_lower): by how many metres did unfaulting lengthen the bed?",
        made,
        "m",
        1.0,
        f"The heave is {heave:.1f} m and {closed:.1f} m of it closed; nearly all of the rest is bed that the "
        "restoration added. A bed that grows is a reason to doubt the picks.",
        (
            (heave, "That is the heave. How much longer did the bed itself become?"),
            (closed, "That is how much of the heave closed. The question is about what did not."),
        ),
        "The change is relative to the length before; bed_length gives the length after.",
        "Let L be the length after unfaulting and p the change: the length before was L / (1 + p).",
    )


def what_hangs_on_velocity(numbers: dict[float, dict[str, float]]) -> Choice:
    """The number that is proportional to the velocity, from the numbers found at each velocity."""

    def change(name):
        values = [each[name] for each in numbers.values()]
        return max(values) / min(values)

    hints = {
        "throw in ms": "It is measured in the section as it was recorded: no velocity is involved.",
        "correlation": f"In the figure it changes by {change('correlation') - 1:.0%}, while the velocity doubles.",
        "throw in metres": "Look at the figure again: this one follows the velocity.",
        "deformation": f"It grows by {change('deformation') - 1:.0%} while the velocity doubles: not in proportion.",
        "none of them": "Look at the figure: one of its lines rises as steeply as the velocity does.",
    }
    doubled = max(numbers) / min(numbers)
    answer = min(next(iter(numbers.values())), key=lambda name: abs(change(name) - doubled))
    return Choice(
        "Which of these grows in proportion to the velocity that you choose?",
        answer,
        "Every length along z does, and slopes, areas and strains change with it. Which beds match does not.",
        tuple((name, hint) for name, hint in hints.items() if name != answer),
        "Which line in the figure is straight, and passes through 4/3 at 4,800 m/s?",
        "Compare each number at 4,800 m/s with that at 2,400 m/s: which one doubles?",
    )
