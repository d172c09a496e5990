"""Picks that stick out of the section, as fault sticks of a larger survey do: only the part inside counts."""

from collections.abc import Iterable

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.geology.findings import Finding
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.section import Section

CLIPPED = "clipped"  # kind of the findings
ROUNDING = 1e-6  # of a trace or a sample


def clip_line(section: Section, points: np.ndarray) -> list[np.ndarray]:
    """The parts of a line that lie in the section, in order, in metres of rock; an empty list if there are none.

    Points outside by no more than rounding are moved onto the border.
    """
    clipped = onto_border(section, points)
    inside = section.contains(clipped)
    if inside.all():
        return [section.to_rock(clipped)]
    x_min, x_max, z_min, z_max = section.extent
    line = LineString(section.to_rock(clipped))
    box = shapely.box(*section.to_rock([(x_min, z_min), (x_max, z_max)]).ravel())
    parts = [shapely.get_coordinates(part) for part in shapely.get_parts(line.intersection(box)) if part.length > 0]
    spans = [(line.project(shapely.Point(part[0])), line.project(shapely.Point(part[-1]))) for part in parts]
    parts = [part if first < last else part[::-1] for part, (first, last) in zip(parts, spans, strict=True)]
    return [parts[index] for index in np.argsort([min(span) for span in spans])]


def onto_border(section: Section, points: np.ndarray) -> np.ndarray:
    """Move points that lie outside the section by no more than rounding onto its border."""
    x_min, x_max, z_min, z_max = section.extent
    clipped = np.clip(points, (x_min, z_min), (x_max, z_max))
    near = (np.abs(points - clipped) <= ROUNDING * np.array([section.dx, section.dz])).all(axis=-1)
    return np.where(near[..., None], clipped, points)


def clip_findings(section: Section, picks: Iterable[Fault | Horizon]) -> list[Finding]:
    """A note for each pick that sticks out of the section, at its farthest point outside."""
    findings = []
    for pick in picks:
        points = np.concatenate([pick.points] if isinstance(pick, Fault) else pick.pieces)
        x_min, x_max, z_min, z_max = section.extent
        beyond = np.abs(points - np.clip(points, (x_min, z_min), (x_max, z_max))) / (section.dx, section.dz)
        if (beyond > ROUNDING).any():
            x, z = points[np.argmax(beyond.max(axis=1))].tolist()
            what = "fault" if isinstance(pick, Fault) else "horizon"
            text = (
                f"{what} {pick.name} sticks out of the section, as far as {section.where((x, z))}; only the part "
                "inside is used"
            )
            findings.append(Finding("note", CLIPPED, text, pick.name, (x, z)))
    return findings
