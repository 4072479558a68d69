"""The summary workbook of a study: the best designs, the front with its chart, designs set apart, and what was asked.

For people: who wants all designs reads the Parquet files. The commands are formulas over the yellow cells, so that a folder
that was moved is typed once; the chart follows the cells of the front.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Any

from livesheet.evaluation import computed
from livesheet.formula.nodes import Binary, CellRef, Node, Text
from livesheet.workbook import (
    Anchor,
    Area,
    Axis,
    Cell,
    Chart,
    Column,
    Fill,
    PrintSetup,
    Properties,
    Series,
    SeriesRef,
    Sheet,
    Style,
    Workbook,
)
from mechsheet.model import Objective, Range
from mechsheet.sheet import styles
from mechsheet.studies.designs import DESIGN
from mechsheet.studies.parts import heads_of, told_of
from mechsheet.studies.ranking import Studied
from mechsheet.words.catalogue import words, words_of_count

MOST_FRONT = 2_000
"""Designs of the front that a sheet holds: a chart of more is a blot."""

HEAD_ROW, FIRST = 5, 6

NUMBER = styles.numbered(styles.COLUMN, "0.0000")
WHOLE = styles.numbered(styles.COLUMN, "0")
COUNT = styles.numbered(styles.RESULT, "#,##0")
TEXT = styles.STATUS
"""Of commands and of remarks."""


def book_of(found: Studied) -> Workbook:
    """The workbook with every value."""
    mechanism = found.designs.mechanism
    sheets = [_best(found)]
    if found.front is not None and found.front.num_rows and found.designs.study.objectives:
        sheets.append(_front(found))
    if found.apart is not None:
        sheets.append(_apart(found))
    sheets.append(_settings(found))
    title = mechanism.title.of(mechanism.language)
    return computed(
        Workbook(tuple(sheets), properties=Properties(title=title, language=mechanism.language, author="mechsheet"))
    )


def _said(found: Studied, key: str, **parts: object) -> str:
    return words(found.designs.mechanism.language, f"study.{key}", **parts)


def _table(table: Any, row: int, col: int) -> list[Cell]:
    """The cells of a table from a place on: what has no number is empty."""
    cells = []
    for across, name in enumerate(table.column_names):
        style = WHOLE if name == DESIGN else NUMBER
        for down, value in enumerate(table.column(name).to_pylist()):
            cells.append(Cell(row + down, col + across, None if value is None else float(value), style))
    return cells


def _top(found: Studied, title: str, about: str) -> list[Cell]:
    """What a sheet is of, above its table."""
    return [Cell(0, 0, title, styles.TITLE), Cell(1, 0, _said(found, about), styles.SUBTITLE)]


def _heads(heads: Sequence[str]) -> list[Cell]:
    """The row over a table."""
    return [Cell(HEAD_ROW, col, head, styles.HEAD) for col, head in enumerate(heads)]


def _sheet(name: str, cells: Sequence[Cell], columns: Sequence[Column], frozen: int, **more: Any) -> Sheet:
    """A sheet with a table; so many columns stay where they are when somebody scrolls."""
    return Sheet(
        name, tuple(cells), columns=tuple(columns), row_heights=((0, 26.0), (HEAD_ROW, 42.0)), freeze=(FIRST, frozen),
        gridlines=False, print_setup=PrintSetup(repeat_rows=(HEAD_ROW, HEAD_ROW)), **more,
    )  # fmt: skip


def _remarks(found: Studied, remarks: list[str | None], col: int) -> list[Cell]:
    """The column of what the workbook says of the designs' numbers; nothing where it says nothing."""
    if not any(remarks):
        return []
    cells = [Cell(HEAD_ROW, col, _said(found, "remarks"), styles.HEAD)]
    return cells + [Cell(FIRST + row, col, text, TEXT) for row, text in enumerate(remarks)]


