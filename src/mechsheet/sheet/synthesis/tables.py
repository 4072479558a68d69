"""The tables of the sheet of synthesis: what is asked and what is got, a curve over a range, changes of the solution.

By how much each step of a solution changes when one input does, by 0.1 degrees or 0.1 percent, is the chain rule in cells:

    d step = sum over what it reads: (∂ step/∂ read) d read
"""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Call, CellRef, Node, Number, Symbol, symbols, with_symbols
from livesheet.formula.parser import parse_description
from livesheet.workbook import Column
from mechsheet.model import Dimension, Synthesis
from mechsheet.sheet import styles
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.synthesis.page import Page
from mechsheet.sheet.task_rows import MEANING, REMARK, ROUNDED, SYMBOL, UNIT, USED, VALUE
from mechsheet.synthesis.kind import MU as NAME_OF_MU
from mechsheet.synthesis.kind import Requirement
from mechsheet.synthesis.kinds import kind_of
from mechsheet.synthesis.writing import says
from mechsheet.words.equations import step_words
from mechsheet.words.symbols import plain

PART = 0.001
"""An input that is no angle changes by this part of it."""

STEP = 0.1
"""An angle, by so many degrees."""


def changes(task: Synthesis, dimensions: Mapping[str, Dimension]) -> dict[tuple[str, str], Node]:
    """(step, input) -> the change of the step in internal units, over symbols; `d step input` names another change.

    Left out where the step does not depend on the input, and steps from which no length follows.
    """
    found: dict[tuple[str, str], Node] = {}
    wanted = _read_by(largest(task, dimensions), task, dimensions)
    for column in task.inputs:
        if column == task.rounding:
            continue
        for step in wanted:
            value = dimensions[step].value
            if isinstance(value, float):
                continue
            terms: list[Node] = []
            for read, slope in _slopes(step, says(value), task):
                if read == column:
                    terms.append(al.mul(slope, _own(dimensions[column])))
                elif (read, column) in found:
                    terms.append(al.mul(slope, Symbol(mark(read, column))))
            if terms:
                found[step, column] = al.total(terms)
    return found


def _slopes(step: str, node: Node, task: Synthesis) -> list[tuple[str, Node]]:
    """What a step reads, and its derivative by that: of a root by the equation that it fulfils."""
    if step not in task.roots:
        slopes = ((read, derivative(node, read)) for read in symbols(node))
        return [(read, slope) for read, slope in slopes if not al.is_zero(slope)]
    b, c, _ = task.roots[step]
    x = Symbol(step)
    slope = al.add(al.mul(x, al.add(al.mul(Number(3.0), x), al.mul(al.TWO, Symbol(b)))), Symbol(c))
    powers = (al.square(x), x, al.ONE)
    return [(read, al.neg(al.div(power, slope))) for read, power in zip(task.roots[step], powers, strict=True)]


def _read_by(ends: list[str], task: Synthesis, dimensions: Mapping[str, Dimension]) -> list[str]:
    """The steps that these follow from, and they themselves, in order."""
    needed = set(ends)
    for step in reversed(task.steps):
        value = dimensions[step].value
        if step in needed and not isinstance(value, float):
            needed |= set(task.roots.get(step, ())) or set(symbols(says(value)))
    return [step for step in task.steps if step in needed]


def mark(step: str, column: str) -> str:
    """The symbol of the change of a step with an input: no description can use a name with a blank in it."""
    return f"d {step} {column}"


def _own(dim: Dimension) -> Node:
    """By how much an input changes itself."""
    if dim.unit.kind == "angle":
        return Call("RADIANS", (Number(STEP),))
    return al.mul(Number(PART), Call("ABS", (Symbol(dim.symbol),)))


def largest(task: Synthesis, dimensions: Mapping[str, Dimension]) -> list[str]:
    """Symbols of the lengths among the ends of a solution that are steps."""
    return [symbol for symbol in task.ends if symbol in task.steps and dimensions[symbol].unit.kind == "length"]


MU, THETA = REMARK + 1, REMARK + 2
"""The columns beside the table of what is asked in which points have their transmission angle and their input angle."""

CURVE_COLUMNS = (VALUE, ROUNDED, USED, MEANING, REMARK)


def curve_columns(task: Synthesis) -> dict[str, int]:
    """Key of a column of the curve's table -> where it stands."""
    curve = kind_of(task).curve(task)
    return {} if curve is None else dict(zip(curve.columns, CURVE_COLUMNS, strict=False))


def has_points(task: Synthesis) -> bool:
    """Whether what is asked is asked at angles of the input link."""
    return any(row.at for row in kind_of(task).asked(task))


def exact_column(task: Synthesis) -> int:
    """Where the errors of the exact lengths stand, if those that are used are rounded: beside what is asked."""
    return MU + (2 if has_points(task) else 0)


def sensitivity_columns(task: Synthesis) -> tuple[int, int]:
    """First and last column of the changes: beside the solution, behind all that is printed."""
    first = exact_column(task) + (1 if task.rounding else 0)
    return first, first + sum(1 for symbol in task.inputs if symbol != task.rounding) - 1


# --- what is asked -------------------------------------------------------------------------------------------------


