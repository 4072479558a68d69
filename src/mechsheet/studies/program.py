"""Equations as numpy computes them: steps over (designs x places) arrays, each value computed once.

A value is as wide as what it depends on: one number; one for each design (n, 1); one for each place (1, r), where all
designs are looked at in the same places; or one for each design and place (n, r). Numbers are folded when the program is
written; steps of the three other kinds are taken once for each chunk of designs, once for all, and for each block. A value
is forgotten where it is read for the last time, so that the next one takes its memory, which the cache still holds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary
from livesheet.formula.written import chosen_by_ifs
from mechsheet.kinematics.numeric import FUNCTIONS, OPERATORS, Array, without_jumps

ONE, DESIGN, PLACE, WHOLE = range(4)
"""How wide a value is; of two that meet, 1 | 2 = 3."""

Width: TypeAlias = int
Function: TypeAlias = Callable[..., Any]

_OPERATORS: Mapping[str, Function] = OPERATORS | {"^": np.power}
_CALLS: Mapping[str, Function] = FUNCTIONS | {
    "ACOS": np.arccos, "ASIN": np.arcsin, "ATAN": np.arctan, "COS": np.cos, "EXP": np.exp, "ISNUMBER": np.isfinite,
    "LN": np.log, "SIN": np.sin, "TAN": np.tan,
}  # fmt: skip
"""numpy's own functions: fast, and with the last bits of the processor."""

_FOLDED = {"AND": np.logical_and, "OR": np.logical_or, "MAX": np.maximum, "MIN": np.minimum}
_TRUTHS = frozenset((
    np.less, np.less_equal, np.greater, np.greater_equal, np.equal, np.isfinite, np.logical_not, np.logical_and,
    np.logical_or,
))  # fmt: skip


@dataclass(frozen=True, slots=True)
class Value:
    """One value of a program: a number, or a step's result by its name."""

    width: Width
    name: str = ""
    number: float = 0.0
    truth: bool = False


@dataclass(frozen=True, slots=True)
class _Step:
    target: Value
    function: Function
    operands: tuple[Value, ...]


class Program:
    """Steps, each once; `given` values come from outside by the symbols that they have."""

    def __init__(self) -> None:
        self._steps: list[_Step] = []
        self._known: dict[tuple[Any, ...], Value] = {}
        self._given: dict[str, Value] = {}

    def given(self, symbol: str, width: Width) -> Value:
        """What comes from outside."""
        return self._given.setdefault(symbol, Value(width, f"g{len(self._given)}"))

    def step(self, function: Function, *operands: Value) -> Value:
        """The result of a function over arrays; the same step twice is one."""
        if function in (np.multiply, np.add) and (same := _neutral(function, operands)) is not None:
            return same
        key = (function, *operands)
        if key not in self._known:
            self._known[key] = self._new(function, operands)
        return self._known[key]

    def _new(self, function: Function, operands: tuple[Value, ...]) -> Value:
        width = ONE
        for operand in operands:
            width |= operand.width
        truth = function in _TRUTHS
        if width == ONE:
            with np.errstate(all="ignore"):
                return Value(ONE, number=float(function(*(operand.number for operand in operands))), truth=truth)
        value = Value(width, f"v{len(self._steps)}", truth=truth)
        self._steps.append(_Step(value, function, operands))
        return value

    def value(self, node: Node, known: Mapping[str, Value], rooted: bool = False) -> Value:
        """The value of a tree over symbols that are known.

        rooted  what stands under a root is a rounding error where it is negative, and counts as 0
        """

        def of(part: Node) -> Value:
            return self.value(part, known, rooted)

        match node:
            case Number(number):
                return Value(ONE, number=number)
            case Symbol(name):
                return known[name]
            case Unary("-", operand):
                return self.step(np.multiply, of(operand), Value(ONE, number=-1.0))
            case Unary("+", operand):
                return of(operand)
            case Unary("%", operand):
                return self.step(np.divide, of(operand), Value(ONE, number=100.0))
            case Binary("^", base, Number(2.0)):
                root = of(base)
                return self.step(np.multiply, root, root)
            case Binary(op, left, right) if op in _OPERATORS:
                return self.step(_OPERATORS[op], of(left), of(right))
            case Call("ATAN2", (x, y)):  # the sheet's order is x first, numpy's y first
                return self.step(np.arctan2, of(y), of(x))
            case Call("SQRT", (square,)) if rooted:
                return self.root(of(square))
            case Call("SUMSQ", args):
                return self.fold(np.add, [of(Binary("^", arg, Number(2.0))) for arg in args])
            case Call("CHOOSE"):
                return of(chosen_by_ifs(node))
            case Call(name, args) if name in _FOLDED:
                return self.fold(_FOLDED[name], [of(arg) for arg in args])
            case Call(name, args) if name in _CALLS:
                return self.step(_CALLS[name], *map(of, args))
        raise ValueError(f"no numeric meaning here: {node}")

    def root(self, square: Value) -> Value:
        """The square root, of less than 0 that of 0."""
        return self.step(np.sqrt, self.step(np.maximum, square, Value(ONE, number=0.0)))

    def fold(self, function: Function, values: Sequence[Value]) -> Value:
        """A function of two, over any number of values."""
        result = values[0]
        for value in values[1:]:
            result = self.step(function, result, value)
        return result

    def running(self, wanted: Mapping[str, Value]) -> Running:
        """The steps that give the values wanted, and no others."""
        live = {value.name for value in wanted.values()}
        needed = []
        for step in reversed(self._steps):
            if step.target.name in live:
                needed.append(step)
                live |= {operand.name for operand in step.operands}
        return Running(needed[::-1], {symbol: value.name for symbol, value in self._given.items()}, wanted)


