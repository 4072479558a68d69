"""Workbooks whose first sheet is judged, after inputs were typed, and the motion that these inputs mean."""

from __future__ import annotations

import math
import zlib
from copy import copy
from dataclasses import replace

import numpy as np
from placed import places_of

from folders import ROOT
from livesheet.engine import compile_book
from livesheet.evaluation import book_of
from livesheet.formats import write
from livesheet.workbook import Fill, Sheet
from mechsheet.description import load, loads
from mechsheet.diagnostics import MechanismError
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.search import TURN, Search
from mechsheet.reference.geometry import link_points
from mechsheet.sheet import styles
from mechsheet.sheet.layout import lay_out
from mechsheet.sheet.plan import MEANING, VALUE
from random_mechanisms import Grower
from typed_files import with_inputs

COLOURS = {id(styles.BAD): "red", id(styles.WARN): "amber", id(styles.GOOD): "green"}


# --- the sheet -----------------------------------------------------------------------------------------------------------


class Sheets:
    """A mechanism's workbook, ready for changed inputs: without its drawing, with the first sheet's colour rules as
    cells.

    values  of its cells, with the inputs typed last
    """

    def __init__(self, mechanism):
        self.mechanism = mechanism
        self.equations = solve(mechanism)
        workbook, self.plan = lay_out(mechanism, self.equations)
        titles = self.plan.at.titles
        wanted = (
            "mechanism",
            "synthesis",
            "positions",
            "rates",
            "forces",
            "checks",
            "extremes",
            "iterations",
            "tolerance",
        )
        needed = {titles[key] for key in wanted if key in titles}
        self.rules = []
        sheets = []
        for sheet in workbook.sheets:
            if sheet.title == self.plan.main:
                sheet = self._with_rules(sheet)
            sheets.append(replace(sheet, charts=(), controls=()) if sheet.title in needed else Sheet(sheet.title))
        self.workbook = replace(workbook, sheets=tuple(sheets))
        self.book = compile_book(book_of(self.workbook))
        self.names = {name.name: name for name in workbook.names}
        self.values = None
        self.truths = {}

    def _with_rules(self, sheet):
        fills = []
        for index, rule in enumerate(sheet.conditionals):
            self.rules.append((rule.area, 60 + index, COLOURS.get(id(rule.style), "other")))
            fills.append(Fill(0, 60 + index, rule.condition))
        return replace(sheet, fills=(*sheet.fills, *fills))

    def type(self, inputs):
        """Type what stands in `inputs` by symbol, as shown; None empties a cell."""
        self.values = self.book.evaluate(self.cells_of(inputs))

    def write(self, inputs, path):
        """The file with these inputs typed: 0 is stored as the result of every formula, which nobody may believe."""
        write(with_inputs(self.workbook, self.cells_of(inputs)), path)

    def truth_of(self, inputs):
        """The motion that these inputs mean; kept, since several programs are judged by it."""
        key = tuple(sorted(inputs.items()))
        if key not in self.truths:
            self.truths[key] = Truth(self, dict(key))
        return self.truths[key]

    def cells_of(self, inputs):
        """The cells in which inputs stand."""
        spots = places_of(self.plan)
        return {(spots[key].sheet, spots[key].row, spots[key].col): value for key, value in inputs.items()}

    def elsewhere(self, values):
        """The same workbook with another program's values."""
        found = copy(self)
        found.values = values
        return found

    def cell(self, row, col):
        return self.values.get(self.plan.main, row, col)

    def of(self, key, col=VALUE):
        return self.cell(self.plan.blocks["verdicts"].rows[key], col)

    def words(self, key):
        return self.of(key, MEANING)

    def spot(self, key):
        spot = places_of(self.plan)[key]
        return self.values.get(spot.sheet, spot.row, spot.col)

    def colour(self, row, col):
        """The colour of a cell of the first sheet: of the first rule that holds."""
        for area, place, colour in self.rules:
            inside = area.first_row <= row <= area.last_row and area.first_col <= col <= area.last_col
            if inside and self.cell(0, place) is True:
                return colour
        return ""


# --- the truth -----------------------------------------------------------------------------------------------------------