def write_asked(page: Page) -> None:
    """Wanted, got, the difference; that of the exact lengths where they are rounded."""
    text = page.text
    rows = page.kind.asked(page.given)
    turns = text("got.turns") if any(row.measure == "angle" for row in rows) else ""
    page.heading("asked", REMARK, value=text("wanted"), rounded=text("got"), used=text("error"), remark=turns)
    if page.rounds:
        page.put(page.rows.heads["asked"], exact_column(page.given), text("error.exact"), styles.SECTION)
    if has_points(page.given):
        for col, over in ((MU, "μ"), (THETA, "θ")):
            page.put(page.rows.heads["asked"], col, over, styles.SECTION)
    for number, asked in enumerate(rows):
        _asked(page, page.rows.of["asked", str(number)], number + 1, asked)


def _asked(page: Page, row: int, number: int, asked: Requirement) -> None:
    style = page.number_style(asked.measure, styles.RESULT)
    wanted, got = (CellRef(row, col) for col in (VALUE, ROUNDED))
    page.put(row, SYMBOL, str(number), styles.SYMBOL)
    page.formula(row, VALUE, page.shown(page.tree(asked.wanted), asked.measure), style)
    page.put(row, UNIT, page.unit_text(asked.measure), styles.UNIT)
    beside = {NAME_OF_MU: page.read(CellRef(row, MU), "angle")} if asked.mu else {}
    found: Node = page.tree(asked.got, **beside)
    if asked.measure == "angle":
        raw = CellRef(row, REMARK)
        page.formula(row, REMARK, page.shown(found, "angle"), style)
        off = page.shown(apart(page.read(raw, "angle"), page.read(wanted, "angle")), "angle")
        page.formula(row, ROUNDED, formula("wanted+off", wanted=wanted, off=off), style)
    else:
        page.formula(row, ROUNDED, page.shown(found, asked.measure), style)
        page.put(row, REMARK, None, styles.LABEL)
    page.formula(row, USED, formula("got-wanted", got=got, wanted=wanted), styles.numbered(style, "0.0E+00"))
    if page.rounds:
        exact, aim = page.exactly(asked.got_alone), page.exactly(asked.wanted)
        off = apart(exact, aim) if asked.measure == "angle" else formula("exact-aim", exact=exact, aim=aim)
        page.formula(row, exact_column(page.given), page.shown(off, asked.measure), styles.numbered(style, "0.0E+00"))
    words = step_words(asked.key, **dict(asked.parts))
    page.put(row, MEANING, words.of(page.plan.language), styles.LABEL)
    if asked.mu:
        page.formula(row, MU, page.shown(page.tree(asked.mu), "angle"), style)
        page.formula(row, THETA, page.shown(page.tree(asked.at), "angle"), style)


def apart(got: Node, wanted: Node) -> Node:
    """The angle between two angles: whole turns are none."""
    return formula("ATAN2(COS(got-wanted),SIN(got-wanted))", got=got, wanted=wanted)


# --- the curve -----------------------------------------------------------------------------------------------------


def write_curve(page: Page) -> None:
    """One formula a column, filled down."""
    curve = page.kind.curve(page.given)
    if curve is None:
        return
    first = page.rows.of["curve", "0"]
    places = curve_columns(page.given)
    head = page.rows.heads["curve"]
    over = {SYMBOL: "curve", **{col: f"curve.{key}" for key, col in places.items()}}
    for col in range(SYMBOL, REMARK + 1):
        page.put(head, col, page.text(over[col]) if col in over else None, styles.SECTION)
    for number in range(curve.rows):
        page.put(first + number, SYMBOL, float(number), styles.INNER)
    cells: dict[str, Node] = {"n": CellRef(first, SYMBOL)}
    for key, (text, kind) in curve.columns.items():
        col = places[key]
        node = page.shown(_in_row(page, text, cells), kind)
        page.formula(first, col, node, page.number_style(kind, styles.COLUMN), rows=curve.rows)
        cells[key] = page.read(CellRef(first, col), kind)


def _in_row(page: Page, text: str | Node, cells: dict[str, Node]) -> Node:
    """An expression over names of the task and columns of the row; the columns come first."""
    marked = {key: f"# {key}" for key in cells}
    parsed = parse_description(text) if isinstance(text, str) else text
    tree = with_symbols(parsed, {key: Symbol(name) for key, name in marked.items()})
    return page.tree(tree, **{name: cells[key] for key, name in marked.items()})


# --- changes -------------------------------------------------------------------------------------------------------


def write_changes(page: Page) -> tuple[Column, ...]:
    """By how much each step changes with each input, beside the solution; folded."""
    first, last = sensitivity_columns(page.given)
    columns = [symbol for symbol in page.given.inputs if symbol != page.given.rounding]
    head = page.rows.heads["solution"]
    for number, symbol in enumerate(columns):
        unit = "0.1°" if page.dimensions[symbol].unit.kind == "angle" else "0.1 %"
        page.put(head, first + number, f"d{plain(symbol)} {unit}", styles.SECTION)
    found = changes(page.given, page.dimensions)

    def cell(step: str, column: str) -> CellRef:
        return CellRef(page.rows.of["solution", step], first + columns.index(column), True, True)

    places = {mark(step, column): cell(step, column) for step, column in found}
    for (step, column), node in found.items():
        value = formula("IFERROR(value,NA())", value=with_symbols(node, places))
        at = cell(step, column)
        page.formula(at.row, at.col, value, styles.numbered(styles.RESULT, "0.0E+00"))
    return (Column(first, last, 14, level=1),)
