"""Every spreadsheet function that the program knows: one line each in `functions.txt`, read here.

A row is written for the reader of a formula (near misses, too few arguments), for the printers (the two spellings), for the
engine (which kinds of arguments a function takes, and the module of its array code) and for the manual's list of functions.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

MANY = 255
"""Excel's limit of arguments."""


@dataclass(frozen=True, slots=True)
class Function:
    """One function.

    name       as in the tree: Excel's English name
    least, most  how many arguments it takes
    ooxml      how an .xlsx spells it (`_xlfn.` before functions younger than the format)
    odf        how OpenFormula spells it
    kinds      the kinds of its arguments, one letter each, as `functions.txt` explains them
    repeated   how many kinds at the end are taken again and again (0: none)
    family     the heading it stands under in the manual
    module     the module of the engine that has its array code
    volatile   recalculated at every change, whatever changed
    note       what is worth knowing about arguments or differences between programs
    """

    name: str
    least: int
    most: int
    ooxml: str
    odf: str
    kinds: str = ""
    repeated: int = 0
    family: str = ""
    module: str = ""
    volatile: bool = False
    note: str = ""

    def needs(self, place: int) -> bool:
        """Whether an argument (counted from 0) may not be left out: `SUM(A1,)` has a blank there."""
        return place < self.least or (self.repeated > 0 and place >= len(self.kinds) - self.repeated)

    def kinds_of(self, count: int) -> str:
        """The kinds of `count` arguments."""
        kinds = self.kinds
        if self.repeated and count > len(kinds):
            group = kinds[-self.repeated :]
            kinds += group * (-(-(count - len(kinds)) // self.repeated))
        return kinds[:count]


_LINE = re.compile(
    r"(?P<name>[A-Z][A-Z0-9._]*)(?: (?P<kinds>[^@|\s]+))?(?: @(?P<flags>[xwml!]+))?(?: \| (?P<note>.+))?"
)
_HEADING = re.compile(r"== (?P<family>.+) \((?P<module>\w+)\)")


def _rows(text: str) -> list[Function]:
    """The rows of the table. Raises ValueError with the line that is none."""
    rows: list[Function] = []
    family = module = ""
    for line in text.splitlines():
        if not line or line[0] == "#":
            continue
        heading = _HEADING.fullmatch(line)
        if heading is not None:
            family, module = heading["family"], heading["module"]
            continue
        match = _LINE.fullmatch(line)
        if match is None:
            raise ValueError(f"functions.txt: not a row: {line}")
        rows.append(_row(match, family, module))
    return rows


_ODF_NAMES = {"FORMULATEXT": "FORMULA"}
"""Functions with another name in OpenFormula."""


def _row(match: re.Match[str], family: str, module: str) -> Function:
    name, kinds, flags = match["name"], match["kinds"] or "", match["flags"] or ""
    fixed, _, group = kinds.partition("(")
    group = group.removesuffix(")*")
    needed = fixed.partition("[")[0]
    prefix = "_xlfn._xlws." if "w" in flags else "_xlfn." if "x" in flags else ""
    odf = "COM.MICROSOFT." if "m" in flags else "LEGACY." if "l" in flags else ""
    letters = re.sub(r"[\[\]]", "", fixed) + group
    return Function(
        name=name,
        least=len(needed),
        most=MANY if group else len(letters),
        ooxml=prefix + name,
        odf=odf + _ODF_NAMES.get(name, name),
        kinds=letters,
        repeated=len(group),
        family=family,
        module=module,
        volatile="!" in flags,
        note=match["note"] or "",
    )


FUNCTIONS = {row.name: row for row in _rows(Path(__file__).with_name("functions.txt").read_text(encoding="utf-8"))}
"""Name in the tree -> its row."""

_PREFIXES = (
    "_XLFN.", "_XLWS.", "COM.MICROSOFT.", "ORG.OPENOFFICE.", "ORG.LIBREOFFICE.", "_XLFNGNUMERIC.", "_XLFNODF.", "ODF.",
)  # fmt: skip
"""The last three are gnumeric's, before what it takes for no function of Excel's."""

_BY_ODF = {row.odf: row.name for row in FUNCTIONS.values()}


def canonical_name(spelling: str, dialect: str = "excel") -> str:
    """The tree's name of a function spelt in a file: `_xlfn.IFNA` is IFNA. Unknown names come back in capitals."""
    name = spelling.upper()
    if dialect == "openformula" and name in _BY_ODF:
        return _BY_ODF[name]
    found = True
    while found:
        found = False
        for prefix in _PREFIXES:
            if name.startswith(prefix):
                name, found = name[len(prefix) :], True
    return name


def spelling(name: str, dialect: str) -> str:
    """How `dialect` ("excel" or "openformula") spells a function of the tree; a name that is not known stays as it is."""
    row = FUNCTIONS.get(name)
    if row is None:
        return name
    return row.odf if dialect == "openformula" else row.ooxml
