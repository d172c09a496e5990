"""The result of an ensemble: percentiles, spreads, and which input matters."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from html import escape

import numpy as np

from seiswidgets.geology.ensembles.member import Frame, Member, Study
from seiswidgets.geology.ensembles.shares import first_order_shares
from seiswidgets.geology.ensembles.uncertainty import INPUTS
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.measures import SHARES, Label, unit_of
from seiswidgets.geology.tables import Table, Value

PERCENTS = (5.0, 50.0, 95.0)
BAR, NARROW = 120, 0.05  # css pixels of an error bar's axis; share of that which a bar takes at least
LISTED = 5  # reasons why members have no restoration
NUMBER = re.compile(r"-?\d[\d.,]*")


@dataclass(frozen=True, eq=False)
class Ensemble:
    """Many restorations of one section, with the errors of its picks drawn at random.

    Attributes
    ----------
    study : Study
        The hypothesis as drawn, the uncertainty and the seed.
    frame : Frame
        The labels of the results, ``(quantity, about)``, and the positions of depths and area ratios.
    members : tuple of Member
        By index; those that were refused or did not settle have a ``problem``, and no restored lengths and areas.
    """

    study: Study
    frame: Frame
    members: tuple[Member, ...]

    @classmethod
    def of(cls, study: Study, frame: Frame, members: Iterable[Member]) -> "Ensemble":
        """The ensemble of members in any order."""
        return cls(study, frame, tuple(sorted(members, key=lambda member: member.index)))

    @property
    def labels(self) -> tuple[Label, ...]:
        """Quantity of each result, and what it is about: ``("throw", "H1 at F1")``."""
        return self.frame.labels

    @cached_property
    def values(self) -> np.ndarray:
        """The results of all members, NaN where one has none, shape (members, results)."""
        return np.array([member.values for member in self.members]).reshape(len(self.members), len(self.labels))

    @property
    def drawn(self) -> np.ndarray:
        """The results of the hypothesis as drawn, shape (results,)."""
        measures, _ = self.study.reference
        return np.array([measures[label] for label in self.labels])

    def percentiles(self, percents: Sequence[float] = PERCENTS) -> dict[Label, np.ndarray]:
        """Percentiles of each result over the members that have it; NaN if none has."""
        return {label: _percentiles(column, percents) for label, column in zip(self.labels, self.values.T, strict=True)}

    @cached_property
    def shares(self) -> dict[str, np.ndarray]:
        """First-order share of each result's variance by input, by linear regression, each of shape (results,).

        NaN where the members are too few, about 1.5 for each number that is drawn, or the result does not vary.
        """
        uncertainty, perturbation = self.study.uncertainty, self.study.perturbation
        draws = [perturbation.explanatory(member.index) for member in self.members]
        varied = [name for name in INPUTS if getattr(uncertainty, name) and self.members]
        return first_order_shares({name: np.array([draw[name] for draw in draws]) for name in varied}, self.values)

    @cached_property
    def depths(self) -> np.ndarray:
        """Depths of the restored horizons of all members, shape (members, horizons, positions)."""
        shape = len(self.members), len(self.frame.horizons), len(self.frame.x)
        return np.array([member.depths for member in self.members]).reshape(shape)

    @property
    def horizon_mean(self) -> np.ndarray:
        """Mean depth of each restored horizon along ``frame.x``, shape (horizons, positions)."""
        return _mean(self.depths)

    @property
    def horizon_spread(self) -> np.ndarray:
        """Standard deviation of these depths; NaN with fewer than two members."""
        return _spread(self.depths)

    @cached_property
    def ratios(self) -> np.ndarray:
        """Area ratio of all members at ``frame.nodes``, shape (members, nz, nx)."""
        shape = len(self.members), *self.frame.nodes.shape[:2]
        return np.array([member.ratio for member in self.members]).reshape(shape)

    @property
    def ratio_mean(self) -> np.ndarray:
        """Mean area ratio, shape (nz, nx)."""
        return _mean(self.ratios)

    @property
    def ratio_spread(self) -> np.ndarray:
        """Standard deviation of the area ratio, shape (nz, nx)."""
        return _spread(self.ratios)

    @property
    def refused(self) -> tuple[Member, ...]:
        """The members that were refused, or did not settle, each with its ``problem``."""
        return tuple(member for member in self.members if member.problem)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """A finding for each reason why members have no restoration, the most frequent first.

        Reasons that differ in their numbers only, such as a position, are one.
        """
        reasons: dict[str, list[Member]] = {}
        for member in self.refused:
            reasons.setdefault(NUMBER.sub("", member.problem), []).append(member)
        ordered = sorted(reasons.values(), key=len, reverse=True)
        count = len(self.members)
        return tuple(
            Finding(
                "warning", "member", f"{len(alike)} of {count} members, such as {alike[0].index}: {alike[0].problem}"
            )
            for alike in ordered
        )

    @property
    def table(self) -> Table:
        """A row for each result: its unit, its percentiles 5, 50 and 95, and the input that explains most of it."""
        units = {"result": "", "unit": "", **{f"P{percent:g}": "1" for percent in PERCENTS}, "explained most by": ""}
        results = enumerate(self.percentiles().items())
        return Table(self.summary, units, tuple(self._row(index, *result) for index, result in results))

    def _row(self, index: int, label: Label, percentiles: np.ndarray) -> tuple[Value, ...]:
        quantity, about = label
        unit, scale = ("%", 100) if quantity in SHARES else (unit_of(quantity, self.study.drawn.section), 1)
        numbers = (scale * value if np.isfinite(value) else None for value in percentiles.tolist())
        return f"{quantity} {about}".strip(), unit, *numbers, self._main_input(index)

    def _main_input(self, index: int) -> str:
        shares = {name: share[index] for name, share in self.shares.items() if np.isfinite(share[index])}
        if not shares:
            return ""
        name = max(shares, key=lambda name: shares[name])
        return f"{name} {shares[name]:.0%}"

    @property
    def summary(self) -> str:
        """One line: how many members, and how many of them have no restoration."""
        count = len(self.refused)
        without = f"; {count} refused or not settled" if count else ""
        return f"{len(self.members)} members, seed {self.study.seed}{without}"

    def __str__(self) -> str:
        return "\n".join([str(self.table), *(finding.text for finding in self.findings)])

    def _repr_html_(self) -> str:
        notes = "".join(f"<li>{escape(finding.text)}</li>" for finding in self.findings[:LISTED])
        table = self.table.html([error_bar(percentiles) for percentiles in self.percentiles().values()])
        return table + (f"<ul>{notes}</ul>" if notes else "")


def error_bar(percentiles: np.ndarray) -> str:
    """SVG of an error bar, on an axis from 0, or around it where 0 is far; "" if there is no spread."""
    low, middle, high = percentiles.tolist()
    if not high > low:
        return ""
    first, last = min(0.0, low), max(0.0, high)
    if high - low < NARROW * (last - first):
        first, last = middle - 2 * (high - low), middle + 2 * (high - low)
    a, b, c = (BAR * (value - first) / (last - first) for value in (low, middle, high))
    return (
        f'<svg role="img" aria-label="from {low:.3g} to {high:.3g}" width="{BAR + 8}" height="14" fill="currentColor" '
        'stroke="currentColor"><g transform="translate(4,0)">'
        f'<path d="M{a:.1f},7H{c:.1f}M{a:.1f},3v8M{c:.1f},3v8"/><circle cx="{b:.1f}" cy="7" r="3"/></g></svg>'
    )


def _percentiles(values: np.ndarray, percents: Sequence[float]) -> np.ndarray:
    known = values[np.isfinite(values)]
    return np.percentile(known, percents, method="weibull") if len(known) else np.full(len(percents), np.nan)


def _mean(values: np.ndarray) -> np.ndarray:
    """Mean over the first axis without NaN; NaN where there is none."""
    return np.ma.masked_invalid(values).mean(axis=0).filled(np.nan)


def _spread(values: np.ndarray) -> np.ndarray:
    """Standard deviation over the first axis without NaN; NaN where there are fewer than two."""
    return np.ma.masked_invalid(values).std(axis=0, ddof=1).filled(np.nan)
