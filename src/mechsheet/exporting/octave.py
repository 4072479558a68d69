"""octave: a function file for GNU Octave and MATLAB: arrays over the sweep, the animated drawing, the curves.

A function file, because only in one do helper functions mean the same in both programs. What is drawn is the list of shapes;
the curves are the workbook's.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import Node
from livesheet.formula.vectors import Vector, minus, plus
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError
from mechsheet.exporting.job import Job
from mechsheet.exporting.lowering import Loop, Step
from mechsheet.exporting.program import Program, brought, commented, heading, one_line, program_of
from mechsheet.kinematics.equations import Equation, System
from mechsheet.model import TIME, ChartRequest
from mechsheet.shapes.forms import ARROWS, HALF, LEAST, Extreme, Mark, Shape
from mechsheet.shapes.listing import shapes_of
from mechsheet.sheet.drawing.charts import chart_requests
from mechsheet.sheet.planning import plan_of

_TAKEN = """
    break case catch continue do else elseif end endfunction endif endwhile for function global if methods otherwise
    persistent properties return switch try until unwind_protect while
    ans result varargin nargout rows n exists start stop step around motion h middle shapes paths pins dots home
    share_ there_ x_ row_
    NaN abs acos and any asin atan cos cumsum error exp find floor isfinite max min nan not numel or ones pi repmat sign sin
    struct tan true
