"""A question knows its answer, and what a wrong answer may come from. Nothing here knows Jupyter."""

import math
import re
from dataclasses import dataclass

Mistakes = tuple[tuple[float | str, str], ...]  # a wrong answer, and the hint that helps who gave it

# What may be written behind a number in a question's unit, and how much of that unit it is.
WRITTEN = {
    "m": {**dict.fromkeys(("", "m", "metre", "metres", "meter", "meters"), 1.0), "km": 1e3, "cm": 0.01, "ft": 0.3048},
    "%": dict.fromkeys(("", "%", "percent"), 1.0),
    "°": dict.fromkeys(("", "°", "deg", "degree", "degrees"), 1.0),
    "": dict.fromkeys(("", "x", "×", "times"), 1.0),
}
SIGNS = str.maketrans("−–‐‑－,", "-----.")  # what looks like a minus, and a decimal comma
NUMBER = re.compile(r"[~≈=]?([-+]?[\d.]+(?:e[-+]?\d+)?)(?:/([\d.]+))?(\D*)")


@dataclass(frozen=True)
class Feedback:
    """Whether an answer is right, and why; or what to think of instead."""

    right: bool
    text: str

    def __str__(self):
        return f"{'Right' if self.right else 'Not yet'}: {self.text}"


@dataclass(frozen=True)
class Number:
    """A question whose answer is a number.

    Parameters
    ----------
    text : str
        What is asked.
    answer : float
    unit : str
        Of the answer; "" if it has none.
    tolerance : float
        How far off an answer may be, in that unit.
    why : str
        Shown with the right answer.
    mistakes : tuple of (float, str)
        What a student may well come to instead, and a hint for each.
    hint : str
        For all other answers.

    Raises
    ------
    ValueError
        If a mistake cannot be told from the answer within the tolerance.
    """

    text: str
    answer: float
    unit: str
    tolerance: float
    why: str
    mistakes: Mistakes
    hint: str

    def __post_init__(self):
        for mistake, _ in self.mistakes:
            if abs(mistake - self.answer) <= 2 * self.tolerance:
                raise ValueError(
                    f"the mistake {mistake:g} cannot be told from the answer {self.answer:g} to within "
                    f"{self.tolerance:g}: ask with other numbers, or leave it out"
                )

    @property
    def asked(self) -> str:
        """What is asked, and how exactly."""
        return f"{self.text} (To within {self.tolerance:g}{self._unit}.)"

    @property
    def _unit(self):
        return self.unit if self.unit in ("", "°") else f" {self.unit}"

    def check(self, given: float | str) -> Feedback:
        """Feedback on a number, or on a text of one, with its unit, another that means the same, or none."""
        value = self._read(given)
        if value is None:
            unit, text = f", in {self.unit}" if self.unit else "", str(given).strip()
            start = f"{text!r} is no number. Give one" if text else "Give a number"
            return Feedback(False, f"{start}{unit}, such as 12.5.")
        if abs(value - self.answer) <= self.tolerance:
            return Feedback(True, self.why)
        return Feedback(False, self._advice(value))

    def _advice(self, value):
        """What to think of instead of a wrong value."""
        if abs(value + self.answer) <= self.tolerance:
            return f"That is right but for its sign: {'leave it out' if value < 0 else 'it is below 0'}."
        if self.unit == "%" and 0 < value < 1:
            return f"{value:g} % is very little. If you mean a share, it is {100 * value:g} %."
        nearest, hint = min(self.mistakes, key=lambda mistake: abs(mistake[0] - value))
        if abs(value - nearest) <= self.tolerance:
            return hint
        return f"{value:g}{self._unit} is too {'large' if value > self.answer else 'small'}. {self.hint}"

    def _read(self, given):
        """A text's number in the question's unit, or None."""
        found = NUMBER.fullmatch(re.sub(r"\s", "", str(given)).lower().translate(SIGNS))
        if not found:
            return None
        number, divisor, unit = found.groups()
        try:
            value = float(number) / float(divisor or 1) * WRITTEN[self.unit][unit]
        except (ValueError, ZeroDivisionError, KeyError):
            return None
        return value if math.isfinite(value) else None


@dataclass(frozen=True)
class Choice:
    """A question whose answer is one of some options.

    Parameters
    ----------
    text, answer, why : str
    mistakes : tuple of (str, str)
        The other options, and a hint for each.

    Raises
    ------
    ValueError
        If two options are the same.
    """

    text: str
    answer: str
    why: str
    mistakes: Mistakes

    def __post_init__(self):
        if len(set(self.options)) <= len(self.mistakes):
            raise ValueError(f"two of the options are the same: {self.options}")

    @property
    def asked(self) -> str:
        """What is asked."""
        return self.text

    @property
    def options(self) -> list[str]:
        """All options, in the order of the alphabet, which gives nothing away."""
        return sorted([self.answer, *(option for option, _ in self.mistakes)])

    def check(self, given: str) -> Feedback:
        """Feedback on one of the options."""
        if given == self.answer:
            return Feedback(True, self.why)
        hint = dict(self.mistakes).get(given)
        return Feedback(False, hint or f"Choose one of: {'; '.join(self.options)}.")
