"""Hypotheses side by side: how well each restores, in one table."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from seiswidgets.errors import PickError, SeiswidgetsError, SettingError
from seiswidgets.geology.correlation import cross_fault_correlation
from seiswidgets.geology.hypothesis import Hypothesis
from seiswidgets.geology.measures import (
    AREA_CHANGE,
    BED_CHANGE,
    DEFORMATION,
    ROTATION,
    SHARES,
    measure_restoration,
)
from seiswidgets.geology.plan import RestorationJob
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.tables import Table
from seiswidgets.geology.validation import checked_kind
from seiswidgets.signatures import strict_keywords

CORRELATION, PROBLEMS, WARNINGS, NAME = "correlation {}", "problems", "warnings", "hypothesis"
MEASURED = (BED_CHANGE, AREA_CHANGE, DEFORMATION, ROTATION)


@dataclass(frozen=True, eq=False)
class Outcome:
    """The restoration of a hypothesis, in numbers.

    Attributes
    ----------
    hypothesis : Hypothesis
    restored : Restoration or None
        None if it was refused.
    values : dict of str to float
        By column: the correlation across each fault, the largest change of a bed's length, of the section's area and of
        the rock's, the largest turn of a block, and the number of problems and warnings.
    problem : str
        The reason why it was refused; "" if it was not.
    """

    hypothesis: Hypothesis
    restored: Restoration | None
    values: dict[str, float]
    problem: str = ""

    @property
    def name(self) -> str:
        """Name of the hypothesis."""
        return self.hypothesis.name

    @property
    def verdict(self) -> str:
        """The verdict on the restoration, or the reason why it was refused."""
        return self.restored.verdict if self.restored is not None else f"refused: {self.problem}"


@dataclass(frozen=True, eq=False)
class Comparison:
    """Outcomes of hypotheses, as a table that can be sorted by each of its columns.

    Attributes
    ----------
    outcomes : tuple of Outcome
    """

    outcomes: tuple[Outcome, ...]

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns that hold numbers."""
        named = dict.fromkeys(column for outcome in self.outcomes for column in outcome.values)
        return tuple(sorted(named, key=lambda column: column in (*MEASURED, PROBLEMS, WARNINGS)))

    def sorted_by(self, column: str, *, descending: bool = False) -> "Comparison":
        """The comparison sorted by a column, or by "hypothesis"; what has no value comes last.

        Changes and turns are sorted by their size, whatever their sign.

        Raises
        ------
        SettingError
            If there is no such column.
        """
        if column == NAME:
            return Comparison(tuple(sorted(self.outcomes, key=lambda one: one.name, reverse=descending)))
        if column not in self.columns:
            raise SettingError(f"there is no column {column!r}; there are {', '.join((NAME, *self.columns))}")
        values = np.array([one.values.get(column, np.nan) for one in self.outcomes])
        keys = (-1 if descending else 1) * (np.abs(values) if column in MEASURED else values)
        order = np.argsort(np.where(np.isnan(keys), np.inf, keys), kind="stable")
        return Comparison(tuple(self.outcomes[index] for index in order))

    @property
    def table(self) -> Table:
        """A row for each hypothesis, with its numbers and its verdict."""
        units = {NAME: "", **{column: _unit(column) for column in self.columns}, "verdict": ""}
        rows = (
            (one.name, *(_rounded(column, one.values.get(column)) for column in self.columns), one.verdict)
            for one in self.outcomes
        )
        return Table("Hypotheses", units, tuple(rows))

    def __str__(self) -> str:
        return str(self.table)

    def _repr_html_(self) -> str:
        return self.table._repr_html_()


@strict_keywords
def compare(hypotheses: Iterable[Hypothesis]) -> Comparison:
    """Restore several hypotheses, and compare how well each restores.

    A good hypothesis correlates across its faults, keeps lengths and areas, and needs little deformation; none of these
    proves it. One that is refused stays in the table, with the reason.

    Parameters
    ----------
    hypotheses : list of Hypothesis
        Such as ``RestorationApp.hypotheses``.

    Raises
    ------
    SettingError
        If there is none, or one is not a Hypothesis.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.planar_fault()
    >>> unfault = sw.Plan((sw.Step("unfault"),), fixed=case.fixed, spacing=150)
    >>> first, second, _ = case.interpretation.horizons
    >>> wrong = sw.Horizon(first.pieces[0], second.pieces[1], name="H1")
    >>> hypotheses = [
    ...     sw.Hypothesis(case.section, case.interpretation, unfault, "right"),
    ...     sw.Hypothesis(case.section, sw.Interpretation(case.interpretation.faults, [wrong]), unfault, "wrong"),
    ... ]
    >>> [outcome.name for outcome in sw.compare(hypotheses).sorted_by("correlation F1", descending=True).outcomes]
    ['right', 'wrong']
    """
    given = list(hypotheses)
    if not given:
        raise SettingError("there is nothing to compare; give at least one hypothesis")
    for one in given:
        checked_kind(one, Hypothesis, "hypotheses")
    return Comparison(tuple(map(outcome_of, given)))


def outcome_of(hypothesis: Hypothesis, restored: Restoration | None = None) -> Outcome:
    """Restore a hypothesis, unless that is done, and measure the result."""
    try:
        if restored is None:
            restored = RestorationJob(hypothesis.section, hypothesis.interpretation, hypothesis.plan).restored()
    except SeiswidgetsError as error:
        return Outcome(hypothesis, None, {}, str(error))
    return Outcome(hypothesis, restored, _values(hypothesis, restored))


def _values(hypothesis: Hypothesis, restored: Restoration) -> dict[str, float]:
    values: dict[str, float] = {}
    for fault in hypothesis.interpretation.faults:
        try:
            values[CORRELATION.format(fault.name)] = cross_fault_correlation(restored, fault)
        except PickError:  # too short, or outside: there is no correlation
            values[CORRELATION.format(fault.name)] = np.nan
    for (quantity, _), value in measure_restoration(restored, hypothesis.interpretation).items():
        if quantity in MEASURED and abs(value) >= abs(values.get(quantity, 0.0)):
            values[quantity] = value
    severities = [finding.severity for finding in restored.findings]
    return {**values, PROBLEMS: severities.count("problem"), WARNINGS: severities.count("warning")}


def heading(column: str) -> str:
    """Heading of a column, with its unit."""
    unit = _unit(column)
    return column if unit == "1" else f"{column} ({unit})"


def shown(column: str, value: float | None) -> str:
    """Text for a value of a column; a dash if there is none."""
    number = _rounded(column, value)
    return "–" if number is None else f"{number:.0f}" if column in (PROBLEMS, WARNINGS) else f"{number:.2f}"


def _unit(column: str) -> str:
    return "%" if column in SHARES else "°" if column == ROTATION else "1"


def _rounded(column: str, value: float | None) -> float | None:
    """A value in the unit of its column, to two decimals; None if there is none."""
    if value is None or np.isnan(value):
        return None
    return round(100 * value if column in SHARES else value, 2) + 0.0  # + 0.0: no "-0.00"
