"""The sheet of checks: in every row the largest gap of each group and what it lacks to come apart, and what people mistype.

The table's rows are those of the table of positions. Over each column stand its worst value and where it occurs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol, shifted, with_symbols
from livesheet.workbook import Area, Column, PrintSetup, Sheet
from mechsheet.kinematics.equations import JOINT_FORCES
from mechsheet.kinematics.numeric import runs_of
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.checks.rows import AGREES, assembly_columns, chunks_of, effort_columns, fit_columns, gap_columns
from mechsheet.sheet.checks.search_rules import DIP
from mechsheet.sheet.over_rows import LEAST, MOST, as_large_as, largest_size, over_rows
from mechsheet.sheet.places import Checked
from mechsheet.sheet.plan import DRIVER, RATES_DRIVER, STATUS, Plan
from mechsheet.sheet.quoted import ALL, formula
from mechsheet.sheet.table.positions import SYMBOL_ROW, heading
from mechsheet.words.symbols import plain

ROUNDING = 1e3
"""Lengths are equal up to so many times what counts as zero (1e-12 of the largest length): 1e-9 of it."""

TITLE_ROW, ABOUT_ROW, TYPED_ROW, ROUNDING_ROW = range(4)
GROUP_ROW = 5
"""The row over the table's headings."""

VALUE, WORDS = 2, 3
"""Columns of the values that hold for the whole table, and of what they say."""

DRIVER_COL, COUNT_COL, DATA = range(3)
"""Columns of the table: driver, stretches begun; then the checks."""

LARGEST, NAMED = 1, 2
"""Of a table of joint forces the columns behind their names: the largest size, and which are the largest so far."""

LEAP = 90.0
"""A link that turns by more [deg] from one row to the next: the rows do not show what happens between."""

Kind = Literal[
    "gap", "margin", "crossing", "leap", "assembly",
    "residual", "needed", "det",
    "velocity_size", "velocity", "acceleration_size", "acceleration", "torque", "effort", "force",
]  # fmt: skip

MEASURED: tuple[Kind, ...] = ("gap", "velocity", "acceleration", "torque")
ROUNDED: tuple[Kind, ...] = (*MEASURED, "residual")
"""What is nothing but rounding where all is well."""

ARRIVED: tuple[Kind, ...] = ("residual", "needed", "det")
"""What is said of where Newton's method has arrived."""

COUNTED: tuple[Kind, ...] = ("leap", "assembly")
"""Columns of 0 and 1."""

RATE_SIZES: tuple[Kind, ...] = ("velocity_size", "acceleration_size")
"""By what differences of rates are measured."""

SIZES: tuple[Kind, ...] = ("effort", "force", *RATE_SIZES)
"""Columns of sizes; the largest ones of forces the first sheet names."""


@dataclass(frozen=True, slots=True)
class Check:
    """One column: the number of its group, and its formula for the first row."""

    kind: Kind
    group: int
    formula: Node