class Running:
    """A program that can be called.

    given   names of what comes from outside, by their symbols;  wanted  what the program gives, by names of its own
    """

    def __init__(self, steps: Sequence[_Step], given: Mapping[str, str], wanted: Mapping[str, Value]) -> None:
        self._given, self._wanted = given, wanted
        kept = {value.name for value in wanted.values()}
        kept |= {operand.name for step in steps if step.target.width == WHOLE for operand in step.operands
                 if operand.width != WHOLE}  # fmt: skip
        self._parts = {
            width: _ending([step for step in steps if step.target.width == width], kept)
            for width in (DESIGN, PLACE, WHOLE)
        }

    def designs(self, given: Mapping[str, Array]) -> dict[str, Array]:
        """What depends on designs alone, by the names in the program; `given` by symbols."""
        return self._run(DESIGN, self._named(given))

    def places(self, given: Mapping[str, Array]) -> dict[str, Array]:
        """What depends on places alone."""
        return self._run(PLACE, self._named(given))

    def both(self, *known: Mapping[str, Array], given: Mapping[str, Array]) -> dict[str, Any]:
        """All that is wanted, by the names that `Program.running` was given; numbers where they are numbers."""
        names = self._named(given)
        for part in known:
            names |= part
        names |= self._run(WHOLE, names)
        return {
            key: names[value.name] if value.name else np.float64(value.number) for key, value in self._wanted.items()
        }

    def _named(self, given: Mapping[str, Array]) -> dict[str, Array]:
        return {name: given[symbol] for symbol, name in self._given.items() if symbol in given}

    def _run(self, width: Width, names: Mapping[str, Array]) -> dict[str, Array]:
        found: dict[str, Any] = {}
        for step, dead in self._parts[width]:
            operands = [
                (found[each.name] if each.name in found else names[each.name]) if each.name else each.number
                for each in step.operands
            ]
            found[step.target.name] = step.function(*operands)
            operands.clear()
            for name in dead:
                del found[name]
        return found


def _ending(steps: Sequence[_Step], kept: Iterable[str]) -> list[tuple[_Step, tuple[str, ...]]]:
    """Each step with the names of what nobody reads after it."""
    own = {step.target.name for step in steps} - set(kept)
    ends: list[tuple[_Step, tuple[str, ...]]] = []
    for step in reversed(steps):
        dead = dict.fromkeys(operand.name for operand in step.operands if operand.name in own)
        own.difference_update(dead)
        ends.append((step, tuple(dead)))
    return ends[::-1]


def _neutral(function: Function, operands: Sequence[Value]) -> Value | None:
    """The other operand of 1 x and x + 0."""
    number = 1.0 if function is np.multiply else 0.0
    for one, other in (operands, operands[::-1]):
        if one.width == ONE and one.number == number and not other.truth:
            return other
    return None


# --- functions that numpy does not have -----------------------------------------------------------------------------------


def kept(value: Any, there: Any) -> Any:
    """The value where it exists, NaN elsewhere."""
    shape = np.broadcast_shapes(np.shape(value), np.shape(there))
    return value if np.shape(value) == shape and np.all(there) else np.where(there, value, np.nan)


def unwrapped(angles: Any) -> Any:
    """Angles without jumps along the places of each design: none more than half a turn from the one before."""
    if np.shape(angles)[-1] < 2:
        return angles
    steps = np.subtract(angles[:, :-1], angles[:, 1:])
    far = ~(np.abs(steps) < np.pi)
    if not far.any():
        return angles
    found = angles.copy()
    designs = np.flatnonzero(far.any(axis=1))
    some = found[designs]
    known = np.isfinite(some).all(axis=1)
    if known.all():
        turns = np.cumsum(np.rint(steps[designs] * (1 / math.tau)), axis=1)
        found[designs, 1:] = some[:, 1:] + math.tau * turns
    else:
        for design, row in zip(designs, some, strict=True):
            found[design] = without_jumps(row)
    return found


def near(angles: Any, place: Any) -> Any:
    """Angles within half a turn of a place."""
    return angles + math.tau * np.rint((place - angles) * (1 / math.tau))
