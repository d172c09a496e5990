"""Questions that know their answers, and what wrong answers may come from. Nothing here knows Jupyter."""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from inspect import signature
from typing import Any

import numpy as np

from exercises.units import Quantity, describe, read_quantity

Mistakes = tuple[tuple[Any, str], ...]  # a wrong answer, and the hint for those who give it
DOTS = "Replace the dots by your line of code, and run the cell again."
RELATIVE = 2e-3  # tolerance of the values of a function


class Sealed:
    """A value that is not printed: students see their questions, and should not see the answers with them."""

    __slots__ = ("__value",)

    def __init__(self, value: object):
        self.__value = value

    def open(self) -> Any:
        """The value."""
        return self.__value

    def __repr__(self) -> str:
        return "<sealed>"


@dataclass(frozen=True)
class Feedback:
    """A verdict on an answer, and the reason why it is right, or a hint."""

    right: bool
    text: str

    def __str__(self):
        return f"{'Right' if self.right else 'Not yet'}: {self.text}"


class Question:
    """Fields that all questions seal, and the help that they offer step by step."""

    SECRET = "answer", "why", "mistakes", "hint", "method"

    def __post_init__(self):
        for name in self.SECRET:
            object.__setattr__(self, name, Sealed(getattr(self, name)))

    @property
    def asked(self) -> str:
        """The text of the question."""
        return self.text

    def help(self, step: int) -> tuple[str, str]:
        """Title and text of a step of help: 0 is a hint, 1 the method, 2 the answer."""
        texts = self.hint.open(), self.method.open(), f"{self.solution} {self.why.open()}"
        return ("Hint", "Method", "Answer")[step], texts[step]


