"""What is said of velocities and forces: rows without them, whether both ways round each group agree, how large they become.

How large the driver's effort and the joints' forces become, and how even a flywheel keeps the speed.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, Symbol, Text
from livesheet.workbook import Area, Conditional
from mechsheet.model import ENERGY, Link, inertia_unit
from mechsheet.sheet import styles
from mechsheet.sheet.checks.rows import AGREES
from mechsheet.sheet.findings.closing import SMALL
from mechsheet.sheet.findings.finding import Finding, InTitle, Line, bad, good, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.over_rows import largest_size_in, row_of_size
from mechsheet.sheet.places import there
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.shown import rich
from mechsheet.sheet.table.positions import decimals_of_kind, decimals_of_unit
from mechsheet.words.equations import link_words

EVEN = 1e-9
"""An angular acceleration smaller than this part of the speed's square is rounding."""

BETWEEN = ", "
"""Between links that are named one after another."""

MOST_SAID = 1000
"""More characters of such names than any mechanism has."""


class LargestEffort(Finding):
    """The largest effort of the driver, over rows."""

    key, placed, needs = "largest_effort", True, ("forces",)

    def line(self, on: Reading) -> Line:
        effort = on.plan.efforts[0]
        unit = on.plan.equations.of(effort).unit
        return Line(
            rich(effort), on.checks.worst_known("effort"), _of_a_number(on, self.key, on.text(self.key)), unit.text,
            decimals_of_unit(on.plan, unit), occurs=_of_a_number(on, self.key, on.checks.worst_at("effort")),
        )  # fmt: skip


class LargestBesides(Finding):
    """The largest effort of a further driver, over rows: its motor is sized by it as the first one's is by the first."""

    placed, needs = True, ("forces",)

    def __init__(self, effort: str) -> None:
        self.effort = effort
        self.key = f"largest_{effort}"

    def line(self, on: Reading) -> Line:
        unit = on.plan.equations.of(self.effort).unit
        column, found = Symbol(ALL + self.effort), on.value(self.key)
        most = formula("IF(COUNT(column)=0,NA(),size)", column=column, size=largest_size_in(column))
        place = on.driver_in_row(row_of_size(column, found))
        return Line(
            rich(self.effort), most, on.where_it_closes(on.text("largest_effort")), unit.text,
            decimals_of_unit(on.plan, unit), occurs=place,
        )  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        rows = np.abs(motion.search.in_rows(self.effort))
        most = float(np.max(rows[np.isfinite(rows)], initial=0.0))
        return {self.key: Expected([most], 1e-9 * most)} if most > 0 else {}


class LargestForce(Finding):
    """The largest joint force, over rows, and of which joint it is."""

    key, placed, needs = "largest_force", True, ("forces",)

    def line(self, on: Reading) -> Line:
        plan = on.plan
        strongest = plan.checked.strongest
        names = strongest.cell if strongest is not None else Text("")
        return Line(
            on.text(self.key), on.checks.worst_known("force"),
            _of_a_number(on, self.key, joined(on.text(f"{self.key}.words"), names)),
            plan.mechanism.dynamics.force_unit if plan.mechanism.dynamics else "", decimals_of_kind(plan, "force"),
            occurs=_of_a_number(on, self.key, on.checks.worst_at("force")),
        )  # fmt: skip


def _of_a_number(on: Reading, key: str, said: Node | str) -> Node:
    """What is said of a finding's number; nothing where it has none."""
    return formula('IF(ISNUMBER(found),said,"")', found=on.value(key), said=said)


class AssumedInertia(Finding):
    """How many links with a mass turn unevenly although nobody has said a moment of inertia: those whose cells hold 0."""

    key, by_rows = "assumed_inertia", True

    def line(self, on: Reading) -> Line:
        links = on.plan.mechanism.assumed_inertia
        tests = [self._assumed(on, link) for link in links]
        count = al.total(formula("IF(test,1,0)", test=test) for test in tests)
        names: list[Node | str] = [
            formula('IF(test,name,"")', test=test, name=f"{BETWEEN}{link_words(link).of(on.plan.language)}")
            for test, link in zip(tests, links, strict=True)
        ]
        listed = formula("MID(names,begin,most)", names=joined(*names), begin=len(BETWEEN) + 1, most=MOST_SAID)
        some = joined(on.text("assumed_inertia.some"), " ", listed)
        words = formula(
            "IF(count=0,none,some)", count=on.value(self.key), none=on.text("assumed_inertia.none"), some=some
        )
        spots = [on.plan.at.spots[f"J_{link.number}"] for link in links]
        cells = [CellRef(spot.row, spot.col, True, True) for spot in spots]
        empty = "AND(cell=0,count>0)"  # a rule reads the cells of its sheet alone
        rules = [
            Conditional(Area(cell.row, cell.col, cell.row, cell.col), formula(empty, cell=cell, count=on.value(self.key)),
                        styles.WARN)
            for cell in cells
        ]  # fmt: skip
        return Line(
            on.text(self.key), count, on.where_it_closes(words), levels=(look("count>0", count=on.value(self.key)),),
            rules=rules,
        )  # fmt: skip

    def in_title(self, on: Reading) -> InTitle:
        said = joined("; ", on.text(self.key), " ", on.words(self.key))
        return InTitle(last=formula('IFERROR(IF(count>0,said,""),"")', count=on.value(self.key), said=said))

    def _assumed(self, on: Reading, link: Link) -> Node:
        """Whether the cell holds 0 and the link's angular velocity changes."""
        speed = on.plan.mechanism.driver_rates[0]
        fastest = _largest(on, speed) if on.plan.at.spots[speed].column else Symbol(speed)
        return formula("AND(inertia=0,largest>even*(1+fastest^2))", inertia=Symbol(f"J_{link.number}"),
                       largest=_largest(on, link.rate_symbols[1]), even=EVEN, fastest=fastest)  # fmt: skip


