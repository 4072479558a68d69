"""The cells of one sheet of an .xls, read in one pass over its records."""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from itertools import pairwise

from livesheet.diagnostics import Fault
from livesheet.formula.book import Block, BookSheet, Kind
from livesheet.formula.nodes import ErrorValue, Node, Scalar
from livesheet.formula.references import cell_name
from livesheet.said import reason, say

from ..reading.formulas import MOST_CELLS, CellFaults, move_values
from .formulas import COLUMNS, ERRORS, Formulas, Token, UnreadableError, normal
from .records import DamagedError, Reader, Record, records
from .records import Kind as Of

Key = tuple[bytes, bytes]
"""A formula as fill-down leaves it: its tokens in normal form, and the constants of its arrays."""
Area = tuple[int, int, int, int]


class SheetScan:
    """What is gathered of a sheet. `texts`: the shared texts; `end`: where the sheet's records have to be over."""

    def __init__(self, file: str, sheet: BookSheet, texts: list[str], formulas: Formulas) -> None:
        self.sheet, self.texts, self.formulas = sheet, texts, formulas
        self.faults = CellFaults(file, sheet.title, "excel")
        self.columns: dict[int, list[tuple[int, Key]]] = {}
        self.members: list[tuple[int, int, tuple[int, int]]] = []
        self.shared: dict[tuple[int, int], Key] = {}
        self.arrays: list[tuple[Area, bytes, bytes]] = []
        self.last = (0, 0)
        self.master = (0, 0)
        self.filtering = False

    def run(self, stream: bytes, at: int, end: int) -> list[Fault]:
        """Read the sheet; the faults found. Raises DamagedError."""
        for record in records(stream, at, end):
            try:
                self.take(record)
            except struct.error:
                raise DamagedError(say("a record ends in the middle")) from None
        self._give_members()
        self.sheet.blocks.extend(self._blocks())
        self._give_arrays()
        self.sheet.hidden.sort()
        return self.faults.found

    def take(self, record: Record) -> None:
        """One record."""
        match record.kind:
            case Of.FORMULA:
                self.formula(record)
            case Of.NUMBER:
                row, col, _, number = struct.unpack_from("<HHHd", record.data)
                self.number(row, col, number)
            case Of.RK:
                row, col, _, code = struct.unpack_from("<HHHI", record.data)
                self.number(row, col, _short_number(code))
            case Of.MANY_RK:
                self.numbers(record.data)
            case Of.SHARED_LABEL:
                self.shared_label(*struct.unpack_from("<HHHI", record.data))
            case Of.LABEL | Of.RICH_LABEL:
                reader = Reader(record.pieces)
                row, col, _, length = reader.unpack("<HHHH")
                self.constant(row, col, reader.text(length))
            case Of.BOOLEAN:
                row, col, _, code, error = struct.unpack_from("<HHHBB", record.data)
                self.constant(row, col, _error(code) if error else code != 0)
            case Of.STRING:
                reader = Reader(record.pieces)
                self.sheet.cached.put(*self.last, reader.text(reader.unpack("<H")[0]))
            case Of.SHARED_FORMULA:
                self.shared_formula(record.data)
            case Of.ARRAY:
                self.array(record.data)
            case Of.TABLE:
                self.table(record.data)
            case Of.ROW:
                self.row(record.data)
            case Of.FILTER_MODE:
                self.filtering = True

    # --- constants ----------------------------------------------------------------------------------------------------

    def constant(self, row: int, col: int, value: Scalar) -> None:
        """A cell that holds a value."""
        if self.inside(row, col):
            self.sheet.constants.put(row, col, value)

    def inside(self, row: int, col: int) -> bool:
        """Whether there is such a cell; a fault where not."""
        if col >= COLUMNS:
            self.faults.note(say("a cell outside the sheet"), row, col)
            return False
        return True

    def number(self, row: int, col: int, value: float) -> None:
        """A cell that holds a number."""
        if math.isfinite(value):
            self.constant(row, col, value)
        else:
            self.faults.note(say("{value} is no number of a cell", value=value), row, col)

    def numbers(self, data: bytes) -> None:
        """Several cells of a row side by side."""
        row, first = struct.unpack_from("<HH", data)
        for place in range((len(data) - 6) // 6):
            code = struct.unpack_from("<I", data, 6 + 6 * place)[0]
            self.number(row, first + place, _short_number(code))

    def shared_label(self, row: int, col: int, _: int, number: int) -> None:
        """A cell that holds one of the shared texts."""
        if number < len(self.texts):
            self.constant(row, col, self.texts[number])
        else:
            self.faults.note(say("there is no shared text {number}", number=number), row, col)

    def row(self, data: bytes) -> None:
        """What is said of a row: whether it is shown."""
        row, about = struct.unpack_from("<H10xH", data)
        if about & 0x20:
            self.sheet.hide(row, row + 1)

    # --- formulas -----------------------------------------------------------------------------------------------------

    def formula(self, record: Record) -> None:
        """A formula with the value it had."""
        data = record.data
        row, col, _ = struct.unpack_from("<HHH", data)
        size = struct.unpack_from("<H", data, 20)[0]
        code, extra = data[22 : 22 + size], data[22 + size :]
        if not self.inside(row, col):
            return
        self.last = row, col
        value = _stored(data[6:14])
        if value is not None:
            self.sheet.cached.put(row, col, value)
        if code[:1] == bytes([Token.CELL_OF_FORMULA]):
            self.master = struct.unpack_from("<HH", code, 1)
            self.members.append((row, col, self.master))
        elif code[:1] == bytes([Token.TABLE]):
            self.sheet.keep([(row, col, 1, 1)])
        else:
            self.columns.setdefault(col, []).append((row, (self.normal(code, row, col), extra)))

    def normal(self, code: bytes, row: int, col: int) -> bytes:
        """The tokens as fill-down leaves them equal; as they are where they cannot be read, which is told when they are."""
        try:
            return normal(code, row, col)
        except DamagedError:
            return code

    def shared_formula(self, data: bytes) -> None:
        """The formula of many cells, which each of them names by one of them."""
        top, _, left, _, _, size = struct.unpack_from("<HHBBHH", data)
        key = self.normal(data[10 : 10 + size], top, left), data[10 + size :]
        self.shared[(top, left)] = key
        self.shared[self.master] = key

    def array(self, data: bytes) -> None:
        """An array formula over an area."""
        top, bottom, left, right = struct.unpack_from("<HHBB", data)
        size = struct.unpack_from("<H", data, 12)[0]
        code = self.normal(data[14 : 14 + size], top, left)
        self.shared.pop((top, left), None)
        self.arrays.append(((top, left, bottom - top + 1, right - left + 1), code, data[14 + size :]))

    def table(self, data: bytes) -> None:
        """A what-if table: its values stay as they are stored."""
        top, bottom, left, right = struct.unpack_from("<HHBB", data)
        area = top, left, max(1, bottom - top + 1), max(1, right - left + 1)
        where = cell_name(top, left)
        self.faults.remark(say("the what-if table {where} is not computed: stored values are kept", where=where), area)

    def _give_members(self) -> None:
        """The cells of shared formulas; what belongs to an array formula is its result."""
        arrays = {(top, left) for (top, left, _, _), _, _ in self.arrays}
        lost: list[Area] = []
        for row, col, master in self.members:
            if master in arrays:
                continue
            key = self.shared.get(master)
            if key is not None:
                self.columns.setdefault(col, []).append((row, key))
            else:
                lost.append((row, col, 1, 1))
        for area in lost:
            self.faults.remark(say("a shared formula that is not in the file: stored values are kept"), area)
        self.sheet.keep(lost)

    def _blocks(self) -> Iterator[Block]:
        """The formulas as blocks, in the order of rows and columns; equal columns side by side are one."""
        runs: list[tuple[int, int, int, Key]] = []  # first row, column, rows, formula
        for col, cells in self.columns.items():
            unique = sorted(dict(cells).items())
            first = 0
            for place, (above, below) in enumerate(pairwise([*unique, (-1, (b"", b""))]), 1):
                if below[0] != above[0] + 1 or below[1] != above[1]:
                    runs.append((unique[first][0], col, place - first, above[1]))
                    first = place
        last: list[tuple[int, int, int, int, Key]] = []  # first row, column, rows, columns, formula
        for row, col, rows, key in sorted(runs, key=lambda run: run[:2]):
            if last and last[-1][:1] + last[-1][2:3] + last[-1][4:] == (row, rows, key) and sum(last[-1][1:4:2]) == col:
                row, left, rows, cols, key = last.pop()
                last.append((row, left, rows, cols + 1, key))
            else:
                last.append((row, col, rows, 1, key))
        for row, col, rows, cols, key in last:
            formula = self._formula(key, (row, col, rows, cols))
            if formula is not None:
                yield Block(row, col, rows, cols, formula)

    def _formula(self, key: Key, area: Area) -> Node | None:
        """The tree of a block's formula; None where it cannot be read, which is remarked: stored values are kept."""
        try:
            return self.formulas.tree(*key, *area[:2])
        except (UnreadableError, DamagedError) as problem:
            self.faults.remark(say("{message}: stored values are kept", message=reason(problem)), area)
            self.sheet.keep([area])
            return None

    def _give_arrays(self) -> None:
        wide: list[Block] = []
        cells = 0
        for area, code, extra in self.arrays:
            top, left, rows, cols = area
            cells += max(rows, 0) * max(cols, 0)
            if rows < 1 or cols < 1 or cells > MOST_CELLS:
                self.faults.note(say("an array formula without a proper area"), top, left)
                return
            formula = self._formula((code, extra), area)
            if formula is not None:
                kind: Kind = "array"
                self.sheet.blocks.append(Block(*area, formula, kind))
                if rows * cols > 1:
                    wide.append(self.sheet.blocks[-1])
        if wide:
            move_values(self.sheet, wide)


def _short_number(code: int) -> float:
    """A number in four bytes: an integer or the upper part of a float, perhaps in hundredths."""
    value = (code >> 2) - (1 << 30 if code & 1 << 31 else 0) if code & 2 else 0
    number = float(value) if code & 2 else struct.unpack("<d", struct.pack("<Q", (code & ~3) << 32))[0]
    return number / 100 if code & 1 else number


def _error(code: int) -> ErrorValue:
    return ErrorValue(ERRORS.get(code, "#N/A"))


def _stored(data: bytes) -> Scalar:
    """The value that a formula had; None where a text follows in a record of its own."""
    if data[6:8] != b"\xff\xff":
        number: float = struct.unpack("<d", data)[0]
        return number if math.isfinite(number) else None
    match data[0]:
        case 1:
            return data[2] != 0
        case 2:
            return _error(data[2])
        case 3:
            return ""
    return None
