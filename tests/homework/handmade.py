"""Workbooks as students make them, written by openpyxl: layouts, names, anchors, and a plain exporter of descriptions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import openpyxl
from openpyxl.utils import get_column_letter
from openpyxl.workbook.defined_name import DefinedName


@dataclass
class Table:
    """A table by hand. Formulas name dimensions and earlier columns in braces: `{a2}*COS({fi})`.

    given    (label, name, value or formula) of the cells above the table
    columns  (heading, name, formula); the first is the driver, its formula a list of values
    """

    given: Sequence[tuple[str, str, float | str]]
    columns: Sequence[tuple[str, str, str | list[float]]]
    across: bool = False
    two_sheets: bool = False
    names: bool = False
    headings: bool = True
    labels: bool = True
    cells: Mapping[str, object] = field(default_factory=dict)

    def save(self, path: Path) -> Path:
        book = openpyxl.Workbook()
        sheet = book.active
        sheet.title = "Veri" if self.two_sheets else "Sayfa1"
        table = book.create_sheet("Tablo") if self.two_sheets else sheet
        where: dict[str, str] = {}
        for row, (label, name, value) in enumerate(self.given, 2):
            if self.labels:
                sheet.cell(row, 1, label)
            anchored = f"$B${row}"
            sheet.cell(row, 2, self._filled(value, where, 0) if isinstance(value, str) else value)
            if self.names:
                safe = name if not re.fullmatch(r"[a-z]{1,3}\d+", name) else f"{name}_"
                book.defined_names[safe] = DefinedName(safe, attr_text=f"{sheet.title}!{anchored}")
                where[name] = safe
            else:
                where[name] = f"{sheet.title}!{anchored}" if self.two_sheets else anchored
        top = 4 if self.two_sheets else len(self.given) + 5
        places = {name: column for column, (_, name, _) in enumerate(self.columns, 1)}
        rows = len(self.columns[0][2])
        for heading, name, formula in self.columns:
            line = places[name]
            if self.headings:
                self._at(table, top - 1, line, heading)
            for row in range(rows):
                here = dict(where) | {other: self._address(top + row, col) for other, col in places.items()}
                here |= {f"{other}-": self._address(top + row - 1, col) for other, col in places.items()}
                here["#"] = str(top + row)
                value = formula[row] if isinstance(formula, list) else self._filled(formula, here, row)
                self._at(table, top + row, line, value)
        for cell, value in self.cells.items():
            table[cell] = value
        book.save(path)
        return path

    def _address(self, pos: int, line: int) -> str:
        # tables to the right stand in rows below the given cells
        if self.across:
            return f"{get_column_letter(pos)}{line + 20}"
        return f"{get_column_letter(line)}{pos}"

    def _at(self, sheet, pos: int, line: int, value: object) -> None:
        sheet[self._address(pos, line)] = value

    @staticmethod
    def _filled(formula: str, where: Mapping[str, str], row: int) -> str:
        return "=" + re.sub(r"\{([^}]+)\}", lambda match: where[match[1]], formula)


FOUR_BAR = (("a1", "a1", 100.0), ("a2", "a2", 35.0), ("a3", "a3", 70.0), ("a4", "a4", 80.0))
STEPS = [15.0 * n for n in range(25)]


def four_bar(**changes: str) -> list[tuple[str, str, str | list[float]]]:
    """The four-bar by the diagonal and two angles; `changes` are formulas in place of some columns'."""
    columns = {
        "deg": ("Krank açısı (derece)", STEPS),
        "fi": ("fi", "RADIANS({deg})"),
        "xA": ("xA", "{a2}*COS({fi})"),
        "yA": ("yA", "{a2}*SIN({fi})"),
        "s": ("s", "SQRT(({a1}-{xA})^2+{yA}^2)"),
        "b": ("beta", "ATAN2({a1}-{xA},-{yA})"),
        "g": ("gama", "ACOS(({a3}^2+{s}^2-{a4}^2)/(2*{a3}*{s}))"),
        "t13": ("theta13", "{b}+{g}"),
        "xB": ("xB", "{xA}+{a3}*COS({t13})"),
        "yB": ("yB", "{yA}+{a3}*SIN({t13})"),
        "t14": ("Teta14 (rad)", "ATAN2({xB}-{a1},{yB})"),
        "mu": ("mu", "DEGREES({t14}-{t13})"),
    }
    return [(heading, name, changes.get(name, formula)) for name, (heading, formula) in columns.items()]
