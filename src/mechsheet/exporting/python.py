"""python: a module that needs numpy and nothing else; `solve()` gives the arrays, running it prints a table."""

from __future__ import annotations

import builtins
import json
import keyword
import sys
from collections.abc import Iterable
from textwrap import dedent, wrap

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import Node
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError
from mechsheet.exporting.job import Job
from mechsheet.exporting.lowering import Loop, Step
from mechsheet.exporting.program import WIDTH, Program, brought, commented, heading, one_line, program_of
from mechsheet.kinematics.equations import Equation
from mechsheet.model import TIME

RESERVED = (
    *keyword.kwlist, *keyword.softkwlist, *dir(builtins), "np", "csv", "sys", "solve", "main", "n", "rows", "exists",
    "start", "stop", "step", "warnings", "home", "own_", "share_", "x_", "annotations", "ArrayLike", "NDArray",
    "Array", "UNITS",
)  # fmt: skip


def write(job: Job) -> list[bytes]:
    """The module in UTF-8."""
    if job.name in {*sys.stdlib_module_names, *keyword.kwlist, "numpy"}:
        fault = say('"{name}" is a module or a word of Python: nobody could import this one', name=job.name)
        raise MechsheetError(Fault(fault, key="output", hint=say("for example {name}_mechanism.py", name=job.name)))
    program = program_of(job.compiled, RESERVED)
    lines = [*_opening(program, job.name), *_tables(program), *_solve(program)]
    loops = any(column.loop for column in program.columns)
    helpers = brought("python.txt").replace("@@FOLLOWED@@", brought("python_newton.txt") if loops else "")
    return [("\n".join(lines) + helpers).encode()]


_CALLS = {"CONTINUOUS": "_continuous({0})", "TRIANGLE": "_triangle({0}, {1}, {2})"}


def _text(program: Program, node: Node) -> str:
    return program.print(node, "python", _CALLS)


def _quoted(text: str) -> str:
    """A text of the description inside a docstring."""
    return one_line(text).replace("\\", "\\\\").replace('"', "'")


def _string(text: str) -> str:
    """A string in double quotes; JSON's escapes are Python's."""
    return json.dumps(text, ensure_ascii=False)


def _paragraph(text: str, indent: str = "") -> list[str]:
    return wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent, break_long_words=False)


def _opening(program: Program, name: str) -> list[str]:
    mechanism = program.mechanism
    title, source = (_quoted(words.of(mechanism.language)) for words in (mechanism.title, mechanism.source))
    body = [
        f'"""{title}: positions over a sweep of {program.names[mechanism.driver.symbol]}.',
        "",
        *([*_paragraph(f"Source: {source}"), ""] if source else []),
        *_paragraph(
            f"Lengths are in {_quoted(mechanism.length_unit)}, angles in radians. Each array has one entry per row of the "
            "sweep, NaN where the links cannot be joined. Angles are continuous from row to row. Needs numpy only."
        ),
        "",
        f"    import {name}",
        f'    found = {name}.solve()["{program.shown[1]}"]',
        '"""',
    ]
    imports = """
        from __future__ import annotations

        import csv
        import sys
        @@WARNINGS@@
        @@CALLABLE@@
        import numpy as np
        from numpy.typing import ArrayLike, NDArray

        Array = NDArray[np.float64]
        """
    loops = any(column.loop for column in program.columns)
    for mark, line in (("WARNINGS", "import warnings\n"), ("CALLABLE", "from collections.abc import Callable\n\n")):
        imports = dedent(imports).replace(f"@@{mark}@@\n", line if loops else "\n" * (mark == "CALLABLE"))
    return [*body, *imports.splitlines(), ""]


def _tables(program: Program) -> list[str]:
    units = [f"    {_string(symbol)}: {_string(one_line(program.unit_of(symbol)))}," for symbol in program.shown]
    return ["UNITS = {", *units, "}", '"""Unit of each array that `solve` returns."""', ""]


def _solve(program: Program) -> list[str]:
    driver = program.names[program.mechanism.driver.symbol]
    body = ['    with np.errstate(all="ignore"):']
    given = ", ".join(program.names[line.symbol] for line in (*program.given, *program.modes))
    body += [f"        ({given},) = np.array(({given},), float)"] if given else []
    body += [text for line in program.derived for text in _line(program, line)]
    body += _driver(program, driver)
    body += [f"        rows = len({driver})"]
    group: int | None = None
    for column in program.columns:
        if column.group != group:
            group = column.group
            body += [f"        # {heading(program, group)}"]
        body += _line(program, column) if column.loop is None else _loop(program, column, column.loop)
    body += [f"        exists = np.broadcast_to({_text(program, program.exists)}, {driver}.shape)"]
    body += ["        return {"]
    given_rows = program.given_by_row
    body += [f"            {_string(symbol)}: {program.names[symbol]}," for symbol in given_rows]
    kept = program.shown[len(given_rows) :]
    body += [f"            {_string(symbol)}: _kept({program.names[symbol]}, exists)," for symbol in kept]
    return [*_signature(program), *body, "        }", ""]


