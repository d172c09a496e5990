"""A table whose headings sort it, and one of whose rows is chosen."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import anywidget
from traitlets import Dict, List, Unicode

from seiswidgets.widgets.assets import asset


@dataclass(frozen=True)
class TableRow:
    """A row of a table.

    Attributes
    ----------
    name : str
        Its first cell, a button.
    cells : tuple of str
    title : str
        Shown when the pointer rests on the row.
    chosen : bool
    dim : bool
        True for a row that is out of date.
    """

    name: str
    cells: tuple[str, ...] = ()
    title: str = ""
    chosen: bool = False
    dim: bool = False


class SortableTable(anywidget.AnyWidget):
    """A table. A click on a heading, or Enter on it, asks to sort by that column; one on a row's name chooses the row.

    Parameters
    ----------
    sort : callable(column)
        Called with the index of a column, 0 for the names.
    choose : callable(name)
        Called with the name of a row.

    Attributes
    ----------
    headings : list of str
    rows : list of dict
        Fields of the `TableRow` s.
    sorted : list
        Index of the column that the rows are sorted by, or -1, and whether they descend.
    """

    _esm = asset("sortable_table.js")
    _css = asset("sortable_table.css")

    headings = List(Unicode()).tag(sync=True)
    rows = List(Dict()).tag(sync=True)
    sorted = List([-1, False]).tag(sync=True)

    def __init__(self, sort: Callable[[int], None], choose: Callable[[str], None]):
        self._sort, self._choose = sort, choose
        super().__init__()
        self.on_msg(self._receive)

    def show(
        self, headings: Sequence[str], rows: Sequence[TableRow], column: int = -1, descending: bool = False
    ) -> None:
        """Show other headings and rows."""
        with self.hold_sync():
            self.headings, self.rows = list(headings), [vars(row) | {"cells": list(row.cells)} for row in rows]
            self.sorted = [column, descending]

    def _receive(self, _: object, content: dict[str, Any], buffers: object) -> None:
        if content["kind"] == "sort":
            self._sort(int(content["column"]))
        else:
            self._choose(str(content["name"]))
