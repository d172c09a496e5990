"""Questions of notebook 08: plausible matches, what decides between them, and uncertainty."""

from math import radians, sin, tan

import numpy as np

from exercises.question import Choice, Code, Number


def peaks_apart(period: float, dip: float) -> Number:
    """The distance of two peaks of a scan, from the beds' period (m) and the fault's dip (degrees)."""
    angle = radians(dip)
    return Number(
        f"The beds repeat every {period:.0f} m, and the fault dips at {dip:.0f}°. By how much do the slips of two "
        "peaks differ?",
        period / sin(angle),
        "m",
        4.0,
        "To move by one period downwards, the block has to slide farther along the fault.",
        (
            (period, "That is the difference of their throws. The slip is measured along the fault."),
            (period / tan(angle), "That is the difference of their heaves."),
            (period * sin(angle), "The slip is longer than its vertical part, not shorter."),
        ),
        "Read it off the figure, or draw the triangle of throw, heave and slip.",
        "Divide the period by the sine of the dip.",
    )


def what_tells_alone(values: dict[str, dict[str, float]]) -> Choice:
    """The number that tells two hypotheses with one horizon apart: none."""
    correlations = [value for one in values.values() for name, value in one.items() if name.startswith("correlation")]
    if np.ptp(correlations) > 0.1:
        raise ValueError(f"the hypotheses must correlate about as well, but their correlations are {correlations}")
    return Choice(
        "With one horizon, which number of the table decides between the two hypotheses?",
        "none of them",
        "Both correlate, and both balance. A straight fault lets the block slide to either match without deforming it.",
        (
            (
                "the correlation",
                f"They are {correlations[0]:.2f} and {correlations[1]:.2f}. Other noise could turn their order round.",
            ),
            ("the change of bed length", "It is nearly zero for both."),
            ("the deformation", "It is nearly zero for both: the block moved as a whole."),
        ),
        "Compare the two rows, number by number.",
        "Ask of each number whether it could be the other way round with other noise.",
    )


def what_decided() -> Choice:
    """The evidence that decided between two matches."""
    return Choice(
        "What decided between the two matches?",
        "that both horizons must fit one slip",
        "Two horizons at one straight fault contradict each other unless the match is right. So pick a second horizon, "
        "best one that cannot be confused with another.",
        (
            ("the weights of the scan", "They only say how well the picture fits, and it fits both."),
            (
                "that the ash is older or younger than H2",
                "Its age says that it is the same bed in both wells, no more.",
            ),
            ("the finer mesh", "The mesh was the same for all four."),
        ),
        "What did the second table add to the first?",
        "Look at the change of bed length and the deformation in both tables: when did they become large?",
    )


def interval_function() -> Code:
    """A function for the width of the middle 90% of values."""
    rng = np.random.default_rng(0)
    cases = tuple((rng.normal(size=count) * scale,) for count, scale in ((200, 1.0), (50, 7.0), (31, 0.2)))
    return Code(
        "Write the line of interval, for any array of values.",
        lambda values: np.ptp(np.percentile(values, (5, 95))),
        "return np.percentile(values, 95) - np.percentile(values, 5)",
        cases,
        "Compare interval(two_matches) with interval(decided_by_ash): a second horizon beats better picks.",
        (
            (lambda values: np.ptp(values), "That is the whole range, which grows with the number of restorations."),
            (lambda values: 2 * np.std(values), "Two standard deviations describe one hump, not two."),
            (
                lambda values: np.ptp(np.percentile(values, (10, 90))),
                "That holds 80%. Which percentiles have 5% on either side?",
            ),
            (lambda values: np.ptp(np.quantile(values, (0.25, 0.75))), "That holds the middle half."),
        ),
        "np.percentile(values, 5) is the value below which 5% of the values lie.",
        "Subtract the 5th percentile from the 95th.",
    )
