"""[tolerance]: of which quantities and summaries bands are wanted; only of positions, and only where a dimension has a
tolerance."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from livesheet.said import say
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.requests import check_column
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Dimension, Driver, FurtherDriver, Tolerances

_PATH: Path = ("tolerance",)


def read(
    data: dict[str, Any],
    dimensions: tuple[Dimension, ...],
    driven: Sequence[Driver | FurtherDriver],
    layout: str,
    scope: Scope,
) -> Tolerances | None:
    """What is asked for; None without [tolerance]."""
    if "tolerance" not in data or data["tolerance"] is BAD:
        return None
    _check_dimensions(dimensions, layout, scope)
    named = data["tolerance"].get("of")
    if named is BAD:
        return None
    # a cam's follower stands where dimensions say: base circle, roller, offset, its segments
    given = {each.symbol for each in driven if not (isinstance(each, FurtherDriver) and each.segments is not None)}
    if named is None:
        found = [name for name in (*scope.outputs, *scope.summaries) if _has_positions(name, given, scope)]
        if not found:
            message = say("there is no output and no summary of positions to give a band to")
            scope.report.at(_PATH, message, say('name what is wanted: of = ["{given}"]', given=_example(given, scope)))
    else:
        for number, name in enumerate(named):
            _check(name, named[:number], given, (*_PATH, "of", number), scope)
        found = [name for name in named if name is not BAD]
    summaries = tuple(name for name in found if name in scope.summaries)
    quantities = dict.fromkeys(scope.summaries.get(name, name) for name in found)
    return Tolerances(tuple(quantities), summaries, named is not None)


def _check_dimensions(dimensions: tuple[Dimension, ...], layout: str, scope: Scope) -> None:
    if layout == "page":
        message = say("bands need a sheet of their own, which the layout page does not have")
        scope.report.at(_PATH, message, say('write layout = "sheets"'))
    own = [dim for dim in dimensions if dim.tolerance and not dim.path]
    for dim in own:
        if dim.derived:
            message = say(
                "{symbol} follows from other dimensions: its tolerance follows from theirs", symbol=quoted(dim.symbol)
            )
            scope.report.at(("dimensions", dim.symbol, "tolerance"), message, say("give those tolerances"))
    if not any(not dim.derived for dim in own):
        inputs = [dim for dim in dimensions if not dim.derived and not dim.path and dim.shown is not None]
        symbol, value = (inputs[0].symbol, inputs[0].shown) if inputs else ("a2", 40)
        hint = say(
            "write for example {symbol} = {{ value = {value:.12g}, tolerance = 0.1 }}", symbol=symbol, value=value
        )
        message = say("no dimension has a tolerance: there is nothing that could spread")
        scope.report.at(_PATH, message, hint)


def _check(name: Any, before: list[Any], given: set[str], path: Path, scope: Scope) -> None:
    """One name: of a summary, or of something with a position in every row."""
    if name is BAD:
        return
    if name in before:
        scope.report.at(path, say("{name} is listed twice", name=quoted(name)))
        return
    of = scope.summaries.get(name, name)
    if of is BAD:
        return
    if name not in scope.summaries and name not in scope.units and not _known(name, scope):
        _report_unknown(name, path, scope)
        return
    if name not in scope.summaries:
        check_column(name, path, scope)
    if scope.reads_rates(of):
        message = say(
            "{name} is, or reads, a velocity, an acceleration or a force: bands are found of positions only",
            name=quoted(name),
        )
        scope.report.at(path, message)
    elif name in scope.takes and not scope.takes[name].linear:
        message = say(
            "{name} is no number that changes as its quantity does: bands are found of the largest, the smallest, the"
            " range, the mean, the first and the last",
            name=quoted(name),
        )
        scope.report.at(path, message)
    elif of in given:
        scope.report.at(path, say("{name} is driven: no dimension changes it", name=quoted(name)))
    elif of.partition(".")[0] in scope.fixed:
        scope.report.at(
            path, say("{name} is of a point of the ground, which has no column of its own", name=quoted(name))
        )


def _known(name: str, scope: Scope) -> bool:
    return (
        name in scope.variables or name in scope.outputs or "." in name or scope.is_rate(name) or name in scope.forces
    )


def _report_unknown(name: str, path: Path, scope: Scope) -> None:
    if scope.complete:
        known = [*scope.outputs, *scope.summaries, *scope.variables]
        message = say("no output, variable or summary is called {name}", name=quoted(name))
        if name in scope.motion_outputs:
            message = say("{name} follows from summaries: bands are found of these", name=quoted(name))
        scope.report.at(path, message, suggestion(name, known, "allowed"))


def _has_positions(name: str, given: set[str], scope: Scope) -> bool:
    """Whether an output or a summary is of positions, and changes as they do."""
    if name in scope.takes and not scope.takes[name].linear:
        return False
    of = scope.summaries.get(name, name)
    return of is not BAD and not scope.reads_rates(of) and of not in given and of.partition(".")[0] not in scope.fixed


def _example(given: set[str], scope: Scope) -> str:
    return next((name for name in scope.variables if name not in given), "theta14")
