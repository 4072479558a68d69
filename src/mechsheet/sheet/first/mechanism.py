"""The first sheet, where a person works: dimensions, modes, the position shown, results; drawing and charts beside them."""

from __future__ import annotations

from livesheet.formula.nodes import Call, CellRef, Node, Number, RangeRef, Symbol, Text
from livesheet.workbook import (
    Anchor,
    Area,
    Column,
    Control,
    PrintSetup,
    Sheet,
    Style,
    Validation,
)
from mechsheet.kinematics.equations import Group, System
from mechsheet.kinematics.newton.system import CLOSED
from mechsheet.model import Dimension
from mechsheet.sheet import styles
from mechsheet.sheet.cells import ROW_HEIGHT
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.checks.extremes import Extremes
from mechsheet.sheet.columns.bands import tolerance_symbol
from mechsheet.sheet.columns.lowering import in_pass
from mechsheet.sheet.deleted import sheets_of
from mechsheet.sheet.findings.inputs import marks_of
from mechsheet.sheet.first.blocks import (
    MEANING_WIDTH,
    Writer,
    band_here,
    quantity_style,
    value_style,
    while_sheets_are_there,
    write_bands,
    write_below,
    write_legend,
    write_summaries,
)
from mechsheet.sheet.first.verdicts import write_verdicts
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import (
    CHARTS,
    INPUT_BLOCKS,
    LEGEND_ROW,
    MARGIN,
    MEANING,
    SYMBOL,
    TOLERANCE,
    UNIT,
    VALUE,
    VERDICT_ROW,
    Plan,
)
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.shown import input_validation, label_of, rich, shown_unit, words_of
from mechsheet.sheet.table.positions import decimals_of_kind, decimals_of_unit
from mechsheet.sheet.table.status import while_inputs_can_be
from mechsheet.sheet.table.tolerance import Tolerance
from mechsheet.words.equations import given_words
from mechsheet.words.symbols import plain

MOST_OF_CONTROL = 30_000
"""The highest number that a scroll bar or spin button reaches."""

LINE_HEIGHT = 34.0
"""The line under the title may take two lines of text."""


def mechanism_sheet(
    plan: Plan,
    checks: Checks,
    extremes: Extremes,
    tolerance: Tolerance,
    controls: tuple[Control, ...],
) -> Sheet:
    """The sheet, with the controls that others have made for it."""
    writer = Writer(plan, plan.main)
    mechanism = plan.mechanism
    writer.put(0, 0, mechanism.title.of(plan.language), styles.TITLE)
    source = mechanism.source.of(plan.language)
    if source:
        writer.put(VERDICT_ROW, CHARTS, plan.text("source", source=source), styles.SUBTITLE)
    write_legend(writer)
    _position(writer)
    _dimensions(writer)
    write_summaries(writer)
    _sweep(writer)
    _given_elsewhere(writer)
    _assembly(writer)
    _variables(writer)
    write_bands(writer, tolerance)
    write_verdicts(writer, checks, extremes)
    for row, marked in marks_of(plan).items():
        writer.formula(row, MARGIN, marked, styles.MARK)
    _derived(writer)
    write_below(writer)
    return Sheet(
        plan.main,
        tuple(writer.cells),
        tuple(while_sheets_are_there(writer)),
        columns=(
            Column(SYMBOL, SYMBOL, 12),
            Column(VALUE, VALUE, 14),
            Column(UNIT, UNIT, 8),
            Column(TOLERANCE, TOLERANCE, 9),
            Column(MEANING, MEANING, MEANING_WIDTH),
            Column(MARGIN, MARGIN, 3),
        ),
        # given, not left to the program: rows with subscripts would be higher than others, and charts hang on rows
        row_heights=(
            (0, 26.0),
            (VERDICT_ROW, LINE_HEIGHT),
            *((row, writer.heights.get(row, float(ROW_HEIGHT))) for row in range(LEGEND_ROW, _last_row(plan) + 1)),
        ),
        merges=tuple(writer.merges),
        controls=controls,
        validations=tuple(writer.validations),
        conditionals=tuple(writer.conditionals),
        freeze=(LEGEND_ROW + 1, 0),  # what has become amber or red is said there: in sight wherever one types
        selected=_first_input(plan),
        gridlines=False,
        tab_color="1F4E79",
        print_setup=PrintSetup(footer=plan.footer, fit_height=1),
    )


def _last_row(plan: Plan) -> int:
    return max(row for block in plan.blocks.values() for row in (block.row, *block.rows.values()))


