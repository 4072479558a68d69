"""The part [exercise]: what is asked of students, which dimensions vary from one to the next, how it is marked."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from livesheet.formula.names import folded
from livesheet.formula.nodes import symbols
from livesheet.said import Said, say
from mechsheet.description.force_names import CENTER, OF_MOTION
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.scope import Scope, part
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Exercise, Need, Vary

ALL_ROWS = "all rows"
_COMPARED = re.compile(r"(.+?)(<=|>=|<|>)(.+)", re.DOTALL)
MOST_STEPS = 1_000_000
MOST_NAMED = 3
"""Quantities that a hint names."""


def read(data: Mapping[str, Any], summaries: Mapping[str, Any], driver: str, scope: Scope) -> Exercise | None:
    """The exercise, None where the description has none. `driver`: the driver's symbol."""
    if not data:
        return None
    asked = _asked(part(data, "asked", {}), summaries, driver, scope)
    needs = _needs(part(data, "need", ""), summaries, scope)
    tolerance, not_live = part(data, "tolerance", 1e-4), part(data, "not_live", 0.5)
    for key, value, most in (("tolerance", tolerance, 0.1), ("not_live", not_live, 1)):
        if not 0 <= value <= most:
            scope.report.at(
                ("exercise", key), say("must lie between 0 and {most}, not {value:g}", most=most, value=value)
            )
    return Exercise(
        asked=asked,
        vary=_varied(part(data, "vary", {}), scope),
        need=needs,
        tolerance=float(tolerance),
        follow_through=data.get("follow_through", True) is not False,
        not_live=float(not_live),
    )


def _asked(data: Mapping[str, Any], summaries: Mapping[str, Any], driver: str, scope: Scope) -> dict[str, float]:
    """Marks by what is asked. What drives is no question: its values are given, and so is a number taken of them."""
    found: dict[str, float] = {}
    forces = [name for name, what in scope.forces.items() if what not in (*OF_MOTION, CENTER)]
    known = [*scope.variables, *scope.coordinates, *scope.outputs, *scope.rates, *forces, *summaries]
    for symbol, marks in data.items():
        if symbol not in known and scope.complete:
            message = say(
                "no variable, coordinate, rate, force, output or summary is called {symbol}", symbol=quoted(symbol)
            )
            hint: Said | str = suggestion(symbol, known, "allowed")
            if symbol in scope.motion_outputs:
                message = say("{symbol} follows from summaries: ask for these", symbol=quoted(symbol))
            elif symbol in scope.inputs:
                message, hint = say("{symbol} is given: a dimension is no question", symbol=quoted(symbol)), ""
            elif _follows(symbol, scope):
                message = say(
                    "{symbol} is a dimension that follows from others; an output asks for it", symbol=quoted(symbol)
                )
                hint = _as_output(symbol, scope)
            elif scope.is_rate(symbol) or symbol in scope.forces:
                message = say("{symbol} can be asked for by an output that names it", symbol=quoted(symbol))
                name = symbol.replace(".", "_")
                hint = say('write {name} = "{symbol}" in [outputs], and ask for {name}', name=name, symbol=symbol)
            scope.report.at(("exercise", "asked", symbol), message, hint)
        elif driver and driver in (symbol, scope.summaries.get(symbol)):
            message = say("{symbol} is given: the driver is no question", symbol=quoted(symbol))
            others = [name for name in (*scope.variables, *scope.outputs) if name != driver]
            hint = say("ask for example for {names}", names=", ".join(others[:MOST_NAMED])) if others else ""
            scope.report.at(("exercise", "asked", symbol), message, hint)
        elif marks is not BAD:
            found[symbol] = float(marks)
    return found


def _follows(symbol: str, scope: Scope) -> bool:
    """Whether a dimension is a formula of others."""
    name, _, path = scope.symbols.taken.get(folded(symbol), ("", "", ()))
    return name == symbol and path[:1] == ("dimensions",) and symbol not in scope.inputs


def _as_output(symbol: str, scope: Scope) -> Said:
    """How a dimension is asked for: by an output of another name, since names differ."""
    name, unit = f"{symbol}_asked", scope.units[symbol].symbol
    formula = f'"{symbol}"' if unit == scope.length_unit else f'{{ formula = "{symbol}", unit = "{unit}" }}'
    return say("write {name} = {formula} in [outputs], and ask for {name}", name=name, formula=formula)


def _varied(data: Mapping[str, Any], scope: Scope) -> tuple[Vary, ...]:
    """The dimensions that vary, in their own units."""
    found = []
    for symbol, span in data.items():
        path: Path = ("exercise", "vary", symbol)
        if scope.can_vary(symbol, path) and span is not BAD and BAD not in span:
            low, high, step = map(float, span)
            if not (step > 0 and low <= high and (high - low) / step < MOST_STEPS):
                scope.report.at(path, say("expected [from, to, step] with from <= to and a step above 0"))
            found.append(Vary(symbol, low, high, step))
    return tuple(found)


def _needs(text: str, summaries: Mapping[str, Any], scope: Scope) -> tuple[Need, ...]:
    """What must hold: `all rows`, or comparisons of summaries joined by `and`."""
    path: Path = ("exercise", "need")
    found = []
    for each in [] if not text.strip() else re.split(r"\band\b|,", text):
        if " ".join(each.split()).lower() == ALL_ROWS:
            found.append(Need())
            continue
        compared = _COMPARED.fullmatch(each)
        if compared is None:
            hint = say('"{all_rows}", or a comparison such as "mu_min > 30"', all_rows=ALL_ROWS)
            scope.report.at(path, say("{text} is no condition", text=quoted(each.strip())), hint)
            continue
        sides = [scope.condition_side(side.strip(), path) for side in (compared[1], compared[3])]
        known = [*summaries, *scope.units]
        for side in sides:
            for name in symbols(side) if side is not None else ():
                if name not in known:
                    message = say("{name} is no summary and no dimension", name=quoted(name))
                    scope.report.at(path, message, suggestion(name, known, "allowed"))
        if sides[0] is not None and sides[1] is not None:
            found.append(Need(sides[0], compared[2], sides[1], each.strip()))
    return tuple(found)
