"""Angles of the two-way tables, whose cells have no row above: each is taken into one turn around a straight line."""

from __future__ import annotations

import math
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
    """The rules, where outputs (and the table itself) read angles that are counted in turns through their windows.

    Inside the equations of groups an angle may be off by whole turns: they take its sine and cosine, or add it to others.
    An output may halve it, so it reads `theta14 windowed`, a rule that stands after that of theta14.
    """
    counted = {equation.symbol for equation in plan.equations.columns if equation.first is not None}
    counted = varying(rules, counted)
    angles = {
        equation.symbol
        for equation in plan.equations.columns
        if equation.role == "variable" and equation.unit == "angle" and equation.symbol in counted & rules.keys()
    }
    if not angles:
        return rules
    outputs = {output.symbol for output in plan.mechanism.outputs}
    windows = _windows(plan, angles)
    driver = Symbol(plan.mechanism.driver.symbol)
    result: dict[str, Node] = {}
    for symbol, rule in rules.items():
        result[symbol] = _read_windowed(rule, angles) if symbol in outputs else rule
        if symbol in angles:
            result[WINDOWED.format(symbol=symbol)] = windows[symbol].taken(Symbol(symbol), driver)
    return result


def _read_windowed(rule: Node, angles: set[str]) -> Node:
    def change(part: Node) -> Node:
        if isinstance(part, Symbol) and part.name in angles:
            return Symbol(WINDOWED.format(symbol=part.name))
        return part

    return transform(rule, change) if angles.intersection(symbols(rule)) else rule


def _windows(plan: Plan, angles: set[str]) -> dict[str, Window]:
    """Each angle's window, from the values that it has with the dimensions as described."""
    driver = np.array(plan.driver)
    values = plan.nominal
    turns = plan.mechanism.driver.unit in ("deg", "rad") and bool(np.ptp(driver) > 0)
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
