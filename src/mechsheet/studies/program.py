"""Equations printed as numpy: straight-line functions over (designs x places) arrays, each value computed once.

A value is as wide as what it depends on: one number; one for each design (n, 1); one for each place (1, r), where all
designs are looked at in the same places; or one for each design and place (n, r). Numbers are folded when the program is
written; the three other kinds are three functions, called once for each chunk of designs, once for all, and for each block.
Where an operand of a whole array is read for the last time, the result takes its memory.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary
from livesheet.formula.written import chosen_by_ifs
from mechsheet.kinematics.numeric import FUNCTIONS, Array, without_jumps

ONE, DESIGN, PLACE, WHOLE = range(4)
"""How wide a value is; of two that meet, 1 | 2 = 3."""

Width: TypeAlias = int

_OPERATORS = {
    "+": "np.add", "-": "np.subtract", "*": "np.multiply", "/": "np.divide", "^": "np.power", "<": "np.less",
    "<=": "np.less_equal", ">": "np.greater", ">=": "np.greater_equal", "=": "np.equal",
}  # fmt: skip
_CALLS = {
    "ABS": "np.abs", "ACOS": "np.arccos", "ASIN": "np.arcsin", "ATAN": "np.arctan", "COS": "np.cos", "DEGREES": "np.degrees",
    "EXP": "np.exp", "IF": "np.where", "ISNUMBER": "np.isfinite", "LN": "np.log", "NOT": "np.logical_not",
    "RADIANS": "np.radians", "ROUND": "_rounded", "SIGN": "np.sign", "SIN": "np.sin", "SQRT": "np.sqrt", "TAN": "np.tan",
}  # fmt: skip
_FOLDED = {"AND": "np.logical_and", "OR": "np.logical_or", "MAX": "np.maximum", "MIN": "np.minimum"}
_IN_PLACE = frozenset((
    "np.add", "np.subtract", "np.multiply", "np.divide", "np.power", "np.arctan2", "np.abs", "np.arccos", "np.arcsin",
    "np.arctan", "np.cos", "np.degrees", "np.exp", "np.log", "np.radians", "np.sign", "np.sin", "np.sqrt", "np.tan",
    "np.maximum", "np.minimum",
))  # fmt: skip
_TRUTHS = frozenset((
    "np.less", "np.less_equal", "np.greater", "np.greater_equal", "np.equal", "np.isfinite", "np.logical_not",
    "np.logical_and", "np.logical_or",
))  # fmt: skip


@dataclass(frozen=True, slots=True)
class Value:
    """One value of a program: a number, or a step's result by its name."""

    width: Width
    name: str = ""
    number: float = 0.0
    truth: bool = False

    @property
    def text(self) -> str:
        """As it stands in the program."""
        if self.name:
            return self.name
        special = {"nan": "np.nan", "inf": "np.inf", "-inf": "-np.inf"}
        return special.get(repr(self.number), repr(self.number))


@dataclass(frozen=True, slots=True)
class _Step:
    target: Value
    function: str
    operands: tuple[Value, ...]


