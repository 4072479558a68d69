"""The part [outputs]: further quantities of every row, and those that follow from summaries, of the whole motion."""

from __future__ import annotations

from typing import Any

from livesheet.formula.nodes import Call, Node, Symbol, symbols, transform, walk
from livesheet.said import say
from mechsheet.description.driving.rates import known as known_rate
from mechsheet.description.kinds import ANGLE, LENGTH, label_fault, plain_unit, unit_kind
from mechsheet.description.report import BAD, listed, suggestion, within
from mechsheet.description.requests import is_coordinate
from mechsheet.description.scope import Scope, circle_message, cycles, words
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Driver, Output
from mechsheet.units import Unit, unit_of

LARGEST_FORMULA = 2000
"""Parts of a formula that a cell of 8,192 characters surely holds."""


def spelled_out(data: dict[str, Any]) -> dict[str, Any]:
    """The entries in their long form: `height = "W.y"` as { formula = "W.y" }."""
    return {name: {"formula": entry} if isinstance(entry, str) else entry for name, entry in data.items()}


def outputs(data: dict[str, Any], driver: Driver | None, scope: Scope) -> tuple[tuple[Output, ...], tuple[Output, ...]]:
    """(quantities of every row, quantities of the whole motion): the latter are those whose formulas name summaries, or
    outputs that do. Each comes after those that it reads.
    """
    trees = _trees(data, scope)
    _note_motion_outputs(trees, scope)
    units = {name: _unit(entry, trees.get(name), scope) for name, entry in data.items() if entry is not BAD}
    for name in trees:
        scope.kinds.setdefault(name, unit_kind(units[name]))
    for name in trees:
        if name in scope.outputs:
            _check_of_row(name, trees[name], data[name], units[name], scope)
    _note_summaries(units, scope)
    for name in scope.motion_outputs:
        _check_of_motion(name, trees[name], data[name], units[name], scope)
    _write_out(trees, scope)
    made = [_made(name, trees[name], data[name], units[name], scope) for name in trees]
    _show_units(units, driver, scope)
    return (
        tuple(output for output in made if output.symbol in scope.outputs),
        tuple(output for output in made if output.symbol in scope.motion_outputs),
    )


def _trees(data: dict[str, Any], scope: Scope) -> dict[str, Node]:
    """The formulas, in the order of the file where none reads a later one."""
    trees: dict[str, Node] = {}
    for name, entry in data.items():
        text = BAD if entry is BAD else entry["formula"]
        tree = None if text is BAD else scope.parse(text, ("outputs", name, "formula"))
        if tree is not None:
            trees[name] = tree
    order, circles = cycles({name: symbols(tree) for name, tree in trees.items()})
    for circle in circles:
        scope.report.at(("outputs", circle[0], "formula"), circle_message(circle, "the outputs"))
    names = [*trees]
    in_order = all(each not in names[place:] for place, name in enumerate(names) for each in symbols(trees[name]))
    return trees if in_order else {name: trees[name] for name in order}


def _unit(entry: dict[str, Any], tree: Node | None, scope: Scope) -> Unit:
    """As the entry says; of one quantity alone its own; else the length unit."""
    own = _own_unit(tree.name, scope) if isinstance(tree, Symbol) else scope.length_unit
    word = entry.get("unit", own)
    return unit_of(scope.length_unit if word is BAD else plain_unit(word), scope.length_unit)


def _own_unit(name: str, scope: Scope) -> str:
    """What stands behind the numbers of a quantity."""
    if scope.kinds.get(name) == ANGLE and name in scope.variables:
        return scope.angle_unit.symbol
    of_time = {"v": "/s", "vx": "/s", "vy": "/s", "a": "/s²", "ax": "/s²", "ay": "/s²"}
    _, dot, part = name.partition(".")
    if dot and part in of_time:
        return scope.length_unit + of_time[part]
    if name in scope.rates:
        return {"omega": "rad/s", "alpha": "rad/s²"}.get(name[:5], "s")
    return scope.force_units.get(name, scope.length_unit)


def _made(name: str, tree: Node, entry: dict[str, Any], unit: Unit, scope: Scope) -> Output:
    cell = scope.cell(entry, ("outputs", name))
    return Output(name, tree, unit, words(entry.get("label")), cell, entry["formula"])


# --- of every row -----------------------------------------------------------------------------------------------------


def _check_of_row(name: str, tree: Node, entry: dict[str, Any], unit: Unit, scope: Scope) -> None:
    """An expression over variables, coordinates, rates, dimensions and other outputs."""
    path, text = ("outputs", name, "formula"), entry["formula"]
    names = symbols(tree)
    good = [each in scope.units or _is_known(each, text, path, scope) for each in names]
    if any(map(scope.reads_rates, names)):
        scope.of_rates.add(name)
    scope.fits(tree, text, unit_kind(unit), path, _wants_unit(entry))
    if all(good) and all(each in scope.numbers for each in names):
        scope.value(tree, path)
    _check_label(name, tree, text, unit, scope)


def _wants_unit(entry: dict[str, Any]) -> str:
    """What to write where the formula of an output is an angle, and what stands behind it a length, or the other way."""
    if "unit" in entry:
        return say('write unit = "deg" for an angle; without a unit an output is a length')
    return say('write unit = "deg" beside the formula: without a unit an output is a length')


