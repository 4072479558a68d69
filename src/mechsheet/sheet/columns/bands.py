"""The columns of bands: of each quantity its derivatives by the dimensions that have a tolerance, and what these come to.

    worst case            sum of |S t|           all dimensions at the end of their tolerance that hurts
    root sum of squares   sqrt(sum of (S t)^2)   of the same confidence as the tolerances, where these are independent

S stands as people read it (degrees by the length unit, say), t is the cell beside the dimension.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol, with_symbols
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.equations import Equations, Role
from mechsheet.kinematics.numeric import Array, value
from mechsheet.kinematics.rates.sensitivity import (
    NO_BANDS,
    Sensitivities,
    Sensitivity,
    by_symbol,
    determinant_symbol,
    of_constant,
    sensitivities,
    toleranced,
)
from mechsheet.model import Mechanism
from mechsheet.sheet.columns.lowering import Assignment, Assignments, guarded
from mechsheet.sheet.quoted import SHOWN, formula
from mechsheet.units import LENGTH, NUMBER, Unit
from mechsheet.words.equations import phrase

QUANTITIES = 10_000
"""Blocks of columns are counted from here: one for each quantity."""

WORST, ROOT, LOW, HIGH = "worst case", "root sum of squares", "lower end", "upper end"
HEADINGS = {WORST: "bands.worst", ROOT: "bands.root", LOW: "bands.low", HIGH: "bands.high"}
"""What stands over such a column."""


def part_of(quantity: str, part: str) -> str:
    """The symbol of a quantity's worst case, root sum of squares, or end of its band."""
    return f"{quantity}:{part}"


def tolerance_symbol(dimension: str) -> str:
    """The symbol of a dimension's tolerance, which is as people read it."""
    return f"tolerance {dimension}"


@dataclass(frozen=True, slots=True)
class Banded:
    """A quantity with its band. `dimensions`: those that change it, by symbol."""

    symbol: str
    dimensions: tuple[str, ...]

    @property
    def derivatives(self) -> tuple[str, ...]:
        """Symbols of its columns of derivatives."""
        return tuple(by_symbol(self.symbol, name) for name in self.dimensions)

    @property
    def parts(self) -> tuple[Node, ...]:
        """S t of each dimension."""
        return tuple(
            al.mul(Symbol(name), Symbol(tolerance_symbol(dimension)))
            for name, dimension in zip(self.derivatives, self.dimensions, strict=True)
        )


def band_of_constant(mechanism: Mechanism, equations: Equations, node: Node) -> Node:
    """The worst case of what follows from dimensions alone."""
    parts = []
    for name, slope in of_constant(mechanism, equations, node).items():
        known = al.value_of(slope)
        size = formula("ABS(slope)", slope=slope) if known is None else al.number(abs(known))
        unit = next(dim.unit for dim in mechanism.dimensions if dim.symbol == name)
        tolerance: Node = Symbol(tolerance_symbol(name))
        parts.append(al.mul(size, Call("RADIANS", (tolerance,)) if unit.in_degrees else tolerance))
    return al.total(parts)


def found_bands(mechanism: Mechanism, equations: Equations) -> tuple[Mechanism, Sensitivities]:
    """The derivatives that are asked for, and the mechanism that asks for these: of all outputs and summaries, where the
    description names none, those that a tolerance changes. Raises MechanismError where there are none.
    """
    bands = mechanism.bands
    if bands is None:
        return mechanism, NO_BANDS
    newton = [group.label for group in equations.groups if group.system is not None]
    if newton:
        message = say("bands are not found where links must be solved all at once: {group}", group=newton[0])
        raise MechanismError(Fault(message, key="tolerance", hint=say("leave [tolerance] out; positions are found")))
    found = sensitivities(mechanism, equations, bands.quantities)
    still = [each.quantity for each in found.of if not each.by]
    if not still:
        return mechanism, found
    moved = [name for name in bands.quantities if name not in still]
    if bands.named or not moved:
        raise MechanismError(
            Fault(say('no dimension with a tolerance changes "{name}"', name=name), key="tolerance",
                  hint=say("give another dimension a tolerance, or leave it out of `of`"))
            for name in still
        )  # fmt: skip
    of = {summary.symbol: summary.of for summary in mechanism.summaries}
    left = replace(bands, quantities=(*moved,), summaries=tuple(each for each in bands.summaries if of[each] in moved))
    return replace(mechanism, bands=left), sensitivities(mechanism, equations, moved)


def with_bands(mechanism: Mechanism, equations: Assignments, found: Sensitivities) -> Assignments:
    """The equations for cells with the columns of bands behind all others."""
    if not found.of:
        return equations
    constants = tuple(_constant(mechanism, equations, name, node) for name, node in found.constants.items())
    known = _determinants(equations, found)
    columns = [each for each in known.values() if isinstance(each, Assignment)]
    inline = {name: each for name, each in known.items() if not isinstance(each, Assignment)}
    for number, each in enumerate(found.of, QUANTITIES):
        columns += _columns(mechanism, equations, each, number, inline)
    return replace(equations, constants=(*equations.constants, *constants), columns=(*equations.columns, *columns))