class Checks:
    """The sheet, planned before any formula that reads it is written; `columns`: its checks, one a column."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.title = plan.at.titles["checks"]
        self.group_row, self.head_row, self.most_row, self.at_row, self.first = range(GROUP_ROW, GROUP_ROW + 5)
        self.last = self.first + plan.rows - 1
        first = plan.at.first
        self.columns = [Check("gap", number, node) for number, node in gap_columns(plan, self.title, first)]
        self.columns += [
            Check("margin", number, plan.at.bind(_least_nearby(symbol, plan), self.title, first))
            for number, symbol in plan.equations.margins.items()
        ]
        self.columns += [
            Check("crossing", number, self._crossed(symbol)) for number, symbol in plan.equations.crossings.items()
        ]
        self.columns += [Check("leap", 0, node) for node in _leaps(plan, self.title)]
        self.columns += [Check(*found) for found in assembly_columns(plan, self.title, CellRef(self.first, COUNT_COL))]
        self.columns += [Check(*found) for found in fit_columns(plan, self.title, first, self._next())]
        self.columns += [Check(*found) for found in effort_columns(plan, self.title, first)]

    @property
    def places(self) -> Checked:
        """Where other sheets find what is here."""
        title, rows, columns = self.title, self.plan.rows, [*enumerate(self.columns, DATA)]
        return Checked(
            Spot(title, self.first, COUNT_COL, rows), Spot(title, TYPED_ROW, VALUE), Spot(title, ROUNDING_ROW, VALUE),
            {check.group: Spot(title, self.first, col, rows) for col, check in columns if check.kind == "margin"},
            {
                check.group: (Spot(title, self.most_row, col), Spot(title, self.at_row, col))
                for col, check in columns if check.kind == "crossing"
            },
            Spot(title, self.first_force + len(self.forces) - 1, self.forces_col + NAMED) if self.forces else None,
        )  # fmt: skip

    @property
    def forces(self) -> tuple[str, ...]:
        """The joint forces of which the largest is named."""
        return self.plan.equations.equations.forces(*JOINT_FORCES)

    @property
    def forces_col(self) -> int:
        """The first column of their table, to the right of all others."""
        return DATA + len(self.columns) + 1

    @property
    def first_force(self) -> int:
        """The first row of their table: below the rows of positions, among which people insert some."""
        return self.last + 3

    def _next(self) -> CellRef:
        """The first cell of the column that comes next."""
        return CellRef(self.first, DATA + len(self.columns))

    def _crossed(self, sine: str) -> Node:
        """The sine of the angle between two lines, times that of the row before, where both rows exist: below 0 the lines
        turn parallel in between, and meet nowhere. Before the first row comes the last, where a whole turn leaves its last
        row out."""
        plan = self.plan
        here, before = (plan.at.cell(sine, self.title, plan.at.first - back) for back in range(2))
        last = CellRef(plan.at.last, plan.at.spots[sine].col, True, True, plan.table)
        said = RangeRef(*(CellRef(plan.at.first - back, STATUS, sheet=plan.table) for back in (1, 0)))
        return formula(
            'IFERROR(IF(ROW()=ROW(top),IF(whole=2,last*here,""),IF(COUNTIF(said,ok)<2,"",before*here)),"")',
            top=CellRef(self.first, DRIVER_COL, True, True), whole=plan.searched.whole.cell,
            last=last, here=here, before=before, said=said,
            ok=plan.text("status.ok"),
        )  # fmt: skip

    def worst(self, kind: Kind, group: int | None = None) -> Node:
        """The largest value of all columns of a kind (of leaps: their number), or those of a group, as another sheet reads
        it."""
        parts = self._parts(kind, group)
        return al.nested("SUM" if kind in COUNTED else "MIN" if kind == "det" else "MAX", parts) if parts else al.ZERO

    def worst_known(self, kind: Kind) -> Node:
        """The same of all columns of a kind; #N/A where no row has a value."""
        parts, worst = tuple(self._parts(kind)), self.worst(kind)
        return formula("IF(counted=0,NA(),worst)", counted=Call("COUNT", parts), worst=worst) if parts else worst

    def _parts(self, kind: Kind, group: int | None = None) -> list[Node]:
        """The cells with the largest values of such columns."""
        parts: list[Node] = []
        for first, beyond in runs_of([check.kind == kind and group in (None, check.group) for check in self.columns]):
            start, end = (CellRef(self.most_row, DATA + at, True, True, self.title) for at in (first, beyond - 1))
            parts.append(start if start == end else RangeRef(start, end))
        return parts

    def worst_at(self, kind: Kind) -> Node:
        """The driver's value where the first column of a kind with the worst value has it."""
        cols = [DATA + index for index, check in enumerate(self.columns) if check.kind == kind]
        if not cols:
            return Call("NA")
        most, places = (
            RangeRef(CellRef(row, cols[0], True, True, self.title), CellRef(row, cols[-1], True, True, self.title))
            for row in (self.most_row, self.at_row)
        )
        if len(cols) == 1:  # gnumeric finds nothing by INDEX in a single cell
            return places.start
        return formula("INDEX(places,MATCH(worst,most,0))", places=places, worst=self.worst(kind), most=most)


def checks_sheet(plan: Plan, checks: Checks) -> Sheet:
    """The sheet."""
    return _Writer(plan, checks).sheet()


