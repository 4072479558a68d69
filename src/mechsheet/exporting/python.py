"""python: a module that needs numpy and nothing else; `solve()` gives the arrays, running it prints a table."""

from __future__ import annotations

import builtins
import json
import keyword
import sys
from textwrap import dedent, wrap

from mechsheet.diagnostics import Fault, MechsheetError
from mechsheet.exporting.job import Job
from mechsheet.exporting.program import WIDTH, ColumnLine, Line, Program, commented, heading, one_line, program_of
from mechsheet.formula.nodes import Node
from mechsheet.kinematics.equations import System
from mechsheet.kinematics.newton.system import CLOSED, FIRST_PASSES
from mechsheet.model import TIME

RESERVED = (
    *keyword.kwlist, *keyword.softkwlist, *dir(builtins), "np", "csv", "sys", "solve", "main", "n", "rows", "exists",
    "start", "stop", "step", "annotations", "ArrayLike", "NDArray", "Array", "UNITS",
)  # fmt: skip

_HELPERS = '''
def _direction(x: ArrayLike, y: ArrayLike) -> Array:
    """Angle of the vector (x, y), x first as in a spreadsheet; NaN where it has no length."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    return np.where((x == 0) & (y == 0), np.nan, np.arctan2(y, x))


def _rounded(x: ArrayLike, digits: float) -> Array:
    """Half away from zero, as a spreadsheet rounds."""
    x, scale = np.asarray(x, float), 10.0**digits
    return np.asarray(np.sign(x) * np.floor(np.abs(x) * scale + 0.5) / scale)


def _continuous(angles: ArrayLike) -> Array:
    """The angles with whole turns added: none is more than half a turn from the one before; anew after NaN."""
    angles = np.array(angles, float)
    if angles.ndim == 0:  # the same in every row
        return angles
    edges = np.flatnonzero(np.diff(np.isfinite(angles), prepend=False, append=False))
    for first, end in edges.reshape(-1, 2):
        angles[first:end] = np.unwrap(angles[first:end])
    return angles


def _triangle(opposite: ArrayLike, beside: ArrayLike, other: ArrayLike) -> Array:
    """The angle of a triangle opposite the first side: the law of cosines, by Heron's area, which keeps its digits."""
    c, a, b = (np.asarray(side, float) for side in (opposite, beside, other))
    product = (a + b + c) * (a + b - c) * (c + a - b) * (c - a + b)
    return np.arctan2(np.sqrt(np.maximum(0, product)), a * a + b * b - c * c)


@@FOLLOWED@@def _kept(x: ArrayLike, exists: NDArray[np.bool_]) -> Array:
    """The finite values in rows that exist, NaN elsewhere."""
    whole = np.broadcast_to(np.asarray(x, float), exists.shape)
    return np.where(exists & np.isfinite(whole), whole, np.nan)


def main() -> None:
    """Print the variables over the sweep as CSV, angles in degrees."""
    found = solve()
    degrees = {symbol: unit == "rad" for symbol, unit in UNITS.items()}
    writer = csv.writer(sys.stdout, lineterminator="\\n")
    writer.writerow(f"{symbol} [{'deg' if degrees[symbol] else UNITS[symbol]}]" for symbol in found)
    for row in zip(*(np.degrees(x) if degrees[s] else x for s, x in found.items()), strict=True):
        writer.writerow("" if np.isnan(value) else repr(float(value)) for value in row)


if __name__ == "__main__":
    main()
'''


_FOLLOWED = '''def _followed(
    step: Callable[..., tuple[Array, float, float]], start: ArrayLike, given: tuple[ArrayLike, ...], home: int, passes: int,
    rows: int,
) -> Array:
    """Newton's method row by row, each from the row before that has a position: the unknowns, NaN where none is found.

    `step` gives J^-1 F, the residual and det J; the determinant's other sign is another assembly. `start` fits row `home`.
    """
    columns = [np.broadcast_to(np.asarray(part, float), (rows,)) for part in given]

    def arrived(x: Array, row: int, count: int) -> tuple[Array, float] | None:
        here = [column[row] for column in columns]
        for _ in range(count):
            x = x - step(x, *here)[0]
        _, residual, determinant = step(x, *here)
        return (x, determinant) if residual <= @@CLOSED@@ else None

    found = np.full((np.size(start), rows), np.nan)
    first = arrived(np.array(start, float), home, @@FIRST@@)
    if first is not None:
        last, sign = first
        for row in range(rows):
            here = arrived(last, row, passes)
            if here is not None and here[1] * sign > 0:
                found[:, row] = last = here[0]
    return found


'''.replace("@@CLOSED@@", repr(CLOSED)).replace("@@FIRST@@", str(FIRST_PASSES))


