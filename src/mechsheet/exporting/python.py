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
from mechsheet.exporting.program import WIDTH, Program, commented, heading, one_line, program_of, with_numbers
from mechsheet.kinematics.equations import Equation
from mechsheet.model import TIME

RESERVED = (
    *keyword.kwlist, *keyword.softkwlist, *dir(builtins), "np", "csv", "sys", "solve", "main", "n", "rows", "exists",
    "start", "stop", "step", "warnings", "home", "own_", "share_", "x_", "annotations", "ArrayLike", "NDArray",
    "Array", "UNITS",
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
    step: Callable[..., tuple[Array, float, float]], way: Callable[..., tuple[ArrayLike, ...]], start: ArrayLike,
    there: tuple[ArrayLike, ...], given: tuple[ArrayLike, ...], home: int, passes: int, rows: int, scales: ArrayLike,
) -> Array:
    """Newton's method row by row, each from the row before that has a position: the unknowns, NaN where none is found.

    `step` gives J^-1 F, the residual and det J; the determinant's other sign is another assembly. `start` fits row `home` of
    the described dimensions: from these it goes in equal steps, a pass each, to those that are there; `way` says what the
    step is given then. A warning says where the assembly ends on that way (the determinant changes its sign, an unknown, as
    a part of its scale, leaves its trend, the residual leaps), and which rows may be of another.
    """
    shares = np.minimum(np.arange(@@FIRST@@ + 1) / @@LED@@, 1.0)
    ends = [np.broadcast_to(np.asarray(part, float), (rows,))[home] for part in there]
    lead = [np.broadcast_to(np.asarray(part, float), shares.shape) for part in way(shares, *ends)]
    x, path, residuals, determinants = np.array(start, float), [], [], []
    for place in range(len(shares)):
        correction, residual, determinant = step(x, *(column[place] for column in lead))
        path.append(x)
        residuals.append(residual)
        determinants.append(determinant)
        x = np.where(np.all(np.isfinite(correction)), x - correction, x)
    found = np.full((np.size(start), rows), np.nan)
    last, begun = path[-1], bool(residuals[-1] <= @@CLOSED@@)
    leaps = np.abs(np.diff(path, 2, axis=0)) < @@TREND@@ * np.asarray(scales)
    steady = np.array(residuals[2:]) < max(@@STEADY@@ * residuals[1], @@SETTLED@@)
    if not (np.all(np.array(determinants) * determinants[0] > 0) and np.all(leaps) and np.all(steady)):
        what = "perhaps these positions are of another" if begun else "no position was found"
        text = f"on the way from the described values to these the assembly described ends: {what}"
        warnings.warn(text, stacklevel=3)
    if not begun:
        return found
    sign = determinants[-1]
    columns = [np.broadcast_to(np.asarray(part, float), (rows,)) for part in given]
    for row in range(rows):
        here = [column[row] for column in columns]
        x = last
        for _ in range(passes):
            x = x - step(x, *here)[0]
        _, residual, determinant = step(x, *here)
        if residual <= @@CLOSED@@ and determinant * sign > 0:
            found[:, row] = last = x
    here, before, earlier = found[:, 1:], found[:, :-1], np.hstack([found[:, :1] * np.nan, found[:, :-2]])
    there, told = np.isfinite(here[0]), np.isfinite(before[0])
    bent = np.abs(np.where(np.isfinite(earlier), here - 2 * before + earlier, here - before))
    leapt = told & np.any(bent > np.radians(@@LEAP@@) * np.reshape(scales, (-1, 1)), axis=0)
    behind = ~told & np.logical_or.accumulate(told)
    count = int(np.sum(there & (leapt | behind)))
    if count:
        warnings.warn(f"{count} rows may be of another assembly: behind others without a position, or a leap", stacklevel=3)
    return found


'''


def write(job: Job) -> list[bytes]:
    """The module in UTF-8."""
    if job.name in {*sys.stdlib_module_names, *keyword.kwlist, "numpy"}:
        fault = say('"{name}" is a module or a word of Python: nobody could import this one', name=job.name)
        raise MechsheetError(Fault(fault, key="output", hint=say("for example {name}_mechanism.py", name=job.name)))
    program = program_of(job.compiled, RESERVED)
    lines = [*_opening(program, job.name), *_tables(program), *_solve(program)]
    loops = any(column.loop for column in program.columns)
    return [("\n".join(lines) + _HELPERS.replace("@@FOLLOWED@@", with_numbers(_FOLLOWED) if loops else "")).encode()]


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
