"""The lines of what can be said: each with a symbol, a value, its unit, where it occurs, and words."""

from __future__ import annotations

from livesheet.formula.nodes import CellRef, Node
from livesheet.workbook import Area, Content, Style
from mechsheet.sheet import styles
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.checks.extremes import Extremes
from mechsheet.sheet.first.blocks import Writer
from mechsheet.sheet.first.other_sheets import are_there
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import MEANING, TOLERANCE, UNIT, VALUE
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.table.positions import places
from mechsheet.units import behind_number

MARKS = {styles.BAD: "●", styles.WARN: "▲"}
"""Beside what is red, and what is amber: in print without colours, too."""


class VerdictLines:
    """The lines, by key; `levels`: the tests that make the words of each red or amber, with their marks."""

    def __init__(self, writer: Writer, checks: Checks, extremes: Extremes) -> None:
        self.writer = writer
        self.plan, self.found = writer.plan, writer.plan.searched
        self.checks = checks
        self.extremes = extremes
        self.rows = writer.plan.blocks["verdicts"].rows
        self.driver = writer.plan.mechanism.driver
        self.turning = self.driver.unit.kind == "angle"
        self.unit = behind_number(self.driver.unit.text)
        self.levels: dict[str, list[tuple[Node, str]]] = {}

    def there(self, key: str) -> Node:
        """Whether a sheet that can be deleted is there, and what it needs."""
        return there(are_there(self.plan, [key]))

    def says_itself(self, key: str, *cols: int) -> None:
        """Some cells of a line are written to say what is left without another sheet."""
        self.writer.says_itself |= {(self.rows[key], col) for col in cols}

    # --- small things -----------------------------------------------------------------------------------------

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook."""
        return self.plan.text(f"verdict.{key}", **parts)

    def line(
        self, key: str, symbol: Content, unit: str | Node, value: Node, digits: int | Style, words: Node
    ) -> CellRef:
        """One line; the cell of its value, which has so many decimals or a style of its own. A unit that is a formula is
        the number of rows that the value is of."""
        row = self.rows[key]
        self.writer.line(row, symbol, unit if isinstance(unit, str) else None, None)
        if not isinstance(unit, str):
            self.writer.formula(row, UNIT, unit, styles.numbered(styles.UNIT, '"/ "0'))
        style = styles.decimals(styles.RESULT, digits) if isinstance(digits, int) else digits
        self.writer.formula(row, VALUE, value, style)
        self.writer.formula(row, MEANING, words, styles.LABEL_SAID)
        return self.value(key)

    def where_it_closes(self, words: Node | str) -> Node:
        """Words about rows: nothing where no row closes."""
        return formula('IF(closed=0,"",words)', closed=self.value("rows_closed"), words=words)

    @property
    def of_rows(self) -> Node:
        """The cell with the number of rows of the table."""
        return self.plan.places.rows.cell

    def value(self, key: str) -> CellRef:
        """The cell of a line's value."""
        return CellRef(self.rows[key], VALUE, True, True)

    def words(self, key: str) -> CellRef:
        """The cell of a line's words."""
        return CellRef(self.rows[key], MEANING, True, True)

    def at(self, key: str, place: Node) -> None:
        """Where it occurs: a value of the driver."""
        self.writer.formula(self.rows[key], TOLERANCE, place, styles.decimals(styles.RESULT, self.driver_places()))

    def colour(self, key: str, test: str, style: Style, **holes: Node | float | str) -> None:
        """The words' colour where a test of this sheet's own cells holds: other programs refuse another's cells."""
        row = self.rows[key]
        area = Area(row, MEANING, row, MEANING)
        self.levels.setdefault(key, []).append((formula(test, **holes), MARKS.get(style, "")))
        self.writer.colour(area, formula(test, **holes), style)

    def driver_text(self, value: Node) -> Node:
        """A value of the driver in words: 48.3°."""
        return joined(formula("ROUND(value,2)", value=value), self.unit)

    def driver_places(self) -> int:
        """Decimals of a value of the driver."""
        return places(self.plan, "angle" if self.turning else "length")