def _first_input(plan: Plan) -> tuple[int, int]:
    rows = plan.blocks["dimensions"].rows.values()
    return (next(iter(rows), plan.blocks["position"].row + 1), VALUE)


# --- blocks ------------------------------------------------------------------------------------------------------


def _dimensions(writer: Writer) -> None:
    plan = writer.plan
    rows = plan.blocks["dimensions"].rows
    listed = [dim for dim in plan.mechanism.dimensions if dim.symbol in rows]
    tolerated = any(dim.tolerance is not None or tolerance_symbol(dim.symbol) in plan.at.spots for dim in listed)
    writer.heading("dimensions", plan.text("head.tolerance") if tolerated else None)
    for dim in listed:
        row = rows[dim.symbol]
        if not isinstance(dim.value, float):
            _from_synthesis(writer, dim, row)
            continue
        writer.line(row, rich(dim.symbol), dim.unit.text, label_of(plan, dim))
        value = dim.shown if dim.shown is not None else dim.unit.written(dim.value)
        writer.put(row, VALUE, value, styles.INPUT)
        read = tolerance_symbol(dim.symbol) in plan.at.spots
        writer.put(row, TOLERANCE, dim.tolerance, styles.INPUT if read else styles.UNIT)
        if read:
            title, message = plan.text("hint.tolerance.title"), plan.text("hint.tolerance")
            writer.takes(row, TOLERANCE, "decimal", title, message, ">=", Number(0.0))
        writer.validations.append(input_validation(plan, Area(row, VALUE, row, VALUE), dim.symbol))


def _from_synthesis(writer: Writer, dim: Dimension, row: int) -> None:
    """A dimension that the synthesis finds: no number while its task has no solution."""
    plan = writer.plan
    label = label_of(plan, dim)
    said = plan.text("synthesis.from")
    writer.line(row, rich(dim.symbol), dim.unit.text, f"{label} ({said})" if label else said)
    writer.put(row, TOLERANCE, dim.tolerance, styles.UNIT)
    value: Node = dim.value if not isinstance(dim.value, float) else Text("")
    value = Call("DEGREES", (value,)) if dim.unit.in_degrees else value
    solved = formula("IF(unsolved>0,NA(),value)", unsolved=there(plan.places.unsolved).cell, value=value)
    writer.formula(row, VALUE, solved, value_style(plan, dim.unit))


def _derived(writer: Writer) -> None:
    plan = writer.plan
    writer.heading("derived")
    rows = plan.blocks["derived"].rows
    for dim in plan.mechanism.dimensions:
        if not isinstance(dim.value, float) and dim.symbol in rows:
            row = rows[dim.symbol]
            writer.line(row, rich(dim.symbol), dim.unit.text, label_of(plan, dim) or dim.written)
            _result(writer, row, dim.value, dim.unit.in_degrees, value_style(plan, dim.unit))
    for equation in plan.equations.constants:
        row = rows[equation.symbol]
        unit = plan.mechanism.shown(equation.unit)
        writer.line(row, rich(equation.symbol), unit.text, equation.label.of(plan.language))
        tolerance = equation.symbol == plan.equations.tolerance
        style = styles.numbered(styles.RESULT, "0.0E+00") if tolerance else value_style(plan, equation.unit)
        # every group compares with what counts as zero: while an input cannot be, none closes
        value = while_inputs_can_be(plan, equation.says) if tolerance else equation.expression
        _result(writer, row, value, unit.in_degrees, style)


def _result(writer: Writer, row: int, expression: Node, degrees: bool, style: Style) -> None:
    writer.formula(row, VALUE, Call("DEGREES", (expression,)) if degrees else expression, style)


def _sweep(writer: Writer) -> None:
    plan = writer.plan
    if "sweep" not in plan.blocks:
        return
    writer.heading("sweep")
    driver = plan.mechanism.driver
    rows = plan.blocks["sweep"].rows
    unit = driver.unit.text
    degrees = driver.unit.in_degrees
    computed = not all(isinstance(quantity, float) for quantity in (driver.start, driver.step))
    shown = styles.decimals(styles.RESULT, decimals_of_kind(plan, driver.unit.kind) + 2) if computed else styles.RESULT
    for key, quantity in (("start", driver.start), ("step", driver.step)):
        writer.line(rows[key], plan.text(f"name.{key}"), unit, plan.text(f"sweep.{key}"))
        if isinstance(quantity, float):
            writer.put(rows[key], VALUE, driver.unit.written(quantity), styles.INPUT)
        else:
            _result(writer, rows[key], quantity, degrees, shown)
    if isinstance(driver.start, float) and driver.symbol in plan.equations.positive:
        start = rows["start"]
        writer.validations.append(input_validation(plan, Area(start, VALUE, start, VALUE), driver.symbol))
    writer.line(rows["stop"], plan.text("name.stop"), unit, plan.text("sweep.stop", rows=plan.rows))
    drivers = plan.at.column(driver.symbol, plan.main)  # whose last row may be deleted
    writer.formula(rows["stop"], VALUE, formula("INDEX(drivers,ROWS(drivers))", drivers=drivers), shown)
    step = rows["step"]
    writer.validations.append(
        Validation(
            Area(step, VALUE, step, VALUE),
            "custom",
            low=formula("cell<>0", cell=CellRef(step, VALUE)),
            error_title=plan.text("hint.number.title"),
            error_message=plan.text("hint.step"),
        )
    )


