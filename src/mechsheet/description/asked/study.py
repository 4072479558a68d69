"""The part [study]: which dimensions vary and how, which designs are kept, and what is best."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from livesheet.formula.nodes import Call, Node, Symbol, symbols, transform
from livesheet.said import say
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.scope import Scope, part
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import EXTREME, POINT_RATES, Condition, Objective, Range, Study

MOST_OBJECTIVES = 3
MOST_DESIGNS = 10**12
RATE = 200_000
"""Designs a second on one core, in round numbers: for what is said of a study that nobody should wait for."""

_COMPARED = re.compile(r"(<=|>=|<|>)")
_WORD = re.compile(r"(closes|crank|grashof)(?:\s*\((.*)\))?", re.DOTALL)
_EXAMPLES = '"mu_min > 40", "60 < swing < 90", "closes", "crank(LINK)", "grashof(LOOP)"'


def read(
    data: Mapping[str, Any], bodies: Mapping[str, Any], summaries: Mapping[str, Any], scope: Scope
) -> Study | None:
    """The study, None where the description has none.

    bodies, summaries  the parts [links] and [summary], by name
    """
    if not data:
        return None
    sample = "sobol" if data.get("sample") == "sobol" else "grid"
    count = part(data, "count", 0)
    vary = _varied(part(data, "vary", {}), sample, scope)
    if sample == "sobol" and "count" not in data:
        scope.report.at(
            ("study",), say("a Sobol sample needs its number of designs"), say("for example count = 100_000")
        )
    if sample == "grid" and "vary" in data and scope.report.sound("study"):
        _check_size(vary, scope)
    for key in ("count", "seed"):
        if sample == "grid" and key in data:
            scope.report.at(
                ("study", key), say("belongs to a Sobol sample; a grid is all combinations"), say('sample = "sobol"')
            )
    texts = enumerate(part(data, "keep", []))
    keep = [_condition(text, ("study", "keep", at), bodies, summaries, scope) for at, text in texts if text is not BAD]
    return Study(
        vary=vary,
        sample="sobol" if sample == "sobol" else "grid",
        count=int(count),
        seed=int(part(data, "seed", 0)),
        keep=tuple(each for each in keep if each is not None),
        objectives=_objectives(data, summaries, scope),
        best=int(part(data, "best", 50)),
    )


# --- what varies ------------------------------------------------------------------------------------------------------


def _varied(data: Mapping[str, Any], sample: str, scope: Scope) -> tuple[Range, ...]:
    """The ranges, in the units of their dimensions."""
    found = []
    for symbol, given in data.items():
        path: Path = ("study", "vary", symbol)
        if scope.can_vary(symbol, path) and given is not BAD:
            one = _range(symbol, given, sample, path, scope)
            found += [one] if one is not None else []
    return tuple(found)


def _range(symbol: str, given: Any, sample: str, path: Path, scope: Scope) -> Range | None:
    if isinstance(given, Mapping) and "values" in given:
        values = given["values"]
        if values is BAD or BAD in values:
            return None
        if sample == "sobol":
            scope.report.at(path, say("a Sobol sample varies between two ends, not over a list"), say("[from, to]"))
            return None
        return Range(symbol, values=tuple(map(float, values)))
    ends = [given.get(key) for key in ("from", "to", "by")] if isinstance(given, Mapping) else [*given, None][:3]
    low, high, step = ends
    if BAD in ends or low is None or high is None:
        return None  # which has been reported
    if sample == "sobol":
        if step is not None:
            scope.report.at(path, say("a Sobol sample has no step: any number between the ends"), say("[from, to]"))
        elif not low < high:
            scope.report.at(
                path,
                say("from {low:g} to {high:g} is no range", low=low, high=high),
                say("[from, to] with from < to"),
            )
        else:
            return Range(symbol, float(low), float(high))
    elif step is None:
        hint = say('[from, to, step]; without a step: sample = "sobol" and count')
        scope.report.at(path, say("a grid needs a step"), hint)
    elif not (step > 0 and low <= high):
        scope.report.at(path, say("expected [from, to, step] with from <= to and a step above 0"))
    else:
        return Range(symbol, float(low), float(high), float(step))
    return None


def _check_size(vary: tuple[Range, ...], scope: Scope) -> None:
    """Refuse a grid that nobody lives to see, with the time it would take."""
    total = math.prod(one.count for one in vary)
    if total <= MOST_DESIGNS:
        return
    days = total / RATE / 86_400
    size = {"parts": " · ".join(f"{one.count:,}" for one in vary), "total": total, "rate": RATE, "most": MOST_DESIGNS}
    message = say(
        "{parts} = {total:,.4g} designs, at {rate:,} a second {days:,.0f} days: the most are {most:,}",
        **size,
        days=days,
    )
    if days >= 10_000:
        message = say(
            "{parts} = {total:,.4g} designs, at {rate:,} a second {years:,.3g} years: the most are {most:,}",
            **size,
            years=days / 365.25,
        )
    hint = say('sample = "sobol" with count = 1_000_000 first; then a grid around what it finds')
    scope.report.at(("study", "vary"), message, hint)


# --- conditions and objectives ----------------------------------------------------------------------------------------


def _condition(
    text: str, path: Path, bodies: Mapping[str, Any], summaries: Mapping[str, Any], scope: Scope
) -> Condition | None:
    plain = " ".join(text.split())
    other, _, rest = plain.partition(" ") if plain.startswith("not ") else ("", "", plain)
    word = _WORD.fullmatch(rest)
    if word is not None:
        name = (word[2] or "").strip()
        if word[1] == "closes":
            if word[2] is not None:
                scope.report.at(path, say("closes has no argument: it asks for all rows"), say('"closes"'))
            return Condition(plain, "closes", other=bool(other))
        if word[1] == "crank":
            if name not in bodies:
                links = suggestion(name, bodies, "links")
                scope.report.at(
                    path, say("in {plain}: no link is called {name}", plain=quoted(plain), name=quoted(name)), links
                )
            return Condition(plain, "crank", name, bool(other))
        if not name:
            scope.report.at(path, say("grashof asks of a loop"), say('"grashof(A0ABB0)": the loop by its pins'))
        return Condition(plain, "grashof", name, bool(other))
    parts = _COMPARED.split(rest)
    if len(parts) not in (3, 5) or not all(part.strip() for part in parts):
        scope.report.at(path, say("{text} is no condition", text=quoted(plain)), say(_EXAMPLES))
        return None
    sides = [_value(side.strip(), path, summaries, scope) for side in parts[::2]]
    if any(side is None for side in sides):
        return None
    return Condition(
        plain, "compare", "", bool(other), tuple(side for side in sides if side is not None), tuple(parts[1::2])
    )


def _objectives(data: Mapping[str, Any], summaries: Mapping[str, Any], scope: Scope) -> tuple[Objective, ...]:
    found = []
    for key in ("minimize", "maximize"):
        for at, text in enumerate(part(data, key, [])):
            if text is not BAD and (node := _value(text, ("study", key, at), summaries, scope)) is not None:
                found.append(Objective(" ".join(text.split()), node, key == "maximize"))
    if len(found) > MOST_OBJECTIVES:
        key = "maximize" if data.get("maximize") else "minimize"
        message = say(
            "{count} objectives: a front of more than {most} tells nobody anything",
            count=len(found),
            most=MOST_OBJECTIVES,
        )
        scope.report.at(("study", key), message, say("make conditions of the others"))
    twice = [each.text for at, each in enumerate(found) if each.text in [other.text for other in found[:at]]]
    for text in twice:
        scope.report.at(("study",), say("{text} is an objective twice", text=quoted(text)))
    return tuple(found)


def _value(text: str, path: Path, summaries: Mapping[str, Any], scope: Scope) -> Node | None:
    """The tree of an expression over dimensions, summaries and extremes; None where it is wrong, which is reported."""
    tree = scope.condition_side(text, path)
    if tree is None:
        return None
    rowwise = [*scope.variables, *scope.coordinates, *scope.outputs]
    rowwise += [*scope.rates, *scope.forces]
    rowwise += [f"{point}.{part}" for point in scope.points for part in POINT_RATES if scope.moves]

    def change(node: Node) -> Node:
        match node:
            case Call("MIN" | "MAX" as function, (Symbol(name),)) if name in rowwise:
                return Symbol(EXTREME.format(take=function.lower(), of=name))
        return node

    tree = transform(tree, change)
    known = [*summaries, *scope.units]
    fine = True
    for name in symbols(tree):
        if name in known or "(" in name:
            continue
        fine = False
        if name in rowwise:
            message, hint = (
                say("{name} has a value in every row", name=quoted(name)),
                say("min({name}) or max({name}), or a summary of it", name=name),
            )
        else:
            message, hint = (
                say("{name} is no summary and no dimension", name=quoted(name)),
                suggestion(name, known, "allowed"),
            )
        if scope.complete or name in rowwise:
            scope.report.at(
                path,
                message if name == text.strip() else say("in {text}: {message}", text=quoted(text), message=message),
                hint,
            )
    return tree if fine else None
