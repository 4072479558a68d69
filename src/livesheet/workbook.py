"""A workbook as plain data: everything a person will see, decided before any file format is known.

Rows and columns count from 0. Formulas are trees without `Symbol`: every quantity is bound to a cell or a name.
Sizes are in pixels at 96 dpi. Colours are "RRGGBB". Writers spell this out and decide nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Literal, TypeAlias

from livesheet.formula.nodes import CellRef, Node, Scalar


@dataclass(frozen=True, slots=True)
class Style:
    """How a cell looks. `name` makes it a named style of the file; equal styles are one style.

    wrap    a long text is broken into lines;  shrink  it is printed smaller until it fits
    """

    name: str = ""
    bold: bool = False
    italic: bool = False
    size: float = 10.0
    color: str = "000000"
    fill: str = ""
    border: Literal["", "thin", "bottom", "top"] = ""
    border_color: str = "B0B0B0"
    number_format: str = "General"
    align: Literal["", "left", "center", "right"] = ""
    valign: Literal["", "top", "center", "bottom"] = ""
    wrap: bool = False
    shrink: bool = False
    indent: int = 0
    locked: bool = True


PLAIN = Style()


@dataclass(frozen=True, slots=True)
class Rich:
    """A text with subscripts and superscripts: (text, "" | "sub" | "super" | "italic") parts."""

    parts: tuple[tuple[str, str], ...]

    @property
    def plain(self) -> str:
        """The text without its formatting."""
        return "".join(text for text, _ in self.parts)


Content: TypeAlias = float | str | bool | Rich | None


def plain_text(content: Rich | str) -> str:
    """A text, rich or not, without its formatting."""
    return content.plain if isinstance(content, Rich) else content


@dataclass(frozen=True, slots=True)
class Cell:
    """One cell holding a constant. `style` alone (content None) makes an empty styled cell."""

    row: int
    col: int
    content: Content
    style: Style = PLAIN

    @property
    def value(self) -> float | str | bool | None:
        """The content as programs compute with it: of a rich text its text."""
        return self.content.plain if isinstance(self.content, Rich) else self.content


@dataclass(frozen=True, slots=True)
class Fill:
    """A rectangle filled with one formula, as if its first cell were copied to the others; one cell is a 1 x 1 fill.

    formula  the tree as the top-left cell has it (relative references are shifted for the others: `nodes.shifted`)
    values   the computed values, row after row; empty until the engine has run
    """

    row: int
    col: int
    formula: Node
    style: Style = PLAIN
    rows: int = 1
    cols: int = 1
    values: Sequence[Scalar] = ()

    def value(self, row: int, col: int) -> Scalar:
        """The value of the cell at absolute (row, col)."""
        return self.values[(row - self.row) * self.cols + (col - self.col)]


@dataclass(frozen=True, slots=True)
class Area:
    """A rectangle of cells on the sheet it belongs to, both corners included."""

    first_row: int
    first_col: int
    last_row: int
    last_col: int

    def holds(self, row: int, col: int) -> bool:
        """Whether a cell is in it."""
        return self.first_row <= row <= self.last_row and self.first_col <= col <= self.last_col

    def places(self) -> Iterator[tuple[int, int]]:
        """Row and column of each of its cells, row by row."""
        return product(range(self.first_row, self.last_row + 1), range(self.first_col, self.last_col + 1))


@dataclass(frozen=True, slots=True)
class Comment:
    """A note that appears over a cell."""

    row: int
    col: int
    text: str


@dataclass(frozen=True, slots=True)
class Validation:
    """What may be typed into `area`.

    kind    "decimal", "whole": compared by `operator` with `low` (and `high` for "between");
            "list": one of `choices`, or of the cells of the range `low`; "custom": `low` is a formula that must be TRUE
    """

    area: Area
    kind: Literal["decimal", "whole", "list", "custom"]
    operator: Literal["between", ">", ">=", "<", "<=", "="] = "between"
    low: Node | None = None
    high: Node | None = None
    choices: tuple[str, ...] = ()
    input_title: str = ""
    input_message: str = ""
    error_title: str = ""
    error_message: str = ""
    stop: bool = True


@dataclass(frozen=True, slots=True)
class Conditional:
    """Cells of `area` where `condition` (written for the top-left cell) is TRUE get `style` (colour, fill, bold only)."""

    area: Area
    condition: Node
    style: Style


@dataclass(frozen=True, slots=True)
class Anchor:
    """Where a chart or control stands: a cell's corner plus an offset, and its size."""

    row: int
    col: int
    width: int
    height: int
    dx: int = 0
    dy: int = 0


Dash: TypeAlias = Literal["solid", "dash", "dot"]


@dataclass(frozen=True, slots=True)
class SeriesRef:
    """A column (or row) of cells on a named sheet: the data of a series."""

    sheet: str
    area: Area


@dataclass(frozen=True, slots=True)
class Series:
    """One curve; see `Chart.smooth` for what is drawn between its points.

    name        a constant, or a cell (its sheet given)
    line        colour of the line, "" for none;  width in points;  dash "solid" | "dash" | "dot"
    marker      "" | "circle" | "square" | "diamond" | "triangle" | "plus" | "x";  size in points
    marker_fill colour inside the marker, "" for none
    show_name   the series' name is shown as label at its points (live text: scale bar, point names)
    label_side  where that label stands
    in_legend   False takes the series out of the legend
    """

    name: str | CellRef
    x: SeriesRef
    y: SeriesRef
    line: str = ""
    width: float = 1.5
    dash: Dash = "solid"
    marker: str = ""
    marker_size: int = 6
    marker_line: str = ""
    marker_fill: str = ""
    show_name: bool = False
    label_side: Literal["right", "left", "above", "below", "center"] = "right"
    label_size: float = 9.0
    in_legend: bool = True


