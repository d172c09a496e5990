"""The rock beyond the ends of a horizon that is flattened: left free, kept, or flattened along an extended horizon."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString, Point

from seiswidgets.core.mesh import Mesh
from seiswidgets.errors import Keyword, SettingError, Text
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding

BEYOND = FREE, KEEP, LEVEL, TREND = "free", "keep", "level", "trend"
SWING = 2.0  # times as far as the horizon itself the rest may move along with it
LEAST = 5.0  # samples by which it may move in any case
LEAST_ROOM = 3.0  # mesh spacings between an end of a horizon and the border, beyond which rock can be held
CHOSEN = {
    KEEP: "the rest is left where it is, and the rock next to the horizon moves",
    LEVEL: "it was extended level to the border; the rest moves",
    TREND: "it was extended along its trend to the border; the rest moves",
}


def check_beyond(beyond: str) -> str:
    """Validate a choice for the rock beyond a horizon's ends."""
    if beyond not in BEYOND:
        raise SettingError(f"beyond must be one of {', '.join(BEYOND)}, but is {beyond!r}")
    return beyond


@dataclass(frozen=True, eq=False)
class Beyond:
    """The rock beyond the ends of a horizon, and what happens to it.

    Attributes
    ----------
    left, right : float
        Range of x that the horizon covers, in metres.
    choice : {"free", "keep", "level", "trend"}
    domain : RestorationDomain
    extensions : tuple of LineString
        Straight lines from the horizon's outermost ends to the border.
    """

    left: float
    right: float
    choice: str
    domain: RestorationDomain
    extensions: tuple[LineString, ...] = ()

    @classmethod
    def of(cls, pieces: Sequence[LineString], domain: RestorationDomain, choice: str) -> "Beyond":
        """The rock beyond the ends of the pieces of a horizon."""
        inside = [part for piece in pieces for part in shapely.get_parts(piece.intersection(domain.outline))]
        ends = [np.array(line.coords[end]) for line in inside if line.length > 0 for end in (0, -1)]
        if not ends:
            return cls(-np.inf, np.inf, FREE, domain)  # which mesh_bed refuses
        low, _, high, _ = shapely.total_bounds(inside)
        left, right = min(ends, key=lambda end: float(end[0])), max(ends, key=lambda end: float(end[0]))
        slope = right - left if choice == TREND else np.array([1.0, 0.0])
        extend = choice in (LEVEL, TREND) and right[0] > left[0]
        return cls(float(low), float(high), choice, domain, _extensions(left, right, slope, domain) if extend else ())

    def is_drawn(self, x: np.ndarray) -> np.ndarray:
        """True for positions in the range that the horizon covers; shape (n,) of bool."""
        slack = 1e-9 * (self.right - self.left)
        return np.asarray((x >= self.left - slack) & (x <= self.right + slack))

    def free_vertices(self, mesh: Mesh) -> np.ndarray:
        """The vertices that may move, shape (n,) of bool.

        With "keep", those within the horizon's own width of it, or within half of the way to the section's end if that
        is nearer; none are held between an end and a border that is hardly farther than the mesh spacing.
        """
        free, x = np.ones(len(mesh.vertices), bool), mesh.vertices[:, 0]
        for outwards in (self.left - x, x - self.right):
            room = outwards.max()
            if self.choice == KEEP and room > LEAST_ROOM * self.domain.spacing:
                free &= outwards <= min(self.right - self.left, room / 2)
        return free

    def findings(self, name: str, mesh: Mesh, vertices: np.ndarray, own: float) -> list[Finding]:
        """A finding about the rest, if it moves much farther than the horizon (``own`` metres), or if it was chosen."""
        x, rise = mesh.vertices[:, 0], mesh.vertices[:, 1] - vertices[:, 1]
        outside = np.maximum(self.left - x, x - self.right)
        moved = np.where(outside > 0, np.abs(rise), 0.0)
        swings = moved.max() > max(SWING * own, LEAST * self.domain.sample)
        if outside.max() <= self.domain.spacing or (self.choice == FREE and not swings):
            return []
        farthest = int(np.argmax(moved))
        point, section = mesh.vertices[farthest], self.domain.section
        height = f"{moved[farthest] / section.metres[1]:.3g} {section.z_unit}"
        far = f"by up to {height} {'up' if rise[farthest] > 0 else 'down'}, near {self.domain.where(point)}"
        span = f"horizon {name} spans {(self.right - self.left) / np.ptp(x):.0%} of the section"
        severity, text = ("warning", _advice(span, far)) if self.choice == FREE else ("note", self._note(span, far))
        return [Finding(severity, "beyond", text, name, self.domain.position(point))]

    def _note(self, span: str, far: str) -> str:
        return f"{span}: {CHOSEN[self.choice]} {far}"


def _advice(span: str, far: str) -> Text:
    return Text(
        f"{span}, and to flatten it turns the rest with it, which moves {far}. Draw more of the horizon, or say by ",
        Keyword("beyond"),
        " what happens to the rest: keep leaves it where it is, level and trend extend the horizon",
    )


def _extensions(
    left: np.ndarray, right: np.ndarray, slope: np.ndarray, domain: RestorationDomain
) -> tuple[LineString, ...]:
    """Lines from two ends outwards, parallel to a slope, as far as the rock there reaches."""
    x_min, z_min, x_max, z_max = domain.outline.bounds
    along = np.hypot(x_max - x_min, z_max - z_min) * slope / np.hypot(*slope)
    added: list[LineString] = []
    for end, way in ((left, -along), (right, along)):
        parts = shapely.get_parts(LineString([end, end + way]).intersection(domain.outline))
        added += [part for part in parts if part.length > 0 and part.dwithin(Point(end), 1e-6 * domain.spacing)]
    return tuple(added)
