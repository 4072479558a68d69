"""A mechanism's designs by the thousand: what is asked of them, the programs that answer it, what all of them share."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from functools import cached_property

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import Node, symbols, with_symbols
from livesheet.said import say
from mechsheet.compiled import Compiled
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_order, dimension_values, largest_length
from mechsheet.kinematics.driving import given_between, given_values, step_of
from mechsheet.kinematics.equations import FORCES, RATES
from mechsheet.kinematics.inputs import asked_of
from mechsheet.kinematics.numeric import Array, value
from mechsheet.kinematics.whole_turns import LEAST_OF_TURN, Periods
from mechsheet.model import Mechanism, Study, Way
from mechsheet.sheet.checks.boundless import bounded, divisor_of, seen_by_rates
from mechsheet.sheet.checks.search_rules import CORNER_PLACE, WRAPS
from mechsheet.sheet.classification import classification
from mechsheet.sheet.columns.lowering import lowered
from mechsheet.sheet.over_rows import is_back, meeting, whole_turns
from mechsheet.sheet.plan import LEAST_PROBED
from mechsheet.studies.extremes import Asked
from mechsheet.studies.lowering import Lowered, Lowering
from mechsheet.studies.questions import Questions, questions_of
from mechsheet.studies.sampling import sampling_of

DESIGN, REMARKS, APART = "design", "remarks", "set_apart"
"""Columns that every study has: the number of the design, from 1; what the workbook says of its numbers; whether it is set
apart for it."""

DIVISOR = "divisor of {symbol}"
"""The column of what a quantity is divided by only as an absolute value."""


class Designs:
    """All designs of a mechanism's study. Raises MechanismError for what a study cannot answer.

    varied     symbols of the dimensions that vary;  dependent: they, and those that follow from them
    given      of every row the driver's value and what is given beside it;  rows: how many
    row_given  the same as arrays of one design
    constants  the program for what rows do not change
    ruling     the one for what conditions ask of the rows;  in_rows: for all quantities there
    at_places  by quantity the one for it at other places;  seen_by_rates: those that have columns of both derivatives
    closing    there, for how far groups are from coming apart
    spiking    groups whose dead centres make spikes in what is asked for;  spiky: quantities that have them
    may_grow   quantities that can be without bound;  divisors: what those of them are divided by as absolute values
    unprobed   whether no margin says where a stretch of rows ends
    between_unseen  whether there are so few rows that nothing is looked for between them
    decisive   names of the quantities that conditions and objectives read
    """

    def __init__(self, mechanism: Mechanism) -> None:
        if mechanism.study is None:
            raise MechanismError(
                Fault(say("the description has no part [study]"), key="study", hint=say("[study] vary = { … }"))
            )
        self.mechanism = mechanism
        self.study: Study = mechanism.study
        self.varied = tuple(one.symbol for one in self.study.vary)
        compiled = Compiled(mechanism)
        self.equations = compiled.equations
        self.modes = compiled.modes
        self._following = _following(mechanism, self.varied)
        self._refuse()
        self.sampling = sampling_of(self.study)
        self.questions: Questions = questions_of(mechanism, self.study, self.equations)
        self.dimensions = dimension_values(mechanism)
        self.units = {dim.symbol: dim.unit for dim in mechanism.dimensions}
        self.size = largest_length(mechanism, self.dimensions) or 1.0
        self.given = given_values(mechanism, self.dimensions)
        self.rows = len(self.given[mechanism.driver.symbol])
        self._refuse_names()
        self._write()

    # --- before -----------------------------------------------------------------------------------------------------------

    def _refuse(self) -> None:
        for group in self.equations.groups:
            if group.system is not None:
                message = say("a study does not solve links that must be found all at once: {group}", group=group.label)
                hint = say("`mechsheet build --set` builds one design at a time")
                raise MechanismError(Fault(message, key="study", hint=hint))
        synthesis = self.mechanism.synthesis
        if synthesis is not None and any(self._following.get(symbol) for symbol in synthesis.steps):
            message = say("the dimensions that a synthesis finds vary here, and its assembly with them")
            raise MechanismError(Fault(message, key="study.vary", hint=say("vary what the synthesis does not read")))
        driver = self.mechanism.driver
        parts = [driver.start, driver.stop, driver.step, *driver.values]
        parts += [value for values in self.mechanism.listed.values() for value in values]
        names = {name for part in parts if not isinstance(part, float) for name in symbols(part)}
        if driver.law is not None:
            names |= {driver.law.start, driver.law.stop, driver.law.duration}
        moved = sorted({symbol for name in names for symbol in self._following.get(name, ())})
        if moved:
            message = say(
                "the driver's values follow {moved}, which vary here: each design would have its own rows",
                moved=", ".join(moved),
            )
            raise MechanismError(
                Fault(message, key="study.vary", hint=say("give [driver] start, stop and step as numbers"))
            )

    def _refuse_names(self) -> None:
        for name in self.names:
            if name in (DESIGN, REMARKS, APART):
                message = say('every study has a column "{name}" of its own', name=name)
                raise MechanismError(Fault(message, key="study", hint=say("give it another name in the description")))

    def _write(self) -> None:
        """Write the programs."""
        mechanism, questions = self.mechanism, self.questions
        driver = mechanism.driver.symbol
        self.dependent = [symbol for symbol, moved in self._following.items() if moved]
        nodes = {dim.symbol: dim.value for dim in mechanism.dimensions}
        derived = [(symbol, node) for symbol in self.dependent if not isinstance(node := nodes[symbol], float)]
        fixed = {symbol: number for symbol, number in self.dimensions.items() if symbol not in self.dependent}
        fixed |= {mode: float(number) for mode, number in self.modes.items()}
        given = dict.fromkeys((driver, *self.given))
        lowering = Lowering(self.equations, fixed, self.varied, derived, given, asked_of(mechanism))
        wanted = dict.fromkeys(quantity.of for quantity in questions.quantities)
        self.cranks = {each.name: self._angle_of(each.name) for each in questions.others if each.kind == "crank"}
        turning = [symbol for symbol in self.cranks.values() if symbol != driver]
        self.lengths = {
            name: [f"{name} {side}" for side in range(len(nodes))] for name, nodes in questions.loops.items()
        }
        sides = {
            key: node
            for name, keys in self.lengths.items()
            for key, node in zip(keys, questions.loops[name], strict=True)
        }
        tolerance = self.equations.tolerance
        self.constants = lowering.constants([*self.dependent, tolerance], sides)
        self.row_given = {symbol: column[None, :] for symbol, column in self.given.items()}
        decided = {name for each in questions.others for side in each.sides for name in symbols(side)}
        ruling = [quantity.of for quantity in questions.quantities if quantity.name in decided]
        ruling = list(dict.fromkeys([*ruling, *turning, *self.equations.tied, tolerance]))
        self.ruling = Called(lowering.columns(ruling, rows=True, closing=bool(self.cranks)), self.row_given)
        self.limits = bool(lowering.margins) and not mechanism.driver.values and self.rows > 1
        self.between_unseen = self.rows < LEAST_PROBED and not mechanism.driver.values
        self.rows_only = bool(mechanism.driver.values) or self.between_unseen or mechanism.layout == "page"
        self._doubts(wanted)
        wanted |= dict.fromkeys(group.transmission for group in self.spiking)
        divisors = {DIVISOR.format(symbol=symbol): node for symbol, node in self.divisors.items()}
        self.in_rows = Called(
            lowering.columns([*wanted, *self.equations.tied], rows=True, anchors=True, nodes=divisors), self.row_given
        )
        self.closing = Called(lowering.columns([], rows=False, closing=True))
        self.at_places = {of: Called(lowering.columns([of], rows=False)) for of in wanted}
        rates = {equation.symbol for equation in self.equations.columns if equation.role in RATES}
        self.seen_by_rates = {of for of in wanted if seen_by_rates(mechanism, rates, of)}
        self._asked: dict[tuple[str, Way], Asked] = {}
        self.decisive = [quantity.name for quantity in questions.quantities if quantity.name in self._read]

    def _doubts(self, wanted: Iterable[str]) -> None:
        """Which quantities may be without bound, and by what they are divided; whether nobody knows where stretches end."""
        equations, mechanism = self.equations, self.mechanism
        assignments = lowered(mechanism, equations)
        loose = bool(assignments.crossings) or any(group.only_undetermined for group in equations.groups)
        self.unprobed = loose and not assignments.margins and not mechanism.driver.values
        transmission = classification(mechanism, assignments).transmission
        columns = {equation.symbol for equation in equations.columns} | self.given.keys()
        self.may_grow = set() if self.rows_only else {*wanted} & columns - bounded(mechanism, equations, transmission)
        self.spiky = set() if self.rows_only else {symbol for symbol in wanted if self._reads_rates(symbol)}
        self.spiking = transmission if self.spiky else ()
        self.divisors: dict[str, Node] = {}
        for symbol in sorted(self.may_grow - self.given.keys()):
            divisor = divisor_of(equations.of(symbol).expression, lambda each: not columns.isdisjoint(symbols(each)))
            if divisor is not None:
                self.divisors[symbol] = divisor

    def _reads_rates(self, symbol: str) -> bool:
        """Whether a quantity is, or reads, a velocity or a force."""
        return any(equation.role in (*RATES, *FORCES) for equation in self.equations.behind([symbol]))

    @property
    def _read(self) -> set[str]:
        """Names that conditions and objectives read."""
        sides = [side for each in self.study.keep for side in each.sides]
        return {name for node in (*sides, *(each.value for each in self.study.objectives)) for name in symbols(node)}

    @property
    def step(self) -> float:
        """How far the driver goes from row to row."""
        return step_of(self.given[self.mechanism.driver.symbol])

    def _angle_of(self, link: str) -> str:
        mechanism = self.mechanism
        if mechanism.driver.link == link and mechanism.driver.relative_to == mechanism.ground.name:
            return mechanism.driver.symbol
        return mechanism.link(link).angle_symbol

    # --- the driver -------------------------------------------------------------------------------------------------------

    def driven(self, places: Array) -> dict[str, Array]:
        """The driver's values, and what is given beside them, at places counted in rows from 1."""
        return given_between(self.mechanism, self.dimensions, self.given, places)

    def whole(self, columns: Mapping[str, Array], designs: int) -> Array:
        """What the rows cover, for each design: 1 for whole turns whose last row is the first again, 2 where that row is
        left out, else 0."""
        driver = self.mechanism.driver
        if not driver.link or driver.values or self.rows < LEAST_OF_TURN:
            return np.zeros(designs)
        values, tied = self.given[driver.symbol], self.equations.tied
        covered = abs(float(values[-1] - values[0])) / math.tau
        back = np.ones(designs, bool)
        for symbol in tied:  # what gears turn is not back with every turn of the driver
            known = {
                "first": columns[symbol][:, 0],
                "last": columns[symbol][:, -1],
                "turn": math.tau,
                "size": self.size,
            }
            back &= value(is_back(self.is_angle(symbol)), known)
        turns = {"covered": covered, "more": covered * self.rows / (self.rows - 1), "back": back}
        return np.broadcast_to(value(whole_turns(driver.law is not None, bool(tied)), turns), (designs,)).astype(float)

    def unchanged(self, inside: Mapping[str, Array], count: int) -> dict[str, Array]:
        """What rows do not change, of so many designs."""
        with np.errstate(all="ignore"):
            out = self.constants.both(self.constants.designs(inside), given=inside)
        return {key: np.broadcast_to(column, (count, 1))[:, 0] for key, column in out.items()}

    def corners(self, inside: Mapping[str, Array], whole: Array) -> list[Array]:
        """Places of each design where pieces of its motion meet (`sheet/checks/corners.py`)."""
        if self.rows_only or not self.mechanism.seams:
            return []
        known = {**self.dimensions, **self.unchanged(inside, len(whole))}
        known |= {symbol: column[:, 0] for symbol, column in inside.items()}
        known |= {"start": float(self.given[self.mechanism.driver.symbol][0]), "step": self.step, "turn": math.tau}
        known |= {"rows": self.rows, "whole": whole}
        angles = (value(angle, known) for angle in self.mechanism.seams)
        return [value(CORNER_PLACE, known | {"angle": angle}) * np.ones(len(whole)) for angle in angles]

    def is_angle(self, symbol: str) -> bool:
        """Whether a quantity is an angle, which may go on by whole turns."""
        return self.equations.is_angle(self.mechanism, symbol)

    def asked(self, symbol: str, way: Way) -> Asked:
        """An extreme, and what decides where its search begins."""
        if (symbol, way) not in self._asked:
            unit = self.equations.unit_of(self.mechanism, symbol)
            wraps = with_symbols(WRAPS, {"meet": meeting(self._periods.change(symbol), unit)})
            pole = symbol in self.may_grow and symbol not in self.seen_by_rates
            moves = self.mechanism.driver.law is None
            self._asked[symbol, way] = Asked(way, wraps, moves, self.limits, pole)
        return self._asked[symbol, way]

    @cached_property
    def _periods(self) -> Periods:
        return Periods(self.equations.columns, self.mechanism.driven_symbols)

    @property
    def names(self) -> tuple[str, ...]:
        """The columns of the result, in order: dimensions varied, summaries and extremes, objectives."""
        own = [*self.varied, *(quantity.name for quantity in self.questions.quantities)]
        return tuple(dict.fromkeys([*own, *(each.text for each in self.study.objectives)]))


class Called:
    """A program that was lowered and is called.

    of_rows  what rows alone decide, where it is one for rows
    """

    def __init__(self, lowered: Lowered, row_given: Mapping[str, Array] | None = None) -> None:
        self.anchors, self.margins = lowered.anchors, lowered.margins
        self.run = lowered.run
        with np.errstate(all="ignore"):
            self.of_rows = {} if row_given is None else self.run.places(row_given)


def _following(mechanism: Mechanism, varied: tuple[str, ...]) -> dict[str, set[str]]:
    """By dimension, in the order of derivation, which of those that vary it follows."""
    found: dict[str, set[str]] = {}
    values = {dim.symbol: dim.value for dim in mechanism.dimensions}
    for symbol in dimension_order(mechanism):
        value = values[symbol]
        own = {symbol} & set(varied)
        found[symbol] = own if isinstance(value, float) else own.union(*(found[name] for name in symbols(value)))
    return found
