"""Comparison of an interpretation with another one of the same section: the truth, or a teacher's."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from scipy.optimize import linear_sum_assignment
from shapely import LineString, line_locate_point, points
from shapely import distance as distances

from seiswidgets.errors import PickError
from seiswidgets.geology.cutoffs import throw
from seiswidgets.geology.picks import FAULT, HORIZON, Fault, Horizon, Interpretation
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import checked_kind

SAMPLES = 200  # points along each line that are compared
REACH = 0.05  # of the height of the section: picks farther from a true line do not count as picking it


@dataclass(frozen=True)
class LineScore:
    """The distance of a pick from the one that it should be.

    Attributes
    ----------
    kind : {"fault", "horizon"}
    name : str
        Its name in the truth.
    pick : str or None
        Its name in the interpretation; None if it was not picked.
    error : float
        RMS distance of the pick from the truth, in metres of rock; NaN if it was not picked.
    coverage : float
        Share of the true line's length that was picked.
    """

    kind: str
    name: str
    pick: str | None
    error: float
    coverage: float


@dataclass(frozen=True)
class ThrowScore:
    """The throw of a horizon at a fault, as picked and in truth, in the section's unit of z.

    ``picked`` is None if the interpretation has no such throw.
    """

    fault: str
    horizon: str
    picked: float | None
    true: float

    @property
    def error(self) -> float:
        """Absolute error relative to the true throw; 1 where no throw was picked."""
        return 1.0 if self.picked is None else abs(self.picked - self.true) / max(abs(self.true), 1e-9)


@dataclass(frozen=True)
class PickComparison:
    """An interpretation beside the truth; see `compare_picks`.

    Attributes
    ----------
    lines : tuple of LineScore
        One for each fault and horizon of the truth.
    throws : tuple of ThrowScore
        One for each throw of the truth.
    extra : tuple of str
        Picks that match nothing in the truth.
    z_unit : str
    """

    lines: tuple[LineScore, ...]
    throws: tuple[ThrowScore, ...]
    extra: tuple[str, ...]
    z_unit: str

    def error(self, kind: str) -> float:
        """RMS error of the picked faults or horizons, in metres of rock; NaN if none was picked."""
        errors = [line.error for line in self._of(kind) if line.pick is not None]
        return float(np.sqrt(np.mean(np.square(errors)))) if errors else np.nan

    def coverage(self, kind: str) -> float:
        """Mean share of the true lengths of faults or horizons that was picked."""
        return float(np.mean([line.coverage for line in self._of(kind)] or [1.0]))

    @property
    def throw_error(self) -> float:
        """Mean relative error of the throws; NaN if the truth has none."""
        return float(np.mean([score.error for score in self.throws])) if self.throws else np.nan

    def _of(self, kind: str) -> list[LineScore]:
        return [line for line in self.lines if line.kind == kind]

    def rows(self) -> list[tuple[str, str]]:
        """Labels and texts of the comparison, line by line."""
        rows = [(f"{line.kind} {line.name}", _line_text(line)) for line in self.lines]
        for score in self.throws:
            picked = "not picked" if score.picked is None else f"{score.picked:.4g} {self.z_unit}"
            rows.append(
                (f"throw of {score.horizon} at {score.fault}", f"{picked}; true {score.true:.4g} {self.z_unit}")
            )
        return rows + [("not in the truth", name) for name in self.extra]

    def __str__(self) -> str:
        width = max((len(label) for label, _ in self.rows()), default=0)
        return "\n".join(f"{label:<{width}}  {text}" for label, text in self.rows())

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"


def _line_text(line: LineScore) -> str:
    if line.pick is None:
        return "not picked"
    return f"{line.error:.1f} m off (RMS), {line.coverage:.0%} picked as {line.pick}"


def compare_picks(section: Section, picks: Interpretation, truth: Interpretation) -> PickComparison:
    """Compare an interpretation with the truth, or with a teacher's: distances of picks, and throws.

    Picks are matched by position, not by name: each true fault or horizon with the pick nearest to it, one to one.

    Parameters
    ----------
    section : Section
    picks, truth : Interpretation

    Raises
    ------
    SettingError
        If an argument has the wrong type.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.faulted_fold()
    >>> sw.compare_picks(case.section, case.interpretation, case.interpretation).throw_error
    0.0
    """
    checked_kind(section, Section, "section")
    checked_kind(picks, Interpretation, "picks")
    checked_kind(truth, Interpretation, "truth")
    faults, more_faults = _match(section, FAULT, picks.faults, truth.faults)
    horizons, more_horizons = _match(section, HORIZON, picks.horizons, truth.horizons)
    return PickComparison(
        (*faults, *horizons),
        tuple(_throws(picks, truth, {(line.kind, line.name): line.pick for line in (*faults, *horizons)})),
        (*more_faults, *more_horizons),
        section.z_unit,
    )


def _match(
    section: Section, kind: str, picks: Sequence[Fault | Horizon], truth: Sequence[Fault | Horizon]
) -> tuple[list[LineScore], list[str]]:
    """Scores of the true lines of a kind, and the names of the picks that are left over."""
    reach = REACH * float(np.ptp(section.extent[2:]) * section.metres[1])
    drawn = [_dense_lines(section, pick) for pick in picks]
    true = [_dense_lines(section, pick) for pick in truth]
    errors = np.array([[_error(line, other) for line in drawn] for other in true]).reshape(len(true), len(drawn))
    partner = dict(zip(*linear_sum_assignment(errors), strict=True))
    scores = []
    for row, pick in enumerate(truth):
        if row in partner:
            column = partner[row]
            found = float(errors[row, column]), _coverage(drawn[column], true[row], reach)
            scores.append(LineScore(kind, pick.name, picks[column].name, *found))
        else:
            scores.append(LineScore(kind, pick.name, None, np.nan, 0.0))
    return scores, [pick.name for column, pick in enumerate(picks) if column not in set(partner.values())]


def _dense_lines(section: Section, pick: Fault | Horizon) -> list[np.ndarray]:
    """Points at equal distances along each line of a pick, in metres of rock."""
    pieces = [pick.points] if isinstance(pick, Fault) else pick.pieces
    lines = [LineString(section.to_rock(piece)) for piece in pieces]
    total = sum(line.length for line in lines)
    counts = [max(2, round(SAMPLES * line.length / total)) for line in lines]
    return [
        np.array([line.interpolate(share, normalized=True).coords[0] for share in np.linspace(0, 1, count)])
        for line, count in zip(lines, counts, strict=True)
    ]


def _error(drawn: list[np.ndarray], true: list[np.ndarray]) -> float:
    """RMS distance of the drawn points from the true lines."""
    at = points(np.concatenate(drawn))
    nearest = np.min([distances(at, LineString(line)) for line in true], axis=0)
    return float(np.sqrt(np.mean(nearest**2)))


def _coverage(drawn: list[np.ndarray], true: list[np.ndarray], reach: float) -> float:
    """Share of the true lines' length that lies beside the drawn ones, within reach."""
    pieces = [LineString(line) for line in true]
    covered = [np.zeros(SAMPLES, dtype=bool) for _ in pieces]
    for line in drawn:
        at = points(line)
        index = int(np.argmin([distances(at, piece).mean() for piece in pieces]))
        near = at[distances(at, pieces[index]) <= reach]
        if not len(near):
            continue
        along = line_locate_point(pieces[index], near, normalized=True)
        places = (np.arange(SAMPLES) + 0.5) / SAMPLES
        covered[index] |= (places >= along.min()) & (places <= along.max())
    lengths = [piece.length for piece in pieces]
    return float(np.average([mask.mean() for mask in covered], weights=lengths))


def _throws(picks: Interpretation, truth: Interpretation, names: dict[tuple[str, str], str | None]) -> list[ThrowScore]:
    scores = []
    for fault in truth.faults:
        for horizon in truth.horizons:
            true = _throw(fault, horizon)
            if true is None:
                continue
            own_fault, own_horizon = names[FAULT, fault.name], names[HORIZON, horizon.name]
            picked = None
            if own_fault is not None and own_horizon is not None:
                picked = _throw(picks.fault(own_fault), picks.horizon(own_horizon))
            scores.append(ThrowScore(fault.name, horizon.name, picked, true))
    return scores


def _throw(fault: Fault, horizon: Horizon) -> float | None:
    """The throw, or None where there is none or more than one."""
    try:
        return throw(fault, horizon)
    except PickError:
        return None