@dataclass(frozen=True, slots=True)
class Axis:
    """An axis. `low`, `high`, `step` None = chosen by the program. `visible` False hides line, ticks and numbers."""

    title: str = ""
    low: float | None = None
    high: float | None = None
    step: float | None = None
    number_format: str = "General"
    visible: bool = True
    gridlines: bool = True


@dataclass(frozen=True, slots=True)
class Chart:
    """A scatter chart. `inner` is the plot area as fractions (x, y, width, height) of the frame: with a square one and
    fixed equal axes a circle is round. Cells with #N/A leave a gap. `smooth`: whether curves are bent between their points;
    of a whole chart, since in LibreOffice one smooth series bends all."""

    title: str
    anchor: Anchor
    series: tuple[Series, ...]
    x_axis: Axis
    y_axis: Axis
    legend: Literal["", "right", "bottom", "top"] = "bottom"
    inner: tuple[float, float, float, float] | None = None
    name: str = ""
    alt_text: str = ""
    smooth: bool = False


@dataclass(frozen=True, slots=True)
class Control:
    """A form control bound to a cell of the same sheet that holds a whole number."""

    kind: Literal["scroll", "spin"]
    name: str
    anchor: Anchor
    linked_row: int
    linked_col: int
    low: int
    high: int
    step: int
    page: int
    horizontal: bool = True


@dataclass(frozen=True, slots=True)
class Column:
    """Width [characters of the default font] and outline of columns first..last."""

    first: int
    last: int
    width: float
    level: int = 0
    hidden: bool = False
    collapsed: bool = False


@dataclass(frozen=True, slots=True)
class Merge:
    """Cells of `area` shown as one; the top-left cell is a `Cell` or `Fill` as usual."""

    area: Area


@dataclass(frozen=True, slots=True)
class PrintSetup:
    """Paper and print range; A4. `fit_width` pages across (0: no fit), `fit_height` pages down (0: as many as needed).

    `scale`: instead of a fit, percent of the size on screen; `page_at`, `row_at`: columns and rows that begin a page, which
    a fit forbids.
    `repeat_rows`, `repeat_cols` (first, last) stand on every page; the columns are ones that `Sheet.columns` names.
    `footer`: &L, &C, &R begin its parts, &P is the page, &N their count, &A the sheet, && an ampersand.
    """

    landscape: bool = True
    fit_width: int = 1
    fit_height: int = 0
    scale: int = 0
    page_at: tuple[int, ...] = ()
    row_at: tuple[int, ...] = ()
    repeat_rows: tuple[int, int] | None = None
    repeat_cols: tuple[int, int] | None = None
    area: Area | None = None
    footer: str = ""


@dataclass(frozen=True, slots=True)
class Sheet:
    """One sheet. `freeze` is the first unfrozen (row, column); `selected` the cell the cursor stands on."""

    title: str
    cells: tuple[Cell, ...] = ()
    fills: tuple[Fill, ...] = ()
    columns: tuple[Column, ...] = ()
    row_heights: tuple[tuple[int, float], ...] = ()
    merges: tuple[Merge, ...] = ()
    charts: tuple[Chart, ...] = ()
    controls: tuple[Control, ...] = ()
    validations: tuple[Validation, ...] = ()
    conditionals: tuple[Conditional, ...] = ()
    comments: tuple[Comment, ...] = ()
    freeze: tuple[int, int] | None = None
    selected: tuple[int, int] = (0, 0)
    hidden: bool = False
    gridlines: bool = True
    tab_color: str = ""
    print_setup: PrintSetup = PrintSetup()


@dataclass(frozen=True, slots=True)
class Name:
    """A defined name for one cell (absolute)."""

    name: str
    sheet: str
    row: int
    col: int


@dataclass(frozen=True, slots=True)
class NamedFunction:
    """A name that stands for a function: `formula` is a LAMBDA. An .ods leaves it out; there a `Module` says the same."""

    name: str
    formula: Node


@dataclass(frozen=True, slots=True)
class Module:
    """A module of Basic in the document's library Standard, which an .ods holds and an .xlsx leaves out."""

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class Properties:
    """Document properties. The dates are fixed by the writers: the same input gives the same bytes.

    author  the program that made the workbook, of its notes over cells too; letters only, for its seal
    """

    title: str = ""
    subject: str = ""
    comments: str = ""
    keywords: str = ""
    language: str = "en"
    author: str = "livesheet"


@dataclass(frozen=True, slots=True)
class Workbook:
    """Sheets in order, the first one active."""

    sheets: tuple[Sheet, ...]
    names: tuple[Name, ...] = ()
    properties: Properties = Properties()
    functions: tuple[NamedFunction, ...] = ()
    modules: tuple[Module, ...] = ()

    def sheet(self, title: str) -> Sheet:
        """The sheet with this title."""
        return next(sheet for sheet in self.sheets if sheet.title == title)


def with_values(workbook: Workbook, values: Iterator[Sequence[Scalar]]) -> Workbook:
    """The workbook with each fill's values taken in turn from `values` (sheet after sheet, fill after fill)."""
    return replace(
        workbook,
        sheets=tuple(
            replace(sheet, fills=tuple(replace(fill, values=next(values)) for fill in sheet.fills))
            for sheet in workbook.sheets
        ),
    )