def _largest(on: Reading, symbol: str) -> Node:
    """The largest size of a quantity."""
    return formula("MAX(most,-least)", most=on.extreme("max", symbol)[0], least=on.extreme("min", symbol)[0])


class MeanTorque(Finding):
    """The driver's mean torque over a turn at even speed."""

    key = "mean_torque"

    def line(self, on: Reading) -> Line:
        plan, torque = on.plan, on.plan.efforts[0]
        speed, acceleration = (Symbol(name) for name in plan.mechanism.driver_rates)
        even = formula("AND(whole=1,count=rows,speed<>0,acceleration=0)", count=on.value("rows_closed"), rows=on.of_rows,
                       whole=on.found.whole.cell, speed=speed, acceleration=acceleration)  # fmt: skip
        column = plan.at.column(torque, plan.main)
        mean = formula("IF(even,(SUM(column)-(first+last)/2)/steps,NA())", even=even, column=column, first=column.start,
                       last=column.end, steps=formula("MAX(1,rows-1)", rows=on.of_rows))  # fmt: skip
        words = _where_known(on, self.key, on.text("mean_torque.words"))
        unit = plan.equations.of(torque).unit.text
        return Line(on.text(self.key), mean, words, unit, decimals_of_kind(plan, "moment"))


class EnergyChange(Finding):
    """By how much the energy changes over the turn, and where the shaft is slowest and fastest."""

    key = "energy_change"
    needs = ("extremes",)  # it is the change from the mean torque of a whole turn

    def line(self, on: Reading) -> Line:
        plan, drivers = on.plan, on.drivers
        energy = plan.at.column(ENERGY, plan.main)
        slow, fast = (
            on.driver_text(formula(f"INDEX(drivers,MATCH({way}(energy),energy,0))", drivers=drivers, energy=energy))
            for way in ("MAX", "MIN")
        )
        words = joined(on.text("energy_change.slow"), " ", slow, on.text("energy_change.fast"), " ", fast)
        change = formula("MAX(energy)-MIN(energy)", energy=energy)
        unit = plan.equations.of(ENERGY).unit.text
        return Line("ΔE", change, _where_known(on, self.key, words), unit, decimals_of_kind(plan, "moment"))


class FlywheelInertia(Finding):
    """The moment of inertia that keeps the speed within its bounds."""

    key = "flywheel"
    needs = ("extremes",)

    def line(self, on: Reading) -> Line:
        mechanism = on.plan.mechanism
        inertia = formula(
            "change/(fluctuation*speed^2)", change=on.value("energy_change"), fluctuation=Symbol("fluctuation"),
            speed=Symbol(mechanism.driver_rates[0]),
        )  # fmt: skip
        unit = inertia_unit(mechanism.dynamics, mechanism.length_unit) if mechanism.dynamics else ""
        return Line(on.text(self.key), inertia, _where_known(on, self.key, on.text("flywheel.words")), unit,
                    styles.numbered(styles.RESULT, "0.000E+00"))  # fmt: skip


def _where_known(on: Reading, key: str, words: Node | str) -> Node:
    """Words where there is the number, else what it needs."""
    known = formula("IF(ISNUMBER(value),words,missing)", value=on.value(key), words=words,
                    missing=on.text("flywheel.missing"))  # fmt: skip
    return on.where_it_closes(known)


class DeadCentres(Finding):
    """In how many rows that close there are no velocities."""

    key = "dead_centres"

    def line(self, on: Reading) -> Line:
        count, closed = on.value(self.key), on.value("rows_closed")
        said, ok = there(on.plan.places.rates).whole(), on.plan.text("status.ok")
        some = on.text("dead_centres.some", rates=on.plan.at.titles["rates"])
        words = formula("IF(count=0,none,some)", count=count, none=on.text("dead_centres.none"), some=some)
        return Line(
            on.text(self.key), formula("closed-COUNTIF(said,ok)", closed=closed, said=said, ok=ok),
            on.where_it_closes(words), on.of_rows, levels=(look("count>0", count=count),),
        )  # fmt: skip


class Agrees(Finding):
    """How far two ways to the same numbers are apart.

    of     whose worst value the sheet of checks has;  words: where its words are
    """

    def __init__(self, key: str, of: Literal["velocity", "acceleration", "torque"], words: str) -> None:
        self.key, self.of, self.said = key, of, words
        self.needs = ("forces",) if of == "torque" else ("rates",)

    def line(self, on: Reading) -> Line:
        effort, said = self.of == "torque", on.words(self.key)
        most: Node | float = AGREES if effort else on.plan.checked.rounding.cell
        wrong, fine = on.text(f"{self.said}.not", sheet=on.checks.title), on.text(f"{self.said}.fit")
        words = formula("IF(gap>most,wrong,fine)", gap=on.value(self.key), most=most, wrong=wrong, fine=fine)
        words = _of_a_number(on, self.key, words)
        return Line(
            on.text(self.key), on.checks.worst_known(self.of), on.where_it_closes(words),
            "" if effort else on.plan.mechanism.length_unit, SMALL,
            levels=(bad("said=wrong", said=said, wrong=wrong), good("said=fine", said=said, fine=fine)),
        )  # fmt: skip