def _given_elsewhere(writer: Writer) -> None:
    """The driver's speed and acceleration, where they are the same in every row; masses and loads."""
    plan = writer.plan
    for key in INPUT_BLOCKS:
        if key not in plan.blocks:
            continue
        writer.heading(key)
        for symbol, row in plan.blocks[key].rows.items():
            dim = next(dim for dim in plan.mechanism.dimensions if dim.symbol == symbol)
            named = symbol == dim.driver_key or dim is plan.mechanism.flywheel
            name = plan.text(f"name.{symbol}") if named else rich(symbol)
            writer.line(row, name, dim.unit.text, given_words(plan.mechanism, plan.language, dim))
            if isinstance(dim.value, float):
                writer.put(row, VALUE, dim.shown if dim.shown is not None else dim.value, styles.INPUT)
                writer.validations.append(input_validation(plan, Area(row, VALUE, row, VALUE), symbol))
            else:
                shown = styles.decimals(styles.RESULT, decimals_of_unit(plan, dim.unit))
                _result(writer, row, dim.value, dim.unit.in_degrees, shown)


def _assembly(writer: Writer) -> None:
    plan = writer.plan
    if "assembly" not in plan.blocks:
        return
    writer.heading("assembly")
    for group in plan.equations.groups:
        if not group.mode:
            continue
        row = plan.blocks["assembly"].rows[group.mode]
        writer.line(row, rich(group.mode), "", None)
        writer.formula(row, MEANING, _mode_words(plan, group, row), styles.LABEL_SAID)
        if group.follows is not None:
            mode = formula("IF(unsolved>0,NA(),mode)", unsolved=there(plan.places.unsolved).cell, mode=group.follows)
            writer.formula(row, VALUE, mode, styles.RESULT)
            continue
        writer.put(row, VALUE, float(group.mode_value), styles.INPUT)
        choices = tuple(str(value) for value in group.mode_values)
        writer.takes(row, VALUE, "list", plan.text("hint.mode.title"), _mode_hint(plan, group), choices=choices)


def _mode_hint(plan: Plan, group: Group) -> str:
    return plan.text("hint.mode") if group.system is None else plan.text("hint.choice", most=len(group.assemblies))


def _mode_words(plan: Plan, group: Group, row: int) -> Node:
    if group.system is not None:
        return start_words(plan, group.system)
    plus, minus = (Text(words.of(plan.language)) for words in group.assemblies)
    return formula("IF(cell>0,plus,minus)", cell=CellRef(row, VALUE, True, True), plus=plus, minus=minus)


def start_words(plan: Plan, system: System) -> Node:
    """Where the group starts, as the passes from the start values have it."""
    parts: list[Node | str] = [f"{plan.text('newton.start')} "]
    for index, (unknown, variable) in enumerate(zip(system.unknowns, system.variables, strict=True)):
        value: Node = Symbol(in_pass(unknown, 0))
        unit = plan.mechanism.shown(plan.equations.of(variable).unit)
        shown = formula("DEGREES(value)", value=value) if unit.in_degrees else value
        digits = 1 if unit.in_degrees else 3
        parts += [
            f"{', ' if index else ''}{plain(variable)} = ",
            formula("ROUND(shown,digits)", shown=shown, digits=digits),
        ]
        parts.append(unit.text if unit.in_degrees else "")
    arrived = formula("residual<=closed", residual=Symbol(in_pass(system.residual, 0)), closed=CLOSED)
    return formula("IFERROR(IF(arrived,words,nowhere),nowhere)", arrived=arrived, words=joined(*parts),
                   nowhere=plan.text("position.nowhere"))  # fmt: skip


def _at_position(plan: Plan, column: RangeRef) -> Node:
    """The value of a column in the row of the position shown; #N/A where there is no such position."""
    position, numbers = there(plan.places.position).cell, there(plan.places.number).whole(plan.main)
    return formula("INDEX(column,MATCH(position,numbers,0))", column=column, position=position, numbers=numbers)


