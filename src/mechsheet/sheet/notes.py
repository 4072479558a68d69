"""The sheet of notes: how to use the workbook, what the colours mean, the assumptions, the links, and every equation.

Beside each equation stands the formula of its cell, as text.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from livesheet.formula.nodes import Node
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_name, column_letters
from livesheet.workbook import Area, Cell, Column, Content, PrintSetup, Rich, Sheet, Style, Workbook
from mechsheet.kinematics.equations import BANDS, FORCES, RATES
from mechsheet.model import Cartesian, Distances, GivenPoint, Joint, Polar, Quantity
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.cells import Cells, wrapped_lines
from mechsheet.sheet.columns.lowering import Assignment
from mechsheet.sheet.mathematics import LoopRates, Part, symbol_parts, written
from mechsheet.sheet.plan import HIDDEN, STATUS, Plan
from mechsheet.sheet.shown import words_of
from mechsheet.sheet.table.positions import column_unit, group_title, mathematics
from mechsheet.units import DEG, NUMBER
from mechsheet.words.equations import body_words, link_words
from mechsheet.words.symbols import plain

SYMBOL, UNIT, EQUATION, MEANING, PLACE, FORMULA = range(6)
WIDTHS = (13, 9, 78, 44, 18)
"""Widths of the columns in characters; that of the cells' formulas is beside them, and not printed."""
FORMULA_WIDTH = 90

LINE = 14.0
"""Height of one line of text [points]."""

PARAGRAPHS = (
    "inputs",
    "position",
    "modes",
    "sweep",
    "positions",
    "rates",
    "forces",
    "tolerance",
    "arrows",
    "charts",
    "tables",
    "summaries",
    "checks",
    "grashof",
    "extremes",
    "hidden",
    "missing",
    "delete",
)
ASSUMPTIONS = ("planar", "angles", "radians", "cosines", "continuous", "constant_mode", "rounding")
RATE_ASSUMPTIONS = ("rates", "coefficients", "dead")
FORCE_ASSUMPTIONS = ("forces", "rigid")
COLOURS: tuple[tuple[str, Style], ...] = (
    ("input", styles.INPUT),
    ("result", styles.RESULT),
    ("good", styles.GOOD),
    ("warning", styles.WARN),
    ("bad", styles.BAD),
    ("current", styles.CURRENT),
    ("no_position", styles.MISSING),
)


def notes_sheet(plan: Plan) -> tuple[Sheet, dict[int, Spot]]:
    """The sheet, and by row where the quantity stands whose equation it has."""
    page = _Page(plan)
    page.opening()
    page.colours()
    rates = RATE_ASSUMPTIONS if plan.equations.equations.turning else ()
    page.list_of("assumptions", ASSUMPTIONS + rates + (FORCE_ASSUMPTIONS if plan.forces else ()))
    page.links()
    page.equations()
    sheet = Sheet(
        page.title,
        tuple(page.cells),
        columns=tuple(Column(col, col, width) for col, width in enumerate((*WIDTHS, FORMULA_WIDTH))),
        row_heights=tuple(sorted(page.heights.items())),
        merges=tuple(page.merges),
        gridlines=False,
        tab_color="6B7280",
        print_setup=PrintSetup(footer=plan.footer, area=Area(0, 0, page.row - 1, PLACE)),
    )
    return sheet, page.places