def _loop(program: Program, column: Step, loop: Loop) -> list[str]:
    """The unknowns of a system, by a function of its own for one pass."""
    names, system = program.names, loop.system
    unknowns, given = (", ".join(names[name] for name in part) for part in (system.unknowns, system.given))
    step, way = f"step_{column.group}", f"way_{column.group}"
    tail = "," if len(system.unknowns) == 1 else ""
    lines = [
        "",
        f"        def {step}(",
        *_typed("x_: Array", (f"{names[name]}: float" for name in system.given)),
        "        ) -> tuple[Array, float, float]:",
    ]
    lines += [f"            {unknowns}{tail} = x_"]
    lines += [text for part in system.body for text in _line(program, part, 12)]
    corrections = [_text(program, part) for part in system.corrections]
    there = _paragraph(", ".join(names[name] for name in loop.there) + ",", " " * 16)
    first = f"np.argmin(np.abs({names[system.driver]} - {system.home!r}))"
    lines += [
        "            return (",
        f"                np.array([{', '.join(corrections)}]),",
        f"                {names[system.residual]}, {names[system.determinant]},",
        "            )",
        "",
        *_way(program, way, loop),
        "",
        f"        starts_{column.group} = (",
        *(f"            ({', '.join(repr(x) for x in start)}{tail})," for start in system.starts),
        "        )",
        f"        home = min({system.row}, rows - 1) if own_ else int({first})",
        f"        {unknowns}{tail} = _followed(",
        f"            {step}, {way}, starts_{column.group}[int({names[system.mode]}) - 1],",
        *([f"            ({there[0].strip()}),"] if len(there) == 1 else ["            (", *there, "            ),"]),
        f"            ({given},), home, {system.passes}, rows,",
        f"            ({', '.join(repr(x) for x in loop.scales)}{tail}),",
        "        )",
    ]
    return lines


def _typed(first: str, others: Iterable[str]) -> list[str]:
    """Parameters with their types, which are not parted from them."""
    text = "".join(f"{part.replace(' ', '~')}, " for part in (first, *others)).rstrip()
    return [line.replace("~", " ") for line in _paragraph(text, " " * 12)]


def _way(program: Program, name: str, loop: Loop) -> list[str]:
    """What a pass is given, on the way from the described values to those that are there."""
    names = program.names
    lines = [
        f"        def {name}(",
        *_typed("share_: Array", (f"{names[symbol]}: ArrayLike" for symbol in loop.there)),
        "        ) -> tuple[ArrayLike, ...]:",
    ]
    for symbol, value in loop.described:
        lines.append(f"            {names[symbol]} = {value!r} + share_ * ({names[symbol]} - {value!r})")
    lines += [text for line in loop.way for text in _line(program, line, 12)]
    return [*lines, f"            return ({', '.join(names[symbol] for symbol in loop.system.given)},)"]


def _signature(program: Program) -> list[str]:
    names = [program.names[symbol] for symbol in program.asked_by_row]
    head = ["", "def solve(", *(f"    {name}: ArrayLike | None = None," for name in names)]
    head += ["    *,"] if program.given or program.modes else []  # Python wants something behind it
    whose = "driver's values" if program.law is None else "time in seconds"
    texts = ["", f"    {names[0]}: the {whose}, one per row; by default the description's sweep"]
    texts += [f"    {name}: one per row; by default as the description lists them" for name in names[1:]]
    for line in (*program.given, *program.modes):
        head.append(f"    {program.names[line.symbol]}: float = {_text(program, line.expression)},")
        texts += _argument(program, line)
    doc = ['    """Positions of all links in every row: {symbol: array}, units in `UNITS`.', *texts, '    """']
    return [*head, ") -> dict[str, Array]:", *doc]


def _argument(program: Program, line: Step) -> list[str]:
    unit, words = program.unit(line), program.words(line)
    text = f"{program.names[line.symbol]} [{unit}]" if unit else program.names[line.symbol]
    return _paragraph(_quoted(f"{text}: {words}" if words else text), " " * 4)


def _line(program: Program, line: Step | Equation, indent: int = 8) -> list[str]:
    text = _text(program, line.expression)
    if isinstance(line, Step) and line.still:
        text = f"np.full(rows, {text})"
    return commented(f"{' ' * indent}{program.names[line.symbol]} = {text}", program.words(line), "#")


def _driver(program: Program, driver: str) -> list[str]:
    """The driver's values: given, or the description's; these may be made of dimensions."""
    if program.law is not None:
        time, duration, last = program.names[TIME], program.names[program.law.duration], program.law.rows - 1
        return [
            *_own(program, time),
            f"        if {time} is None:",
            f"            {time} = np.arange({last + 1}) * {duration} / {last}",
            f"        {time} = np.atleast_1d(np.asarray({time}, float))",
            f"        {driver} = {_text(program, program.law.value)}",
        ]
    lines = [*_own(program, driver), f"        if {driver} is None:"]
    if program.sweep:
        start, stop, step = (_text(program, part) for part in program.sweep)
        lines += [
            f"            start, stop, step = {start}, {stop}, {step}",
            f"            {driver} = start + step * np.arange(np.floor((stop - start) / step + 1e-9) + 1)",
        ]
    else:
        lines += [f"            {driver} = ({', '.join(_text(program, value) for value in program.values)},)"]
    lines.append(f"        {driver} = np.atleast_1d(np.asarray({driver}, float))")
    for symbol, values in program.listed.items():
        name = program.names[symbol]
        lines.append(f"        if {name} is None:")
        lines.append(f"            {name} = ({', '.join(_text(program, value) for value in values)},)")
        lines.append(f"        {name} = np.asarray({name}, float) + 0 * {driver}")
    return lines


def _own(program: Program, name: str) -> list[str]:
    """Whether the rows are the description's: asked where a loop begins in one of them."""
    return [f"        own_ = {name} is None"] if any(column.loop for column in program.columns) else []