def _check_label(name: str, tree: Node, text: str, unit: Unit, scope: Scope) -> None:
    """A label of one's own must not stand behind radians, nor behind lengths in another unit."""
    if unit.kind != "label":
        return
    message, hint = label_fault(tree, quoted(text), scope.kinds, unit.symbol, scope.length_unit)
    if message is not None:
        scope.report.at(("outputs", name, "unit"), message, hint)


def _is_known(name: str, text: str, path: Path, scope: Scope) -> bool:
    """True when a formula's symbol is a variable, a coordinate or an output; reports what else it is."""
    where = within(text, name)
    if name in scope.outputs:
        return True
    if name in scope.variables or known_rate(name, path, scope) or is_coordinate(name, path, scope, where):
        return True
    if "." in name or not (scope.complete and scope.solved):
        return False
    known = [*scope.variables, *scope.coordinates, *scope.units, *scope.outputs, *scope.rates_there, *scope.forces]
    hint = scope.meant(name) or suggestion(name, known, "allowed")
    scope.report.at(path, say("{where}{name} is not a variable or dimension", where=where, name=quoted(name)), hint)
    return False


# --- of the whole motion ----------------------------------------------------------------------------------------------


def _note_motion_outputs(trees: dict[str, Node], scope: Scope) -> None:
    """Those that name a summary, or an output that does: `trees` has each after those that it reads."""
    for name, tree in trees.items():
        if (scope.summaries.keys() | scope.motion_outputs.keys()) & {*symbols(tree)}:
            scope.outputs.remove(name)
            scope.motion_outputs[name] = tree


def _write_out(trees: dict[str, Node], scope: Scope) -> None:
    """The formulas of the whole motion over summaries and dimensions alone: those of other outputs in their places."""
    for name in scope.motion_outputs:
        whole = transform(
            trees[name],
            lambda part: trees[part.name] if isinstance(part, Symbol) and part.name in scope.motion_outputs else part,
        )
        trees[name] = scope.motion_outputs[name] = whole
        if sum(1 for _ in walk(whole)) > LARGEST_FORMULA:
            path = ("outputs", name, "formula")
            scope.report.at(path, say("with the outputs that it reads, the formula is too long for a cell"))
            return


def _note_summaries(units: dict[str, Unit], scope: Scope) -> None:
    """A summary is of the kind of what it is of."""
    for summary, of in scope.summaries.items():
        if of is not BAD:
            own = unit_kind(units[of]) if of in units else LENGTH if of.endswith((".x", ".y")) else scope.kinds.get(of)
            if own:
                scope.kinds.setdefault(summary, own)


def _check_of_motion(name: str, tree: Node, entry: dict[str, Any], unit: Unit, scope: Scope) -> None:
    """An expression over summaries, dimensions and other outputs of summaries: what differs from row to row has no place
    in one number."""
    path, text = ("outputs", name, "formula"), entry["formula"]
    whole = scope.summaries.keys() | scope.motion_outputs.keys()
    named = [each for each in symbols(tree) if each in whole]
    for each in symbols(tree):
        if each not in scope.units and each not in whole:
            _refuse(each, named, text, path, scope)
    scope.fits(tree, text, unit_kind(unit), path, _wants_unit(entry))
    _check_label(name, tree, text, unit, scope)


def _refuse(name: str, named: list[str], text: str, path: Path, scope: Scope) -> None:
    where = within(text, name)
    known = [*scope.summaries, *scope.units]
    if name in scope.variables or name in scope.outputs or scope.is_rate(name) or name in scope.forces or "." in name:
        message = say(
            "{name} differs from row to row, but {others} are numbers of the whole motion",
            name=quoted(name),
            others=listed(named),
        )
        if len(named) == 1:
            message = say(
                "{name} differs from row to row, but {other} is one number of the whole motion",
                name=quoted(name),
                other=listed(named),
            )
        hint = say("a summary of {name} may stand there", name=name)
    elif scope.complete:
        message = say("{name} is not a summary or dimension", name=quoted(name))
        hint = suggestion(name, known, "allowed")
    else:
        return
    scope.report.at(path, say("{where}{message}", where=where, message=message) if where else message, hint)


def _show_units(units: dict[str, Unit], driver: Driver | None, scope: Scope) -> None:
    """For conditions, which read summaries and dimensions in their units: the formulas over those, in the output's own."""
    degrees = {name for name, unit in scope.units.items() if unit.in_degrees}
    for summary, of in scope.summaries.items():
        own = units[of] if of in units else scope.angle_unit if scope.kinds.get(summary) == ANGLE else None
        own = driver.unit if driver is not None and of == driver.symbol else own
        if own is not None and own.in_degrees:
            degrees.add(summary)

    def change(part: Node) -> Node:
        return Call("RADIANS", (part,)) if isinstance(part, Symbol) and part.name in degrees else part

    for name, tree in scope.motion_outputs.items():
        shown = transform(tree, change)
        scope.motion_outputs[name] = Call("DEGREES", (shown,)) if units[name].in_degrees else shown
