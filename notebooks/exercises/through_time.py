"""Questions of notebook 09: growth of a fault, restoration step by step, and decompaction."""

from exercises.question import Choice, Number


def expansion_index(hanging_wall: float, footwall: float) -> Number:
    """The expansion index of a layer, from its thickness (m) on both sides of the fault."""
    return Number(
        f"At the fault, the layer between H2 and H3 is {hanging_wall:.0f} m thick in the hanging wall and "
        f"{footwall:.0f} m in the footwall. What is its expansion index?",
        hanging_wall / footwall,
        "",
        0.03,
        "Above 1, the fault moved while the layer was deposited. Compaction makes the index a little too small.",
        (
            (footwall / hanging_wall, "The other way round: hanging wall over footwall."),
            (1.0, "That would be a fault that did not move then."),
            ((hanging_wall - footwall) / footwall, "That is the share by which it is thicker. The index is a ratio."),
        ),
        "Both thicknesses are in the table, in the line from H2 to H3.",
        "Divide the thickness in the hanging wall by that in the footwall.",
    )


def when_it_moved() -> Choice:
    """The time in which the fault moved."""
    return Choice(
        "When did this fault move?",
        "before H2 was deposited, and back to the time of H5 at least",
        "Throw and thickness grow down to H5, and H2 is still offset. H1 and what lies above it are not.",
        (
            ("after H1 was deposited", "Then H1 would be cut."),
            ("only at the time of H5", "Then all horizons above H5 would have no throw."),
            (
                "all at once, after H2 was deposited",
                "Then all horizons would have the same throw, and beds one thickness.",
            ),
        ),
        "Which horizons does the fault cut, and does the throw change from one to the next?",
        "A fault is younger than what it cuts, and older than what covers it; it grew where the throw changes.",
    )


def extended(before: float, after: float) -> Number:
    """The extension of a section (m), from its widths before and after."""
    return Number(
        "By how many metres did the fault extend the section from 25 Ma to today? Write the line, with width(...).",
        after - before,
        "m",
        1.0,
        "The extension is less than the heave of H5 because the bed was also turned on the listric fault.",
        (
            (before - after, "Subtract the other way round: before from after."),
            (before, "That is the width at 25 Ma. How much wider is the section today?"),
            (0.0, "Did you compare a state with itself?"),
        ),
        "You need the width in two states: story[0.0] and story[25.0].",
        "Take width(story[0.0]) and subtract width(story[25.0]).",
    )


def too_shallow(found: float, truth: float) -> Number:
    """The share (%) by which the basin is too shallow without decompaction."""
    return Number(
        "By what share of its true depth is the basin too shallow without decompaction?",
        100 * (1 - found / truth),
        "%",
        0.5,
        "The beds kept the thickness to which the youngest layer had squeezed them.",
        (
            (100 * found / truth, "That is the share that was found. How much is missing?"),
            (100 * (truth / found - 1), "That is relative to the depth that was found, not to the true one."),
            (0.0, "Compare the two pictures, or the two depths printed above."),
        ),
        "Both depths are printed above.",
        "Subtract the depth that was found from the true one, and divide by the true one.",
    )


def doubt_growth() -> Choice:
    """The best reason not to believe in growth of the fault at Teapot Dome."""
    return Choice(
        "What is the strongest reason not to restore Teapot Dome step by step?",
        "the beds are older than the fault",
        "The geology excludes growth. No measurement in the section is as strong as that.",
        (
            ("the fault is steep", "Growth faults may be steep, above all near the surface."),
            ("the section is in time", "The index is a ratio of thicknesses, and hardly depends on the velocity."),
            ("the throw is small", "Small faults can grow too."),
        ),
        "Which of these would hold even if the index were larger?",
        "Read the geology card of Teapot Dome in Real sections.",
    )
