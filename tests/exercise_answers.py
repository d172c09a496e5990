"""Answers of students to the notebooks' exercises: the right one, and wrong ones with a word of the hint they get.

The right answers are worked out by hand from what each notebook sets (a throw of 150 m on a fault of 60°, ...), or
read off its figures, and typed as a student would. Answers to exercises in code are Python, evaluated in the notebook.
"""

ANSWERS = {
    "01_restore_a_section": [
        ("173 m", {"150": "vertical part", "86": "horizontal part", "237": "third side"}),
        (
            "it turned about the centre of the arc",
            {
                "it was shifted along the mean dip": "overlaps rock",
                "it dropped": "no heave",
                "it was sheared along the beds": "changes the angles",
            },
        ),
        ("32.5", {"-32.5": "other way round", "0": "itself", "3943.6": "wider is that"}),
        (
            "the top of the section",
            {
                "the base of the section": "pulled apart",
                "all of it alike": "keeps its length",
                "the rock along the fault": "hardly anything",
            },
        ),
    ],
    "02_how_it_works": [
        ("edge length", {"mean value": "know no size", "contour": "border", "bed length": "look at the rock"}),
        (
            "10",
            {
                "50": "one vertex against one",
                "11.1": "all pulls balance",
                "0.9": "still missing",
                "100": "Gauss-Newton",
            },
        ),
        (
            "lambda count, slide, stitch: stitch / (stitch + count * slide) * 100",
            {
                "lambda count, slide, stitch: stitch / (stitch + count * slide)": "share is returned",
                "lambda count, slide, stitch: 100 * stitch / (stitch + slide)": "How many hold",
                "lambda count, slide, stitch: 100 * count * slide / (stitch + count * slide)": "still missing",
                "lambda slide, stitch: 10": "must take 3 arguments",
            },
        ),
        ("4", {"1": "fixed number", "2": "steady speed", "8": "square", "3": "too small"}),
    ],
    "03_fault_restoration": [
        (
            "43.7 m",
            {
                "0.33 km": "other way round",
                "41": "takes the throw for the slip",
                "128": "along the fault",
                "70°": "angle",
            },
        ),
        (
            "lambda throw, dip: throw / np.tan(np.radians(dip))",
            {
                "lambda throw, dip: throw / np.tan(dip)": "takes radians",
                "lambda throw, dip: throw * np.tan(np.radians(dip))": "other way round",
                "lambda throw, dip: throw * np.cos(np.radians(dip))": "for the slip",
                "lambda throw, dip: throw / tan(dip)": "spelt",
            },
        ),
        (
            "the correlation",
            {
                "the deformation": "slid as a whole",
                "how far the cut-offs are apart": "the wrong ones too",
                "whether the solver settled": "not that it was right",
            },
        ),
        ("303 ft", {"80": "vertical part", "46": "horizontal part", "69": "longer"}),
        ("217", {"125": "straight line", "177": "parabola", "33.5": "from the tip"}),
        ("139", {"69": "closes one fault", "0": "fill a gap", "240": "Those are the throws"}),
        ("twice", {"not at all": "normal fault", "once": "overlap"}),
    ],
    "04_flattening": [
        (
            "0.073",
            {
                "7.9": "width before folding",
                "0.134": "steepest limb",
                "0.927": "is left",
                "0": "longer than a straight one",
            },
        ),
        (
            "lambda points: 100 * (1 - np.ptp(points[:, 0]) / length_of(points))",
            {
                "lambda points: 1 - np.ptp(points[:, 0]) / length_of(points)": "share",
                "lambda points: 100 * np.ptp(points[:, 0]) / length_of(points)": "left",
                "lambda points: 'much'": "not a number",
                "lambda points: None": "return",
            },
        ),
        (
            "only how high everything lies",
            {
                "the deformation: a higher datum costs more": "compare",
                "the length of the horizon": "string",
                "the shape of the other beds": "lay one over the other",
            },
        ),
        ("0.46", {"0": "That is the truth", "0.54": "taken away", "100": "flatter", "216": "other way round"}),
    ],
    "05_two_domains": [
        ("775", {"695": "without the fault", "609": "lengthens", "0.845 km": "vertical"}),
        (
            "lambda x, z: restored.to_original([(x, z)])[0]",
            {
                "lambda x, z: restored.to_restored([(x, z)])[0]": "other way",
                "lambda x, z: (x, z)": "where it is",
                "lambda x, z: restored.to_original([(x, z)])": "2 numbers are wanted",
                "lambda x, z: restored.to_original(x, z)": "on its own",
            },
        ),
        ("131", {"150": "That is the throw", "86": "horizontal", "0": "restored path"}),
        (
            "165",
            {"10": "away from the fault", "150": "vertical part", "86": "horizontal part", "173": "Nearly"},
        ),
    ],
    "06_real_sections": [
        ("1.187", {"32": "true proportions", "128": "No fault is steeper", "9": "compressed vertically"}),
        ("1.24 rad", {"58": "milliseconds for metres", "80": "two-way", "19": "with the vertical"}),
        ("31.7", {"63.4": "take half", "17.6": "number of milliseconds", "9.8": "more metres"}),
        ("20.8 m", {"26.8": "That is the heave", "6.6": "how much of the heave closed", "1.6": "too small"}),
        (
            "throw in metres",
            {
                "throw in ms": "no velocity is involved",
                "correlation": "it changes by",
                "deformation": "not in proportion",
                "none of them": "as steeply",
            },
        ),
    ],
    "07_limits": [
        ("73 m", {"200": "how far it came", "68.4": "along the beds", "188": "whole distance", "0": "do not dip"}),
        ("0.185", {"0": "Salt flows", "83": "at the crest", "15.6": "present-day salt"}),
        ("393", {"300": "So says the restoration", "229": "other way round", "348": "do not subtract"}),
        (
            "lambda thickness, porosity, then: thickness * (1 - porosity) / (1 - then)",
            {
                "lambda thickness, porosity, then: thickness * (1 - then) / (1 - porosity)": "other way round",
                "lambda thickness, porosity, then: thickness * then / porosity": "grains",
                "lambda thickness, porosity, then: thickness": "in 1 of 3",
            },
        ),
        ("52", {"60": "of that depth", "66.8": "other way round", "44": "tangent"}),
    ],
    "08_which_match": [
        ("231", {"200": "throws", "115": "heaves", "173": "not shorter"}),
        (
            "none of them",
            {
                "the correlation": "Other noise",
                "the change of bed length": "nearly zero",
                "the deformation": "as a whole",
            },
        ),
        (
            "that both horizons must fit one slip",
            {
                "the weights of the scan": "fits both",
                "that the ash is older or younger than H2": "no more",
                "the finer mesh": "the same",
            },
        ),
        (
            "lambda values: np.diff(np.percentile(values, [5, 95]))[0]",
            {
                "lambda values: np.ptp(values)": "whole range",
                "lambda values: np.std(values)": "none of 3",
                "lambda values: np.percentile(values, 90) - np.percentile(values, 10)": "80%",
            },
        ),
    ],
    "09_through_time": [
        (
            "1.64",
            {"0.61": "other way round", "1": "did not move", "64 %": "by which it is thicker", "2 km": "a length"},
        ),
        (
            "before H2 was deposited, and back to the time of H5 at least",
            {
                "after H1 was deposited": "be cut",
                "only at the time of H5": "no throw",
                "all at once, after H2 was deposited": "the same throw",
            },
        ),
        ("329", {"0": "with itself", "-329": "other way round", "50": "too small"}),
        ("0.129", {"87 %": "missing", "14.8": "true one", "0": "Compare"}),
        (
            "the beds are older than the fault",
            {
                "the fault is steep": "may be steep",
                "the section is in time": "ratio",
                "the throw is small": "Small faults",
            },
        ),
    ],
}