def _position(writer: Writer) -> None:
    plan = writer.plan
    writer.heading("position")
    rows = plan.blocks["position"].rows
    driver = plan.mechanism.driver
    last = plan.rows - 1
    writer.line(rows["position"], plan.text("name.position"), "", None)
    before, after = plan.text("position.number", last="#").split("#")
    number = joined(before, formula("rows-1", rows=plan.places.rows.cell), after)
    writer.formula(rows["position"], MEANING, number, styles.LABEL_SAID)
    writer.put(rows["position"], VALUE, float(plan.first_shown), styles.INPUT)
    title, message = plan.text("hint.position.title"), plan.text("hint.position", last=last)
    writer.takes(rows["position"], VALUE, "list", title, message, low=there(plan.places.number).whole(plan.main))
    writer.line(rows[driver.symbol], rich(driver.symbol), driver.unit.text, plan.text("position.driver"))
    writer.formula(
        rows[driver.symbol],
        VALUE,
        _at_position(plan, plan.at.column(driver.symbol, plan.main)),
        value_style(plan, driver.unit),
    )
    writer.line(rows["status"], plan.text("head.status"), "", "")
    status = _at_position(plan, plan.places.status.whole(plan.main))
    said = formula("IFERROR(status,nowhere)", status=status, nowhere=plan.text("position.nowhere"))
    writer.formula(rows["status"], VALUE, said, styles.VERDICT)
    for kind in plan.arrows:
        row = rows[f"show_{kind}"]
        writer.line(row, plan.text("name.arrows"), "", plan.text(f"position.show_{kind}"))
        writer.put(row, VALUE, 1.0, styles.INPUT)
        title, message = plan.text(f"arrows.{kind}"), plan.text(f"position.show_{kind}")
        writer.takes(row, VALUE, "list", title, message, choices=("1", "0"))


def _variables(writer: Writer) -> None:
    plan = writer.plan
    writer.heading("variables", plan.text("head.tolerance") if plan.banded else None)
    for symbol, row in plan.blocks["variables"].rows.items():
        unit = plan.unit_of(symbol)
        writer.line(row, rich(symbol), shown_unit(plan, symbol), words_of(plan, symbol))
        node = _at_position(plan, plan.at.column(symbol, plan.main))
        writer.needs[row] = sheets_of(plan, symbol)
        style = quantity_style(plan, unit)
        if symbol in plan.shown_forces:
            style = styles.decimals(styles.RESULT, decimals_of_unit(plan, unit))
        if symbol in plan.band_decimals:
            style = styles.decimals(styles.RESULT, plan.band_decimals[symbol])
        writer.formula(row, VALUE, node, style)
        band_here(writer, symbol, row)


def _motion_controls(plan: Plan) -> tuple[Control, ...]:
    """A scroll bar in the row of the speed, or of a motion law's duration, where it is a whole number: controls count in
    these."""
    found = []
    for dim in plan.mechanism.dimensions:
        value = dim.shown
        if dim.driver_key not in ("speed", "duration") or value is None or value < 1 or value != int(value):
            continue
        high = next(high for power in range(9) for n in (1, 2, 5) if (high := n * 10**power) >= 2 * value)
        if high <= MOST_OF_CONTROL:
            row, low = plan.blocks["motion"].rows[dim.symbol], int(dim.driver_key == "duration")
            name = f"{dim.driver_key} scroll bar"
            found.append(
                Control("scroll", name, Anchor(row, TOLERANCE, 66, 20), row, VALUE, low, high, 1, high // 10 or 1)
            )
    return tuple(found)


def controls(plan: Plan) -> tuple[Control, ...]:
    """The scroll bar and the spin button of the position cell; a scroll bar beside the driver's speed or duration."""
    if plan.rows < 2:
        return ()
    return *_motion_controls(plan), *position_controls(plan, Anchor(2, CHARTS, 350, 20), VALUE, MARGIN)


def position_controls(plan: Plan, bar: Anchor, value: int, button: int) -> tuple[Control, Control]:
    """The scroll bar of the position cell and its spin button; `value`, `button`: their columns in the position's row."""
    row = plan.blocks["position"].rows["position"]
    last = min(plan.rows - 1, MOST_OF_CONTROL)
    page = max(1, last // 12)
    return (
        Control("scroll", "position scroll bar", bar, row, value, 0, last, 1, page),
        Control("spin", "position spin button", Anchor(row, button, 18, 20), row, value, 0, last, 1, page, False),
    )