class _Writer(Cells):
    def __init__(self, plan: Plan, checks: Checks) -> None:
        super().__init__(plan, checks.title)
        self.at = checks

    def sheet(self) -> Sheet:
        """The finished sheet."""
        plan, at = self.plan, self.at
        self.put(TITLE_ROW, 0, plan.text("checks.title"), styles.TITLE)
        self.put(ABOUT_ROW, 0, plan.text("checks.about"), styles.NOTE_TEXT)
        last_col = max(DATA + len(at.columns) - 1, WORDS + 4)
        self.merge(ABOUT_ROW, 0, last_col)
        self._whole()
        self._table()
        for index, check in enumerate(at.columns):
            self._column(DATA + index, check)
        self._forces()
        self._grey_where_missing()
        return Sheet(
            at.title,
            tuple(self.cells),
            tuple(self.fills),
            columns=(Column(0, 0, 13), Column(1, max(last_col, at.forces_col + NAMED), 13)),
            row_heights=((TITLE_ROW, 26.0), (ABOUT_ROW, 58.0), (at.head_row, 42.0)),
            merges=tuple(self.merges),
            conditionals=tuple(self.conditionals),
            freeze=(at.first, COUNT_COL),
            selected=(TYPED_ROW, VALUE),
            gridlines=False,
            tab_color="B8860B",
            print_setup=PrintSetup(repeat_rows=(at.group_row, at.at_row), footer=plan.footer),
        )

    # --- what holds for the whole table -----------------------------------------------------------------------

    def _whole(self) -> None:
        """Cells typed over, and what counts as rounding."""
        plan = self.plan
        for row, key in ((TYPED_ROW, "typed"), (ROUNDING_ROW, "rounding")):
            self.put(row, 0, plan.text(f"checks.{key}"), styles.LABEL)
            self.put(row, 1, None, styles.LABEL)
            self.merge(row, 0, 1)
        self.formula(TYPED_ROW, VALUE, typed_over(plan), styles.decimals(styles.RESULT, 0))
        words = formula("IF(count=0,fine,look)", count=CellRef(TYPED_ROW, VALUE, True, True),
                        fine=plan.text("checks.all_formulas"), look=plan.text("checks.some_typed"))  # fmt: skip
        self.formula(TYPED_ROW, WORDS, words, styles.VERDICT)
        area = Area(TYPED_ROW, WORDS, TYPED_ROW, WORDS)
        typed = formula("count<>0", count=CellRef(TYPED_ROW, VALUE, True, True))
        self.colour(area, typed, styles.BAD)
        rounding = formula("times*tolerance", times=ROUNDING, tolerance=Symbol(plan.equations.tolerance))
        self.formula(ROUNDING_ROW, VALUE, rounding, styles.numbered(styles.RESULT, styles.ERROR.number_format))

    # --- the table --------------------------------------------------------------------------------------------

    def _table(self) -> None:
        """The driver, and how many stretches of positions have begun."""
        plan, at, first = self.plan, self.at, self.at.first
        driver = plan.at.cell(plan.mechanism.driver.symbol, at.title, plan.at.first)
        self.formula(first, DRIVER_COL, driver, styles.decimals(styles.COLUMN, 2), plan.rows)
        ok = plan.text("status.ok")
        said = CellRef(plan.at.first, STATUS, sheet=plan.table)
        counted = styles.decimals(styles.INNER, 0)
        # over the first row is nothing here, and a heading there
        begins = formula("before+IF(AND(said=ok,said_before<>ok),1,0)", before=CellRef(first - 1, COUNT_COL),
                         said=said, said_before=shifted(said, -1), ok=ok)  # fmt: skip
        self.formula(first, COUNT_COL, begins, counted, plan.rows)
        heads = (heading(plan, plan.columns[DRIVER]), plan.text("checks.begun"))
        for col, head in enumerate(heads):
            self.put(at.head_row, col, head, styles.HEAD)
        self.put(at.group_row, 0, plan.text("checks.rows"), styles.SECTION)
        for col in range(1, DATA + len(at.columns)):
            self.put(at.group_row, col, None, styles.SECTION)
        for row, key in ((at.most_row, "most"), (at.at_row, "at")):
            self.put(row, 0, plan.text(f"checks.{key}"), styles.LABEL)
            self.put(row, 1, None, styles.LABEL)
            self.merge(row, 0, COUNT_COL)

    def _column(self, col: int, check: Check) -> None:
        """The column, its head, its worst value and where it is."""
        plan, at = self.plan, self.at
        unit = self._unit(check.kind)
        words = plan.text(f"checks.{check.kind}", number=check.group)
        self.put(at.head_row, col, f"{words} [{unit}]" if unit else words, styles.HEAD)
        style = styles.decimals(styles.COLUMN, 4 if check.kind in ("margin", "crossing", *SIZES) else 0)
        style = styles.ERROR if check.kind in ROUNDED else style
        style = styles.numbered(styles.COLUMN, styles.DETERMINANT) if check.kind == "det" else style
        self.formula(at.first, col, check.formula, style, plan.rows)
        column = RangeRef(CellRef(at.first, col, True), CellRef(at.last, col, True))
        most = formula('IF(COUNT(column)=0,"",worst)', column=column, worst=Call(_WORST[check.kind], (column,)))
        self.formula(at.most_row, col, most, styles.numbered(styles.RESULT, style.number_format))
        drivers = RangeRef(CellRef(at.first, DRIVER_COL, True, True), CellRef(at.last, DRIVER_COL, True, True))
        sought: Node = al.ONE if check.kind in COUNTED else CellRef(at.most_row, col, True)
        where = formula("INDEX(drivers,MATCH(sought,column,0))", drivers=drivers, sought=sought, column=column)
        if check.kind in ROUNDED:  # where rounding is largest says nothing, and other programs round otherwise
            rounding = al.number(AGREES) if check.kind == "torque" else CellRef(ROUNDING_ROW, VALUE, True, True)
            where = formula('IF(worst>rounding,where,"")', worst=sought, rounding=rounding, where=where)
        where = formula('IFERROR(where,"")', where=where)
        self.formula(at.at_row, col, where, styles.numbered(styles.RESULT, "0.00"))

    def _forces(self) -> None:
        """Each joint force with its largest size; the names of those that are as large as any, one more in each row.

        A force normal to a guide has a sign, that in a pin is a size.
        """
        plan, at = self.plan, self.at
        normal = plan.equations.equations.forces("normal")
        forces, col, row = at.forces, at.forces_col, at.first_force
        if not forces:
            return
        for number, key in enumerate(("name", "most", "named")):
            self.put(row - 1, col + number, plan.text(f"checks.forces.{key}"), styles.HEAD)
        for number, name in enumerate(forces):
            self.put(row + number, col, plain(name), styles.LABEL)
            column = Symbol(ALL + name)
            largest = over_rows(MOST, column)
            if name in normal:
                largest = largest_size(largest, over_rows(LEAST, column))
            self.formula(row + number, col + LARGEST, largest, styles.decimals(styles.COLUMN, 4))
        ends = (CellRef(each, col + LARGEST, True, True) for each in (row, row + len(forces) - 1))
        most = formula("MAX(sizes)", sizes=RangeRef(*ends))
        own = formula('IF(size>=least," "&name,"")', size=CellRef(row, col + LARGEST, False, True),
                      least=as_large_as(most), name=CellRef(row, col, False, True))  # fmt: skip
        self.formula(row, col + NAMED, own, styles.LABEL_SAID)
        if len(forces) > 1:
            further = formula("before&own", before=CellRef(row, col + NAMED, False, True), own=shifted(own, 1))
            self.formula(row + 1, col + NAMED, further, styles.LABEL_SAID, len(forces) - 1)

    def _unit(self, kind: Kind) -> str:
        """The unit of a column."""
        plan = self.plan
        if kind in ("crossing", "torque", *RATE_SIZES, *COUNTED, *ARRIVED):
            return ""
        if kind == "effort":
            return plan.equations.of(plan.efforts[0]).unit.text
        dynamics = plan.mechanism.dynamics
        return dynamics.force_unit if kind == "force" and dynamics else plan.mechanism.length_unit

    def _grey_where_missing(self) -> None:
        """Rows that do not exist: their gaps are no numbers."""
        gaps = [DATA + index for index, check in enumerate(self.at.columns) if check.kind == "gap"]
        if gaps:
            missing = formula("ISTEXT(gap)", gap=CellRef(self.at.first, gaps[-1], col_abs=True))
            area = Area(self.at.first, 0, self.at.last, DATA + len(self.at.columns) - 1)
            self.colour(area, missing, styles.MISSING)