def _constant(mechanism: Mechanism, equations: Assignments, name: str, node: Node) -> Assignment:
    """The derivative of a derived dimension, or of a constant, by a dimension."""
    symbol, _, dimension = name.partition(":")
    units = {dim.symbol: dim.unit for dim in mechanism.dimensions}
    units |= {each.symbol: each.unit for each in equations.constants}
    above, below = (
        mechanism.shown(units.get(each, LENGTH)).internal for each in (symbol, dimension)
    )  # a gap is a length
    unit = Unit("number", per(above, below).symbol)
    label = phrase("constant_derivative", symbol=symbol, dimension=dimension)
    return Assignment(name, node, node, "constant", unit, label)


def _determinants(equations: Assignments, found: Sensitivities) -> dict[str, Node | Assignment]:
    """By symbol: a column that is empty at a dead centre; that of the velocities where there is one; a number."""
    moving = {
        each.group: each.symbol for each in equations.equations.columns if each.role == "coefficient" and each.exists
    }
    known: dict[str, Node | Assignment] = {}
    for group in equations.groups:
        if group.number not in found.groups or group.determinant is None:
            continue
        symbol = determinant_symbol(group.number)
        if group.dead is None:
            known[symbol] = group.determinant
            continue
        if group.number in moving and al.value_of(group.determinant) is None:
            other = Symbol(moving[group.number])
            own = equations.equations.of(other.name).expression
            if own in (group.determinant, al.neg(group.determinant)):
                known[symbol] = other if own == group.determinant else al.neg(other)
                continue
        expression = guarded([group.dead], group.determinant)
        label = phrase("determinant")
        known[symbol] = Assignment(symbol, expression, group.determinant, "influence", NUMBER, label)
    return known


def _columns(
    mechanism: Mechanism, equations: Assignments, found: Sensitivity, group: int, inline: dict[str, Node]
) -> list[Assignment]:
    """Of one quantity."""

    def known(node: Node) -> Node:
        return with_symbols(node, inline)

    def column(symbol: str, node: Node, role: Role, unit: Unit, label: str, says: Node | None = None) -> Assignment:
        words = phrase(label, symbol=found.quantity)
        return Assignment(symbol, known(node), known(says or node), role, unit, words, group)

    own = mechanism.shown(equations.of(found.quantity).unit)
    columns = [column(name, node, "influence", NUMBER, "gap_influence") for name, node in found.inner.items()]
    units = {dim.symbol: mechanism.shown(dim.unit) for dim in toleranced(mechanism)}
    for name, node in found.by.items():
        shown = in_units(node, own, units[name])
        label = phrase("sensitivity", symbol=found.quantity, dimension=name)
        columns.append(
            replace(
                column(by_symbol(found.quantity, name), shown, "band", per(own, units[name]), "band", node), label=label
            )
        )
    band = Banded(found.quantity, tuple(found.by))
    worst, root = part_of(found.quantity, WORST), part_of(found.quantity, ROOT)
    middle, shown, most = Symbol(found.quantity), Symbol(SHOWN + found.quantity), Symbol(worst)
    sums: list[tuple[str, Node, Node, str]] = [
        (worst, al.total(Call("ABS", (part,)) for part in band.parts), Symbol("Σ|S·t|"), "band_worst"),
        (root, formula("SQRT(squares)", squares=Call("SUMSQ", band.parts)), Symbol("√Σ(S·t)²"), "band_root"),
        (part_of(found.quantity, LOW), al.sub(shown, most), al.sub(middle, most), "band_low"),
        (part_of(found.quantity, HIGH), al.add(shown, most), al.add(middle, most), "band_high"),
    ]
    return columns + [column(symbol, node, "band", own, label, says) for symbol, node, says, label in sums]


def in_units(node: Node, own: Unit, dimension: Unit) -> Node:
    """A derivative as people read it: in degrees where the quantity is, by a degree where the dimension is in degrees."""
    if own.in_degrees == dimension.in_degrees:
        return node
    return Call("DEGREES" if own.in_degrees else "RADIANS", (node,))


def per(own: Unit, dimension: Unit) -> Unit:
    """The unit of a derivative: °/mm, mm/°, nothing where both are the same."""
    above, below = own.text, dimension.text
    if above == below:
        return NUMBER
    return Unit("label", f"{above or '1'}/{below}" if below else above or "1")


def sizes(
    mechanism: Mechanism, found: Sensitivities, equations: Assignments, nominal: dict[str, Array]
) -> dict[str, Array]:
    """By quantity its worst case in every row, as people read it, with the dimensions as described.

    nominal  every symbol's values over the rows
    """
    known: dict[str, Array] = dict(nominal)
    result = {}
    tolerances = {dim.symbol: dim.unit.to_internal(dim.tolerance or 0.0) for dim in toleranced(mechanism)}
    with np.errstate(all="ignore"):
        for name, node in found.constants.items():
            known[name] = value(node, known)
        for group in equations.groups:
            if group.number in found.groups and group.determinant is not None:
                known[determinant_symbol(group.number)] = value(group.determinant, known)
        for each in found.of:
            for name, node in each.inner.items():
                known[name] = value(node, known)
            parts = [np.abs(value(node, known) * tolerances[name]) for name, node in each.by.items()]
            unit = mechanism.shown(equations.of(each.quantity).unit)
            rows = next(iter(nominal.values())).shape
            result[each.quantity] = unit.to_shown(np.broadcast_to(sum(parts), rows))
    return result
