"""Picks written for other programs, at their positions on the map: OpendTect, and Petrel's points with attributes."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError, Keyword, SettingError
from seiswidgets.geology.picks import FAULT, HORIZON, Horizon, Interpretation
from seiswidgets.geology.section import Section
from seiswidgets.io.picks.map_points import Along, line_coordinates

BEYOND = 0.01  # of the line's length: distance beyond its ends that is extrapolated


@dataclass(frozen=True, eq=False)
class ExportRoute:
    """A section on the map: how positions along it become X and Y, and the name of its seismic line."""

    path: Path
    section: Section
    along: Along | None
    line: str

    def on_map(self, x: np.ndarray) -> np.ndarray:
        """X and Y of positions along the section, shape (n, 2)."""
        along = self.along
        if isinstance(along, str) and along in ("x", "y"):
            return np.column_stack([x, np.zeros(len(x))][:: 1 if along == "x" else -1])
        if along is None or isinstance(along, str) or callable(along):
            raise SettingError(
                f"{self.path} needs positions on a map; give ",
                Keyword("along"),
                ": 'x' or 'y', if the section runs along that axis, or the line's own map coordinates [(X, Y), ...]",
            )
        return self._on_line(x - self.section.x0, line_coordinates(along))

    def _on_line(self, distance: np.ndarray, points: np.ndarray) -> np.ndarray:
        steps = np.diff(points, axis=0)
        lengths = np.hypot(*steps.T)
        starts = np.concatenate([[0], np.cumsum(lengths)])
        if distance.min() < -BEYOND * starts[-1] or distance.max() > (1 + BEYOND) * starts[-1]:
            raise DataError(
                f"{self.path}: picks reach from {distance.min():g} to {distance.max():g} along the line given as ",
                Keyword("along"),
                f", which is {starts[-1]:g} long; check that it is the section's line, in the section's unit of x",
            )
        index = np.clip(np.searchsorted(starts, distance, "right") - 1, 0, len(lengths) - 1)
        share = (distance - starts[index]) / lengths[index]
        return np.asarray(points[index] + share[:, None] * steps[index])


def opendtect_horizons(interpretation: Interpretation, route: ExportRoute) -> str:
    """2-D horizons: one row for each trace, with the trace's number counted from 1."""
    _require(interpretation.horizons, HORIZON, route)
    unit = route.section.z_unit
    names = ("Horizon Name", "Line Name", "X", "Y", "Trace Nr", "ShotPoint Nr", f"Z ({unit})")
    header = [*(f"# {count}: {name}" for count, name in enumerate(names, 1)), "#-------------------"]
    rows = (row for horizon in interpretation.horizons for row in _horizon_rows(horizon, route))
    return "\n".join([*header, *rows]) + "\n"


def _horizon_rows(horizon: Horizon, route: ExportRoute) -> Iterator[str]:
    seen: set[int] = set()
    last = -9
    for traces, z in _sampled_pieces(horizon, route):
        if seen & set(traces.tolist()):
            raise DataError(
                f"{route.path}: horizon {horizon.name!r} has two depths at one trace, which one of OpendTect's cannot "
                "have; write petrel-points or GeoJSON",
                pick=horizon.name,
            )
        seen.update(traces.tolist())
        if abs(traces[0] - last) < 2:  # or the reader could not see where the piece begins
            traces, z = traces[::-1], z[::-1]
        last = int(traces[-1])
        names = f'"{_clean(horizon.name)}"\t"{_clean(route.line)}"'
        for (x, y), trace, depth in zip(route.on_map(route.section.x[traces]), traces + 1, z, strict=True):
            yield f"{names}\t{x:.2f}\t{y:.2f}\t{trace}\t{trace:.2f}\t{depth:.4f}"


def _sampled_pieces(horizon: Horizon, route: ExportRoute) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Indices of traces, and z, of each piece that crosses two traces or more, from left to right."""
    section = route.section
    for piece in sorted(horizon.pieces, key=lambda piece: piece[:, 0].min()):
        points = piece if piece[0, 0] <= piece[-1, 0] else piece[::-1]
        if (np.diff(points[:, 0]) <= 0).any():
            raise DataError(
                f"{route.path}: horizon {horizon.name!r} is overturned near x={points[0, 0]:g}, which a horizon of "
                "OpendTect cannot be; write petrel-points or GeoJSON",
                pick=horizon.name,
            )
        (traces,) = np.nonzero((section.x >= points[0, 0]) & (section.x <= points[-1, 0]))
        if len(traces) > 1:
            yield traces, np.interp(section.x[traces], *points.T)


def opendtect_faults(interpretation: Interpretation, route: ExportRoute) -> str:
    """Fault stick sets: a stick for each fault, with stick and node index and the name of the line."""
    _require(interpretation.faults, FAULT, route)
    rows = []
    for stick, fault in enumerate(interpretation.faults):
        on_map = route.on_map(fault.points[:, 0]).tolist()
        for node, ((x, y), z) in enumerate(zip(on_map, fault.points[:, 1].tolist(), strict=True)):
            rows.append(f'"{_clean(fault.name)}"\t{x!r}\t{y!r}\t{z!r}\t{stick}\t{node}\t{_clean(route.line)}')
    return "\n".join(rows) + "\n"


def petrel_points(interpretation: Interpretation, route: ExportRoute) -> str:
    """Points with attributes: kind, name and piece; Z is negative downwards, as in Petrel."""
    section = route.section
    rows = [
        "# Petrel Points with attributes",
        f"# Unit in X and Y direction: {section.x_unit}",
        f"# Unit in depth: {section.z_unit}",
        *("VERSION 1", "BEGIN HEADER", "X", "Y", "Z", "STRING,Kind", "STRING,Name", "INT,Piece", "END HEADER"),
    ]
    picks: list[tuple[str, str, tuple[np.ndarray, ...]]] = []
    picks += [(FAULT, fault.name, (fault.points,)) for fault in interpretation.faults]
    picks += [(HORIZON, horizon.name, horizon.pieces) for horizon in interpretation.horizons]
    for kind, name, pieces in picks:
        for count, piece in enumerate(pieces, 1):
            for (x, y), z in zip(route.on_map(piece[:, 0]).tolist(), (-piece[:, 1]).tolist(), strict=True):
                rows.append(f'{x!r} {y!r} {z!r} "{kind}" "{_clean(name)}" {count}')
    return "\n".join(rows) + "\n"


def _require(picks: Sequence, kind: str, route: ExportRoute) -> None:
    if not picks:
        raise DataError(f"{route.path}: there is no {kind} to write in this format")


def _clean(name: str) -> str:
    """A name without quotes, tabs and line ends, which these formats cannot hold."""
    return " ".join(name.replace('"', "'").split())
