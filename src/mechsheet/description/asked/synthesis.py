"""The part [synthesis]: a task, checked, and the dimensions that solve it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol, symbols
from livesheet.formula.scalar import evaluate
from livesheet.said import reason, say
from mechsheet.description.kinds import LENGTH, unit_kind
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Dimension, Synthesis, TaskPlace
from mechsheet.synthesis.kind import Kind
from mechsheet.synthesis.kinds import KINDS, written
from mechsheet.synthesis.writing import Task, Units, Writer
from mechsheet.units import NUMBER, Unit

ROUNDING = "round_to"

STEEPEST = 1e-9
"""Of a function whose ends lie nearer to each other, as a part of its size, it is said that it is constant."""


@dataclass(slots=True)
class Found:
    """What was read: nothing where there is no task, or nothing usable.

    dimensions  inputs of the task, and the steps of its solution
    units       of the mechanism's dimensions that are results, where the description says none;  trees: what these are
    """

    synthesis: Synthesis | None = None
    dimensions: tuple[Dimension, ...] = ()
    units: dict[str, Unit] = field(default_factory=dict)
    trees: dict[str, Node] = field(default_factory=dict)


def read(data: Any, given: Mapping[str, Any], scope: Scope, others: Iterable[str] = ()) -> Found:
    """The task and its solution.

    given   the part [dimensions];  others: further names of the description, that no step may have
    """
    taken = {
        symbol: entry["synthesis"]
        for symbol, entry in given.items()
        if isinstance(entry, dict) and entry.get("synthesis", BAD) is not BAD
    }
    scope.solved = data is None
    if not isinstance(data, dict) or not data:
        for symbol in taken if data is None else ():
            message = say("there is no part [synthesis] whose result it could be")
            scope.report.at(("dimensions", symbol, "synthesis"), message)
        return Found()
    task = _task(data, given, scope)
    if task is None or any(f"{fault.key}.".startswith("synthesis.") for fault in scope.report.faults):
        return Found()  # also what was told before: it is not among the data
    units = Units(scope.length, scope.angle_unit, NUMBER)
    plain = [symbol for symbol, entry in given.items() if _is_plain(entry)]
    scope.solved = True
    writer = written(data["kind"], task, units, frozenset((*given, *others)), plain)
    replaced = [name for name in writer.results if name in given and name not in taken]
    return _found(data["kind"], task, writer, taken, replaced, scope)


def declare(found: Found, scope: Scope) -> None:
    """Enter the names, units and values of the task's inputs and steps; a step that has no value stays without."""
    for dim in found.dimensions:
        hint = say("rename it: a step of the synthesis has that name") if dim.derived else say("rename it")
        scope.symbols.claim(dim.symbol, "synthesis", dim.path, hint)
        scope.units[dim.symbol] = dim.unit
        scope.kinds[dim.symbol] = unit_kind(dim.unit)
        value = dim.value if isinstance(dim.value, float) else _value(dim.value, scope.numbers)
        if value is not None:
            scope.numbers[dim.symbol] = value


def _value(tree: Node, numbers: Mapping[str, float]) -> float | None:
    """The value of a step; None where the task has no solution."""
    if not all(name in numbers for name in symbols(tree)):
        return None
    try:
        return evaluate(tree, numbers)
    except (ArithmeticError, ValueError):
        return None


# --- the task ------------------------------------------------------------------------------------------------------


def _task(data: dict[str, Any], given: Mapping[str, Any], scope: Scope) -> Task | None:
    """The task's numbers in internal units; reports what is wrong with them."""
    kind = KINDS[data["kind"]]
    numbers = _numbers(data, kind, scope)
    for place, value in numbers.items():
        if place[0] in (*kind.positive, "round") and value <= 0:
            scope.report.at(("synthesis", *place), say("must be greater than 0, not {value:g}", value=value))
    if data.get("best") is False:
        scope.report.at(("synthesis", "best"), say("is true, or left out with another key in its place"))
    for key in kind.own:
        if key not in data and not _is_plain(given.get(key)):
            scope.report.at(("synthesis", key), say("is missing: give it here, or as a number in [dimensions]"))
    chosen: dict[str, str] = {}
    function: Node | None = None
    if kind.pairs:
        function = _function(data, numbers, chosen, scope)
    return Task(numbers, kind.positive, chosen, function)