class Program:
    """Steps, each once; `given` values come from outside by the symbols that they have."""

    def __init__(self) -> None:
        self._steps: list[_Step] = []
        self._known: dict[tuple[Any, ...], Value] = {}
        self._given: dict[str, Value] = {}

    # --- writing --------------------------------------------------------------------------------------------------------

    def given(self, symbol: str, width: Width) -> Value:
        """What comes from outside."""
        return self._given.setdefault(symbol, Value(width, f"g{len(self._given)}"))

    def step(self, function: str, *operands: Value) -> Value:
        """The result of a function of numpy, or of `HELPERS`; the same step twice is one."""
        if function in ("np.multiply", "np.add") and (same := _neutral(function, operands)) is not None:
            return same
        key = (function, *operands)
        if key not in self._known:
            self._known[key] = self._new(function, operands)
        return self._known[key]

    def _new(self, function: str, operands: tuple[Value, ...]) -> Value:
        width = ONE
        for operand in operands:
            width |= operand.width
        truth = function in _TRUTHS
        if width == ONE:
            with np.errstate(all="ignore"):
                call = HELPERS[function] if function in HELPERS else getattr(np, function.removeprefix("np."))
                return Value(ONE, number=float(call(*(operand.number for operand in operands))), truth=truth)
        value = Value(width, f"v{len(self._steps)}", truth=truth)
        self._steps.append(_Step(value, function, operands))
        return value

    def value(self, node: Node, known: Mapping[str, Value], rooted: bool = False) -> Value:
        """The value of a tree over symbols that are known.

        rooted  what stands under a root is a rounding error where it is negative, and counts as 0
        """
        match node:
            case Number(number):
                return Value(ONE, number=number)
            case Symbol(name):
                return known[name]
            case Unary("-", operand):
                return self.step("np.multiply", self.value(operand, known, rooted), Value(ONE, number=-1.0))
            case Unary("+", operand):
                return self.value(operand, known, rooted)
            case Unary("%", operand):
                return self.step("np.divide", self.value(operand, known, rooted), Value(ONE, number=100.0))
            case Binary("^", base, Number(2.0)):
                root = self.value(base, known, rooted)
                return self.step("np.multiply", root, root)
            case Binary(op, left, right) if op in _OPERATORS:
                return self.step(_OPERATORS[op], self.value(left, known, rooted), self.value(right, known, rooted))
            case Call("PI"):
                return Value(ONE, number=float(np.pi))
            case Call("NA"):
                return Value(ONE, number=float(np.nan))
            case Call("ATAN2", (x, y)):  # the sheet's order is x first, numpy's y first
                return self.step("np.arctan2", self.value(y, known, rooted), self.value(x, known, rooted))
            case Call("SQRT", (square,)) if rooted:
                return self.root(self.value(square, known, rooted))
            case Call("SUMSQ", args):
                squares = [self.value(Binary("^", arg, Number(2.0)), known, rooted) for arg in args]
                return self.fold("np.add", squares)
            case Call("CHOOSE"):
                return self.value(chosen_by_ifs(node), known, rooted)
            case Call(name, args) if name in _FOLDED:
                return self.fold(_FOLDED[name], [self.value(arg, known, rooted) for arg in args])
            case Call(name, args) if name in _CALLS:
                return self.step(_CALLS[name], *(self.value(arg, known, rooted) for arg in args))
        raise ValueError(f"no numeric meaning here: {node}")

    def root(self, square: Value) -> Value:
        """The square root, of less than 0 that of 0."""
        return self.step("np.sqrt", self.step("np.maximum", square, Value(ONE, number=0.0)))

    def fold(self, function: str, values: Sequence[Value]) -> Value:
        """A function of two, over any number of values."""
        result = values[0]
        for value in values[1:]:
            result = self.step(function, result, value)
        return result

    # --- printing -------------------------------------------------------------------------------------------------------

    def printed(self, wanted: Mapping[str, Value]) -> Printed:
        """The functions that give the values wanted, and nothing else."""
        steps = self._needed(wanted.values())
        parts: dict[Width, list[_Step]] = {DESIGN: [], PLACE: [], WHOLE: []}
        for step in steps:
            parts[step.target.width].append(step)
        read = {operand.name: operand for step in parts[WHOLE] for operand in step.operands if operand.name}
        read |= {value.name: value for value in wanted.values() if value.name}
        outward = {
            width: [value for value in read.values() if value.width == width and value.name.startswith("v")]
            for width in (DESIGN, PLACE)
        }
        given = {value.name: symbol for symbol, value in self._given.items()}
        used = {name for step in steps for operand in step.operands for name in [operand.name]} | set(read)
        return Printed(
            _function("of_designs", _inputs(parts[DESIGN], given), parts[DESIGN], outward[DESIGN]),
            _function("of_places", _inputs(parts[PLACE], given), parts[PLACE], outward[PLACE]),
            _function("of_both", _read(parts[WHOLE]), parts[WHOLE],
                      [value for value in wanted.values() if value.width == WHOLE and value.name.startswith("v")]),
            {name: symbol for name, symbol in given.items() if name in used},
            wanted,
        )  # fmt: skip

    def _needed(self, wanted: Iterable[Value]) -> list[_Step]:
        live = {value.name for value in wanted}
        found = []
        for step in reversed(self._steps):
            if step.target.name in live:
                found.append(step)
                live |= {operand.name for operand in step.operands}
        return found[::-1]


@dataclass(frozen=True, slots=True)
class Function:
    """One function: its text, what it reads and what it gives, by the names in the program."""

    text: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Printed:
    """Three functions; `given` are the symbols of what comes from outside, by their names in the program."""

    of_designs: Function
    of_places: Function
    of_both: Function
    given: Mapping[str, str]
    wanted: Mapping[str, Value]

    @property
    def text(self) -> str:
        """The whole program, for people to read."""
        return "\n\n".join(part.text for part in (self.of_designs, self.of_places, self.of_both))