def _best(found: Studied) -> Sheet:
    mechanism, table = found.designs.mechanism, found.best
    count = 0 if table is None else table.num_rows
    name, kept = mechanism.title.of(mechanism.language), found.result.kept
    title = words_of_count(mechanism.language, "study.title", kept, title=name, shown=count, kept=f"{kept:,}")
    cells = _top(found, title, "about")
    for row, (key, text) in enumerate(
        (("description", f"{mechanism.stem}.toml"), ("folder", found.folder.path.name)), 2
    ):
        cells += [Cell(row, 0, _said(found, key), styles.LABEL), Cell(row, 2, text, styles.INPUT)]
    if table is None:
        return Sheet(_said(found, "best"), tuple(cells), columns=(Column(0, 0, 20.0), Column(1, 2, 14.0)))
    table, remarks = told_of(table)
    front = set(found.ranked.front.tolist())
    heads = [_said(found, "rank"), _said(found, "design"), *heads_of(table)[1:]]
    last = len(heads)
    tail = ([_said(found, "on_front")] if front else []) + [_said(found, "command")]
    cells += _heads([*heads, *tail])
    cells += _table(table, FIRST, 1)
    cells += _remarks(found, remarks, last + len(tail))
    for row, design in enumerate(table.column(DESIGN).to_pylist()):
        cells.append(Cell(FIRST + row, 0, float(row + 1), WHOLE))
        if front:
            words = _said(found, "yes") if design in front else None
            cells.append(Cell(FIRST + row, last, words, styles.centred(styles.COLUMN)))
    command = last + len(tail) - 1
    fill = Fill(FIRST, command, _command(1), TEXT, rows=table.num_rows)
    columns = (Column(0, 0, 20.0), Column(1, 1, 12.0), Column(2, command - 1, 13.0), *_wide(command))
    return _sheet(_said(found, "best"), cells, columns, 2, fills=(fill,), selected=(FIRST, 0))


def _apart(found: Studied) -> Sheet:
    """Designs that meet the conditions by numbers that the workbook marks."""
    table, remarks = told_of(found.apart)
    language, apart = found.designs.mechanism.language, found.result.apart
    title = words_of_count(language, "study.apart.title", apart, shown=table.num_rows, apart=f"{apart:,}")
    heads = [_said(found, "design"), *heads_of(table)[1:], _said(found, "command")]
    command = len(heads) - 1
    cells = [*_top(found, title, "apart.about"), *_heads(heads)]
    cells += [*_table(table, FIRST, 0), *_remarks(found, remarks, len(heads))]
    fill = Fill(FIRST, command, _command(0, _said(found, "best")), TEXT, rows=table.num_rows)
    columns = (Column(0, 0, 12.0), Column(1, command - 1, 13.0), *_wide(command))
    return _sheet(_said(found, "apart"), cells, columns, 1, fills=(fill,))


def _wide(command: int) -> tuple[Column, Column]:
    """The columns of commands and of remarks."""
    return Column(command, command, 70.0), Column(command + 1, command + 1, 60.0)


def _command(col: int, inputs: str | None = None) -> Node:
    """mechsheet build DESCRIPTION --design FOLDER:17 -o design-17.xlsx, of the row's design.

    col  the column of its number;  inputs: the sheet of the yellow cells
    """
    design = CellRef(FIRST, col, False, True)
    description, folder = (CellRef(row, 2, True, True, inputs) for row in (2, 3))
    parts: list[Node] = [Text("mechsheet build "), description, Text(" --design "), folder, Text(":"), design]
    parts += [Text(" -o design-"), design, Text(".xlsx")]
    return reduce(lambda before, part: Binary("&", before, part), parts)


