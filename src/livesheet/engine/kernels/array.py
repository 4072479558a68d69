"""Functions whose result is an array: filtering, sorting, stacking, cutting and folding; matrices."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cmp_to_key
from typing import Any

import numpy as np

from ...formula.nodes import MAX_COLUMNS, MAX_ROWS, ErrorValue, Scalar
from ..values.cells import MOST_CELLS, MOST_LISTED, Cells, Numbers, error_code, too_large
from ..values.coerce import Problem, to_number, to_truth

_MOST_EXACT = 100
"""Rows of a matrix whose determinant is found in whole numbers: their time grows with the cube, a second for 150."""


def _square(matrix: Numbers) -> None:
    if matrix.shape[0] != matrix.shape[1]:
        raise Problem("#VALUE!")


def product(left: Numbers, right: Numbers) -> Numbers:
    """MMULT."""
    if left.shape[1] != right.shape[0]:
        raise Problem("#VALUE!")
    if left.shape[0] * right.shape[1] > MOST_CELLS:
        raise too_large(left.shape[0], right.shape[1])
    return np.asarray(left @ right, np.float64)


def inverse(matrix: Numbers) -> Numbers:
    """MINVERSE: #NUM! of a singular matrix."""
    _square(matrix)
    found = np.linalg.inv(matrix)
    if not np.all(np.isfinite(found)):
        raise Problem("#NUM!")
    return np.asarray(found, np.float64)


def determinant(matrix: Numbers) -> float:
    """MDETERM: exact for matrices of small whole numbers, else by elimination."""
    _square(matrix)
    found = float(np.linalg.det(matrix))
    small = len(matrix) <= _MOST_EXACT
    if small and np.all(matrix == np.rint(matrix)) and abs(found) < 2.0**50 and np.abs(matrix).max() < 2.0**40:
        return float(_whole_determinant([[int(item) for item in row] for row in matrix.tolist()]))
    return found


def _whole_determinant(rows: list[list[int]]) -> int:
    """Bareiss' elimination without fractions."""
    sign, before, n = 1, 1, len(rows)
    for k in range(n - 1):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        if pivot is None:
            return 0
        if pivot != k:
            rows[k], rows[pivot] = rows[pivot], rows[k]
            sign = -sign
        for i in range(k + 1, n):
            for j in range(k + 1, n):
                rows[i][j] = (rows[i][j] * rows[k][k] - rows[i][k] * rows[k][j]) // before
        before = rows[k][k]
    return sign * rows[-1][-1]


def unit(size: float) -> Numbers:
    """MUNIT."""
    n = math.trunc(size)
    if not 1 <= n <= 4096:
        raise Problem("#VALUE!")
    return np.eye(n)


Grid = list[list[Scalar]]
NA = ErrorValue("#N/A")


def _need_room(height: int, width: int) -> None:
    """Raise UnsupportedError for an array that would take too much memory."""
    if height * width > MOST_LISTED:
        raise too_large(height, width)


def _turned(grid: Grid) -> Grid:
    return [list(column) for column in zip(*grid, strict=True)]


def _not_empty(grid: Grid) -> Grid:
    if not grid or not grid[0]:
        raise Problem("#CALC!")
    return grid


def filtered(grid: Grid, include: Grid, otherwise: Scalar = ErrorValue("#CALC!")) -> Grid:  # noqa: B008 - immutable
    """FILTER: the rows (or columns) whose mark is true."""
    if len(include[0]) == 1 and len(include) == len(grid):
        marks = [to_truth(row[0]) for row in include]
        found = [row for row, mark in zip(grid, marks, strict=True) if mark]
    elif len(include) == 1 and len(include[0]) == len(grid[0]):
        marks = [to_truth(value) for value in include[0]]
        found = [[value for value, mark in zip(row, marks, strict=True) if mark] for row in grid] if any(marks) else []
    else:
        raise Problem("#VALUE!")
    return found or [[otherwise]]


def _kind(value: Scalar) -> int:
    """Numbers come before texts, these before truth values, then errors; blanks are always last."""
    if value is None:
        return 4
    if isinstance(value, ErrorValue):
        return 3
    if isinstance(value, bool):
        return 2
    return 1 if isinstance(value, str) else 0


