"""Does it do it? What is live on the sheet about the mechanism that comes out: a number, words, a colour for each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, RangeRef, Text
from livesheet.workbook import Area
from mechsheet.sheet import styles
from mechsheet.sheet.grashof import BEGINS, named
from mechsheet.sheet.over_rows import LEAST, MOST, largest_size_in, over_rows
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import MEANING as FIRST_SHEET_WORDS
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.synthesis.page import MODE, Page
from mechsheet.sheet.synthesis.tables import MU, curve_columns, exact_column, has_points, largest, sensitivity_columns
from mechsheet.sheet.task_rows import INPUTS, LINE_ROW, MEANING, REMARK, ROUNDED, SYMBOL, UNIT, UNSOLVED, USED, VALUE
from mechsheet.sheet.transmission import POOR
from mechsheet.units import behind_number

YES, DOUBT, NO = "✓", "!", "✗"
"""Beside each verdict: green, amber, red."""

SOLVED, WRONG_INPUT, NO_SOLUTION = 0, 1, 2
"""What the cell `unsolved` holds."""

EXACT = 1e-6
"""Errors below it, in the units shown, are none."""

DEAD = 0.01
"""Degrees from a dead centre that count as one."""

LOST = "AND(value<0,exact>=0)"
"""Whether rounding takes what the exact lengths have: of what must not be below 0."""

COARSE = 0.05
"""A length that changes by more than this part of it is not known well."""


Over = Mapping[str, Node | float]
"""What names in a test mean."""

NOTHING: Over = {}


def can_be(page: Page, symbol: str) -> Node:
    """Whether the cell of an input holds what it can."""
    cell = page.cell(symbol)
    return formula("N(cell)>0" if symbol in page.given.positive else "ISNUMBER(cell)", cell=cell)


class Does:
    """Writes the block."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.verdicts = [key for block, key in page.rows.of if block == "does"]

    def write(self) -> None:
        """Every verdict, and the line under the title."""
        page = self.page
        page.heading("does")
        self._inputs()
        self._unsolved()
        for key in self.verdicts[2:]:
            getattr(self, f"_{key}")(key)
        self._line()

    # --- one line each

    def _entry(
        self, key: str, value: Node, unit: str, words: Sequence[tuple[str, Node | str]], otherwise: Node | str,
        red: str = "FALSE", amber: str = "FALSE", counted: bool = False, over: Over = NOTHING,
    ) -> None:  # fmt: skip
        """A number and what it says: the words of the first test that holds. Tests are over `value` and the names `over`.

        counted  the number is a whole one
        """
        page, row = self.page, self.page.rows.of["does", key]
        number = CellRef(row, VALUE, True, True)
        page.put(row, SYMBOL, page.text(f"does.{key}"), styles.SYMBOL)
        style = styles.decimals(styles.RESULT, 0 if counted else 4)
        page.formula(row, VALUE, formula("IFERROR(value,NA())", value=value), style)
        page.put(row, UNIT, unit, styles.UNIT)
        said: Node = Text(otherwise) if isinstance(otherwise, str) else otherwise
        for test, reason in reversed(words):
            condition = formula(test, value=number, **over)
            said = formula("IF(condition,reason,said)", condition=condition, reason=reason, said=said)
        if key not in (INPUTS, UNSOLVED):
            said = formula("IF(unsolved>0,none,IFERROR(said,nothing))", unsolved=there(page.plan.places.unsolved).cell,
                           said=said, none="–", nothing="–")  # fmt: skip
        page.formula_across(row, USED, MEANING, said, styles.VERDICT)
        bad, poor = (
            formula(f"IFERROR({test},{otherwise})", value=number, **over)
            for test, otherwise in ((red, "TRUE"), (amber, "FALSE"))
        )
        grade = formula("IF(bad,no,IF(poor,doubt,yes))", bad=bad, poor=poor, no=NO, doubt=DOUBT, yes=YES)
        page.formula(row, ROUNDED, grade, styles.centred(styles.VERDICT))
        area = Area(row, ROUNDED, row, MEANING)
        for mark, colours in ((NO, styles.BAD), (DOUBT, styles.WARN), (YES, styles.GOOD)):
            condition = formula("mark=own", mark=CellRef(row, ROUNDED, True, True), own=mark)
            page.colour(area, condition, colours)

    def _inputs(self) -> None:
        """The number of the first input that cannot be, 0 where all can."""
        page, inputs = self.page, self.page.given.inputs
        none = 10.0 ** len(str(len(inputs) + 1)) - 1  # more than there are
        numbers = [
            formula("number+none*good", number=number, none=none, good=formula("(good)*1", good=can_be(page, symbol)))
            for number, symbol in enumerate(inputs, 1)
        ]
        first = formula("MOD(least,none)", least=al.smallest([*numbers, al.number(none)]), none=none)
        names = self._column("task", SYMBOL)
        before, after = page.plan.text("verdict.inputs.wrong", symbol="#").split("#")
        number = CellRef(page.rows.of["does", INPUTS], VALUE, True, True)
        wrong = joined(before, formula("INDEX(names,number)", names=names, number=number), after)
        self._entry(INPUTS, first, "", [("value>0", wrong)], page.text("inputs.fine"), red="value>0", counted=True)

    def _unsolved(self) -> None:
        page = self.page
        wrong = CellRef(page.rows.of["does", INPUTS], VALUE, True, True)
        solved = al.all_of([formula("ISNUMBER(step)", step=page.cell(symbol)) for symbol in page.given.ends])
        state = formula("IF(wrong>0,input,IF(solved,yes,none))", wrong=wrong, solved=solved, yes=SOLVED,
                        none=NO_SOLUTION, input=WRONG_INPUT)  # fmt: skip
        none = [(f"value={NO_SOLUTION}", self._why())]
        self._entry(UNSOLVED, state, "", none, page.text("solved"), red="value>0", counted=True)

    def _why(self) -> Node:
        """Why there is no solution: what the first step without a value says of it."""
        page = self.page
        why: Node = Text(page.text("nothing"))
        for symbol, _ in reversed(page.given.reasons):
            said = CellRef(page.rows.of["solution", symbol], REMARK, True, True)
            why = formula("IF(ISNUMBER(step),why,said)", step=page.cell(symbol), why=why, said=said)
        return why

    def _column(self, block: str, col: int) -> RangeRef:
        """A column of a table of this sheet, anchored."""
        rows = [row for (name, _), row in self.page.rows.of.items() if name == block]
        return RangeRef(CellRef(rows[0], col, True, True), CellRef(rows[-1], col, True, True))

    def _meets(self, key: str) -> None:
        """The largest error of what is asked, in parts of each unit.

        It is a doubt where the lengths are rounded, and where the points are more than decide them; else the mechanism is
        not the one that the task wants. Where only rounding keeps it from reaching what is asked, that is a doubt, too.
        """
        page = self.page
        errors = self._column("asked", USED)
        measures = {each.measure for each in page.kind.asked(page.given)}
        unit = page.unit_text(measures.pop()) if len(measures) == 1 else ""
        value = largest_size_in(errors)
        missing = formula("COUNT(errors)<ROWS(errors)", errors=errors)
        largest_error = joined(page.text("meets.about"), formula("ROUND(number,4)", number=CellRef(
            page.rows.of["does", key], VALUE, True, True)), behind_number(unit))  # fmt: skip
        said: list[tuple[str, Node | str]] = [
            ("ISNA(value)", page.text("meets.not")),
            (f"value>{EXACT}", largest_error),
        ]
        amber, over = f"value>{EXACT}", dict(NOTHING)
        red = f"IF(ISNA(value),TRUE,{amber})" if page.kind.decided(page.given) else "ISNA(value)"
        if page.rounds:
            exact = self._column("asked", exact_column(page.given))
            over["reached"] = formula("COUNT(exact)=ROWS(exact)", exact=exact)
            said.insert(0, ("AND(ISNA(value),reached)", page.text("meets.rounded")))
            red, amber = "AND(ISNA(value),NOT(reached))", f"IF(ISNA(value),TRUE,{amber})"
            if page.kind.decided(page.given):
                over["off"] = largest_size_in(exact)
                red = f"IF(reached,off>{EXACT},TRUE)"
        value = formula("IF(missing,NA(),value)", missing=missing, value=value)
        self._entry(key, value, unit, said, page.text("meets.exactly"), red, amber, over=over)

    def _assemblies(self, key: str) -> None:
        """On how many of the two assemblies the points lie, and whether the mechanism is the one that the task wants."""
        page = self.page
        sides = [page.cell(symbol) for symbol in page.given.sides if symbol not in page.given.results.values()]
        total = formula("ABS(total)", total=al.total(sides))
        listed: list[Node | str] = [page.text("assemblies.both")]
        for number, side in enumerate(sides, 1):
            listed.append(formula("IF(side>0,plus,minus)", side=side, plus=f" {number}: +", minus=f" {number}: −"))
        value = formula("IF(total=count,1,2)", total=total, count=len(sides))
        said = [("value=2", joined(*listed)), ("own<>wanted", page.text("assemblies.other"))]
        over = {"own": page.naming.nodes[MODE], "wanted": page.cell(page.given.results[MODE])}
        self._entry(
            key, value, "", said, page.text("assemblies.one"), "OR(value=2,own<>wanted)", counted=True, over=over
        )

    def _order(self, key: str) -> None:
        """Whether the input goes through the points one after the other."""
        page = self.page
        steps = [page.tree(step) for step in page.kind.steps(page.given)]
        total = al.total(formula("SIGN(step)", step=step) for step in steps)
        value = formula("IF(ABS(total)=count,1,0)", total=total, count=len(steps))
        other = [("value=0", page.text("order.not"))]
        self._entry(key, value, "", other, page.text("order.kept"), amber="value=0", counted=True)

    def _closes_throughout(self, key: str) -> None:
        """In how many rows of the range the mechanism closes."""
        column = self._transmission_angles()
        self._entry(
            key, formula("COUNT(column)", column=column), "",
            [("value<most", self.page.text("closes_throughout.not"))], self.page.text("closes_throughout.all"),
            red="value<most", counted=True, over={"most": formula("ROWS(column)", column=column)},
        )  # fmt: skip

    def _transmission_angles(self) -> RangeRef:
        """Those of the curve."""
        return self._column("curve", curve_columns(self.page.given)["mu"])

    def _transmission_used(self, key: str) -> None:
        """The least transmission angle over the range."""
        self._transmits(key, self._nearest_to_line(self._transmission_angles()))

    def _nearest_to_line(self, column: RangeRef) -> Node:
        """The least angle between two lines: one above 90 degrees counts from the other side."""
        half = 180.0 if self.page.degrees else al.PI
        low, high = (over_rows(which, column) for which in (LEAST, MOST))
        return formula("MIN(low,half-high)", low=low, half=half, high=high)

    def _transmits(self, key: str, value: Node) -> None:
        page = self.page
        unit = page.unit_text("angle")
        poor = POOR if page.degrees else formula("RADIANS(poor)", poor=POOR)
        self._entry(
            key, value, unit, [("value<poor", page.text("transmission.poor"))], page.text("transmission.good"),
            amber="value<poor", over={"poor": poor},
        )  # fmt: skip

    def _transmission_least(self, key: str) -> None:
        self._transmits(key, self.page.cell(self.page.given.results["mu_min"]))

    def _together(self, key: str) -> None:
        """Whether one assembly has both dead centres."""
        page = self.page
        value = page.cell(page.given.names["together"])
        self._entry(
            key, value, "", [("value<=0", page.text("together.not"))], page.text("together.both"), red="value<=0"
        )

    def _turns(self, key: str) -> None:
        """Whether the crank turns fully: a doubt where only rounding keeps it from that."""
        page = self.page
        unit = page.unit_text("length")
        said: list[tuple[str, Node | str]] = [("value<0", page.text("turns.not"))]
        red, amber, over = "value<0", "FALSE", dict(NOTHING)
        if page.rounds:
            exact = over["exact"] = page.exactly(page.kind.turns)
            margin = formula("ROUND(exact,4)", exact=exact)
            said.insert(0, (LOST, joined(page.text("turns.rounded"), margin, behind_number(unit))))
            red, amber = "AND(value<0,exact<0)", LOST
        self._entry(key, page.tree(page.kind.turns), unit, said, page.text("turns.fully"), red, amber, over=over)

    def _at_dead_centre(self, key: str) -> None:
        """How near a point is to a dead centre."""
        page = self.page
        if has_points(page.given):
            value = self._nearest_to_line(self._column("asked", MU))
        else:
            value = page.shown(page.tree(page.kind.beside), "angle")
        near = DEAD if page.degrees else formula("RADIANS(dead)", dead=DEAD)
        self._entry(
            key, value, page.unit_text("angle"), [("value<near", page.text("at_dead_centre.yes"))],
            page.text("at_dead_centre.no"), amber="value<near", over={"near": near},
        )  # fmt: skip

    def _grashof(self, key: str) -> None:
        """What the first sheet says of the loop: red where it cannot be closed, amber at a change point, and where only
        rounding keeps the input link from turning fully."""
        page, plan = self.page, self.page.plan
        loop = plan.found.four_bars[0]
        excess = plan.places.excess(loop.group).cell
        row = plan.blocks["verdicts"].rows[f"grashof_{loop.group}"]
        said = CellRef(row, FIRST_SHEET_WORDS, True, True, plan.main)
        opened, change = (
            Text(f"{named(loop, plan)}: {plan.text(f'verdict.grashof.{word}')}") for word in ("open", "change")
        )
        amber = "said=change"
        over: dict[str, Node | float] = {"said": said, "opened": opened, "change": change}
        words: list[tuple[str, Node | str]] = []
        if page.rounds:
            over |= {"exact": page.exactly(page.kind.turns), "used": page.tree(page.kind.turns)}
            lost = LOST.replace("value", "used")
            words.append((lost, joined(said, page.text("grashof.rounded"))))
            amber = f"OR({amber},{lost})"
        self._entry(
            key, excess, page.unit_text("length"), words, said, BEGINS.replace("begin", "opened"), amber, over=over
        )

    def _sensitivity(self, key: str) -> None:
        """The largest change of a length for a small change of one input, as a part of the length."""
        page = self.page
        found: list[Node] = []
        for symbol in largest(page.given, page.dimensions):
            row = page.rows.of["solution", symbol]
            first, last = sensitivity_columns(page.given)
            changes = RangeRef(CellRef(row, first, True, True), CellRef(row, last, True, True))
            found.append(formula("most/ABS(length)", most=largest_size_in(changes), length=page.cell(symbol)))
        value = formula("100*most", most=al.largest(found))
        number = CellRef(page.rows.of["does", key], VALUE, True, True)
        words = joined(page.text("sensitivity.about"), formula("ROUND(number,2)", number=number), " %")
        self._entry(key, value, "%", [], words, amber=f"value>{100 * COARSE}")

    # --- the line

    def _line(self) -> None:
        """The words of the first red verdict, else those of the first amber one, else that all is well."""
        page = self.page
        marks, words = (self._column("does", col) for col in (ROUNDED, USED))
        said: Node = Text(page.text("does.all"))
        for mark in (DOUBT, NO):
            found = formula("INDEX(words,MATCH(mark,marks,0))", words=words, mark=mark, marks=marks)
            said = formula("IFERROR(found,said)", found=found, said=said)
        page.formula_across(LINE_ROW, SYMBOL, MEANING, said, styles.LINE)
        area = Area(LINE_ROW, SYMBOL, LINE_ROW, MEANING)
        red, amber = (formula("COUNTIF(marks,mark)", marks=marks, mark=mark) for mark in (NO, DOUBT))
        for condition, style in (
            (formula("red>0", red=red), styles.BAD),
            (formula("AND(red=0,amber>0)", red=red, amber=amber), styles.WARN),
            (formula("red+amber=0", red=red, amber=amber), styles.GOOD),
        ):
            page.colour(area, condition, style)