def _front(found: Studied) -> Sheet:
    objectives, table = found.designs.study.objectives, found.front
    every = found.ranked.front
    if table.num_rows > MOST_FRONT:
        table = table.take([round(at * (table.num_rows - 1) / (MOST_FRONT - 1)) for at in range(MOST_FRONT)])
    names = list(dict.fromkeys([DESIGN, *(each.text for each in objectives), *found.designs.varied]))
    remarks, table = told_of(table)[1], table.select(names)
    cells = _top(found, _said(found, "front.title"), "front.about")
    if table.num_rows < len(every) or not found.ranked.whole:
        words = _said(found, "front.thinned", shown=f"{table.num_rows:,}", all=f"{len(every):,}")
        cells.append(Cell(2, 0, words, styles.NOTE))
    heads = heads_of(table)
    cells += _heads([_said(found, "design"), *heads[1:]])
    cells += [*_table(table, FIRST, 0), *_remarks(found, remarks, len(heads))]
    charts = (_chart(found, heads, table.num_rows, any(remarks)),) if len(objectives) > 1 else ()
    columns = (Column(0, 0, 12.0), Column(1, len(heads) - 1, 15.0))
    return _sheet(_said(found, "front"), cells, columns, 1, charts=charts)


def _chart(found: Studied, heads: list[str], rows: int, remarks: bool) -> Chart:
    title, sheet = _said(found, "front.title"), _said(found, "front")
    x, y = (SeriesRef(sheet, Area(FIRST, col, FIRST + rows - 1, col)) for col in (1, 2))
    series = Series(
        title, x, y, marker="circle", marker_size=6, marker_line=styles.SERIES[0], marker_fill=styles.SERIES[0]
    )
    words = [
        f"{head}: {_aim(found, each)}" for head, each in zip(heads[1:], found.designs.study.objectives, strict=False)
    ]
    place = Anchor(FIRST, len(heads) + 1 + remarks, 640, 440)
    return Chart(title, place, (series,), Axis(words[0]), Axis(words[1]), legend="", alt_text=title)


def _aim(found: Studied, objective: Objective) -> str:
    return _said(found, "maximize" if objective.largest else "minimize")


def _settings(found: Studied) -> Sheet:
    designs, study = found.designs, found.designs.study
    lines: list[tuple[str, str | float | None, Style]] = [
        (_said(found, "designs"), float(found.result.designs), COUNT),
        (_said(found, "kept"), float(found.result.kept), COUNT),
    ]
    share = len(lines)
    lines += [
        (_said(found, "share"), None, styles.RESULT),
        (_said(found, "settings.apart"), float(found.result.apart), COUNT),
        (_said(found, "rows"), float(designs.rows), COUNT),
        (_said(found, "sample"), _said(found, study.sample), styles.VERDICT),
    ]
    if study.sample == "sobol":
        lines.append((_said(found, "seed"), float(study.seed), styles.numbered(styles.RESULT, "0")))
    lines.append((_said(found, "vary"), None, styles.SECTION))
    lines += [(one.symbol, _span(one), styles.VERDICT) for one in study.vary]
    lines.append((_said(found, "conditions"), None, styles.SECTION))
    lines += [(text, float(count), COUNT) for text, count in found.result.failed]
    lines.append((_said(found, "objectives"), None, styles.SECTION))
    lines += [(each.text, _aim(found, each), styles.VERDICT) for each in study.objectives]
    lines.append((_said(found, "versions"), None, styles.SECTION))
    lines += [(name, version, styles.VERDICT) for name, version in found.order.versions]
    cells = [Cell(0, 0, _said(found, "settings"), styles.TITLE)]
    for row, (label, value, style) in enumerate(lines, 2):
        cells.append(Cell(row, 0, label, styles.SECTION if style is styles.SECTION else styles.LABEL))
        if row != share + 2:
            cells.append(Cell(row, 1, value, style))
    ratio = Binary("/", CellRef(share + 1, 1, True, True), CellRef(share, 1, True, True))
    fill = Fill(share + 2, 1, ratio, styles.numbered(styles.RESULT, "0.00%"))
    return Sheet(
        _said(found, "settings"), tuple(cells), (fill,), (Column(0, 0, 52.0), Column(1, 1, 34.0)), row_heights=((0, 26.0),),
        gridlines=False,
    )  # fmt: skip


def _span(one: Range) -> str:
    if one.values:
        return ", ".join(f"{value:g}" for value in one.values)
    step = f", {one.step:g}" if one.step else ""
    return f"{one.low:g} … {one.high:g}{step}"