class Running:
    """A printed program that can be called."""

    def __init__(self, printed: Printed) -> None:
        space: dict[str, Any] = {"np": np, **HELPERS}
        exec(compile(printed.text, "<study>", "exec"), space)
        self._call = {name: space[name] for name in ("of_designs", "of_places", "of_both")}
        self.printed = printed

    def designs(self, given: Mapping[str, Array]) -> dict[str, Array]:
        """What depends on designs alone, by the names in the program; `given` by symbols."""
        return self._run("of_designs", self.printed.of_designs, self._named(given))

    def places(self, given: Mapping[str, Array]) -> dict[str, Array]:
        """What depends on places alone."""
        return self._run("of_places", self.printed.of_places, self._named(given))

    def both(self, *known: Mapping[str, Array], given: Mapping[str, Array]) -> dict[str, Any]:
        """All that is wanted, by the names that `Program.printed` was given; numbers where they are numbers."""
        names: dict[str, Array] = self._named(given)
        for part in known:
            names.update(part)
        names.update(self._run("of_both", self.printed.of_both, names))
        return {
            key: names[value.name] if value.name else np.float64(value.number)
            for key, value in self.printed.wanted.items()
        }

    def _named(self, given: Mapping[str, Array]) -> dict[str, Array]:
        return {name: given[symbol] for name, symbol in self.printed.given.items() if symbol in given}

    def _run(self, name: str, function: Function, names: Mapping[str, Array]) -> dict[str, Array]:
        found = self._call[name](*(names[each] for each in function.inputs))
        return dict(zip(function.outputs, found, strict=True))


def _inputs(steps: Sequence[_Step], given: Mapping[str, str]) -> list[str]:
    return list(dict.fromkeys(each.name for step in steps for each in step.operands if each.name in given))


def _read(steps: Sequence[_Step]) -> list[str]:
    own = {step.target.name for step in steps}
    read = [each.name for step in steps for each in step.operands if each.name]
    return [name for name in dict.fromkeys(read) if name not in own]


def _function(name: str, inputs: Sequence[str], steps: Sequence[_Step], outputs: Sequence[Value]) -> Function:
    """The text of a function: operands of whole arrays give their memory up where they are read for the last time."""
    last = {operand.name: at for at, step in enumerate(steps) for operand in step.operands}
    last |= {value.name: len(steps) for value in outputs}
    own = {step.target.name for step in steps}
    shared: set[str] = set()
    lines = [f"def {name}({', '.join(inputs)}):"]
    for at, step in enumerate(steps):
        texts = [operand.text for operand in step.operands]
        free = [
            operand.name for operand in step.operands
            if operand.name in own - shared and last[operand.name] == at and operand.width == WHOLE and not operand.truth
        ]  # fmt: skip
        function = step.function
        if free and step.target.width == WHOLE and function in _IN_PLACE:
            texts.append(free[0])
        elif function in ("_kept", "_unwrapped", "_near"):
            texts.append(str(texts[0] in free))
            if texts[0] not in free:  # the result may be the operand itself
                shared |= {step.target.name, texts[0]}
        lines.append(f"    {step.target.name} = {function}({', '.join(texts)})")
        dead = [each for each in dict.fromkeys(free) if function not in _IN_PLACE or each != free[0]]
        if dead:
            lines.append(f"    {' = '.join(dead)} = None")
    given = ", ".join(value.name for value in outputs)
    lines.append(f"    return ({given},)" if given else "    return ()")
    return Function("\n".join(lines) + "\n", tuple(inputs), tuple(value.name for value in outputs))


def _neutral(function: str, operands: Sequence[Value]) -> Value | None:
    """The other operand of 1 x and x + 0."""
    number = 1.0 if function == "np.multiply" else 0.0
    for one, other in (operands, operands[::-1]):
        if one.width == ONE and one.number == number and not other.truth:
            return other
    return None


# --- helpers of printed programs -----------------------------------------------------------------------------------------


def _kept(value: Any, there: Any, free: bool = False) -> Any:
    """The value where it exists, NaN elsewhere; into its own memory where that is `free`."""
    shape = np.broadcast_shapes(np.shape(value), np.shape(there))
    if np.shape(value) != shape:
        return np.where(there, value, np.nan)
    if np.all(there):
        return value
    if free:
        np.copyto(value, np.nan, where=np.logical_not(there))
        return value
    return np.where(there, value, np.nan)


def _unwrapped(angles: Any, free: bool = False) -> Any:
    """Angles without jumps along the places of each design: none more than half a turn from the one before."""
    if np.shape(angles)[-1] < 2:
        return angles
    steps = np.subtract(angles[:, :-1], angles[:, 1:])
    far = ~(np.abs(steps) < np.pi)
    if not far.any():
        return angles
    found = angles if free else angles.copy()
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


def _near(angles: Any, place: Any, free: bool = False) -> Any:
    """Angles within half a turn of a place."""
    return angles + math.tau * np.rint((place - angles) * (1 / math.tau))


HELPERS: dict[str, Callable[..., Any]] = {
    "_kept": _kept,
    "_unwrapped": _unwrapped,
    "_near": _near,
    "_rounded": FUNCTIONS["ROUND"],
}