def unit_in(place: TaskPlace, kind: Kind, scope: Scope) -> Unit:
    """The unit of the number that stands there, in a task of that kind."""
    match kind.measure(place):
        case "angle":
            return scope.angle_unit
        case "number":
            return NUMBER
    return scope.length


def _is_plain(entry: Any) -> bool:
    """Whether a dimension is a number that is given."""
    return isinstance(entry, float) or (isinstance(entry, dict) and isinstance(entry.get("value"), float))


def _numbers(data: dict[str, Any], kind: Kind, scope: Scope) -> dict[TaskPlace, float]:
    found: dict[TaskPlace, float] = {}

    def enter(value: Any, place: TaskPlace) -> None:
        if isinstance(value, list):
            for index, item in enumerate(value):
                enter(item, (*place, index))
        elif isinstance(value, dict):
            for key, item in value.items():
                enter(item, (*place, key))
        elif isinstance(value, float):
            found[place] = unit_in(place, kind, scope).to_internal(value)

    for key, value in data.items():
        if not isinstance(value, bool):
            enter(value, (key,))
    return found


def _function(
    data: dict[str, Any], numbers: Mapping[TaskPlace, float], chosen: dict[str, str], scope: Scope
) -> Node | None:
    """The pairs of angles, or the function that is to be generated; into `chosen` goes the number of points."""
    report = scope.report
    theta, psi = data["theta"], data["psi"]
    if "f" not in data:
        for key in ("x", "points"):
            if key in data:
                report.at(("synthesis", key), say("goes with `f`: the function of x that is to be generated"))
        if theta is BAD or psi is BAD:
            return None
        if len(theta) != len(psi):
            report.at(
                ("synthesis", "psi"),
                say("has {count} angles for {others} of theta", count=len(psi), others=len(theta)),
            )
        for key, angles in (("theta", theta), ("psi", psi)):
            if len(angles) < 3:
                report.at(
                    ("synthesis", key),
                    say("has {count} angles: three precision points are the least", count=len(angles)),
                )
        chosen["points"] = str(len(theta))
        return None
    for key, angles in (("theta", theta), ("psi", psi)):
        if angles is not BAD and len(angles) != 2:
            report.at(
                ("synthesis", key),
                say("of a function `f` has two angles, the first and the last; found {count}", count=len(angles)),
            )
    if "x" not in data:
        report.at(("synthesis", "x"), say("is missing: the range of the function, [first, last]"))
    points = data.get("points", 3)
    chosen["points"] = str(points)
    text = data["f"]
    if text is BAD or (tree := scope.parse(text, ("synthesis", "f"))) is None:
        return None
    unknown = [name for name in symbols(tree) if name != "x"]
    for name in unknown:
        report.at(
            ("synthesis", "f"),
            say("in {text}: {name} is not known; a function of x alone", text=quoted(text), name=quoted(name)),
        )
    if not unknown and ("x", 1) in numbers and "x" in data:
        _check_function(tree, text, numbers["x", 0], numbers["x", 1], scope)
    return tree


SAMPLES = 81
"""Places at which a function is looked at before it is taken."""


def _check_function(tree: Node, text: str, first: float, last: float, scope: Scope) -> None:
    """Report a function that has no value somewhere, or that turns back: an angle cannot be read off backwards."""
    if first == last:
        scope.report.at(("synthesis", "x"), say("the range has no length"))
        return
    values: list[float] = []
    for index in range(SAMPLES):
        x = first + (last - first) * index / (SAMPLES - 1)
        try:
            values.append(evaluate(tree, {"x": x}))
        except (ArithmeticError, ValueError) as error:
            scope.report.at(
                ("synthesis", "f"),
                say("{text} has no value at x = {x:.6g}: {error}", text=quoted(text), x=x, error=reason(error)),
            )
            return
        if len(values) > 2 and (values[-1] - values[-2]) * (values[-2] - values[-3]) < 0:
            scope.report.at(
                ("synthesis", "f"),
                say("{text} turns back near x = {x:.6g}: it must rise or fall throughout", text=quoted(text), x=x),
            )
            return
    if abs(values[-1] - values[0]) <= STEEPEST * max(map(abs, values)):
        scope.report.at(
            ("synthesis", "f"),
            say(
                "{text} does not change between x = {first:.6g} and {last:.6g}",
                text=quoted(text),
                first=first,
                last=last,
            ),
        )


