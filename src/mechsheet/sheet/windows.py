"""Angles outside the table of positions, whose turns no column counts.

In a function, which sees one position alone, each is taken into one turn around a straight line over the driver (`Window`).
In a two-way table each is taken within half a turn of the cell above, so that it does not jump down the rows; in the first
row, and after rows that do not exist, within half a turn of such a line through the first position of the sweep.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass

import numpy as np

from mechsheet.formula import algebra as al
from mechsheet.formula.algebra import Angle
from mechsheet.formula.nodes import Call, Node, Symbol, symbols, transform
from mechsheet.kinematics.numeric import Array
from mechsheet.sheet.expansion import varying
from mechsheet.sheet.plan import Plan

WINDOWED = "{symbol} windowed"
"""The symbol of an angle taken into its window (no description can use a name with a blank in it)."""


@dataclass(frozen=True, slots=True)
class Window:
    """A turn wide, around the line  centre + slope * driver:  slope 0 for a link that swings, +-1 for one that turns."""

    slope: int
    centre: float

    def taken(self, angle: Node, driver: Node) -> Node:
        """The angle [rad] in the window: low + MOD(angle - low, a turn)."""
        edge = Angle(al.mul(al.number(self.slope), driver), round(math.degrees(self.centre)) - 180.0).expression()
        return al.add(Call("MOD", (al.sub(angle, edge), al.mul(al.TWO, al.PI))), edge)


def with_windows(plan: Plan, rules: dict[str, Node]) -> dict[str, Node]:
    """The rules, where outputs (and what is asked for) read angles that are counted in turns through their windows.

    Inside the equations of groups an angle may be off by whole turns: they take its sine and cosine, or add it to others.
    An output may halve it, so it reads `theta14 windowed`, a rule that stands after that of theta14.
    """
    windows = windows_of(plan, rules)
    driver = Symbol(plan.mechanism.driver.symbol)
    taken = {symbol: window.taken(Symbol(symbol), driver) for symbol, window in windows.items()}
    return _reading(plan, rules, taken)


def with_continued(plan: Plan, rules: dict[str, Node], near: Mapping[str, Node]) -> dict[str, Node]:
    """The same for a table, where `near` is what each of these angles is taken within half a turn of."""
    half = al.PI
    taken = {
        symbol: al.sub(
            al.add(place, Call("MOD", (al.add(al.sub(Symbol(symbol), place), half), al.mul(al.TWO, al.PI)))), half
        )
        for symbol, place in near.items()
    }
    return _reading(plan, rules, taken)


def windows_of(plan: Plan, rules: Mapping[str, Node]) -> dict[str, Window]:
    """The windows of the angles among the rules that are counted in turns, in order of solution."""
    counted = {equation.symbol for equation in plan.equations.columns if equation.first is not None}
    counted = varying(rules, counted)
    angles = {
        equation.symbol
        for equation in plan.equations.columns
        if equation.role == "variable" and equation.unit.kind == "angle" and equation.symbol in counted & rules.keys()
    }
    return _windows(plan, [symbol for symbol in rules if symbol in angles])


def _reading(plan: Plan, rules: dict[str, Node], taken: Mapping[str, Node]) -> dict[str, Node]:
    """The rules with those of the angles as they are taken, which outputs read."""
    outputs = {output.symbol for output in plan.mechanism.outputs}
    result: dict[str, Node] = {}
    for symbol, rule in rules.items():
        result[symbol] = _read_windowed(rule, taken.keys()) if symbol in outputs else rule
        if symbol in taken:
            result[WINDOWED.format(symbol=symbol)] = taken[symbol]
    return result


def _read_windowed(rule: Node, angles: Set[str]) -> Node:
    def change(part: Node) -> Node:
        if isinstance(part, Symbol) and part.name in angles:
            return Symbol(WINDOWED.format(symbol=part.name))
        return part

    return transform(rule, change) if not angles.isdisjoint(symbols(rule)) else rule


def _windows(plan: Plan, angles: Iterable[str]) -> dict[str, Window]:
    """Each angle's window, from the values that it has with the dimensions as described."""
    driver = np.array(plan.driver)
    values = plan.nominal
    turns = plan.mechanism.driver.unit.kind == "angle" and bool(np.ptp(driver) > 0)
    return {symbol: _window(values[symbol], driver, turns) for symbol in angles}


def _window(angle: Array, driver: Array, turns: bool) -> Window:
    known = np.isfinite(angle)
    if not known.any():
        return Window(0, 0.0)
    angle, driver = angle[known], driver[known]
    slope = 0
    if turns and np.ptp(driver) > 0:
        slope = round(float((angle[-1] - angle[0]) / (driver[-1] - driver[0]))) if driver[-1] != driver[0] else 0
    rest = angle - slope * driver
    return Window(slope, float(rest.max() + rest.min()) / 2)
