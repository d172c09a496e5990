"""Answers of students to the notebooks' exercises: the right one, and wrong ones with a word of the hint they get.

The right answers are worked out by hand from what each notebook sets (a throw of 150 m on a fault of 60°, ...), or
read off its figures, and typed as a student would.
"""

ANSWERS = {
    "01_restore_a_section": [
        ("173 m", {"150": "vertical part", "86": "horizontal part", "237": "third side"}),
        (
            "it turned about the centre of the arc",
            {
                "it was shifted along the mean dip": "rock on rock",
                "it dropped": "no heave",
                "it was sheared along the beds": "changes the angles",
            },
        ),
        (
            "the top of the section",
            {
                "the base of the section": "pulled apart",
                "all of it alike": "keeps its length",
                "the rock along the fault": "nearly nothing",
            },
        ),
    ],
    "02_how_it_works": [
        ("edge length", {"mean value": "know no size", "contour": "border", "bed length": "look at the rock"}),
        (
            "10",
            {"50": "one vertex against one", "11.1": "all pulls balance", "90": "still to go", "100": "Gauss-Newton"},
        ),
        ("4", {"1": "fixed number", "2": "steady speed", "8": "square", "3": "too small"}),
    ],
    "03_fault_restoration": [
        ("43.7 m", {"330": "other way round", "41": "takes the throw for the slip", "128": "along the fault"}),
        (
            "the correlation",
            {
                "the deformation": "slid as a whole",
                "how far the cut-offs are apart": "the wrong ones too",
                "whether the solver settled": "not that it was right",
            },
        ),
        ("92", {"80": "vertical part", "46": "horizontal part", "69": "longer"}),
        ("217", {"125": "straight line", "177": "parabola", "33.5": "from the tip"}),
        ("139", {"69": "closes one fault", "0": "fill a gap", "240": "Those are the throws"}),
    ],
    "04_flattening": [
        (
            "7.3 %",
            {"7.9": "what was before", "13.4": "steepest limb", "92.7": "is left", "0": "longer than a level one"},
        ),
        (
            "only how high everything lies",
            {
                "the deformation: a higher datum costs more": "compare",
                "the length of the horizon": "string",
                "the shape of the other beds": "lay one over the other",
            },
        ),
        ("46", {"0": "That is the truth", "54": "taken away", "100": "flatter", "216": "other way round"}),
    ],
    "05_two_domains": [
        ("775", {"695": "without the fault", "609": "lengthens", "845": "vertical"}),
        ("131", {"150": "That is the throw", "86": "horizontal", "0": "restored path"}),
        (
            "165",
            {"10": "away from the fault", "150": "vertical part", "86": "horizontal part", "173": "Nearly"},
        ),
    ],
    "06_real_sections": [
        ("68°", {"32": "true proportions", "128": "No fault is steeper", "9": "pressed flat"}),
        ("71", {"58": "milliseconds for metres", "80": "there and back", "19": "with the vertical"}),
        ("31.7", {"63.4": "take half", "17.6": "number of milliseconds", "9.8": "more metres"}),
        ("20.8 m", {"26.8": "That is the heave", "6.6": "how much of the heave closed", "1.6": "too small"}),
        (
            "throw in metres",
            {
                "throw in ms": "no velocity comes in",
                "correlation": "it changes by",
                "deformation": "not in proportion",
                "none of them": "as steeply",
            },
        ),
    ],
    "07_limits": [
        ("73 m", {"200": "how far it came", "68.4": "along the beds", "188": "whole way", "0": "do not dip"}),
        ("18.5", {"0": "Salt flows", "83": "at the crest", "15.6": "salt of today"}),
        ("393", {"300": "restoration says", "229": "other way round", "348": "do not subtract"}),
        ("52", {"60": "of that depth", "66.8": "other way round", "44": "tangent"}),
    ],
}
