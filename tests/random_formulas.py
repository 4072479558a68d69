"""Random formulas over random cells: trees of operators and functions whose arguments are mostly of the right kind."""

import random

from livesheet.formula.functions import FUNCTIONS
from livesheet.formula.nodes import ErrorValue

ROWS, COLUMNS = 8, 8
_LETTERS = "ABCDEFGH"

UNTRIED = {
    "ANCHORARRAY", "AREAS", "CELL", "COLUMN", "ROW", "FORMULATEXT", "HYPERLINK", "INDIRECT", "INFO", "ISFORMULA", "ISREF",
    "OFFSET", "SHEET", "SHEETS", "SINGLE", "ENCODEURL", "DGET", "CUMIPMT", "CUMPRINC", "VALUETOTEXT", "ARRAYTOTEXT",
}  # fmt: skip
"""Functions of references and surroundings, which have tests of their own, and some that no other program has."""

NAMES = sorted(
    name for name, row in FUNCTIONS.items() if not row.volatile and "f" not in row.kinds and name not in UNTRIED
)
_NUMBERS = ("0", "1", "2", "3", "-1", "0.5", "10", "1.5", "-2.5", "100", "7", "12", "0.1", "40000", "1E-3")
_TEXTS = (
    '"a"',
    '"abc"',
    '"Hello World"',
    '""',
    '"3"',
    '"x*"',
    '"B"',
    '"1.5"',
    '"TRUE"',
    '" pad  ded "',
    '"0.00"',
    '"1001"',
)
_CRITERIA = ('">2"', '"<=5"', '"a*"', '"<>0"', '"="', "3", '"?b*"', '"<>"', '">=a"', "TRUE", '"=3"')
_OPERATORS = ("+", "-", "*", "/", "^", "&", "=", "<>", "<", "<=", ">", ">=")


def random_cells(chance: random.Random):
    """(row, column, value) of a grid: numbers mostly, texts, truth values, blanks, errors."""
    for row in range(ROWS):
        for col in range(COLUMNS):
            value = _value(chance, col)
            if value is not None:
                yield row, col, value


def _value(chance: random.Random, col: int):
    if col < 3:  # numbers alone
        return float(chance.choice((chance.randint(-20, 50), round(chance.uniform(-5, 90), 2), chance.randint(1, 9))))
    pick = chance.random()
    if pick < 0.45:
        return float(chance.choice((chance.randint(-5, 12), round(chance.uniform(0, 9), 1), 0)))
    if pick < 0.7:
        return chance.choice(("abc", "x", "3", "Hello", "b", "1E2", "-4", "TRUE", "aa bb"))
    if pick < 0.8:
        return chance.random() < 0.5
    return ErrorValue(chance.choice(("#N/A", "#DIV/0!", "#VALUE!"))) if pick < 0.83 else None


class Formulas:
    """Draws formulas as texts."""

    def __init__(self, chance: random.Random) -> None:
        self.chance = chance

    def formula(self) -> str:
        """One formula: a call, or an operator between two."""
        if self.chance.random() < 0.25:
            return f"{self.value(2)}{self.chance.choice(_OPERATORS)}{self.value(2)}"
        return self.call(self.chance.choice(NAMES), 2)

    def cell(self, clean: bool = False) -> str:
        """The name of a cell; `clean`: one that holds a number."""
        return f"{_LETTERS[self.chance.randrange(3 if clean else COLUMNS)]}{self.chance.randint(1, ROWS)}"

    def area(self, clean: bool = False, height: int = 0, width: int = 0) -> str:
        """The name of a range."""
        last = 3 if clean else COLUMNS
        width = width or self.chance.randint(1, 2)
        height = height or self.chance.randint(1, 5)
        col, row = self.chance.randrange(last - width + 1), self.chance.randint(1, ROWS - height + 1)
        return f"{_LETTERS[col]}{row}:{_LETTERS[col + width - 1]}{row + height - 1}"

    def call(self, name: str, depth: int) -> str:
        """A call with arguments of the function's kinds."""
        row = FUNCTIONS[name]
        most = min(row.most, row.least + (4 if row.repeated else 2))
        count = self.chance.randint(row.least, max(row.least, most))
        if row.repeated == 2 and name not in ("SWITCH", "SORTBY"):
            count = row.least + 2 * self.chance.randint(0, 1)
        same = self.chance.randint(2, 4), self.chance.randint(1, 2)
        return f"{name}({','.join(self.argument(kind, depth, same) for kind in row.kinds_of(count))})"

    def argument(self, kind: str, depth: int, size: tuple[int, int]) -> str:
        """An argument; ranges of one call have the same size."""
        if kind in "rgl":
            return self.area(self.chance.random() < 0.6, *size)
        if kind == "v":
            return self.area(self.chance.random() < 0.7) if self.chance.random() < 0.7 else self.number(depth - 1)
        if kind == "m":
            return self.area(True, size[0], size[0] if size[0] < 4 else 1)
        if kind == "q":
            return self.chance.choice(_CRITERIA)
        if kind == "t":
            return self.text(depth - 1)
        if kind == "b":
            return self.chance.choice(("TRUE", "FALSE", "TRUE", "FALSE", self.number(0)))
        if kind == "d":
            return self.chance.choice(("40000", "43831.75", "36526", "45000", self.number(depth - 1)))
        return self.value(depth - 1) if kind in "ae" else self.number(depth - 1)

    def value(self, depth: int) -> str:
        """Any single value."""
        return self.chance.choice((self.number, self.number, self.text, self.any_cell))(depth)

    def any_cell(self, depth: int) -> str:
        """Any cell."""
        del depth
        return self.cell()

    def number(self, depth: int) -> str:
        """Mostly a number."""
        pick = self.chance.random()
        if depth > 0 and pick < 0.35:
            return self.call(self.chance.choice(_NUMERIC), depth)
        if depth > 0 and pick < 0.5:
            return f"({self.number(depth - 1)}{self.chance.choice('+-*/')}{self.number(depth - 1)})"
        return self.chance.choice(_NUMBERS) if pick < 0.8 else self.cell(pick < 0.93)

    def text(self, depth: int) -> str:
        """Mostly a text."""
        pick = self.chance.random()
        if depth > 0 and pick < 0.2:
            return self.call(self.chance.choice(_TEXTUAL), depth)
        return self.chance.choice(_TEXTS) if pick < 0.8 else self.cell()


_NUMERIC = (
    "ABS",
    "SQRT",
    "ROUND",
    "SUM",
    "MAX",
    "MIN",
    "INT",
    "MOD",
    "LEN",
    "COUNT",
    "AVERAGE",
    "SIGN",
    "N",
    "FACT",
    "EXP",
)
_TEXTUAL = ("LEFT", "UPPER", "TRIM", "CONCATENATE", "REPT", "MID", "SUBSTITUTE", "PROPER", "T")
