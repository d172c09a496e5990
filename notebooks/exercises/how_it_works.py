"""Questions of notebook 02: the mesh, the terms of the energy, and the two solvers."""

from math import log

from exercises.question import Choice, Number


def what_keeps_the_size(median_ratio: dict[str, float]) -> Choice:
    """Which term keeps triangles from shrinking, by the median area ratio without each."""
    hints = {
        "mean value": "A smaller copy of a triangle fan has the same mean value coordinates: they know no size.",
        "contour": "Only the border's vertices have this term, and where the border is straight its bend is nought at "
        "any size.",
        "level": "This one acts on the horizon alone. Look which panel's rock has become smaller.",
        "bed length": "This one acts on the horizon alone. Without it the horizon shrinks; look at the rock.",
    }
    answer = max(median_ratio, key=lambda term: abs(log(median_ratio[term])))
    return Choice(
        "Which of the five terms keeps the triangles from shrinking all over?",
        answer,
        f"Without it the median triangle has 1/{median_ratio[answer]:.1f} of its area left. The others know "
        "shapes, or only the horizon.",
        tuple((term, hints[term]) for term in median_ratio if term != answer),
    )


def first_step_of_a_rigid_block(count: int, slide: float, stitch: float) -> Number:
    """The share of its way that a rigid block goes in the fixed point's first iteration."""
    pull, hold = stitch, count * slide
    return Number(
        f"Let the block be rigid. {count} vertices on the fault are pulled to where they are with weight {slide:g}, "
        f"and one cut-off is pulled to its partner with weight {stitch:g}. What share of its way does the block go in "
        "the first iteration?",
        100 * pull / (pull + hold),
        "%",
        0.3,
        "The weights balance: the cut-off's against those of all vertices that are held where they were.",
        (
            (100 * pull / (pull + slide), "That is one vertex against one. How many vertices hold the block back?"),
            (100 * pull / hold, "Nearly. The block stops where all pulls balance, the cut-off's own among them."),
            (100 * hold / (pull + hold), "That is the share still to go."),
            (100.0, "That is Gauss-Newton: its contact lets the block slide along the fault for nothing."),
        ),
        "Write the energy of a slip s, of which the cut-off wants S and every other vertex 0, and find its minimum.",
    )


def finer_mesh(iterations: dict[int, int]) -> Number:
    """How many times the iterations grow when a fault has twice the vertices; counts by number of vertices."""
    (few, before), (many, after) = sorted(iterations.items())
    factor = after / before
    return Number(
        f"The chain of {few} vertices had half of its slip after {before} iterations. How many times as many does the "
        f"chain of {many} take?",
        factor,
        "",
        0.3,
        "Slip spreads like heat: twice the vertices, four times the iterations. Gauss-Newton takes the same few.",
        (
            (1.0, "A fixed number of vertices takes part in each iteration, however fine the mesh."),
            (2.0, "That would be right if the slip ran along the fault at a steady speed. It spreads like heat does."),
            (8.0, "Too slow even for heat in a bar. The time goes with the square of the length."),
        ),
        "Print the second number, or think of how the time that heat takes goes with the length of the bar.",
    )