"""
"""Keywords, and what the function itself calls."""


def write(job: Job) -> list[bytes]:
    """The file in UTF-8. Raises MechsheetError where its name is that of a function which the file itself calls."""
    helpers = brought("octave.m")
    if job.name in {*_called(helpers), *_TAKEN.split()}:
        fault = say(
            '"{name}" is called by the file itself: a function of that name would stand in its way', name=job.name
        )
        raise MechsheetError(Fault(fault, key="output", hint=say("for example {name}_mechanism.m", name=job.name)))
    reserved = {*re.findall(r"^function (?:\w+ = )?(\w+)", helpers, re.MULTILINE), *_TAKEN.split(), job.name}
    program = program_of(job.compiled, reserved)
    lines = [*_opening(program, job.name), *_given(program), *_driver(program), *_columns(program), *_result(program)]
    loops = [
        line
        for column in program.columns
        if column.loop
        for line in (*_pass(program, column, column.loop.system), *_way(program, column, column.loop))
    ]
    lines += [
        "",
        "  if nargout == 0",
        *(f"    {line}" for line in _without_result(program, job.name)),
        "    clear result",
        "  end",
    ]
    return [("\n".join([*lines, "end", *loops, ""]) + helpers).encode()]


def _called(code: str) -> list[str]:
    """Words that are called, with parentheses or at the beginning of a line; comments and strings left out."""
    plain = re.sub(r"%.*|'[^'\n]*'", "", code)
    return re.findall(r"\b([A-Za-z]\w+)\(", plain) + re.findall(r"^ *([A-Za-z]\w+)", plain, re.MULTILINE)


_CALLS = {"CONTINUOUS": "continuous({0})", "TRIANGLE": "triangle({0}, {1}, {2})"}


def _text(program: Program, node: Node) -> str:
    return program.print(node, "octave", _CALLS)


def _string(text: str) -> str:
    return "'" + one_line(text).replace("'", "''") + "'"


# --- the equations -----------------------------------------------------------------------------------------------


def _opening(program: Program, name: str) -> list[str]:
    mechanism = program.mechanism
    title, source = (one_line(words.of(mechanism.language)) for words in (mechanism.title, mechanism.source))
    first = program.names[program.given[0].symbol] if program.given else program.names[mechanism.driver.symbol]
    unit = one_line(mechanism.length_unit)
    return [
        f"function result = {name}(varargin)",
        f"% {name.upper()}  {title}",
        "%",
        *([f"% Source: {source}", "%"] if source else []),
        f"%   {name}              numbers, the moving mechanism, its curves; pictures in files where there is no display",
        f"%   r = {name};         arrays over the sweep: r.{program.names[program.shown[1]]} ...",
        f"%   r = {name}('{first}', 40)   with another value; all names stand below",
        "%",
        f"% Lengths are in {unit}, angles in radians. NaN where the links cannot be joined. Angles are continuous from",
        "% row to row. Runs in GNU Octave and in MATLAB.",
        "",
    ]


def _given(program: Program) -> list[str]:
    names = program.names
    changeable = [names[line.symbol] for line in (*program.given, *program.modes)]
    changeable += [names[symbol] for symbol in program.asked_by_row]
    lines = [f"  check_names(varargin, {{{', '.join(_string(name) for name in changeable)}}});", "", "  % dimensions"]
    for line in program.given:
        lines += _argument(program, line)
    if program.modes:
        lines += ["", "  % assembly modes"]
    for line in program.modes:
        lines += _argument(program, line)
    lines += ["", "  % what follows from them"]
    for line in program.derived:
        lines += _line(program, line, _words(program, line))
    return lines


def _words(program: Program, line: Step) -> str:
    return ", ".join(part for part in (one_line(program.unit(line)), program.words(line)) if part)


def _argument(program: Program, line: Step) -> list[str]:
    name = program.names[line.symbol]
    return commented(
        f"  {name} = given(varargin, '{name}', {_text(program, line.expression)});", _words(program, line), "%"
    )


def _driver(program: Program) -> list[str]:
    name = program.names[program.mechanism.driver.symbol]
    if program.law is not None:
        time, duration = program.names[TIME], program.names[program.law.duration]
        lines = [
            f"  {time} = given(varargin, '{time}', (0:{program.law.rows - 1}) .* {duration} ./ {program.law.rows - 1});",
            f"  {time} = {time}(:);",
            f"  rows = numel({time});",
            f"  {name} = {_text(program, program.law.value)};",
        ]
        return ["", "  % driver", *lines]
    if program.sweep:
        start, stop, step = (_text(program, part) for part in program.sweep)
        lines = [f"  start = {start};", f"  stop = {stop};", f"  step = {step};"]
        values = "start + step .* (0:floor((stop - start) ./ step + 1e-9))"
    else:
        lines, values = [], f"[{', '.join(_text(program, value) for value in program.values)}]"
    lines += [f"  {name} = given(varargin, '{name}', {values});", f"  {name} = {name}(:);", f"  rows = numel({name});"]
    for symbol, numbers in program.listed.items():
        own = program.names[symbol]
        listed = ", ".join(_text(program, number) for number in numbers)
        lines += [f"  {own} = given(varargin, '{own}', [{listed}]);", f"  {own} = {own}(:) .* ones(rows, 1);"]
    return ["", "  % driver", *lines]


def _columns(program: Program) -> list[str]:
    lines: list[str] = []
    group = 0
    for column in program.columns:
        if column.group != group:
            group = column.group
            lines += ["", f"  % {heading(program, group)}"]
        lines += _line(program, column) if column.loop is None else _loop(program, column, column.loop)
    return lines


def _line(program: Program, line: Step | Equation, words: str | None = None) -> list[str]:
    text = _text(program, line.expression)
    if isinstance(line, Step) and line.still:
        text = f"repmat({text}, rows, 1)"
    return commented(f"  {program.names[line.symbol]} = {text};", program.words(line) if words is None else words, "%")


def _loop(program: Program, column: Step, loop: Loop) -> list[str]:
    """The unknowns of a system, row by row."""
    names, system, number = program.names, loop.system, column.group
    given, there = (
        ", ".join(f"{names[name]} .* ones(rows, 1)" for name in part) for part in (system.given, loop.there)
    )
    starts = "; ".join(" ".join(repr(x) for x in start) for start in system.starts)
    scales = "; ".join(repr(x) for x in loop.scales)
    return [
        f"  starts_{number} = [{starts}];",
        f"  home = min({system.row + 1}, rows);",
        f"  if is_given(varargin, '{names[program.asked_by_row[0]]}')",
        f"    [~, home] = min(abs({names[system.driver]} - ({system.home!r})));",
        "  end",
        f"  there_ = [{there}];",
        f"  found_{number} = followed(@newton_pass_{number}, @newton_way_{number}, ...",
        f"    starts_{number}({names[system.mode]}, :)', there_(home, :), [{given}], {system.passes}, [{scales}]);",
        *(f"  {names[name]} = found_{number}(:, {index});" for index, name in enumerate(system.unknowns, 1)),
    ]


def _way(program: Program, column: Step, loop: Loop) -> list[str]:
    """A function for what a pass is given, on the way from the described values to those that are there."""
    names = program.names
    lines = ["", f"function given_ = newton_way_{column.group}(share_, there_)"]
    lines += ["% What a pass is given, at these shares of the way from the described values."]
    for index, (symbol, value) in enumerate(loop.described, 1):
        lines.append(f"  {names[symbol]} = {value!r} + share_ .* (there_({index}) - ({value!r}));")
    lines += [f"  {names[name]} = there_({at});" for at, name in enumerate(loop.besides, len(loop.described) + 1)]
    lines += [text for line in loop.way for text in _line(program, line)]
    given = ", ".join(f"{names[name]} .* ones(numel(share_), 1)" for name in loop.system.given)
    return [*lines, f"  given_ = [{given}];", "end"]


def _pass(program: Program, column: Step, system: System) -> list[str]:
    """A function for one pass."""
    names = program.names
    lines = ["", f"function [correction, residual_, determinant] = newton_pass_{column.group}(x_, row_)"]
    lines += ["% J^-1 F, the residual and det J."]
    lines += [f"  {names[name]} = x_({index});" for index, name in enumerate(system.unknowns, 1)]
    lines += [f"  {names[name]} = row_({index});" for index, name in enumerate(system.given, 1)]
    lines += [text for part in system.body for text in _line(program, part)]
    corrections = "; ".join(_text(program, part) for part in system.corrections)
    return [
        *lines,
        f"  correction = [{corrections}];",
        f"  residual_ = {names[system.residual]};",
        f"  determinant = {names[system.determinant]};",
        "end",
    ]


def _result(program: Program) -> list[str]:
    given = [program.names[symbol] for symbol in program.given_by_row]
    kept = [program.names[symbol] for symbol in program.shown[len(given) :]]
    lines = ["", f"  exists = {_text(program, program.exists)} & true(rows, 1);", "  result = struct();"]
    lines += [f"  result.{name} = {name};" for name in given]
    return lines + [f"  result.{name} = kept({name}, exists);" for name in kept]


# --- the picture -------------------------------------------------------------------------------------------------


def _without_result(program: Program, name: str) -> list[str]:
    """What is shown where nobody takes the result: the numbers first, then pictures where any can be made."""
    return [
        "if ~any(exists)", "  error('no position of the sweep exists');", "end",
        "list_numbers(result);",
        "if can_draw()",
        *(f"  {line}" for line in _picture(program, name)),
        "end",
    ]  # fmt: skip


def _picture(program: Program, name: str) -> list[str]:
    mechanism = program.mechanism
    found = shapes_of(mechanism, program.equations)
    known = {extreme.symbol: f"motion({number})" for number, extreme in enumerate(found.extremes, 1)}
    drawn = replace(program, names=program.names | known | {HALF.name: "h"})
    around = [end((x, y), (radius, radius)) for (x, y), radius in found.around for end in (plus, minus)]
    traced = [shape.corners[0] for shape in found.shapes if isinstance(shape, Shape) and shape.kind == "path"]
    marks = {
        kind: [mark.at for mark in found.shapes if mark.kind == kind and isinstance(mark, Mark)] for kind in _MARKS
    }
    arrows = any(shape.kind in ARROWS for shape in found.shapes)
    title = _string(mechanism.title.of(mechanism.language))
    lines = [
        *_tracks(drawn, "around", list(dict.fromkeys(around))),
        f"h = half_window(around, {ROOMY if arrows else ROOM:g});",
        "middle = [(min(around.x(:)) + max(around.x(:))) / 2, (min(around.y(:)) + max(around.y(:))) / 2];",
        f"motion = nan(1, {len(found.extremes)});",
        *(f"motion({number}) = {_extreme(drawn, extreme)};" for number, extreme in enumerate(found.extremes, 1)),
        "shapes = {};",
        *(
            line
            for shape in found.shapes
            if isinstance(shape, Shape) and shape.kind != "path" and (shape.path or shape.frame is None)
            for line in _shape(drawn, shape)
        ),
        *_tracks(drawn, "paths", traced),
        *(line for kind, places in marks.items() for line in _tracks(drawn, _MARKS[kind], places)),
        f"animate(shapes, paths, pins, dots, find(exists), middle, h, {title}, '{name}');",
    ]
    charts = (_computed(program, request) for request in chart_requests(plan_of(mechanism, program.equations)))
    for number, request in enumerate(filter(None, charts), 1):
        lines.append(_curves(program, request, number, name))
    return lines


def _computed(program: Program, request: ChartRequest) -> ChartRequest | None:
    """A chart without what the file does not compute, as the energy of a flywheel; None if nothing is left."""
    if not request.y:
        return request
    known = tuple(symbol for symbol in request.y if symbol in program.names)
    return replace(request, y=known) if known and request.x in program.names else None


_MARKS = {"pin": "pins", "point": "dots"}
ROOM, ROOMY = 0.65, 0.8
"""Half the side of the window, as a part of what is in it; where there are arrows."""


def _tracks(program: Program, name: str, places: Sequence[Vector]) -> list[str]:
    """Columns for places; of none one that is empty, since there is something to move."""
    if not places:
        return [f"{name} = struct('x', nan(rows, 1), 'y', nan(rows, 1));"]
    return [f"{name} = struct('x', {_track(program, places, 0)}, 'y', {_track(program, places, 1)});"]


def _track(program: Program, places: Sequence[Vector], axis: int) -> str:
    """A column for each place."""
    return _table(program, [place[axis] for place in places])


def _table(program: Program, nodes: Sequence[Node]) -> str:
    return f"track({', '.join(['rows', *(_text(program, node) for node in nodes)])})"


def _extreme(program: Program, extreme: Extreme) -> str:
    return f"over_motion('{extreme.take}', {_table(program, extreme.of)}, exists)"


def _color(color: str) -> str:
    return "[" + " ".join(f"{int(color[at : at + 2], 16) / 255:.3g}" for at in (0, 2, 4)) + "]"


def _shape(program: Program, shape: Shape) -> list[str]:
    """A shape: a path in a frame, or its corners; an arrow as long as it is large enough."""
    if shape.frame is not None:
        path = (f"[{' '.join(f'{part:.6g}' for part in parts)}]" for parts in zip(*shape.path, strict=True))
        nodes = (*shape.frame.origin, *shape.frame.along, *shape.frame.across)
        places = ", ".join([*path, *(_text(program, node) for node in nodes)])
        made = f"placed(rows, {places}"
    else:
        made = f"outlined({_track(program, shape.corners, 0)}, {_track(program, shape.corners, 1)}"
    line = f"{made}, {_color(shape.color)}, {shape.width:g}, {_string(shape.name)})"
    if shape.size is not None:
        line = f"large_enough({line}, {_text(program, shape.size)}, {LEAST:g})"
    lines = [f"shapes{{end + 1}} = {line};"]
    if shape.border:
        width = shape.width - 2 * shape.border
        lines.append(f"shapes{{end + 1}} = filled(shapes{{end}}, {_color(shape.fill)}, {width:g});")
    return lines


def _curves(program: Program, request: ChartRequest, number: int, name: str) -> str:
    """A chart of the workbook: curves against the driver, paths of points, hodographs, or the profile of a cam."""
    unit = one_line(program.mechanism.length_unit)
    drawn, place, title = request.paths, "{point}.{axis}", f"y [{unit}]"
    if request.profile:
        drawn = tuple(curve for curve in ("cam", "pitch") if f"{curve}.x" in program.shown)  # a face has no pitch curve
    elif request.hodographs:
        drawn, place, title = request.hodographs, "{point}.v{axis}", f"y of v [{unit}/s]"
    if drawn:
        x, y = (_read(program, [place.format(point=point, axis=axis) for point in drawn]) for axis in "xy")
        names, titles = drawn, ("x", title)
    else:
        x, y = _shown(program, request.x), _read(program, request.y)
        names = tuple(program.names[symbol] for symbol in request.y)
        titles = f"{program.names[request.x]} [{_unit(program, request.x)}]", f"[{_unit(program, request.y[0])}]"
    legend = ", ".join(map(_string, names))
    return f"curves({number}, {x}, {y}, {{{legend}}}, {', '.join(map(_string, titles))}, '{name}');"


def _read(program: Program, symbols: Sequence[str]) -> str:
    """A column for each variable, as people read it."""
    return f"track({', '.join(['rows', *(_shown(program, symbol) for symbol in symbols)])})"


def _shown(program: Program, symbol: str) -> str:
    """A variable as people read it."""
    text = f"result.{program.names[symbol]}" if symbol in program.shown else program.names[symbol]
    return f"{text} * 180 / pi" if program.unit_shown(symbol).in_degrees else text


def _unit(program: Program, symbol: str) -> str:
    return one_line(program.unit_shown(symbol).text)
