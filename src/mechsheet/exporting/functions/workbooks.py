"""Workbooks whose tables call functions: LAMBDA names in an .xlsx, Basic in an .ods, VBA in a module beside an .xlsx (Excel
keeps no macros in that). Extra files beside the default one.

They are the default workbook with other formulas in its two-way tables, a sheet that lists the functions and calls each over
the sweep beside the table of positions, and a line on the first sheet that says what the file needs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from livesheet.formula.names import folded
from livesheet.formula.nodes import Call, CellRef, Node, Number, Text
from livesheet.said import Words, say
from livesheet.workbook import Area, Cell, Conditional, Fill, Module, Sheet, Workbook
from mechsheet.compiled import Compiled
from mechsheet.exporting.functions.all_functions import (
    TABLE_KEY,
    Function,
    functions_of,
    in_degrees,
    is_of_a_function,
    main_table,
    variable_key,
)
from mechsheet.exporting.functions.basic import function_names, introduction, module, refuse_synthesis
from mechsheet.exporting.functions.lambdas import modes_read, named_functions
from mechsheet.exporting.functions.lesson import chain_of
from mechsheet.exporting.functions.routines import Source
from mechsheet.exporting.functions.sheets import LESSON_TITLE, LIST_TITLE, functions_sheet, lesson_sheet
from mechsheet.kinematics.equations import need_one_position
from mechsheet.model import TableRequest
from mechsheet.sheet import styles
from mechsheet.sheet.as_typed import with_typed_constants
from mechsheet.sheet.asked.two_way import CHART_COLUMNS, FIRST, HEAD_ROW
from mechsheet.units import Unit
from mechsheet.words.catalogue import words

NEEDS_ROW = 3
"""The row of the first sheet, empty otherwise, that says what the file needs."""

NEEDS = replace(styles.SUBTITLE, name="", bold=True, italic=False, color=styles.INK)

TABLES_FROM = 2
"""Sheets before those of two-way tables: the first one and the table of positions."""

MODULE = "Mechsheet"
"""What the module of Basic is called."""


@dataclass(frozen=True, slots=True)
class Form:
    """A way of putting functions into a workbook.

    suffix  the file's ending, after the mechanism's name
    tried   the first sheet says that the functions work where one of them has a value; not where programs that lack
            something do not even understand the formula that would try it
    """

    name: str
    suffix: str
    tried: bool = False


FORMS = {
    form.name: form
    for form in (
        Form("basic", "-basic.ods", tried=True),
        Form("lambda", "-lambda.xlsx"),
        Form("vba", "-vba.xlsx", tried=True),
    )
}
"""Name of the option -> form."""


def functions_workbook(compiled: Compiled, form: str) -> Workbook:
    """The workbook, its formulas without values yet; its plan is the default one's.

    An engine computes functions as LAMBDA in all forms.

    form  "basic", "lambda" or "vba"
    Raises MechanismError when the mechanism cannot be solved.
    """
    compiled = in_sheets(compiled)
    refuse_synthesis(compiled.mechanism, say("workbooks with functions"))
    need_one_position(
        compiled.equations, say("a workbook with functions cannot hold this"), "functions", say("`export --to vba` can")
    )
    source = Source(compiled)
    taken = {folded(name.name) for name in compiled.layout.names}
    functions = functions_of(source, compiled.mechanism.language, taken)
    names = function_names(functions) if form != "lambda" else {function.key: function.name for function in functions}
    work = _Work(compiled, source, form, {function.key: function for function in functions}, names)
    return with_typed_constants(work.workbook(compiled.layout))


def module_beside(workbook: Workbook) -> bytes:
    """The module of a workbook of the form "vba", for Excel to import: ASCII, lines ended as Windows does."""
    return workbook.modules[0].text.replace("\n", "\r\n").encode("ascii")


def without_module(workbook: Workbook) -> Workbook:
    """The same, computed already, as it is written where its module is a file beside it."""
    return replace(workbook, functions=(), modules=())


def in_sheets(compiled: Compiled) -> Compiled:
    """The same in the layout of several sheets: functions need the sheets of tables."""
    if compiled.mechanism.layout == "sheets":
        return compiled
    return Compiled(replace(compiled.mechanism, layout="sheets"))


def _free_title(title: Words, sheets: Sequence[Sheet], language: str) -> str:
    """The title, with a number where a sheet has it."""
    taken, base = {sheet.title.casefold() for sheet in sheets}, title.of(language)
    return next(name for name in (base, f"{base} 2", f"{base} 3") if name.casefold() not in taken)


class _Work:
    """The workbook while it is being changed."""

    def __init__(
        self, compiled: Compiled, source: Source, form: str, functions: dict[str, Function], names: dict[str, str]
    ) -> None:
        self.compiled = compiled
        self.plan = plan = compiled.plan
        self.source = source
        self.form = form
        self.functions = functions
        self.names = names
        self.taken = {folded(name.name) for name in plan.names}

    def mode_cell(self, symbol: str) -> Node:
        """The cell of a configuration, as a name's formula reads it."""
        return self.plan.at.reference(symbol, "", None)

    def workbook(self, workbook: Workbook) -> Workbook:
        """The workbook with functions."""
        plan, language = self.plan, self.plan.language
        functions = list(self.functions.values())
        tables = {id(sheet): request for sheet, request in self.tables(workbook)}
        sheets = [self.first_sheet(workbook.sheets[0])]
        sheets += [
            self.table(sheet, tables[id(sheet)]) if id(sheet) in tables else sheet for sheet in workbook.sheets[1:]
        ]
        title = _free_title(LIST_TITLE, sheets, language)
        calls = {function.key: self.call(function, title) for function in functions if not function.basic}
        listed = functions_sheet(plan, self.source, functions, self.names, calls, title)
        sheets.insert(self.tables_from + len(plan.mechanism.tables), listed)
        if chain := chain_of(self.compiled):
            its_title = _free_title(LESSON_TITLE, sheets, language)
            sheets.insert(self.tables_from, lesson_sheet(plan, self.source, chain, self.names, its_title))
        modules: tuple[Module, ...] = ()
        if self.form != "lambda":
            opening = introduction(self.source, tuple(functions), language)
            name = MODULE if self.form == "vba" else ""
            modules = (Module(MODULE, module(functions, opening, name, language)),)
        named = named_functions(functions, self.names, self.mode_cell if self.form == "lambda" else None, self.taken)
        return replace(workbook, sheets=tuple(sheets), functions=named, modules=modules)

    @property
    def tables_from(self) -> int:
        """Where the sheets of two-way tables begin: behind positions, velocities and forces."""
        return TABLES_FROM + bool(self.plan.rates) + bool(self.plan.forces)

    def tables(self, workbook: Workbook) -> list[tuple[Sheet, TableRequest]]:
        """The sheets of two-way tables that functions can compute."""
        mechanism = self.plan.mechanism
        sheets = workbook.sheets[self.tables_from : self.tables_from + len(mechanism.tables)]
        pairs = zip(sheets, mechanism.tables, strict=True)
        return [(sheet, request) for sheet, request in pairs if is_of_a_function(mechanism, request)]

    def first_sheet(self, sheet: Sheet) -> Sheet:
        """The first sheet, with a line that says what the file needs, and tries a function where that can be tried."""
        form, language = FORMS[self.form], self.plan.language
        needs = words(language, f"function.{form.name}.needs", name=self.plan.mechanism.name)
        warning = replace(styles.WARN, name="")
        if not form.tried:
            return replace(sheet, cells=(*sheet.cells, Cell(NEEDS_ROW, 0, needs, NEEDS)))
        tried = Call("ISNUMBER", (self.checked(Call(self.names["length"], (Number(3.0), Number(4.0)))),))
        line = Call(
            "IF",
            (tried, Text(words(language, f"function.{form.name}.works", name=self.plan.mechanism.name)), Text(needs)),
        )
        rule = Conditional(Area(NEEDS_ROW, 0, NEEDS_ROW, 0), Call("NOT", (tried,)), warning)
        return replace(
            sheet,
            fills=(*sheet.fills, Fill(NEEDS_ROW, 0, line, NEEDS)),
            conditionals=(*sheet.conditionals, rule),
        )

    def table(self, sheet: Sheet, request: TableRequest) -> Sheet:
        """A two-way table whose cells call a function; it needs no helper cells."""
        count = len(request.columns)
        helpers = 1 + count + 1 + CHART_COLUMNS + 1
        formula = self.cell(request, sheet.title)
        fills = tuple(
            replace(fill, formula=formula) if (fill.row, fill.col, fill.cols) == (FIRST, 1, count) else fill
            for fill in sheet.fills
            if fill.col < helpers
        )
        return replace(
            sheet,
            fills=fills,
            cells=tuple(cell for cell in sheet.cells if cell.col < helpers),
            columns=tuple(column for column in sheet.columns if column.first < helpers),
        )

    def cell(self, request: TableRequest, sheet: str) -> Node:
        """The formula of a table's cell, as its top-left cell has it: `=AyarlıPompa(Krank, …, B$7, $A8)`."""
        driver = CellRef(FIRST, 0, col_abs=True)
        column = CellRef(HEAD_ROW, 1, row_abs=True)
        main = request == main_table(self.plan.mechanism)
        function = self.functions[TABLE_KEY if main else variable_key(request.value)]
        value = self.call(function, sheet, {request.column: column})(driver)
        return Call("DEGREES", (value,)) if not main and in_degrees(self.source, request.value) else value

    def call(self, function: Function, sheet: str, given: dict[str, Node] | None = None) -> Callable[[Node], Node]:
        """From the driver's cell (as people read it) to a call of the function with the workbook's cells."""
        plan = self.plan
        units = {dim.symbol: dim.unit for dim in plan.mechanism.dimensions}
        left_out = modes_read(function) if self.form == "lambda" else ()

        def argument(symbol: str, unit: Unit, driver: Node) -> Node:
            if symbol == plan.mechanism.driver.symbol:
                in_radians = plan.mechanism.driver.unit.in_degrees and not unit.in_degrees
                return Call("RADIANS", (driver,)) if in_radians else driver
            if given and symbol in given:
                return Call("RADIANS", (given[symbol],)) if units[symbol].in_degrees else given[symbol]
            return plan.at.reference(symbol, sheet, None)

        def called(driver: Node) -> Node:
            parts = [part for part in function.routine.parameters if part.symbol not in left_out]
            arguments = tuple(argument(part.symbol, part.unit, driver) for part in parts)
            return self.checked(Call(self.names[function.key], arguments))

        return called

    def checked(self, call: Node) -> Node:
        """A function of Basic cannot give #N/A to LibreOffice, only a text: VALUE of that is an error."""
        return Call("IFERROR", (Call("VALUE", (call,)), Call("NA"))) if self.form == "basic" else call
