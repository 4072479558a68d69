"""The block "How it stands" of the first sheet: verdicts over the whole sweep, as live formulas with colours."""

from __future__ import annotations

import math

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Boolean, Call, CellRef, Node, Number, RangeRef, Text
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.naming import link_words
from mechsheet.model import Distances, Link
from mechsheet.sheet import styles
from mechsheet.sheet.blocks import Writer
from mechsheet.sheet.checks import ROUNDING
from mechsheet.sheet.extremes import sweep_of
from mechsheet.sheet.findings import FourBar, findings
from mechsheet.sheet.geometry import UV, Known, base_point, distance
from mechsheet.sheet.limits import SLOTS
from mechsheet.sheet.plan import MEANING, TOLERANCE, VALUE
from mechsheet.sheet.positions import places
from mechsheet.sheet.rows import exists_column, first_row, last_row
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.workbook import Area, Conditional, Content, Style

SAME = Number(1e-6)
"""Angles of transmission [rad] this near to each other are the same. At a limit, where the angle goes as the root of the
driver's distance from it, rounding alone makes 1e-8."""

POOR = 40.0
"""Angles of transmission [deg] below this are poor: most of the force only loads the joints."""


def write_stands(writer: Writer) -> None:
    """Fill the block in. The sheet of checks must have been laid out: its verdicts are read here."""
    block = _Block(writer)
    writer.heading("stands", writer.plan.text("head.at"))
    found = findings(writer.plan.mechanism, writer.plan.equations)
    block.assembles()
    if found.limits:
        block.limits()
    if found.reach is not None:
        block.input_range()
    block.checks()
    if found.meets:
        block.shared()
    for loop in found.four_bars:
        block.grashof(loop)
    for link in found.swings:
        block.swing(link, [loop for loop in found.four_bars if link in (loop.first, loop.last)])
    for joint in found.strokes:
        block.stroke(joint.symbol)
    for symbol in found.returning:
        block.ratio(symbol)
    for group in found.transmission:
        block.transmission(group)