def write(job: Job) -> list[bytes]:
    """The module in UTF-8."""
    if job.name in {*sys.stdlib_module_names, *keyword.kwlist, "numpy"}:
        fault = f'"{job.name}" is a module or a word of Python: nobody could import this one'
        raise MechsheetError(Fault(fault, key="output", hint=f"for example {job.name}_mechanism.py"))
    program = program_of(job.compiled, RESERVED)
    lines = [*_opening(program, job.name), *_tables(program), *_solve(program)]
    loops = any(column.loop for column in program.columns)
    return [("\n".join(lines) + _HELPERS.replace("@@FOLLOWED@@", _FOLLOWED if loops else "")).encode()]


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
        @@CALLABLE@@
        import numpy as np
        from numpy.typing import ArrayLike, NDArray

        Array = NDArray[np.float64]
        """
    loops = any(column.loop for column in program.columns)
    callables = "from collections.abc import Callable\n" if loops else ""
    return [*body, *dedent(imports).replace("@@CALLABLE@@\n", f"{callables}\n").splitlines(), ""]


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
        body += _column(program, column)
    body += [f"        exists = np.broadcast_to({_text(program, program.exists)}, {driver}.shape)"]
    body += ["        return {"]
    given_rows = program.given_by_row
    body += [f"            {_string(symbol)}: {program.names[symbol]}," for symbol in given_rows]
    kept = program.shown[len(given_rows) :]
    body += [f"            {_string(symbol)}: _kept({program.names[symbol]}, exists)," for symbol in kept]
    return [*_signature(program), *body, "        }", ""]


def _loop(program: Program, column: ColumnLine, system: System) -> list[str]:
    """The unknowns of a system, by a function of its own for one pass."""
    names = program.names
    unknowns, given = (", ".join(names[name] for name in part) for part in (system.unknowns, system.given))
    step = f"step_{column.group}"
    tail = "," if len(system.unknowns) == 1 else ""
    typed = ", ".join(f"{names[name]}: float" for name in system.given)
    lines = [
        "",
        f"        def {step}(",
        *_paragraph(f"x_: Array, {typed},", " " * 12),
        "        ) -> tuple[Array, float, float]:",
    ]
    lines += [f"            {unknowns}{tail} = x_"]
    for part in system.body:
        words = one_line(part.label.of(program.mechanism.language))
        lines += commented(f"            {names[part.symbol]} = {_text(program, part.expression)}", words, "#")
    corrections = [_text(program, part) for part in system.corrections]
    lines += [
        "            return (",
        f"                np.array([{', '.join(corrections)}]),",
        f"                {names[system.residual]}, {names[system.determinant]},",
        "            )",
        "",
        f"        starts_{column.group} = (",
        *(f"            ({', '.join(repr(x) for x in start)}{tail})," for start in system.starts),
        "        )",
        f"        home = int(np.argmin(np.abs({names[system.driver]} - {system.home!r})))",
        f"        {unknowns}{tail} = _followed(",
        f"            {step}, starts_{column.group}[int({names[system.mode]}) - 1], ({given},), home, {system.passes}, rows",
        "        )",
    ]
    return lines


def _signature(program: Program) -> list[str]:
    names = [program.names[symbol] for symbol in program.asked_by_row]
    head = ["", "def solve(", *(f"    {name}: ArrayLike | None = None," for name in names), "    *,"]
    whose = "driver's values" if program.law is None else "time in seconds"
    texts = ["", f"    {names[0]}: the {whose}, one per row; by default the description's sweep"]
    texts += [f"    {name}: one per row; by default as the description lists them" for name in names[1:]]
    for line in program.given:
        head.append(f"    {program.names[line.symbol]}: float = {_text(program, line.node)},")
        texts += _argument(program, line)
    for line in program.modes:
        head.append(f"    {program.names[line.symbol]}: float = {_text(program, line.node)},")
        texts += _argument(program, line)
    doc = ['    """Positions of all links in every row: {symbol: array}, units in `UNITS`.', *texts, '    """']
    return [*head, ") -> dict[str, Array]:", *doc]


def _argument(program: Program, line: Line) -> list[str]:
    unit = f" [{line.unit}]" if line.unit else ""
    text = _quoted(
        f"{program.names[line.symbol]}{unit}: {line.words}" if line.words else program.names[line.symbol] + unit
    )
    return _paragraph(text, " " * 4)


def _line(program: Program, line: Line) -> list[str]:
    return commented(f"        {program.names[line.symbol]} = {_text(program, line.node)}", line.words, "#")


def _driver(program: Program, driver: str) -> list[str]:
    """The driver's values: given, or the description's; these may be made of dimensions."""
    if program.law is not None:
        time, duration, last = program.names[TIME], program.names[program.law.duration], program.law.rows - 1
        return [
            f"        if {time} is None:",
            f"            {time} = np.arange({last + 1}) * {duration} / {last}",
            f"        {time} = np.atleast_1d(np.asarray({time}, float))",
            f"        {driver} = {_text(program, program.law.value)}",
        ]
    lines = [f"        if {driver} is None:"]
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


def _column(program: Program, column: ColumnLine) -> list[str]:
    if column.loop is not None:
        return _loop(program, column, column.loop)
    text = _text(program, column.node)
    if column.still:
        text = f"np.full(rows, {text})"
    return commented(f"        {program.names[column.symbol]} = {text}", column.words, "#")