_WORST = {"gap": "MAX", "margin": "MIN", "crossing": "MIN", "leap": "SUM", "velocity": "MAX", "acceleration": "MAX"}
_WORST |= {"assembly": "SUM", "residual": "MAX", "needed": "MAX", "det": "MIN"}
_WORST |= dict.fromkeys(("torque", *SIZES), "MAX")


def typed_over(plan: Plan) -> Node:
    """How many cells of the tables hold no formula any more."""
    last, listed = len(plan.columns) - 1, [column.col for column in plan.columns if column.kind == "listed"]
    cols = [(STATUS if plan.mechanism.driver.values else 0, last)]
    if listed:
        cols = [(STATUS, listed[0] - 1), (listed[-1] + 1, last)]
    areas = [
        RangeRef(CellRef(plan.at.first, a, True, True, plan.table), CellRef(plan.at.last, b, True, True, plan.table))
        for a, b in cols
        if a <= b
    ]
    for key, columns in (("rates", plan.rates), ("forces", plan.forces), ("iterations", plan.iterations)):
        if columns:
            title = plan.at.titles[key]
            corners = (plan.at.first, RATES_DRIVER), (plan.at.last, columns[-1].col)
            areas.append(RangeRef(*(CellRef(row, col, True, True, title) for row, col in corners)))
    return al.total(_without_formula(each) for each in areas)