def compared(a: Scalar, b: Scalar) -> int:
    """-1, 0 or 1 in Excel's order of sorting."""
    first, second = _kind(a), _kind(b)
    if first != second:
        return -1 if first < second else 1
    if first >= 3:
        codes = [error_code(value.code) if isinstance(value, ErrorValue) else 0 for value in (a, b)]
        return int(codes[0] > codes[1]) - int(codes[0] < codes[1])
    left: Any = a.casefold() if isinstance(a, str) else a
    right: Any = b.casefold() if isinstance(b, str) else b
    return int(left > right) - int(left < right)


def _sorted_places(keys: list[tuple[list[Scalar], int]]) -> list[int]:
    """The order of places by several keys, each with its direction; equal ones stay as they are."""

    def order(i: int, j: int) -> int:
        for key, direction in keys:
            found = compared(key[i], key[j])
            if found:
                blank = key[i] is None or key[j] is None
                return found if blank else found * direction
        return 0

    return sorted(range(len(keys[0][0])), key=cmp_to_key(order))


def _direction(value: Scalar) -> int:
    number = 1.0 if value is None else to_number(value)
    if number not in (1, -1):
        raise Problem("#VALUE!")
    return int(number)


def sorted_(
    grid: Grid, index: list[Scalar] | None = None, order: list[Scalar] | None = None, across: bool = False
) -> Grid:
    """SORT: by one or several columns (or rows)."""
    rows = _turned(grid) if across else grid
    columns = [math.trunc(to_number(1.0 if value is None else value)) for value in index or [1.0]]
    directions = [_direction(value) for value in order or [1.0]]
    if any(not 1 <= column <= len(rows[0]) for column in columns) or len(directions) not in (1, len(columns)):
        raise Problem("#VALUE!")
    directions = directions * len(columns) if len(directions) == 1 else directions
    keys = [([row[c - 1] for row in rows], d) for c, d in zip(columns, directions, strict=True)]
    found = [rows[place] for place in _sorted_places(keys)]
    return _turned(found) if across else found


def sorted_by(grid: Grid, *pairs: Any) -> Grid:
    """SORTBY: by other arrays."""
    keys: list[tuple[list[Scalar], int]] = []
    across = (len(pairs[0]) == 1 and len(pairs[0][0]) == len(grid[0]) and len(grid) != 1) or len(grid) == 1
    for place in range(0, len(pairs), 2):
        by = pairs[place]
        values = [value for row in by for value in row]
        wanted = len(grid[0]) if across else len(grid)
        if len(values) != wanted or 1 not in (len(by), len(by[0])):
            raise Problem("#VALUE!")
        keys.append((values, _direction(pairs[place + 1][0][0] if place + 1 < len(pairs) else None)))
    rows = _turned(grid) if across else grid
    found = [rows[place] for place in _sorted_places(keys)]
    return _turned(found) if across else found


def unique(grid: Grid, across: bool = False, once: bool = False) -> Grid:
    """UNIQUE: rows (or columns) that differ; `once`: those that appear only once."""
    rows = _turned(grid) if across else grid
    groups: dict[Any, list[int]] = {}
    for place, row in enumerate(rows):
        key = tuple((_kind(value), value.casefold() if isinstance(value, str) else value) for value in row)
        groups.setdefault(key, []).append(place)
    found = [rows[places[0]] for places in groups.values() if not once or len(places) == 1]
    found = _not_empty(found)
    return _turned(found) if across else found


def sequence(*sizes: Scalar) -> Grid:
    """SEQUENCE(rows, columns, start, step): what is left out is 1."""
    given = [1.0 if value is None else to_number(value) for value in (*sizes, None, None, None)[:4]]
    height, width, start, step = math.trunc(given[0]), math.trunc(given[1]), given[2], given[3]
    if height < 0 or width < 0 or height > MAX_ROWS or width > MAX_COLUMNS:
        raise Problem("#VALUE!")
    _need_room(height, width)
    if not height or not width:
        raise Problem("#CALC!")
    return [[start + step * (row * width + col) for col in range(width)] for row in range(height)]


# --- shapes ----------------------------------------------------------------------------------------------------------


def _listed(grid: Grid, ignore: float, by_column: bool) -> list[Scalar]:
    which = math.trunc(ignore)
    if which not in range(4):
        raise Problem("#VALUE!")
    values = [value for row in (_turned(grid) if by_column else grid) for value in row]
    kept = [
        value
        for value in values
        if not (which & 1 and value is None) and not (which & 2 and isinstance(value, ErrorValue))
    ]
    if not kept:
        raise Problem("#CALC!")
    return kept


