"""Questions of notebook 02: the mesh, the terms of the energy, and the two solvers."""

from math import log

from exercises.question import Choice, Code, Number


def what_keeps_the_size(median_ratio: dict[str, float]) -> Choice:
    """The term that keeps triangles from shrinking, by the median area ratio without each."""
    hints = {
        "mean value": "A smaller copy of a triangle fan has the same mean value coordinates: they know no size.",
        "contour": "Only the border's vertices have this term, and where the border is straight its bend is zero at "
        "any size.",
        "level": "This one acts on the horizon alone. Look in which panel the rock has become smaller.",
        "bed length": "This one acts on the horizon alone. Without it the horizon shrinks; look at the rock.",
    }
    answer = max(median_ratio, key=lambda term: abs(log(median_ratio[term])))
    return Choice(
        "Which of the five terms keeps the triangles from shrinking everywhere?",
        answer,
        f"Without it the median triangle has 1/{median_ratio[answer]:.1f} of its area left. The others know "
        "shapes, or only the horizon.",
        tuple((term, hints[term]) for term in median_ratio if term != answer),
        "Compare the median area ratios printed in the panels.",
        "Look for the panel whose median area ratio is farthest from 1: it names the term that is missing.",
    )


def _rigid_share(count, slide, stitch):
    return 100 * stitch / (stitch + count * slide)


def first_step_of_a_rigid_block(count: int, slide: float, stitch: float) -> Number:
    """The share of the slip that a rigid block achieves in the fixed point's first iteration."""
    pull, hold = stitch, count * slide
    return Number(
        f"Let the block be rigid. {count} vertices on the fault are pulled to where they are with weight {slide:g}, "
        f"and one cut-off is pulled to its partner with weight {stitch:g}. What share of the slip does the block "
        "achieve in the first iteration?",
        _rigid_share(count, slide, stitch),
        "%",
        0.3,
        "The weights balance: the cut-off's against those of all vertices that are held where they were.",
        (
            (100 * pull / (pull + slide), "That is one vertex against one. How many vertices hold the block back?"),
            (100 * pull / hold, "Nearly. The block stops where all pulls balance, the cut-off's own among them."),
            (100 * hold / (pull + hold), "That is the share still missing."),
            (100.0, "That is Gauss-Newton: its contact lets the block slide along the fault for nothing."),
        ),
        "Let s be the slip after the step. One spring wants the full slip S, the others want 0.",
        "Write the energy stitch (s - S)² + count slide s², and find the s at its minimum.",
    )


def rigid_share() -> Code:
    """A function for the share of the slip that a rigid block achieves."""
    return Code(
        "Now for any number of vertices and any weights: write the line of rigid_share, which returns percent.",
        _rigid_share,
        "return 100 * stitch / (stitch + count * slide)",
        ((9, 10.0, 10.0), (99, 10.0, 10.0), (20, 1.0, 10.0), (5, 0.0, 10.0)),
        "With more vertices the share falls as 1 / count. That is why a finer mesh needs more iterations.",
        (
            (
                lambda count, slide, stitch: 100 * stitch / (stitch + slide),
                "That holds for one vertex. How many hold the block back?",
            ),
            (
                lambda count, slide, stitch: 100 * count * slide / (stitch + count * slide),
                "That is the share still missing.",
            ),
        ),
        "It is the formula of the exercise before, with names in place of numbers.",
        "The cut-off's weight over the sum of all weights, times 100.",
    )


def finer_mesh(iterations: dict[int, int]) -> Number:
    """The growth of the iterations when a fault has twice the vertices; counts by number of vertices."""
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
            (2.0, "That would be right if the slip ran along the fault at a steady speed. It spreads like heat."),
            (8.0, "Too slow even for heat in a bar. The time goes with the square of the length."),
        ),
        "How does the time in which heat crosses a bar depend on the bar's length?",
        f"Print iterations_to_half({many}) / iterations_to_half({few}).",
    )