def sheets_in_rows(plan: Plan) -> dict[str, CellRef]:
    """The sheets that have a row for each row of the table of positions, and where the driver stands in the first one."""
    begun = plan.checked.begun
    found = {begun.sheet: CellRef(begun.row, DRIVER_COL, True, True, begun.sheet)}
    beside = {"rates": plan.rates, "forces": plan.forces, "iterations": plan.iterations, "tolerance": plan.bands}
    titles = [plan.at.titles[key] for key, columns in beside.items() if columns]
    return found | {title: CellRef(plan.at.first, RATES_DRIVER, True, True, title) for title in titles}


def rows_apart(plan: Plan) -> list[Node]:
    """Of each, 0 where it has the rows of the table: not where somebody has inserted rows in one sheet alone."""
    own = Symbol(ALL + plan.mechanism.driver.symbol)
    return [
        formula(
            "IFERROR(IF(ROWS(rows)=count,SUMPRODUCT((rows<>own)*1),1),0)", own=own, count=plan.searched.rows.cell,
            rows=RangeRef(top, replace(top, row=top.row + plan.rows - 1)),
        )
        for top in sheets_in_rows(plan).values()
    ]  # fmt: skip


def _without_formula(area: RangeRef) -> Node:
    """The cells in columns with a heading: one without is a person's own, or still empty. 0 in programs that do not ask a
    whole range."""
    heads = (replace(corner, row=SYMBOL_ROW) for corner in (area.start, area.end))
    return formula('IFERROR(SUMPRODUCT((1-ISFORMULA(area))*(heads<>"")),0)', area=area, heads=RangeRef(*heads))


def _least_nearby(margin: str, plan: Plan) -> Node:
    """The margin of a row that exists between two others: of the parabola through them where that dips between."""
    before, here, after = (plan.at.cell(margin, plan.at.titles["checks"], plan.at.first + step) for step in (-1, 0, 1))
    said = RangeRef(*(CellRef(plan.at.first + step, STATUS, sheet=plan.table) for step in (-1, 1)))
    least = with_symbols(DIP, {"before": before, "here": here, "after": after})
    return formula('IFERROR(IF(COUNTIF(said,ok)<3,"",least),"")', least=least, said=said, ok=plan.ok)


def _leaps(plan: Plan, sheet: str) -> list[Node]:
    """1 in a row that some link reaches by turning more than `LEAP` since the row before; written for the first row."""
    driver = plan.mechanism.driver.symbol
    angles = (link.angle_symbol for link in plan.mechanism.links[1:])
    tied = plan.equations.equations.tied
    symbols = [name for name in angles if name not in (driver, *tied) and plan.equations.of(name).reads]
    first = plan.at.first
    turned = [
        formula("ABS(here-before)", here=plan.at.cell(name, sheet, first), before=plan.at.cell(name, sheet, first - 1))
        for name in symbols
    ]
    most = LEAP if plan.mechanism.angle_unit.in_degrees else round(math.radians(LEAP), 4)
    return [
        formula("IFERROR(IF(largest>most,1,0),0)", largest=Call("MAX", tuple(chunk)), most=most)
        for chunk in chunks_of(turned)
    ]