# --- results -------------------------------------------------------------------------------------------------------


def _found(kind: str, task: Task, writer: Writer, taken: Mapping[str, str], replaced: list[str], scope: Scope) -> Found:
    dimensions, by_symbol = writer.dimensions, {dim.symbol: dim for dim in writer.dimensions}
    inputs = dict(writer.inputs)
    rounding = ""
    if task.has("round"):
        rounding = inputs["round",] = ROUNDING
        dimensions = [writer.rounding(ROUNDING), *dimensions]
    units, trees, good = {}, {}, {}
    for symbol, name in taken.items():
        path: Path = ("dimensions", symbol, "synthesis")
        if name not in writer.results:
            message = say("a synthesis of kind {kind} gives no {name}", kind=quoted(kind), name=quoted(name))
            scope.report.at(path, message, suggestion(name, writer.results, "results"))
        elif symbol in writer.results and symbol != name:
            message = say(
                "{symbol} is another result of this synthesis: {name} under this name would mislead",
                symbol=quoted(symbol),
                name=quoted(name),
            )
            scope.report.at(path, message, say("name the dimension otherwise"))
        else:
            exact = writer.results[name]
            unit = by_symbol[exact].unit if exact in by_symbol else writer.units.length
            good[symbol], units[symbol] = name, unit
            trees[symbol] = rounded(exact, rounding if unit.kind == LENGTH else "")
    positive = tuple(writer.positive) + ((rounding,) if rounding else ())
    synthesis = Synthesis(
        kind, inputs, tuple(writer.steps), dict(writer.results), good, positive, dict(task.chosen), rounding,
        function=task.function, reasons=tuple(writer.reasons), replaced=tuple(replaced), names=dict(writer.names),
        sides=tuple(writer.sides), roots=dict(writer.roots),
    )  # fmt: skip
    return Found(synthesis, tuple(dimensions), units, trees)


def rounded(exact: str, rounding: str) -> Node:
    """The result as the mechanism uses it."""
    if not rounding:
        return Symbol(exact)
    steps = Call("ROUND", (al.div(Symbol(exact), Symbol(rounding)), al.ZERO))
    return al.mul(Symbol(rounding), steps)


_MODE = re.compile(r"mode_[0-9]+")


def with_modes(task: Synthesis | None, sketch: Mapping[str, Any], scope: Scope) -> Synthesis | None:
    """The synthesis with the assembly modes of [assembly] that are its results."""
    asked = {name: entry for name, entry in sketch.items() if isinstance(entry, dict)}
    found: dict[str, str] = {}
    for name, entry in asked.items():
        path: Path = ("assembly", name)
        result = entry.get("synthesis", BAD)
        if not _MODE.fullmatch(name):
            scope.report.at(
                path,
                say("only an assembly mode is a result of a synthesis"),
                say("mode_1 is that of the first group"),
            )
        elif task is None and not scope.solved:
            continue
        elif task is None:
            scope.report.at(path, say("there is no part [synthesis] whose result it could be"))
        elif result is not BAD and (result != "mode" or result not in task.results):
            message = say(
                "{result} is no assembly that a synthesis of kind {kind} gives",
                result=quoted(result),
                kind=quoted(task.kind),
            )
            allowed = [one for one in task.results if one == "mode"]
            scope.report.at((*path, "synthesis"), message, suggestion(result, allowed, "results"))
        else:
            found[name] = "mode"
    return None if task is None else replace(task, mode=found)