class _Block:
    """The lines; each has a short symbol, a value, its unit, where it occurs, and words."""

    def __init__(self, writer: Writer) -> None:
        self.writer = writer
        self.plan = writer.plan
        self.rows = writer.plan.blocks["stands"].rows
        self.driver = writer.plan.mechanism.driver

    # --- small things -----------------------------------------------------------------------------------------

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook."""
        return self.plan.text(f"stands.{key}", **parts)

    def said(self, key: str, **parts: object) -> Text:
        """The same as a constant of a formula."""
        return Text(self.text(key, **parts))

    def line(self, key: str, symbol: Content, unit: str, value: Node, style: Style, words: Node) -> CellRef:
        """One line; the cell of its value."""
        row = self.rows[key]
        self.writer.line(row, symbol, unit, None)
        self.writer.formula(row, VALUE, value, style)
        self.writer.formula(row, MEANING, words, styles.VERDICT)
        return CellRef(row, VALUE, True, True)

    def at(self, key: str, place: Node) -> None:
        """Where it occurs: a value of the driver."""
        kind = self.driver.unit.kind
        self.writer.formula(self.rows[key], TOLERANCE, place, styles.decimals(styles.RESULT, places(self.plan, kind)))

    def colour(self, key: str, condition: Node, style: Style) -> None:
        """The words' colour where a condition holds; it reads this sheet alone, other programs refuse another's cells."""
        row = self.rows[key]
        self.writer.conditionals.append(Conditional(Area(row, MEANING, row, MEANING), condition, style))

    def words(self, key: str) -> CellRef:
        """The cell of a line's words."""
        return CellRef(self.rows[key], MEANING, True, True)

    def value(self, name: str) -> Node:
        """A cell that another sheet has registered."""
        return self.plan.at.reading_shown(name, self.plan.main, None)

    def drivers(self) -> RangeRef:
        """The driver's column, as people read it."""
        return self.plan.at.column(self.driver.symbol, self.plan.main)

    # --- the whole sweep --------------------------------------------------------------------------------------

    def assembles(self) -> None:
        """In how many rows the mechanism exists, from where to where, and in how many stretches."""
        exists = exists_column(self.plan)
        row = self.rows["rows"]
        count = CellRef(row, VALUE, True, True)
        everything = Binary("=", count, Number(float(self.plan.rows)))
        nothing = Binary("=", count, al.ZERO)
        drivers = self.drivers()
        first = Call("INDEX", (drivers, first_row(self.plan)))
        last = Call("INDEX", (drivers, last_row(self.plan)))
        unit = _after_number(self.driver.unit.text)
        stretches = self._stretches()
        several = _joined(Text(", "), stretches, Text(" "), self.said("stretches"))
        range_words = _joined(
            self.said("from"), Text(" "), _short(first), Text(unit), Text(" "), self.said("to"), Text(" "), _short(last),
            Text(unit), Call("IF", (Binary(">", stretches, al.ONE), several, Text(""))),
        )  # fmt: skip
        words = Call("IF", (everything, self.said("all"), Call("IF", (nothing, self.said("nowhere"), range_words))))
        self.line("rows", self.text("rows"), "", Call("SUM", (exists,)), styles.decimals(styles.RESULT, 0), words)
        self.colour("rows", everything, styles.GOOD)
        self.colour("rows", nothing, styles.BAD)
        self.colour("rows", Call("NOT", (everything,)), styles.WARN)
        missing = Binary("-", Number(float(self.plan.rows)), count)
        cell = CellRef(self.rows["missing"], VALUE, True, True)
        none = Binary("=", cell, al.ZERO)
        words = Call("IF", (none, self.said("none_missing"), self.said("some_missing")))
        self.line("missing", self.text("missing"), "", missing, styles.decimals(styles.RESULT, 0), words)
        gap = Call("INDEX", (drivers, Call("MATCH", (al.ZERO, exists, al.ZERO))))
        self.at("missing", Call("IF", (none, Text(""), gap)))

    def _nowhere(self) -> Node:
        """TRUE where no row exists."""
        return Binary("=", CellRef(self.rows["rows"], VALUE, True, True), al.ZERO)

    def _stretches(self) -> Node:
        """The number of runs of rows that exist: rows that exist where the row above does not."""
        column = exists_column(self.plan)
        start, end = column.start, column.end
        if start == end:
            return Call("SUM", (column,))
        later = RangeRef(CellRef(start.row + 1, start.col, True, True, start.sheet), end)
        earlier = RangeRef(start, CellRef(end.row - 1, end.col, True, True, end.sheet))
        return al.add(start, Call("SUMPRODUCT", (al.mul(later, al.sub(al.ONE, earlier)),)))

    def limits(self) -> None:
        """How many limits the sweep passes, the first of them, and where each stretch ends and begins."""
        slots = [number for number in range(1, SLOTS + 1) if f"#limit {number}" in self.plan.at.spots]
        exists = exists_column(self.plan)
        cell = CellRef(self.rows["limits"], VALUE, True, True)
        none = Binary("=", cell, al.ZERO)
        unit = _after_number(self.driver.unit.text)
        parts: list[Node] = []
        for number in slots:
            value, way = self.value(f"#limit {number}"), self.value(f"#limit way {number}")
            words = _joined(Text(", " if number > 1 else ""), way, Text(" "), _short(value, 3), Text(unit))
            parts.append(Call("IF", (Call("ISNUMBER", (value,)), words, Text(""))))
        more = Call("IF", (Binary(">", cell, Number(float(len(slots)))), Text(" …"), Text("")))
        words = Call("IF", (none, self.said("no_limit"), _joined(*parts, more) if parts else Text("")))
        count = self._changes(exists) if slots else al.ZERO
        self.line("limits", self.text("limits"), "", count, styles.decimals(styles.RESULT, 0), words)
        if slots:
            self.at("limits", Call("IF", (none, Text(""), self.value("#limit 1"))))
        self.colour("limits", Call("NOT", (none,)), styles.WARN)

    def _changes(self, exists: RangeRef) -> Node:
        """Pairs of neighbouring rows of which one exists and the other does not."""
        start, end = exists.start, exists.end
        later = RangeRef(CellRef(start.row + 1, start.col, True, True, start.sheet), end)
        earlier = RangeRef(start, CellRef(end.row - 1, end.col, True, True, end.sheet))
        return Call("SUMPRODUCT", (al.square(al.sub(later, earlier)),))

    def input_range(self) -> None:
        """From where to where the driver can go as far as the first group lets it: its dead centres."""
        ranges = self.value("#input ranges")
        unit = _after_number(self.driver.unit.text)
        names = [self.value(f"#input {key}") for key in ("from", "to", "from other", "to other")]
        one, other = (_joined(_end(a), Text(f"{unit} … "), _end(b), Text(unit)) for a, b in (names[:2], names[2:]))
        turns = self.driver.unit.kind == "angle"
        if turns:  # of a slide the other range is a mirror image: the same lengths laid off backwards
            one = _joined(one, Call("IF", (Binary("=", ranges, al.TWO), _joined(Text("; "), other), Text(""))))
        free = self.said("free.turn" if turns else "free.slide")
        words = Call("IF", (Binary("=", ranges, al.ZERO), free, one))
        words = Call("IF", (Binary("<", ranges, al.ZERO), self.said("nowhere"), words))
        extent = Call("IF", (Binary(">", ranges, al.ZERO), al.sub(names[1], names[0]), Text("")))
        key = "input"
        style = styles.decimals(styles.RESULT, places(self.plan, self.driver.unit.kind))
        self.line(key, self.text("input"), self.driver.unit.text, Call("IFERROR", (extent, Text(""))), style, words)
        self.colour(key, Binary("=", self.words(key), self.said("nowhere")), styles.BAD)

    def checks(self) -> None:
        """The largest gap of a joint, and the leaps, from the sheet of checks."""
        clear = self.value("#clear")
        unit = self.plan.mechanism.length_unit
        style = styles.numbered(styles.RESULT, styles.ERROR.number_format)
        self.line("closure", self.text("closure"), unit, self.value("#worst"), style, clear)
        good = Binary("=", self.words("closure"), Text(self.plan.text("checks.clear")))
        self.colour("closure", good, styles.GOOD)
        self.colour("closure", Call("NOT", (good,)), styles.BAD)
        cell = CellRef(self.rows["leaps"], VALUE, True, True)
        none = Binary("=", cell, al.ZERO)
        words = Call("IF", (none, self.said("no_leap"), self.said("some_leaps")))
        count = self.value("#leaps") if "#leaps" in self.plan.at.spots else al.ZERO
        self.line("leaps", self.text("leaps"), "", count, styles.decimals(styles.RESULT, 0), words)
        self.colour("leaps", none, styles.GOOD)
        self.colour("leaps", Call("NOT", (none,)), styles.WARN)

    def shared(self) -> None:
        """Rows in which both assemblies of a group meet, and the first of them."""
        cell = CellRef(self.rows["shared"], VALUE, True, True)
        none = Binary("=", cell, al.ZERO)
        words = Call("IF", (none, self.said("none_shared"), self.said("some_shared")))
        self.line("shared", self.text("shared"), "", self.value("#shared"), styles.decimals(styles.RESULT, 0), words)
        spot = self.plan.at.shown["#shared rows"]
        first, last = (
            CellRef(row, spot.col, True, True, spot.sheet) for row in (spot.row, spot.row + self.plan.rows - 1)
        )
        where = Call("INDEX", (self.drivers(), Call("MATCH", (al.ONE, RangeRef(first, last), al.ZERO))))
        self.at("shared", Call("IF", (none, Text(""), where)))
        self.colour("shared", Call("NOT", (none,)), styles.WARN)

    # --- four-bar loops ---------------------------------------------------------------------------------------

    def _lengths(self, loop: FourBar) -> tuple[Node, Node, Node, Node]:
        """Ground, first link, coupler, last link."""
        ground = self.plan.mechanism.ground
        ends = (
            (ground, loop.start, loop.end),
            (loop.first, loop.start, loop.pin),
            (loop.coupler, loop.pin, loop.inner),
            (loop.last, loop.end, loop.inner),
        )
        a, b, c, d = (self.plan.at.bind(distance(*end, self._laid_off(*end)), self.plan.main, None) for end in ends)
        return a, b, c, d

    def _laid_off(self, link: Link, *points: str) -> Known:
        """The cells of two points' places, where one is given by distances: written out, it could be of any length."""
        if not any(isinstance(link.points[point], Distances) for point in points):
            return {}
        known: dict[str, UV] = {}
        for point in points:
            if link is self.plan.mechanism.ground:
                known[point] = self.value(f"{point}.x"), self.value(f"{point}.y")
            elif point == base_point(link):
                known[point] = al.ZERO, al.ZERO
            else:
                u, v = (
                    CellRef(spot.row, spot.col, True, True, spot.sheet) for spot in self.plan.ways[link.name, point]
                )
                known[point] = u, v
        return known

    def _rounding(self) -> Node:
        return al.mul(al.number(ROUNDING), self.plan.at.reference(self.plan.equations.tolerance, self.plan.main, None))

    def grashof(self, loop: FourBar) -> None:
        """Shortest + longest - the other two: negative where some link turns fully; and the loop's type in words."""
        key = f"grashof {loop.group}"
        lengths = self._lengths(loop)
        ground, first, coupler, _ = lengths
        total = al.add(al.add(lengths[0], lengths[1]), al.add(lengths[2], lengths[3]))
        shortest, longest = Call("MIN", lengths), Call("MAX", lengths)
        excess = al.sub(al.mul(al.TWO, al.add(shortest, longest)), total)
        cell = CellRef(self.rows[key], VALUE, True, True)
        change = Binary("<=", Call("ABS", (cell,)), self._rounding())
        open_ = Binary(">", al.sub(al.mul(al.TWO, longest), total), self._rounding())

        def named(word: str, turning: Link | None = None) -> Text:
            link = link_words(turning).of(self.plan.language) if turning else ""
            return self.said(word, loop=loop.name, link=link)

        words: Node = named("grashof.one", loop.last)
        words = Call("IF", (Binary("=", coupler, shortest), named("grashof.coupler"), words))
        words = Call("IF", (Binary("=", first, shortest), named("grashof.one", loop.first), words))
        words = Call("IF", (Binary("=", ground, shortest), named("grashof.both"), words))
        words = Call("IF", (Binary(">", cell, al.ZERO), named("grashof.none"), words))
        words = Call("IF", (change, named("grashof.change"), words))
        words = Call("IF", (open_, named("grashof.open"), words))
        unit = self.plan.mechanism.length_unit
        style = styles.decimals(styles.RESULT, places(self.plan, "length"))
        self.line(key, self.text("grashof"), unit, excess, style, words)
        self.colour(key, open_, styles.BAD)
        self.colour(key, change, styles.WARN)

    def swing(self, link: Link, loops: list[FourBar]) -> None:
        """By how much a link turns in the sweep, and whether it is a crank or a rocker."""
        symbol = link.angle_symbol
        key = f"swing {symbol}"
        driven = [loop for loop in loops if self.driver.link in (loop.first.name, loop.last.name)]
        turned = self._by_loop(link, driven[0]) if driven else self._by_turns(symbol)
        kinds = (self.said("crank"), self.said("rocker"))
        words: Node = Call("IF", (turned, *kinds)) if turned is not None else self.said("turned")
        extent = self._extent(symbol)
        style = styles.decimals(styles.RESULT, places(self.plan, "angle"))
        self.line(key, rich(symbol), self.plan.mechanism.angle_unit.text, extent, style, words)

    def _by_loop(self, link: Link, loop: FourBar) -> Node:
        """TRUE for a crank by Grashof's rule: it, or the ground, is the shortest link. In a loop whose other link is the
        driver; what hangs on a link that only swings does not turn, whatever its loop would allow."""
        ground, first, _, last = lengths = self._lengths(loop)
        own = first if link is loop.first else last
        excess = CellRef(self.rows[f"grashof {loop.group}"], VALUE, True, True)
        shortest = Binary("=", Call("MIN", (ground, own)), Call("MIN", lengths))
        return Call("AND", (Binary("<", excess, al.neg(self._rounding())), shortest))

    def _by_turns(self, symbol: str) -> Node | None:
        """TRUE for a link that has gone on by at least a turn when the driver has; None when the driver does not."""
        if sweep_of(self.plan) not in ("closed", "open"):
            return None
        column = self.plan.at.column(symbol, self.plan.main)
        last, first = (Call("INDEX", (column, al.number(row))) for row in (self.plan.rows, 1))
        turn = al.number(360.0) if self.plan.mechanism.angle_unit.in_degrees else al.mul(al.TWO, al.PI)
        on = Binary("<>", Call("ROUND", (al.div(al.sub(last, first), turn), al.ZERO)), al.ZERO)
        return Call("IFERROR", (on, Boolean(False)))  # a link that does not exist in some rows does not turn fully

    def _extent(self, symbol: str) -> Node:
        """#N/A where there is no position: no number, and no 0 that could be taken for a small one."""
        return Call("IFERROR", (al.sub(self.value(f"#max {symbol}"), self.value(f"#min {symbol}")), Call("NA")))

    # --- slides, time ratio, transmission ---------------------------------------------------------------------

    def stroke(self, symbol: str) -> None:
        """How far a slide on the ground travels."""
        style = styles.decimals(styles.RESULT, places(self.plan, "length"))
        unit = self.plan.mechanism.length_unit
        self.line(f"stroke {symbol}", rich(symbol), unit, self._extent(symbol), style, self.said("stroke"))

    def ratio(self, symbol: str) -> None:
        """Time of the slower way between the extremes over that of the faster, for a driver that turns evenly."""
        key = f"ratio {symbol}"
        turn = al.number(360.0) if self.driver.unit.in_degrees else al.mul(al.TWO, al.PI)
        there, back = self.value(f"#max at {symbol}"), self.value(f"#min at {symbol}")
        way = Call("MOD", (al.sub(there, back), turn))
        rest = al.sub(turn, way)
        value: Node = al.div(Call("MAX", (way, rest)), Call("MIN", (way, rest)))
        words = self.said("ratio", symbol=plain(symbol))
        sweep = sweep_of(self.plan)
        if sweep in ("closed", "open"):
            steps = self.plan.rows - 1 if sweep == "closed" else self.plan.rows
            turns = al.div(Call("ABS", (al.mul(al.number(steps), self.value("#step")),)), turn)
            whole = Binary("<", Call("ABS", (al.sub(turns, Call("ROUND", (turns, al.ZERO))),)), Number(1e-9))
            whole_rows = Binary("=", CellRef(self.rows["missing"], VALUE, True, True), al.ZERO)
            value = Call("IF", (Call("AND", (whole, Binary(">", turns, Number(0.5)), whole_rows)), value, Text("")))
        else:
            value, words = Text(""), self.said("no_turn")
        value = Call("IF", (self._nowhere(), Call("NA"), Call("IFERROR", (value, Text("")))))
        self.line(key, self.text("ratio_symbol"), "", value, styles.decimals(styles.RESULT, 2), words)

    def transmission(self, group: Group) -> None:
        """The angle of transmission that is farthest from 90 degrees, as an acute angle."""
        symbol = group.transmission
        key = f"transmission {symbol}"
        low, high = self.value(f"#min {symbol}"), self.value(f"#max {symbol}")
        if group.kind == "RRR":  # the angle between coupler and follower itself, 0 to 180 degrees
            ends = (low, high)
            worst: Node = Call("MIN", (low, al.sub(al.PI, high)))
            at_low = Binary("<=", low, al.add(al.sub(al.PI, high), SAME))
            label: Content = rich(symbol)
        else:  # the rod against the guide: the angle of transmission is what is missing to 90 degrees
            quarter = al.div(al.PI, al.TWO)
            worst = al.sub(quarter, Call("MAX", (high, al.neg(low))))
            ends = (worst, al.sub(quarter, Call("MAX", (al.ZERO, low, al.neg(high)))))
            at_low = Binary(">=", al.neg(low), al.sub(high, SAME))
            label = f"90°−|{plain(symbol)}|" if self.plan.mechanism.angle_unit.in_degrees else f"π/2−|{plain(symbol)}|"
        degrees = self.plan.mechanism.angle_unit.in_degrees
        shown = [Call("DEGREES", (node,)) if degrees else node for node in (worst, *ends)]
        unit = self.plan.mechanism.angle_unit.text
        limit = POOR if degrees else math.radians(POOR)
        cell = CellRef(self.rows[key], VALUE, True, True)
        poor = Binary("<", cell, Number(limit))
        after = _after_number(unit)
        from_to = _joined(_short(shown[1], 1), Text(f"{after} … "), _short(shown[2], 1), Text(f"{after}: "))
        words = _joined(from_to, Call("IF", (poor, self.said("poor"), self.said("fair"))))
        style = styles.decimals(styles.RESULT, places(self.plan, "angle"))
        value = Call("IFERROR", (shown[0], Call("NA")))
        self.line(key, label, unit, value, style, Call("IFERROR", (words, Text(""))))
        place = Call("IF", (at_low, self.value(f"#min at {symbol}"), self.value(f"#max at {symbol}")))
        self.at(key, Call("IFERROR", (place, Text(""))))
        known = Call("ISNUMBER", (cell,))
        self.colour(key, Call("AND", (known, poor)), styles.WARN)
        self.colour(key, known, styles.GOOD)


def _short(node: Node, digits: int = 4) -> Node:
    """A number as text in a formula, with few digits and the reader's own decimal sign."""
    return Call("ROUND", (node, Number(float(digits))))


def _end(node: Node) -> Node:
    """An end of a range in few digits; one that is no number (infinite) as it stands."""
    return Call("IF", (Call("ISNUMBER", (node,)), _short(node, 3), node))


def _joined(*nodes: Node) -> Node:
    result = nodes[0]
    for node in nodes[1:]:
        result = Binary("&", result, node)
    return result


def _after_number(unit: str) -> str:
    return unit if unit in ("°", "") else f" {unit}"