@dataclass(frozen=True)
class Number(Question):
    """A question whose answer is a number.

    Parameters
    ----------
    text : str
    answer : float
    unit : {"m", "ms", "°", "%", ""}
    tolerance : float
        How far off an answer may be, in that unit.
    why : str
        Shown with the right answer.
    mistakes : tuple of (float, str)
        Likely wrong answers, and a hint for each.
    hint, method : str
        Help on demand; the method also follows an answer that is merely too large or too small.

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
    method: str

    def __post_init__(self):
        for mistake, _ in self.mistakes:
            if abs(mistake - self.answer) <= 2 * self.tolerance:
                raise ValueError(
                    f"the mistake {mistake:g} cannot be told from the answer {self.answer:g} to within "
                    f"{self.tolerance:g}: ask with other numbers, or leave it out"
                )
        super().__post_init__()

    @property
    def asked(self) -> str:
        """The text of the question, and how exact the answer must be."""
        return f"{self.text} (To within {describe(self.tolerance, self.unit)}.)"

    @property
    def solution(self) -> str:
        """The answer in words."""
        return f"{describe(float(f'{self.answer.open():.3g}'), self.unit)}."

    def check(self, given: float | str) -> Feedback:
        """Feedback on a number, or on the text of one, with any unit of the right kind or without."""
        if given is ...:
            return Feedback(False, DOTS)
        read = read_quantity(given, self.unit)
        return Feedback(False, read) if isinstance(read, str) else self._judge(read)

    def _judge(self, readings: list[Quantity]) -> Feedback:
        answer = self.answer.open()
        for reading in readings:
            if abs(reading.value - answer) <= self.tolerance:
                return Feedback(True, reading.note + self.why.open())
        hits = [
            (abs(reading.value - mistake), reading.note + hint)
            for mistake, hint in self.mistakes.open()
            for reading in readings
            if mistake or abs(reading.value) < self.tolerance / 10  # a small share is not zero
        ]
        if min(hits, default=(math.inf,))[0] <= self.tolerance:
            return Feedback(False, min(hits)[1])
        for reading in readings:
            if abs(reading.value + answer) <= self.tolerance:
                how = "leave it out" if reading.value < 0 else "it is below 0"
                return Feedback(False, f"{reading.note}That is right but for its sign: {how}.")
        nearest = min(readings, key=lambda reading: abs(math.log(abs(reading.value or 1e-9) / (abs(answer) or 1e-9))))
        size = "large" if nearest.value > answer else "small"
        return Feedback(
            False, f"{nearest.note}{describe(nearest.value, self.unit)} is too {size}. {self.method.open()}"
        )


@dataclass(frozen=True)
class Choice(Question):
    """A question whose answer is one of some options.

    Parameters
    ----------
    text, answer, why : str
    mistakes : tuple of (str, str)
        The other options, and a hint for each.
    hint, method : str
        Help on demand.

    Raises
    ------
    ValueError
        If two options are the same.
    """

    text: str
    answer: str
    why: str
    mistakes: Mistakes
    hint: str
    method: str

    def __post_init__(self):
        super().__post_init__()
        if len(set(self.options)) < len(self.options):
            raise ValueError(f"two of the options are the same: {self.options}")

    @property
    def options(self) -> list[str]:
        """All options in alphabetical order, which gives nothing away."""
        return sorted([self.answer.open(), *(option for option, _ in self.mistakes.open())])

    @property
    def solution(self) -> str:
        """The answer in words."""
        return f"{self.answer.open()}."

    def check(self, given: str) -> Feedback:
        """Feedback on one of the options."""
        if given == self.answer.open():
            return Feedback(True, self.why.open())
        hint = dict(self.mistakes.open()).get(given)
        return Feedback(False, hint or f"Choose one of: {'; '.join(self.options)}.")


@dataclass(frozen=True)
class Code(Question):
    """A question whose answer is a function with a line of code to write, which is run to check it.

    Parameters
    ----------
    text : str
    answer : callable
        A function that is right.
    line : str
        Its code, shown as the last step of help.
    cases : tuple of tuples
        Arguments to call it with.
    why : str
    mistakes : tuple of (callable, str)
        Likely wrong functions, and a hint for each.
    hint, method : str
        Help on demand.
    """

    text: str
    answer: Callable[..., Any]
    line: str
    cases: tuple[tuple, ...]
    why: str
    mistakes: Mistakes
    hint: str
    method: str

    SECRET = *Question.SECRET, "line"

    @property
    def solution(self) -> str:
        """The answer in words."""
        return f"{self.line.open()} ."

    def check(self, given: Callable[..., Any]) -> Feedback:
        """Feedback on a function, from what it returns for all cases."""
        if given is ...:
            return Feedback(False, DOTS)
        if not callable(given):
            return Feedback(False, f"Give the function itself, without brackets; this is {_brief(given)}.")
        found = []
        for case in self.cases:
            value = self._call(given, case)
            if isinstance(value, Feedback):
                return value
            found.append(value)
        return self._judge(found)

    def _call(self, given, case):
        """The value of a function for a case, or feedback on why there is none."""
        called = f"{getattr(given, '__name__', 'the function')}({', '.join(_brief(part) for part in case)})"
        right = np.asarray(self.answer.open()(*case), dtype=float)
        try:
            value = given(*case)
        except Exception as error:  # noqa: BLE001 - whatever a student's line may raise
            return Feedback(False, f"{called} raised {type(error).__name__}: {error}. {_remedy(error, given, case)}")
        if value is ...:
            return Feedback(False, DOTS)
        if value is None:
            return Feedback(False, f"{called} returns nothing; begin the line with return.")
        try:
            value = np.asarray(value, dtype=float)
        except (TypeError, ValueError):
            return Feedback(False, f"{called} returns {_brief(value)}, which is not a number.")
        if value.shape != right.shape:
            wanted = f"{right.size} numbers are" if right.ndim else "one number is"
            return Feedback(False, f"{called} returns an array of shape {value.shape}, but {wanted} wanted.")
        if not np.isfinite(value).all():
            return Feedback(False, f"{called} returns {_brief(value)}. Is something divided by zero?")
        return value

    def _judge(self, found):
        if self._agrees(found, self.answer.open()):
            return Feedback(True, self.why.open())
        for mistake, hint in self.mistakes.open():
            if self._agrees(found, mistake):
                return Feedback(False, hint)
        right = [self.answer.open()(*case) for case in self.cases]
        for factor, reason in FACTORS.items():
            if all(_close(factor * value, wanted) for value, wanted in zip(found, right, strict=True)):
                return Feedback(False, f"Right but for a factor, the same in all cases: {reason}.")
        good = sum(_close(value, wanted) for value, wanted in zip(found, right, strict=True))
        called = f"{len(found)} case{'s' if len(found) > 1 else ''}"
        return Feedback(False, f"It runs, but is right in {good or 'none'} of {called}. {self.method.open()}")

    def _agrees(self, found, function):
        return all(_close(value, function(*case)) for value, case in zip(found, self.cases, strict=True))


FACTORS = {
    -1.0: "its sign is the opposite",
    100.0: "a share is returned where percent are wanted",
    0.01: "percent are returned where a share is wanted",
    180 / math.pi: "radians are returned where degrees are wanted",
    math.pi / 180: "degrees are returned where radians are wanted",
    1000.0: "it is 1000 times too small; look at the units",
    0.001: "it is 1000 times too large; look at the units",
}


def _close(value, wanted):
    return np.shape(value) == np.shape(wanted) and np.allclose(value, wanted, rtol=RELATIVE, atol=1e-9)


def _brief(value):
    text = re.sub(r"\s+", " ", f"{value:g}" if isinstance(value, float) else str(value))
    return text if len(text) <= 60 else f"{text[:57]}..."


def _remedy(error, given, case):
    if isinstance(error, NameError):
        return "Is that name spelt as in the first line, and has its module been imported?"
    if isinstance(error, TypeError) and len(signature(given).parameters) != len(case):
        return f"It must take {len(case)} argument{'s' if len(case) > 1 else ''}; leave the first line as it was."
    return "Try the line on its own in a new cell."
