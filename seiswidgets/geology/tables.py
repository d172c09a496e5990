"""Tables of measured values, with a unit for each column."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any, TypeAlias

Value: TypeAlias = Any  # a string, a number, or None where there is none


@dataclass(frozen=True)
class Table:
    """Rows of values, printed as text and as HTML; `save_table` writes them.

    Parameters
    ----------
    title : str
    units : dict of str to str
        The unit of each column by its name: "m", "1" for a number without, "" for text.
    rows : tuple of tuples
        A value for each column: a string, a number, or None where there is none.
    """

    title: str
    units: Mapping[str, str]
    rows: tuple[tuple[Value, ...], ...]

    @property
    def headings(self) -> list[str]:
        """Name and unit of each column."""
        return [f"{name} ({unit})" if unit not in ("", "1") else name for name, unit in self.units.items()]

    def column(self, name: str) -> list[Value]:
        """The values of a column."""
        return [row[list(self.units).index(name)] for row in self.rows]

    def __iter__(self) -> Iterator[dict[str, Value]]:
        return (dict(zip(self.units, row, strict=True)) for row in self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __str__(self) -> str:
        lines = [self.headings, *(list(map(_text, row)) for row in self.rows)]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        texts = ["  ".join(f"{cell:<{width}}" for cell, width in zip(line, widths, strict=True)) for line in lines]
        return "\n".join([self.title, *(text.rstrip() for text in texts)])

    def _repr_html_(self) -> str:
        return self.html()

    def html(self, pictures: Sequence[str] = ()) -> str:
        """HTML of the table, with a picture, as SVG, at the end of each row if there are any."""
        head = "".join(f'<th scope="col">{escape(heading)}</th>' for heading in self.headings)
        ends = [f"<td>{picture}</td>" for picture in pictures] or len(self) * [""]
        rows = zip(self.rows, ends, strict=True)
        body = "".join(f"<tr>{''.join(map(_cell, row))}{end}</tr>" for row, end in rows)
        return f"<table><caption>{escape(self.title)}</caption><tr>{head}</tr>{body}</table>"


def _cell(value: Value) -> str:
    side = "left" if isinstance(value, str) else "right"
    return f'<td style="text-align: {side}; padding: 1px 8px">{escape(_text(value))}</td>'


def _text(value: Value) -> str:
    return "" if value is None else value if isinstance(value, str) else f"{value:.4g}"