class Truth(Search):
    """The motion that these inputs mean, searched (`mechsheet.kinematics.search`)."""

    def __init__(self, sheets, inputs):
        mechanism, equations = sheets.mechanism, sheets.equations
        self.plan = sheets.plan
        given = dict(inputs)
        changed = []
        for dim in mechanism.dimensions:
            if dim.symbol in given:
                shown = given.pop(dim.symbol)
                dim = replace(dim, value=math.radians(shown) if dim.unit.in_degrees else float(shown))
            changed.append(dim)
        driver = mechanism.driver
        self.scale = math.degrees(1.0) if driver.unit.in_degrees else 1.0
        mechanism = replace(mechanism, dimensions=tuple(changed))
        dimensions = dimension_values(mechanism)
        self._in_one_turn(mechanism.segments, dimensions)
        if driver.values:
            listed = np.array([number(value, dimensions) for value in driver.values])
        else:
            start, step = (
                given.pop(key) / self.scale if key in given else number(getattr(driver, key), dimensions)
                for key in ("start", "step")
            )
            listed = start + step * np.arange(self.plan.rows)
        groups = tuple(self._as_typed(group, given, dimensions) for group in equations.groups)
        if given:
            raise ValueError(f"unknown inputs: {given}")
        super().__init__(mechanism, replace(equations, groups=groups), {driver.symbol: listed})

    @staticmethod
    def _in_one_turn(motion, dimensions):
        """A cam's segments that leave the turn are no motion."""
        for part in motion.parts if motion is not None else ():
            begins, over = number(part.begins, dimensions), number(part.over, dimensions)
            if over <= 0 or begins + over > TURN + 1e-9:
                raise ValueError("the segments leave the turn")

    @staticmethod
    def _as_typed(group, given, dimensions):
        """A group with the assembly that is typed, or that follows from the task of a synthesis."""
        if group.mode in given:
            return replace(group, assembly=group.assembly_of(given.pop(group.mode)))
        if group.follows is not None:
            return replace(group, assembly=group.assembly_of(number(group.follows, dimensions)))
        return group

    def is_constant(self, name):
        """Whether a symbol is the same in every row."""
        return any(equation.symbol == name for equation in self.equations.constants)

    def misfits(self):
        """By how much the length of each redundant link is off in the worst row that closes: the way between the joints that
        it has with the others, against the places of these in the link, as the reference reads them."""
        found = []
        for each in self.mechanism.redundant:
            own = link_points(each.link, self.dimensions)
            pins = {
                point: np.stack(self._pin(point), axis=-1)
                for point in own
                if any(point in link.points for link in self.mechanism.whole_links if link.name != each.link.name)
            }
            start, end = pins
            way = np.linalg.norm(pins[end] - pins[start], axis=-1)
            length = np.linalg.norm(own[end] - own[start])
            found.append((each.link, float(np.max(np.abs(way - length)[self.row_there], initial=0.0))))
        return found

    def _pin(self, point):
        """(x, y) in all rows of a point that another link has too."""
        if point in self.mechanism.ground.points:
            x, y = link_points(self.mechanism.ground, self.dimensions)[point]
            return np.full(self.rows, x), np.full(self.rows, y)
        return self.in_rows(f"{point}.x"), self.in_rows(f"{point}.y")

    def place(self, driver_shown):
        """Where the driver has a value as shown, counted in rows."""
        return 1 + (driver_shown / self.scale - float(self.driver(1.0))) / self.step

    def value_at(self, symbol, driver_shown, of=None):
        """The quantity at a value of the driver as shown, as the sweep reaches it."""
        if self.stepped:
            u = self.place(driver_shown)
        else:
            u = 1 + float(np.argmin(np.abs(self.listed - driver_shown / self.scale)))
        if not 1 - 1e-6 <= u <= self.last + 1e-6:
            return None
        u = min(max(u, 1.0), float(self.last))
        known = self.known(np.array([u]))
        raw = float(np.asarray((of or (lambda x: x))(known[symbol]))[0])
        column = np.asarray((of or (lambda x: x))(self.at[symbol]), float)
        if self.is_angle(symbol) and math.isfinite(raw):
            held = self._held(column)[int(np.clip(round((u - 1) * self.fine), 0, len(self.u) - 1))]
            raw -= TURN * round((raw - held) / TURN)
        return raw


# --- changes -------------------------------------------------------------------------------------------------------------


def shown_inputs(sheets):
    """What the yellow cells of dimensions, start, step and modes hold, by symbol."""
    found = {}
    for dim in sheets.mechanism.dimensions:
        if not dim.derived:
            found[dim.symbol] = (
                dim.shown
                if dim.shown is not None
                else math.degrees(dim.value)
                if dim.unit.in_degrees
                else float(dim.value)
            )
    return found


def change(sheets, random):
    """Random changes of some yellow cells."""
    plan, driver = sheets.plan, sheets.mechanism.driver
    inputs = {}
    spread = random.choice([0.02, 0.1, 0.3, 0.6])
    for symbol, value in shown_inputs(sheets).items():
        dim = next(each for each in sheets.mechanism.dimensions if each.symbol == symbol)
        if random.random() < 0.4:
            continue
        inputs[symbol] = (
            float(value + math.degrees(random.normal(0, spread)))
            if dim.unit.in_degrees
            else float(value * math.exp(random.uniform(-spread, spread)))
        )
    if not driver.values and driver.link:
        degrees = 1.0 if driver.unit.in_degrees else math.radians(1.0)
        if isinstance(driver.start, float) and random.random() < 0.5:
            inputs["start"] = round(random.uniform(-180, 360), 3) * degrees
        if isinstance(driver.step, float) and random.random() < 0.5:
            whole = 360 / (plan.rows - 1)
            steps = [whole, -whole, 360 / plan.rows, random.uniform(0.2, 1.5) * whole, -random.uniform(0.2, 1) * whole]
            inputs["step"] = float(steps[int(random.integers(len(steps)))]) * degrees
    for group in plan.equations.groups:
        if group.mode and random.random() < 0.3 and group.follows is None:  # the cell of one that follows is not yellow
            inputs[group.mode] = float(
                next(value for value in (*group.mode_values[::-1], 0) if value != group.mode_value)
            )
    return inputs


def random_sheets(seed, dyads, rows=25, step=15.0, language="en"):
    """The workbook of a random mechanism, or None where it has none."""
    try:
        return Sheets(loads(Grower(seed, dyads).text(rows, step, language)))
    except MechanismError:
        return None


def named_sheets(name):
    """The workbook of a template, or of `random SEED`."""
    if name.startswith("random "):
        seed = int(name.split()[1])
        return random_sheets(seed, 1 + seed % 3)
    return Sheets(load(ROOT / f"templates/{name}.toml"))


def settings_of(name, sheets, changes):
    """As described, and so many random changes: the same ones for the same name."""
    random = np.random.default_rng(zlib.crc32(name.encode()))
    return [{}, *(change(sheets, random) for _ in range(changes))]
