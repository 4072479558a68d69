"""Changing the driver's sweep as the command line asks: step and number of rows, written into the description's text."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.description.driving.driver import LANDS, check_sweep, kind_and_unit
from mechsheet.description.grammar import MOST_ROWS, Quantity
from mechsheet.description.overrides import DIGITS, scope_for, table_of, typed_value
from mechsheet.description.report import BAD
from mechsheet.description.scope import Scope
from mechsheet.description.shape import fit
from mechsheet.description.text.numbers import typed_number
from mechsheet.description.text.rewrite import number_text, with_value
from mechsheet.description.text.source import Source
from mechsheet.diagnostics import quoted
from mechsheet.units import DEG, Unit

LEAST_ROWS = 2


def with_sweep(source: Source, rows: str | None, step: str | None) -> tuple[Source, list[Fault]]:
    """The source with another step, another number of rows, or both; and what is wrong with these.

    step  a number in the driver's unit, or an expression (see `typed_value`); start and stop stay
    rows  alone: start and stop stay, the step is (stop - start)/(rows - 1); with `step`: start stays, the stop is
          start + (rows - 1) step
    What follows from expressions is written as an expression: it goes on following the dimensions in it.
    """
    driver = source.data.get("driver")
    if not isinstance(driver, dict) or (rows is None and step is None):
        return source, []
    if "values" in driver:
        message = say("the driver's values are listed one by one: there is no sweep to change")
        hint = say("give [driver] start, stop and step in place of `values`")
        options = [option for option, given in (("step", step), ("rows", rows)) if given is not None]
        return source, [Fault(message, source.file, key=option, hint=hint) for option in options]
    if "motion" in driver:
        return _with_rows_of_motion(source, rows, step)
    sweep = _sweep(source)
    faults = sweep.scope.report.faults
    if "segments" in driver:
        if driver.get("closed") is False:
            message = say("a motion that does not close ends where its segments end: write another step in [driver]")
            return source, [Fault(message, source.file, key="rows" if step is None else "step")]
        if rows is not None and step is not None:
            return source, [Fault(say("a cam turns once: give rows or step"), source.file, key="rows")]
    taken = None if step is None else typed_value(step, sweep.unit, "the driver's", sweep.scope)
    if taken is not None:
        fit(float(taken), Quantity(), (), sweep.scope.report)  # its size
    count, wrong = (None, []) if rows is None else _count(rows, source.file)
    faults += wrong
    if faults:
        return source, faults
    for key, value in _changed(sweep, count, taken).items():
        source = with_value(source, ("driver", key), value)
    return source, faults


def _with_rows_of_motion(source: Source, rows: str | None, step: str | None) -> tuple[Source, list[Fault]]:
    """The source with another number of rows of its motion law."""
    count, faults = (None, []) if rows is None else _count(rows, source.file)
    if step is not None:
        message = say("the driver moves by a motion law: its rows are equally spaced in time, there is no step")
        faults.append(Fault(message, source.file, key="step", hint=say("--rows says how many there are")))
    if faults or count is None:
        return source, faults
    return with_value(source, ("driver", "motion", "rows"), str(count)), faults


@dataclass(frozen=True, slots=True)
class _Sweep:
    """start and stop as the description writes them, in what unit; the scope reports at the option `step`."""

    data: Mapping[str, Any]
    kind: str
    unit: Unit
    scope: Scope

    def value(self, given: Any) -> float:
        """The value of a number or expression in internal units, NaN where it has none (the reader will say why)."""
        told = len(self.scope.report.faults)
        found = self.scope.number(self.scope.quantity(given, self.kind, ()))
        del self.scope.report.faults[told:]
        return found


def _sweep(source: Source) -> _Sweep:
    data = table_of(source, "driver")
    scope = scope_for(source, "step")
    if "segments" in data:  # over one turn of the cam
        data = {**data, "start": 0.0, "stop": scope.angle_unit.written(math.tau)}
    kind, unit = kind_and_unit(data, scope)
    return _Sweep(data, kind, unit, scope)


def _count(rows: str, file: str) -> tuple[int | None, list[Fault]]:
    """The number of rows, and what is wrong with it."""
    number = typed_number(rows)
    if number is None or number.unit or number.why or not float(number.text).is_integer():
        hint = number.hint if number and number.why and not number.unit else ""
        return None, [
            Fault(say("expected a whole number, found {text}", text=quoted(rows.strip())), file, key="rows", hint=hint)
        ]
    count = float(number.text)
    if count < LEAST_ROWS:
        return None, [
            Fault(
                say("a sweep has at least {least} rows, not {count:.15g}", least=LEAST_ROWS, count=count),
                file,
                key="rows",
            )
        ]
    if count > MOST_ROWS:
        message = say(
            "a sheet holds at most {most:,} rows below its headings, not {count:,.15g}",
            most=MOST_ROWS,
            count=count,
        )
        return None, [Fault(message, file, key="rows")]
    return int(count), []


def _changed(sweep: _Sweep, rows: int | None, step: str | None) -> dict[str, str]:
    """Keys of [driver] and what they become, as TOML; none, and faults are reported, where that makes no sweep."""
    start, stop = (sweep.data.get(key, BAD) for key in ("start", "stop"))
    first, last = sweep.value(start), sweep.value(stop)
    report = sweep.scope.report
    if step is None:
        assert rows is not None
        if first == last:
            message = say("start and stop are the same: no step makes {rows} rows", rows=rows)
            report.faults.append(Fault(message, report.source.file, key="rows"))
            return {}
        return {} if math.isnan(last - first) else {"step": _step(sweep, start, stop, rows)}
    by = sweep.unit.to_internal(float(step))
    if rows is not None:
        last = first + (rows - 1) * by
    check_sweep(first, last, by, {"start": start, "stop": stop, "step": float(step)}, sweep.scope)
    if report.faults:
        return {}
    if rows is None or math.isnan(first):
        return {"step": step}
    return {"step": step, "stop": _stop(sweep, start, float(step), rows)}


def _step(sweep: _Sweep, start: Any, stop: Any, rows: int) -> str:
    """The step that leads from start to stop in so many rows."""
    if isinstance(start, str) or isinstance(stop, str):
        way = (
            _grouped(stop, sweep.unit) if start == 0 else f"({_term(stop, sweep.unit)} - {_grouped(start, sweep.unit)})"
        )
        return f'"{way} / {rows - 1}"'
    step = (stop - start) / (rows - 1)
    short = _short(step)
    lands = abs(start + (rows - 1) * short - stop) <= 2 * math.ulp(max(abs(start), abs(stop)))
    return number_text(short if lands else step)


def _stop(sweep: _Sweep, start: Any, step: float, rows: int) -> str:
    """The value of the last row."""
    way = (rows - 1) * step
    if isinstance(start, str):
        sign = "-" if way < 0 else "+"
        return f'"{_term(start, sweep.unit)} {sign} {_term(abs(_short(way)), sweep.unit)}"'
    stop = start + way
    short = _short(stop)
    return number_text(short if abs((short - start) / step - (rows - 1)) < LANDS else stop)


def _short(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


def _term(value: Any, unit: Unit) -> str:
    """A number or expression as it stands in an expression, where angles are radians."""
    if isinstance(value, str):
        return " ".join(value.split())
    return f"radians({number_text(value)})" if unit == DEG else number_text(value)


def _grouped(value: Any, unit: Unit) -> str:
    """The same as an operand of - or /."""
    term = _term(value, unit)
    return term if term.isidentifier() or not isinstance(value, str) else f"({term})"