class _Page(Cells):
    """The sheet, line by line."""

    def __init__(self, plan: Plan) -> None:
        super().__init__(plan, plan.at.titles["notes"])
        self.row = 0
        self.places: dict[int, Spot] = {}

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook."""
        return self.plan.text(f"notes.{key}", **parts)

    # --- lines ------------------------------------------------------------------------------------------------

    def line(self, contents: dict[int, Content], style: Style) -> None:
        """A line of cells, as high as its longest text needs."""
        lines = 1
        for col, content in contents.items():
            self.put(self.row, col, content, style)
            lines = max(lines, wrapped_lines(content, WIDTHS[col]))
        if lines > 1:
            self.heights[self.row] = LINE * lines + 4
        self.row += 1

    def across(self, text: str, style: Style) -> None:
        """A text over all columns."""
        self.put(self.row, SYMBOL, text, style)
        self.merge(self.row, SYMBOL, PLACE)
        lines = wrapped_lines(text, sum(WIDTHS))
        self.heights[self.row] = max(LINE * lines + (4 if lines > 1 else 0), style.size * 1.6)
        self.row += 1

    def heading(self, text: str) -> None:
        """A heading after an empty line."""
        self.row += 1
        self.cells += [Cell(self.row, col, text if col == SYMBOL else None, styles.SECTION) for col in range(PLACE + 1)]
        self.row += 1

    def list_of(self, key: str, entries: tuple[str, ...]) -> None:
        """A heading and its paragraphs."""
        self.heading(self.text(key))
        for entry in entries:
            self.across("•  " + self.text(f"{key}.{entry}", **self._facts()), styles.NOTE_TEXT)

    def _facts(self) -> dict[str, object]:
        plan = self.plan
        titles = plan.at.titles
        return {
            "notes": titles["notes"],
            "rows": plan.rows,
            "last": plan.rows - 1,
            "driver": plain(plan.mechanism.driver.symbol),
            "unit": plan.mechanism.length_unit,
            "checks": titles["checks"],
            "extremes": titles["extremes"],
            "hidden": ", ".join(titles[key] for key in HIDDEN if key in titles),
            "positions": titles["positions"],
            "mechanism": titles["mechanism"],
            "table": plan.text("sheet.table"),
            "rates": titles.get("rates", ""),
            "forces": titles.get("forces", ""),
            "tolerance": titles.get("tolerance", ""),
            "speed": plain(plan.mechanism.driver_rates[0]),
            "acceleration": plain(plan.mechanism.driver_rates[1]),
        }

    # --- parts ------------------------------------------------------------------------------------------------

    def opening(self) -> None:
        """Title, source, how to use."""
        plan = self.plan
        self.across(plan.mechanism.title.of(plan.language), styles.TITLE)
        source = plan.mechanism.source.of(plan.language)
        if source:
            self.across(plan.text("source", source=source), styles.SUBTITLE)
        left_out = set()
        if all(request.of_summary for request in plan.mechanism.tables):
            left_out.add("tables")
        if not any(request.of_summary for request in plan.mechanism.tables):
            left_out.add("summaries")
        if not any(group.mode for group in plan.equations.groups):
            left_out.add("modes")
        if not plan.mechanism.driver.stepped:
            left_out.add("sweep")
        if not plan.rates:
            left_out.add("rates")
        if not plan.forces:
            left_out.add("forces")
        if not plan.bands:
            left_out.add("tolerance")
        if not plan.arrows:
            left_out.add("arrows")
        if not plan.found.four_bars:
            left_out.add("grashof")
        self.list_of("use", tuple(entry for entry in PARAGRAPHS if entry not in left_out))

    def colours(self) -> None:
        """A sample of each colour beside its meaning."""
        self.heading(self.text("colours"))
        for key, style in COLOURS:
            self.put(self.row, SYMBOL, self.text(f"sample.{key}"), styles.centred(style))
            self.put(self.row, UNIT, self.text(f"colour.{key}"), styles.NOTE_TEXT)
            self.merge(self.row, UNIT, PLACE)
            self.row += 1

    def links(self) -> None:
        """The links with their points, and the sliding joints."""
        plan = self.plan
        self.heading(self.text("links"))
        head = {SYMBOL: self.text("head.symbol"), UNIT: self.text("head.number"), EQUATION: self.text("head.points")}
        self.line({**head, MEANING: self.text("head.link"), PLACE: self.text("head.key")}, styles.HEAD_LEFT)
        for link in plan.mechanism.links:
            points = self._joined([self._point(name, place) for name, place in link.points.items()])
            fixed = link is plan.mechanism.ground
            angle: Content = self.text("fixed") if fixed else Rich(tuple(symbol_parts(link.angle_symbol)))
            words = link_words(link).of(plan.language)
            self._entry(angle, str(link.number), points, words, link.name)
        for joint in plan.mechanism.joints:
            symbol = Rich(tuple(symbol_parts(joint.symbol)))
            self._entry(symbol, "", self._joint(joint), "", joint.name)

    def _entry(self, symbol: Content, unit: str, equation: Content, meaning: str, place: str) -> None:
        contents = {SYMBOL: symbol, UNIT: unit, EQUATION: equation, MEANING: meaning, PLACE: place}
        self.line(contents, styles.NOTE_CELL)

    def _quantity(self, quantity: Quantity, angle: bool = False) -> list[Part]:
        if not isinstance(quantity, float):
            return list(written(quantity, self.plan.language).parts)
        number = f"{(DEG if angle else NUMBER).written(quantity):.10g}".replace("-", "−")
        number = number.replace(".", self.plan.text("number.decimal"))
        return [(number + ("°" if angle else ""), "")]

    def _point(self, name: str, place: GivenPoint) -> list[Part]:
        """`C (126.6; 30°)` and the like."""
        match place:
            case Cartesian(x, y):
                inside = [*self._quantity(x), ("; ", ""), *self._quantity(y)]
            case Polar(r, angle):
                inside = [("r = ", ""), *self._quantity(r), (", ∠ ", ""), *self._quantity(angle, angle=True)]
            case Distances(first, b, second, c, side):
                inside = [(f"{name}{first} = ", ""), *self._quantity(b), (f", {name}{second} = ", "")]
                inside += [*self._quantity(c), (", " + self.text(side, first=first, second=second), "")]
        return [*symbol_parts(name), (" (", ""), *inside, (")", "")]

    def _joined(self, pieces: list[list[Part]]) -> Rich:
        parts: list[Part] = []
        for index, piece in enumerate(pieces):
            parts += [(",  ", ""), *piece] if index else piece
        return Rich(tuple(parts))

    def _joint(self, joint: Joint) -> Rich:
        """A sliding joint in a sentence."""
        words = {key: body_words(self.plan.mechanism, name) for key, name in (("link", joint.link), ("on", joint.on))}
        names = {key: name.of(self.plan.language) for key, name in words.items()}
        parts: list[Part] = [(self.text(joint.kind, point=joint.point, **names) + " ", "")]
        if isinstance(joint.through, str):
            parts.append((joint.through, ""))
        else:
            parts += [
                ("(", ""),
                *self._quantity(joint.through[0]),
                ("; ", ""),
                *self._quantity(joint.through[1]),
                (")", ""),
            ]
        return Rich((*parts, (", ∠ ", ""), *self._quantity(joint.angle, angle=True)))

    # --- equations --------------------------------------------------------------------------------------------

    def equations(self) -> None:
        """One line for each symbol: dimensions, constants, columns, group by group."""
        self.heading(self.text("equations"))
        head = {
            SYMBOL: self.plan.text("head.symbol"),
            UNIT: self.plan.text("head.unit"),
            EQUATION: self.text("head.equation"),
        }
        self.line({**head, MEANING: self.plan.text("head.meaning"), PLACE: self.text("head.place")}, styles.HEAD_LEFT)
        self.cells.append(Cell(self.row - 1, FORMULA, self.text("head.formula"), styles.HEAD_LEFT))
        self._dimensions()
        self._group(self.text("constants"))
        for equation in self.plan.equations.constants:
            self._equation(equation, self.plan.mechanism.shown(equation.unit).text)
        self._driver()
        columns = [equation for equation in self.plan.equations.columns if equation.role not in BANDS]
        self._groups(
            [equation for equation in columns if equation.role not in (*RATES, *FORCES) and equation.group >= 0]
        )
        rates = [equation for equation in columns if equation.role in RATES]
        if rates:
            self._group(self.plan.text("rates.title"))
            self._loops()
            self._groups(rates)
        forces = [equation for equation in columns if equation.role in FORCES]
        if forces:
            self._group(self.plan.text("forces.title"))
            for group in self.plan.equations.groups:
                if group.system is not None:
                    said = self.text("newton.forces", number=group.number)
                    self._entry("", "", "Jᵀ λ = Q", said, self.plan.at.titles["forces"])
            self._groups(forces)
        self._groups([equation for equation in columns if equation.group < 0])

    def _loops(self) -> None:
        """The loop equations of velocities and of accelerations, as a textbook has them."""
        if not self.plan.equations.equations.turning:
            return
        loops = LoopRates(self.plan)
        for group in self.plan.equations.groups:
            if group.system is not None:
                for text, key in (("J x′ = u,  u = −F′", "velocities"), ("J x″ = k,  k = −F″", "accelerations")):
                    said = self.text(f"newton.{key}", number=group.number)
                    self._entry(self.text(f"loop.{key}"), "", text, said, self.plan.at.titles["rates"])
                continue
            for key, equation in (
                ("velocities", loops.velocities(group.closure)),
                ("accelerations", loops.accelerations(group.closure)),
            ):
                self._entry(self.text(f"loop.{key}"), "", equation, self.text("loop", number=group.number), "")

    def _groups(self, equations: list[Assignment]) -> None:
        """Equations, group by group."""
        for number in dict.fromkeys(equation.group for equation in equations):
            if number != 0:
                self._group(group_title(self.plan, number))
                self._newton(number, equations)
            for equation in equations:
                # of the passes of Newton's method the last stands for all
                if equation.group == number and not (equation.role == "iteration" and equation.symbol[-1].isdecimal()):
                    self._equation(equation, self._unit(equation))

    def _newton(self, number: int, equations: list[Assignment]) -> None:
        """F(x) = 0, the Jacobian and the iteration of a group that Newton's method solves, before their parts."""
        system = self.plan.equations.groups[number - 1].system if number > 0 else None
        if system is None or not any(equation.role == "iteration" for equation in equations):
            return
        names = ", ".join(plain(name) for name in system.variables)
        count = len(system.unknowns)
        forces = ", ".join(plain(name) for name in system.equations)
        for text, key in (
            (f"x = ({names}),  F = ({forces}) = 0", "newton.system"),
            (f"J = ∂F/∂x,  {count} × {count}", "newton.jacobian"),
            ("x(k+1) = x(k) − J⁻¹ F", "newton.iteration"),
        ):
            self._entry("", "", text, self.text(key), self.plan.at.titles["iterations"])
        group = self.plan.equations.groups[number - 1]
        for place, words in enumerate(group.assemblies, 1):
            said = f"{place}: {words.of(self.plan.language)}"
            self._entry(plain(group.mode), "", said, self.text("newton.assembly"), "")

    def _group(self, title: str) -> None:
        for col in range(PLACE + 1):
            self.put(self.row, col, title if col == SYMBOL else None, styles.HEAD_LEFT)
        self.merge(self.row, SYMBOL, PLACE)
        self.row += 1

    def _dimensions(self) -> None:
        plan = self.plan
        self._group(plan.text("block.dimensions"))
        for dim in plan.mechanism.dimensions:
            content: Content = self.text("given")
            if not isinstance(dim.value, float):
                content = Rich((("= ", ""), *written(dim.value, plan.language).parts))
            label = dim.label.of(plan.language) if dim.label else ""
            self._row(dim.symbol, dim.unit.text, content, label)

    def _driver(self) -> None:
        """The table's own columns: the driver, the word on the position."""
        plan = self.plan
        self._group(plan.text("group.driver"))
        for column in plan.columns:
            if column.kind not in ("driver", "time", "listed"):
                continue
            stepping: Content = self.text("given")
            if said := mathematics(plan, column):
                stepping = Rich((("= ", ""), *said.parts)) if isinstance(said, Rich) else f"= {said}"
            words = self.text("driver") if column.kind == "driver" else words_of(plan, column.symbol)
            self._row(column.symbol, column_unit(plan, column), stepping, words, self._column(column.col))
        self.line(
            {
                SYMBOL: plan.text("head.status"), UNIT: "", EQUATION: self.text("column.status"), MEANING: "",
                PLACE: self._column(STATUS),
            },
            styles.NOTE_CELL,
        )  # fmt: skip

    def _unit(self, equation: Assignment) -> str:
        """The unit in which people read the column."""
        unit = equation.unit.internal if equation.role == "intermediate" else equation.unit
        return self.plan.mechanism.shown(unit).text

    def _equation(self, equation: Assignment, unit: str) -> None:
        parts: list[Part] = [("= ", ""), *self._written(equation.says)]
        self._row(equation.symbol, unit, Rich(tuple(parts)), equation.label.of(self.plan.language))

    def _written(self, node: Node) -> tuple[Part, ...]:
        return written(node, self.plan.language).parts

    def _row(self, symbol: str, unit: str, content: Content, label: str, place: str = "") -> None:
        name = Rich(tuple(symbol_parts(symbol)))
        self.places[self.row] = self.plan.at.spots[symbol]
        self._entry(name, unit, content, label, place or self._place(symbol))

    def _place(self, symbol: str) -> str:
        """Where people read it: `Positions K`, `Mechanism B12`."""
        spot = self.plan.at.spots[symbol]
        return f"{spot.sheet} {column_letters(spot.col) if spot.column else cell_name(spot.row, spot.col)}"

    def _column(self, col: int) -> str:
        return f"{self.plan.table} {column_letters(col)}"


STYLE = replace(styles.NOTE_CELL, name="", wrap=False)


def with_formulas(workbook: Workbook, title: str, places: Mapping[int, Spot]) -> Workbook:
    """The workbook with them, in a column that is not printed.

    title   of the notes;  places: where the quantity of each of their rows stands
    """
    wanted = {(spot.sheet, spot.row, spot.col): row for row, spot in places.items()}
    found = [
        Cell(wanted[sheet.title, fill.row, fill.col], FORMULA, f"={print_formula(fill.formula)}", STYLE)
        for sheet in workbook.sheets
        for fill in sheet.fills
        if (sheet.title, fill.row, fill.col) in wanted
    ]
    sheets = (replace(each, cells=(*each.cells, *found)) if each.title == title else each for each in workbook.sheets)
    return replace(workbook, sheets=tuple(sheets))