def to_column(grid: Grid, ignore: float = 0.0, by_column: bool = False) -> Grid:
    """TOCOL."""
    return [[value] for value in _listed(grid, ignore, by_column)]


def to_row(grid: Grid, ignore: float = 0.0, by_column: bool = False) -> Grid:
    """TOROW."""
    return [_listed(grid, ignore, by_column)]


def below_each_other(*grids: Grid) -> Grid:
    """VSTACK: narrower arrays are filled with #N/A."""
    width = max(len(grid[0]) for grid in grids)
    _need_room(sum(map(len, grids)), width)
    return [row + [NA] * (width - len(row)) for grid in grids for row in grid]


def beside_each_other(*grids: Grid) -> Grid:
    """HSTACK."""
    return _turned(below_each_other(*(_turned(grid) for grid in grids)))


def _part(length: int, count: float | None, take: bool) -> range:
    """The places that TAKE keeps, or that DROP leaves."""
    if count is None:
        return range(length)
    many = math.trunc(count)
    size = min(abs(many), length)
    if take:
        return range(size) if many >= 0 else range(length - size, length)
    return range(size, length) if many >= 0 else range(length - size)


def _cut(take: bool) -> Callable[..., Grid]:
    def of(grid: Grid, rows: Scalar = None, cols: Scalar = None) -> Grid:
        counts = [None if value is None else to_number(value) for value in (rows, cols)]
        down, right = _part(len(grid), counts[0], take), _part(len(grid[0]), counts[1], take)
        return _not_empty([[grid[i][j] for j in right] for i in down])

    return of


def _picked(length: int, lists: tuple[list[Scalar], ...]) -> list[int]:
    places = []
    for value in (value for values in lists for value in values):
        place = math.trunc(to_number(value))
        if not 1 <= abs(place) <= length:
            raise Problem("#VALUE!")
        places.append(place - 1 if place > 0 else length + place)
    return places


def choose_rows(grid: Grid, *places: list[Scalar]) -> Grid:
    """CHOOSEROWS: negative numbers count from the end."""
    return [grid[place] for place in _picked(len(grid), places)]


def choose_columns(grid: Grid, *places: list[Scalar]) -> Grid:
    """CHOOSECOLS."""
    columns = _picked(len(grid[0]), places)
    return [[row[place] for place in columns] for row in grid]


def expanded(grid: Grid, rows: Scalar, cols: Scalar = None, pad: Scalar = NA) -> Grid:
    """EXPAND: to a size not smaller than its own."""
    height = len(grid) if rows is None else math.trunc(to_number(rows))
    width = len(grid[0]) if cols is None else math.trunc(to_number(cols))
    if height < len(grid) or width < len(grid[0]):
        raise Problem("#VALUE!")
    _need_room(height, width)
    wide = [row + [pad] * (width - len(row)) for row in grid]
    return wide + [[pad] * width for _ in range(height - len(grid))]


def wrap_rows(values: Grid, count: float, pad: Scalar = NA) -> Grid:
    """WRAPROWS: one line of values in rows of so many."""
    if 1 not in (len(values), len(values[0])):
        raise Problem("#VALUE!")
    width = math.trunc(count)
    if width < 1:
        raise Problem("#NUM!")
    line = [value for row in values for value in row]
    width = min(width, len(line)) if len(line) < width else width
    _need_room(math.ceil(len(line) / width), width)
    rows = [line[start : start + width] for start in range(0, len(line), width)]
    return [row + [pad] * (width - len(row)) for row in rows]


PLAIN: dict[str, Callable[..., Any]] = {
    "FILTER": filtered,
    "SORT": sorted_,
    "SORTBY": sorted_by,
    "UNIQUE": unique,
    "SEQUENCE": sequence,
    "TOCOL": to_column,
    "TOROW": to_row,
    "VSTACK": below_each_other,
    "HSTACK": beside_each_other,
    "TAKE": _cut(True),
    "DROP": _cut(False),
    "CHOOSEROWS": choose_rows,
    "CHOOSECOLS": choose_columns,
    "EXPAND": expanded,
    "WRAPROWS": wrap_rows,
    "WRAPCOLS": lambda values, count, pad=NA: _turned(wrap_rows(values, count, pad)),
    "MMULT": product,
    "MINVERSE": inverse,
    "MDETERM": determinant,
    "MUNIT": unit,
    "TRANSPOSE": lambda table: Cells(table.numbers.T, table.codes.T),
}
