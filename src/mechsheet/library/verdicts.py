"""What is to be said of a mechanism, by name: the verdicts of its workbook's first sheet, and what no cell can know; and
what the tolerances of its dimensions come to, the bands of outputs and summaries. A wrong name is told with the one that may
be meant."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from typing import Any, TypeVar

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import Scalar
from livesheet.said import say
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides
from mechsheet.description.reader import with_settings
from mechsheet.description.report import suggestion
from mechsheet.diagnostics import MechsheetError, quoted
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.search import Search
from mechsheet.library.building import told
from mechsheet.model import Mechanism
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.columns.bands import ROOT, WORST
from mechsheet.sheet.findings.limits import InputEnd, Limits
from mechsheet.sheet.findings.listing import findings_of
from mechsheet.sheet.findings.searched import SearchedMotion
from mechsheet.sheet.plan import MEANING, TOLERANCE
from mechsheet.sheet.shown import shown_unit
from mechsheet.sheet.table.tolerance import lines_of
from mechsheet.units import behind_number
from mechsheet.words.catalogue import text_in

Thing = TypeVar("Thing")


class UnknownNameError(MechsheetError, KeyError):
    """Nothing has this name."""

    def __str__(self) -> str:
        return "\n".join(str(fault) for fault in self.faults)


def unknown(name: object, known: Iterable[str]) -> UnknownNameError:
    """The error for a name that is none of those known."""
    message = say("nothing is called {name}", name=quoted(str(name)))
    return UnknownNameError(Fault(message, hint=suggestion(str(name), known, say("names"))))


class Named(dict[str, Thing]):
    """Things by name; printed one a line."""

    def __missing__(self, name: object) -> Thing:
        raise unknown(name, self)

    def __str__(self) -> str:
        return "\n".join(
            f"{name} = {thing:.10g}" if isinstance(thing, float) else f"{name}{thing}" for name, thing in self.items()
        )

    def as_json(self) -> str:
        """Verdicts and bands for programs: {"limit_1": {"value": 33.9, "where": 360.0, "words": "...", "sure": true}}."""
        things: dict[str, Any] = dict(self)
        return json.dumps({name: asdict(thing) for name, thing in things.items()}, ensure_ascii=False, indent=1)


# --- verdicts ---------------------------------------------------------------------------------------------------------


_LANDS = 1e-6
"""By this part of a step the stop may be missed: it is rounding."""

_DIGITS, _MOST_DIGITS = 6, 15
"""Digits of a number in a line; more only where fewer would say something absurd."""


DOUBTS = ("verdict.about", "verdict.beyond", "verdict.rows.only")
"""What the first sheet may say of a number beside it."""

OF_ROWS = ("verdict.within", "verdict.unsure", "verdict.largest_effort", "verdict.largest_force.words")
"""What it says of a number that is one of the rows', or known to a step."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """One line of the first sheet.

    value, where  the number, and the driver's value where it occurs; None for none
    words         what is said of it
    sure          whether the number is that of the motion itself, and not one of the rows that may be missed between them
    """

    value: float | None
    where: float | None
    words: str
    sure: bool = True

    def __str__(self) -> str:
        text = "" if self.value is None else f" = {self.value:.10g}"
        text += "" if self.where is None else f" at {self.where:.10g}"
        return f"{text}: {self.words}" if self.words else text


def verdict(compiled: Compiled) -> str:
    """`closes in 19 / 25 positions; ...; the step misses the stop (360°): the last row is 350°`.

    The cell `verdict` of the computed workbook, in its language, and what is wrong with the description itself.
    """
    mechanism, plan = compiled.mechanism, compiled.plan
    said = [str(compiled.value(plan.places.verdict))]
    missed = _missed_stop(mechanism, plan.rows)
    if missed is not None:
        unit = shown_unit(plan, mechanism.driver.symbol)
        digits = _telling(*missed)
        stop, last = (_shown(each, unit, digits) for each in missed[:2])
        shown = {"stop": stop, "last": last}
        said.append(say("the step misses the stop ({stop}): the last row is {last}", **shown))
    said += _undetermined(compiled)
    said += [
        say(
            "the sketch says nothing about group {group}: mode +1 was taken, {mode}; a point under [assembly] decides",
            group=group.number,
            mode=group.mode_words,
        )
        for group in plan.equations.groups
        if group.open
    ]
    return "; ".join(text_in(each, mechanism.language) for each in said)


def _undetermined(compiled: Compiled) -> list[str]:
    """Of each group the rows in which its links could be joined and are still free to move: how many, and the first."""
    found: list[str] = []
    for group in compiled.equations.groups:
        if group.degenerate is None:
            continue
        with np.errstate(all="ignore"):
            free = np.broadcast_to(value(group.degenerate, compiled.values), compiled.closed.shape)
        rows = np.flatnonzero(free & ~compiled.closed)
        if not len(rows):
            continue
        driver = compiled.mechanism.driver
        place = _shown(driver.unit.to_shown(compiled.values[driver.symbol][rows[0]]), driver.unit.text)
        if len(rows) == 1:
            found.append(say("undetermined at {place}: {links}", place=place, links=group.label))
        else:
            found.append(
                say("undetermined in {count} positions, the first at {place}: {links}", count=len(rows), place=place,
                    links=group.label)
            )  # fmt: skip
    return found


def _missed_stop(mechanism: Mechanism, rows: int) -> tuple[float, float, float] | None:
    """As people read them the stop of the sweep, the last row and the one that would come next, where none is the stop."""
    driver = mechanism.driver
    if not driver.stepped:
        return None
    values = dimension_values(mechanism)
    start, stop, step = (number(part, values) for part in (driver.start, driver.stop, driver.step))
    if abs((stop - start) / step - (rows - 1)) < _LANDS:
        return None
    stop, last, beyond = (driver.unit.to_shown(each) for each in (stop, start + (rows - 1) * step, start + rows * step))
    return stop, last, beyond


def _telling(stop: float, last: float, beyond: float) -> int:
    """So many digits, at least six, that the stop does not read like the row before it or the one after it."""
    for digits in range(_DIGITS, _MOST_DIGITS):
        if f"{stop:.{digits}g}" not in (f"{last:.{digits}g}", f"{beyond:.{digits}g}"):
            return digits
    return _MOST_DIGITS


def _shown(value: object, unit: str, digits: int = _DIGITS) -> str:
    return f"{value:.{digits}g}{behind_number(unit)}" if isinstance(value, float | int) else str(value)


def verdicts_of(mechanism: Mechanism) -> Named[Verdict]:
    """What is to be said, by the names of the first sheet's cells: the value, where it occurs, and the words beside it.

    The first is `verdict`, the line under the title; summaries and outputs of them are the last. None stands for a value
    that there is none of. Values are searched in Python wherever a search can be sure (`kinematics.search`), the others
    and the words are the sheet's: those of several sheets, which say more than one page has room for.
    """
    mechanism = replace(mechanism, layout="sheets")
    compiled = told(mechanism)
    plan = compiled.plan

    doubts = tuple(plan.text(key) for key in (*DOUBTS, *OF_ROWS))

    def line(value: Scalar, where: Scalar, words: Scalar) -> Verdict:
        """One line; errors and empty texts are nothing."""
        number, place = (each if isinstance(each, float) else None for each in (value, where))
        said = words if isinstance(words, str) else ""
        return Verdict(number, place, said, not any(doubt in said for doubt in doubts))

    verdict = plan.places.verdict
    found = Named({verdict.name: line(None, None, compiled.value(verdict))})
    for key, spot in plan.places.lines.items():
        at = plan.places.occurs.get(key)
        where = None if at is None else compiled.value(at)
        found[spot.name] = line(compiled.value(spot), where, compiled.value(replace(spot, col=MEANING)))
    for spot in plan.searched.limits:
        if isinstance(limit := compiled.value(spot), float):
            found[spot.name] = line(limit, None, None)
    for single in mechanism.motion_numbers:
        spot = plan.places.summaries[single.symbol]
        where, words = (compiled.value(replace(spot, col=col)) for col in (TOLERANCE, MEANING))
        found[spot.name] = line(compiled.value(spot), where, words)
    names = {key: spot.name for key, spot in plan.places.lines.items()}
    names |= {f"limit_{number}": spot.name for number, spot in enumerate(plan.searched.limits, 1)}
    motion = SearchedMotion(plan, Search(mechanism, compiled.equations, compiled.given))
    of_a_step = any(plan.text("verdict.within") in said.words for said in found.values())
    for finding in findings_of(mechanism, plan.found):
        for key, expected in finding.expected(motion).items():
            if not expected.told or (name := names.get(key, key)) not in found:
                continue
            # words of limits name the sheet's numbers, which have to agree
            if of_a_step and isinstance(finding, Limits | InputEnd):
                found[name] = replace(found[name], sure=False)
            else:
                found[name] = replace(found[name], value=next(iter(expected.numbers), None))
    return found


# --- bands ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Band:
    """Of one quantity or summary; None for no number (a dead centre, no position).

    value       of a summary; None for a quantity, which has one in every row
    worst, rss  the worst case and the root sum of squares, in `unit`; of a quantity where its band is largest
    shares      by dimension (S t)^2 of the sum of squares, at most 1
    words       what the first sheet says
    """

    value: float | None
    worst: float | None
    rss: float | None
    unit: str
    shares: dict[str, float | None]
    words: str

    def __str__(self) -> str:
        unit = behind_number(self.unit)
        if self.worst is None or self.rss is None:
            return f": {self.words}"
        shares = sorted(self.shares.items(), key=lambda pair: -(pair[1] or 0.0))
        said = ", ".join(f"{dimension} {share:.0%}" for dimension, share in shares if share is not None)
        return f" ± {self.worst:.3g}{unit} (RSS {self.rss:.3g}{unit}): {said}; {self.words}"


def bands_of(mechanism: Mechanism, file: str = "<text>") -> Named[Band]:
    """The bands of a mechanism's [tolerance]; without one of all its outputs and summaries.

    file  what messages call its description

    Raises DescriptionError where no dimension has a tolerance or nothing can have a band, MechanismError where the mechanism
    cannot be solved.
    """
    compiled = told(with_settings(mechanism, Overrides(tolerance=True), file))
    plan = compiled.plan

    def number(spot: Spot) -> float | None:
        found = compiled.number(spot)
        return None if math.isnan(found) else found

    result: Named[Band] = Named()
    for line in lines_of(plan):
        if line.kind == "shown":
            continue
        key = line.key
        band, spot = plan.banded[line.quantity], plan.places.bands[key]
        title = plan.at.titles["tolerance"]
        words = compiled.value(replace(spot, col=MEANING))
        result[key] = Band(
            value=number(plan.places.summaries[key]) if line.summary else None,
            worst=number(line.spot(plan, WORST)),
            rss=number(line.spot(plan, ROOT)),
            unit=shown_unit(plan, line.quantity),
            shares={
                name: number(Spot(title, line.row + 1, plan.at.spots[symbol].col))
                for name, symbol in zip(band.dimensions, band.derivatives, strict=True)
            },
            words=words if isinstance(words, str) else "",
        )
    return result
