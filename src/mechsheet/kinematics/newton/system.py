"""A system of equations F(x) = 0 solved in numbers by Newton's method: x := x - J^-1 F, so many passes a row.

A row starts from the row before it, or from the last one that has a position; the row at which it all begins starts from
start values, through `FIRST_PASSES` passes. The determinant of J keeps its sign as long as a motion is smooth: a row at
which Newton's method arrives with the other sign is another assembly, and counts as none. Just so the workbook does it.

Start values belong to the dimensions for which they were found. Where these have changed since, the first `LED` passes go
along with them in equal steps: so the start is the same assembly as long as that can be kept, and where the determinant
changes its sign on the way it could not. (E. L. Allgower, K. Georg, Introduction to Numerical Continuation Methods.)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np

from livesheet import portable
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary
from mechsheet.kinematics.equations import Equation, System
from mechsheet.kinematics.numeric import FUNCTIONS, Array, evaluate_equation

Step: TypeAlias = "Callable[[Sequence[Any], Sequence[Any]], Pass]"
"""From the unknowns and what is given to a pass."""

FIRST_PASSES = 32
"""Passes from the start values."""

LED = 24
"""So many of these go with the dimensions from those described to those that are there."""

REFINING = 20
"""Passes from a guess that may be far off."""

CLOSED = 1e-11
"""Up to this residual a position exists: what is left of the gaps is 1e-9 of the size even in short links."""

SETTLED = 1e-12
"""Below this residual a pass has arrived."""

STILL = 1e-15
"""Radians, or parts of a displacement: a smaller change is of the last digits, whatever the determinant is."""

MOST_PASSES = 12

_SINGLE: Mapping[str, Callable[..., Any]] = FUNCTIONS | {
    "ABS": abs, "COS": portable.cos, "MAX": max, "MIN": min, "PI": lambda: math.pi, "RADIANS": math.radians,
    "SIN": portable.sin, "SQRT": math.sqrt,
}  # fmt: skip
"""What numpy does for arrays, for one number at a time."""


@dataclass(frozen=True, slots=True)
class Pass:
    """One pass in numbers: the next unknowns, and residual and determinant at those that it was given."""

    unknowns: tuple[Any, ...]
    residual: Any
    determinant: Any


def followed(system: System, known: Mapping[str, Any], rows: int) -> dict[str, Array]:
    """The unknowns over rows that follow one another; NaN where none is found, or only with the determinant's other sign.

    known  the values of what the system reads, one per row or one for all
    """
    given = [np.broadcast_to(np.asarray(known[name], float), (rows,)).tolist() for name in system.given]
    found = np.full((rows, len(system.unknowns)), np.nan)
    start = start_of(system, known, rows)
    if start is None:
        return {name: found[:, index] for index, name in enumerate(system.unknowns)}
    step, last = scalar_step(system), start.unknowns
    with np.errstate(all="ignore"):  # far from any position numbers grow without bound
        for row in range(rows):
            here = _arrived(step, last, [column[row] for column in given], system.passes)
            if here is not None and here.determinant * start.determinant > 0:
                found[row] = last = here.unknowns
    return {name: found[:, index] for index, name in enumerate(system.unknowns)}


def start_of(system: System, known: Mapping[str, Any], rows: int) -> Pass | None:
    """Where it all begins: the position to which the start values lead in their row; None where they lead to none."""
    if not system.starts or not rows:
        return None
    number = int(np.broadcast_to(known[system.mode], (rows,))[0])
    start = system.starts[min(max(number, 1), len(system.starts)) - 1]
    row = min(system.row, rows - 1)
    there = {name: float(np.broadcast_to(column, (rows,))[row]) for name, column in known.items()}
    given = [there[name] for name in system.given]
    step = scalar_step(system)
    with np.errstate(all="ignore"):
        if all(there[name] == value for name, value in system.described):
            return _arrived(step, start, given, FIRST_PASSES)
        return _arrived(step, _led(system, step, start, there), given, FIRST_PASSES - LED)


def _led(system: System, step: Step, start: Sequence[float], there: Mapping[str, float]) -> Sequence[float]:
    """The unknowns after going with the dimensions from the described ones to those that are there, a step each."""
    unknowns = start
    for given in way_to(system, there, np.arange(LED) / LED):
        unknowns = moved(step, unknowns, given)
    return unknowns


def way_to(system: System, there: Mapping[str, float], shares: Array) -> list[tuple[float, ...]]:
    """What the system reads at each share of the way from the described values to those that are there."""
    count = len(shares)
    known: dict[str, Any] = dict(there)
    known |= {name: value + shares * (there[name] - value) for name, value in system.described}
    for equation in system.way:
        known[equation.symbol] = evaluate_equation(equation, known, count)
    return [*zip(*(np.broadcast_to(known[name], (count,)).tolist() for name in system.given), strict=True)]


def moved(step: Step, unknowns: Sequence[float], given: Sequence[float]) -> Sequence[float]:
    """The unknowns after a pass; where no step can be made (a group before does not close there) they stay."""
    try:
        following = step(unknowns, given).unknowns
    except (ArithmeticError, ValueError):
        return unknowns
    return following if all(map(math.isfinite, following)) else unknowns


def refined(
    system: System, known: Mapping[str, Any], guesses: Sequence[Array], passes: int = REFINING
) -> tuple[list[Array], Array, Array]:
    """Many starts at once, row by row its own: unknowns, residuals, determinants after so many passes."""
    shape = np.shape(guesses[0])
    step = step_of(system, known)
    unknowns = [np.asarray(guess, float) for guess in guesses]
    with np.errstate(all="ignore"):
        for _ in range(passes):
            unknowns = [*step(unknowns).unknowns]
        last = step(unknowns)
    return unknowns, np.broadcast_to(last.residual, shape), np.broadcast_to(last.determinant, shape)


def step_of(system: System, known: Mapping[str, Any]) -> Callable[[Sequence[Array]], Pass]:
    """One pass over many starts at once."""
    given = [np.asarray(known[name], float) for name in system.given]
    step = _arrays(system)
    return lambda unknowns: step(unknowns, given)


def _arrived(step: Step, start: Sequence[float], given: Sequence[float], passes: int) -> Pass | None:
    """The unknowns after so many passes from a start, with residual and determinant there; None where they do not fit."""
    unknowns = start
    try:
        for _ in range(passes):
            here = step(unknowns, given)
            if _stays(unknowns, here.unknowns):
                break
            unknowns = here.unknowns
        else:
            here = step(unknowns, given)
    except (ArithmeticError, ValueError):
        return None
    return Pass(tuple(unknowns), here.residual, here.determinant) if here.residual <= CLOSED else None


def _stays(unknowns: Sequence[float], following: Sequence[float]) -> bool:
    """Whether a pass moves nothing any more: those that are left would not either."""
    return all(abs(x - y) <= STILL * max(1.0, abs(x)) for x, y in zip(unknowns, following, strict=True))


# --- one pass as generated code: a row is too little for numpy, and a walk over the trees is too slow -----------------


def scalar_step(system: System) -> Step:
    """One pass from one start."""
    return _generated(system.unknowns, system.given, system.body, system.corrections, system.residual,
                      system.determinant, True)  # fmt: skip


def _arrays(system: System) -> Step:
    return _generated(system.unknowns, system.given, system.body, system.corrections, system.residual,
                      system.determinant, False)  # fmt: skip


@lru_cache(maxsize=64)
def _generated(
    unknowns: tuple[str, ...],
    given: tuple[str, ...],
    body: tuple[Equation, ...],
    corrections: tuple[Node, ...],
    residual: str,
    determinant: str,
    single: bool,
) -> Step:
    names: dict[str, str] = {}
    for name in (*unknowns, *given, *(equation.symbol for equation in body)):
        names[name] = f"v{len(names)}"
    lines = ["def step(x, given):"]
    for index, name in enumerate(unknowns):
        lines.append(f"    {names[name]} = x[{index}]")
    for index, name in enumerate(given):
        lines.append(f"    {names[name]} = given[{index}]")
    lines += [f"    {names[each.symbol]} = {_spelt(each.expression, names)}" for each in body]
    following = ", ".join(
        f"{names[name]} - {_spelt(part, names)}" for name, part in zip(unknowns, corrections, strict=True)
    )
    lines.append(f"    return Pass(({following},), {names[residual]}, {names[determinant]})")
    functions = _SINGLE if single else FUNCTIONS
    space: dict[str, Any] = {"Pass": Pass, **{f"f_{name}": function for name, function in functions.items()}}
    exec(compile("\n".join(lines), "<newton>", "exec"), space)
    step: Step = space["step"]
    return step


def _spelt(node: Node, names: Mapping[str, str]) -> str:
    """An expression in Python, in parentheses."""
    match node:
        case Number(number):
            return repr(number)
        case Symbol(name):
            return names[name]
        case Unary("-", operand):
            return f"(-{_spelt(operand, names)})"
        case Binary("^", base, Number(2.0)):
            inner = _spelt(base, names)
            return f"({inner} * {inner})"
        case Binary("+" | "-" | "*" | "/" as sign, left, right):
            return f"({_spelt(left, names)} {sign} {_spelt(right, names)})"
        case Call(name, args):
            return f"f_{name}({', '.join(_spelt(arg, names) for arg in args)})"
    raise ValueError(f"no pass can hold this: {node}")


def leading(
    wanted: Sequence[str], rules: Mapping[str, Collection[str]], changing: Collection[str]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """(those of `changing` that `wanted` follows from, the rules between them in order); the rest stays as it is.

    rules     by symbol what it reads, in order of solution
    changing  symbols that are given, whatever rule they have
    """
    moving = set(changing)
    for symbol, reads in rules.items():
        if not moving.isdisjoint(reads):
            moving.add(symbol)
    needed = set(wanted) & moving
    for symbol, reads in reversed([*rules.items()]):
        if symbol in needed and symbol not in changing:
            needed.update(moving.intersection(reads))
    return (
        tuple(symbol for symbol in changing if symbol in needed),
        tuple(symbol for symbol in rules if symbol in needed and symbol not in changing),
    )
