"""Random interpretations as a hand draws them, on sections of many shapes and units; and an audit of the answers."""

import re
from dataclasses import dataclass

import numpy as np
from shapely import LineString

import seiswidgets as sw
from seiswidgets.core.mesh import triangle_areas
from tests.cases import DEPTH, WIDTH, random_case

# Traces, samples, and the keywords of a section
SURVEYS = {
    "depth": (321, 201, {"dx": 12.5, "dz": 10.0}),
    "map coordinates": (321, 201, {"dx": 12.5, "dz": 10.0, "x0": 4_312_687.5, "z0": -150.0}),
    "time": (401, 251, {"dx": 12.5, "dz": 4.0, "x0": 612_400.0, "z_unit": "ms", "velocity": 2400.0}),
    "seconds and kilometres": (
        401,
        251,
        {"dx": 0.0125, "dz": 0.004, "x0": 5871.2, "x_unit": "km", "z_unit": "s", "velocity": 3000.0},
    ),
    "feet": (300, 300, {"dx": 55.0, "dz": 20.0, "x0": 2_140_000.0, "x_unit": "ft", "z_unit": "ft"}),
    "thin": (1601, 41, {"dx": 12.5, "dz": 15.0}),
    "tall": (101, 1001, {"dx": 12.5, "dz": 4.0, "x0": 1_000_000.0}),
    "few samples": (81, 21, {"dx": 50.0, "dz": 100.0}),
}
SCREEN = np.array([900, 450])  # pixels, on which a section is drawn
SLIPS = (0.0, 0.0, 0.3, -0.3, 1.0, -1.0, 3.0, -3.0, 10.0, -10.0)  # of a line's end, in pixels, beyond or short
NEAR = (1e-9, 1e-6, 1e-3, 0.05, 0.3)  # pixels from a point to one that was clicked twice
NUMBER = r"[-+]?(?:\d[\d,]*\.?\d*|\.\d+)(?:e[-+]?\d+)?"
POSITION = re.compile(rf"x=({NUMBER})(?: (\S+?))?, z=({NUMBER})(?: (\w+))?")
LENGTH = re.compile(rf"({NUMBER}) (m²|km²|ft²|m|km|ft|ms|s)\b")


@dataclass(frozen=True)
class HandDrawing:
    """A section, an interpretation of it, and a point to hold or None."""

    survey: str
    section: sw.Section
    interpretation: sw.Interpretation
    fixed: tuple[float, float] | None


def hand_drawing(seed):
    """Random case of `random_case`, stretched to one of the surveys and drawn by an unsteady hand."""
    rng = np.random.default_rng([seed, 12])
    survey = list(SURVEYS)[seed % len(SURVEYS)]
    nx, nz, keywords = SURVEYS[survey]
    section = sw.Section(np.zeros((nz, nx), np.float32), **keywords)
    _, faults, horizons, fixed = random_case(seed)
    steadiness = rng.choice([0.0, 0.5, 1.0, 2.0])  # in pixels
    picks = sw.Interpretation(
        [sw.Fault(_redrawn(rng, section, fault.points, steadiness), fault.name) for fault in faults],
        [
            sw.Horizon(*(_redrawn(rng, section, piece, steadiness) for piece in horizon.pieces), name=horizon.name)
            for horizon in horizons
        ],
    )
    held = None if fixed is None else tuple(_placed(section, [fixed])[0].tolist())
    return HandDrawing(survey, section, picks, held)


def _placed(section, points):
    x_min, x_max, z_min, z_max = section.extent
    return np.array(points) * ((x_max - x_min) / WIDTH, (z_max - z_min) / DEPTH) + (x_min, z_min)


def _redrawn(rng, section, points, steadiness):
    """A line with other points, unsteady, its ends off, some points clicked twice; drawn from either end."""
    line = LineString(np.array(points) * SCREEN / (WIDTH, DEPTH))
    count = max(2, round(line.length / rng.choice([2.0, 10.0, 30.0, 90.0])))
    drawn = np.array([line.interpolate(share, normalized=True).coords[0] for share in np.linspace(0, 1, count)])
    drawn[1:-1] += min(steadiness, line.length / count / 4) * rng.normal(size=(count - 2, 2))
    for end, inner in ((0, 1), (-1, -2)):
        arm = drawn[end] - drawn[inner]
        reach = min(rng.choice(SLIPS) * rng.uniform(), 0.3 * np.hypot(*arm)) if count == 2 else rng.choice(SLIPS)
        drawn[end] += max(reach, -0.8 * np.hypot(*arm)) * arm / np.hypot(*arm)
    for index in rng.integers(0, len(drawn), rng.choice([0, 0, 1, 3])):
        drawn = np.insert(drawn, index, drawn[index] + rng.choice(NEAR) * rng.normal(size=2), axis=0)
    tolerance = 0.5
    while not LineString(drawn).is_simple:  # the app says so as such a line is drawn
        drawn, tolerance = np.array(LineString(drawn).simplify(tolerance).coords), 2 * tolerance
    return _placed(section, (drawn if rng.integers(2) else drawn[::-1]) * (WIDTH, DEPTH) / SCREEN)


def outcome(drawing, **options):
    """Outcome of a drawing: a word and its messages; an AssertionError if an answer is wrong or of no help."""
    try:
        restored = sw.Plan(fixed=drawing.fixed, **options).restore(drawing.section, drawing.interpretation)
    except sw.SeiswidgetsError as error:
        audit_refusal(drawing, error)
        return "refused", [str(error)]
    for stage in restored.stages:
        assert triangle_areas(stage.vertices, stage.mesh.triangles).min() > 0
        assert stage.report.converged or any(finding.kind == "unsettled" for finding in stage.report.findings)
    for finding in restored.findings:
        audit_text(drawing.section, str(finding.text))
    word = "restored" if restored.settled else "not settled"
    return word + (", with findings" if restored.findings else ""), [str(finding.text) for finding in restored.findings]


def audit_refusal(drawing, error):
    """A refusal names the pick, or the keyword, and what to do; its position lies on the section."""
    names = [pick.name for pick in (*drawing.interpretation.faults, *drawing.interpretation.horizons)]
    assert error.pick in names or "fixed" in str(error), f"names no pick: {error}"
    assert error.pick is None or error.pick in str(error), f"does not say which pick: {error}"
    assert re.search(r"[;:,] .*\b(draw|redraw|leave|reduce|keep|move|split|join|give|choose|make)", str(error)), error
    audit_text(drawing.section, str(error))


def audit_text(section, text):
    """Positions and lengths in a message have the section's units, and lie on the section or near it."""
    x_min, x_max, z_min, z_max = section.extent
    width, height = x_max - x_min, z_max - z_min
    for x, x_unit, z, z_unit in POSITION.findall(text):
        assert (x_unit or section.x_unit, z_unit or section.z_unit) == (section.x_unit, section.z_unit), text
        assert x_min - width <= float(x.replace(",", "")) <= x_max + width, text
        assert z_min - height <= float(z.replace(",", "")) <= z_max + height, text
    for value, unit in LENGTH.findall(POSITION.sub("", text)):
        assert unit.rstrip("²") in (section.x_unit, section.z_unit), f"unit {unit}: {text}"
        if "²" not in unit:
            largest = height if unit == section.z_unit != section.x_unit else 2 * (width + height * _ratio(section))
            assert float(value.replace(",", "")) <= 2 * largest, f"{value} {unit} is larger than the section: {text}"


def _ratio(section):
    """Units of x in one of z, as rock."""
    x, z = section.metres
    return z / x
