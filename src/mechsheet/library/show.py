"""What was understood, as text and data: groups, equations, cells, variables, dimensions with their exact values."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_name
from livesheet.said import say
from livesheet.workbook import Workbook
from mechsheet.compiled import Compiled, compiled_of, further_of, motion_of
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.equations import FORCES, RATES, Equations, Group
from mechsheet.kinematics.graph import graph_of
from mechsheet.kinematics.mobility import mobility
from mechsheet.kinematics.points_in_link import number
from mechsheet.library.building import told
from mechsheet.library.verdicts import DOUBTS, verdict
from mechsheet.model import TIME, Dimension, Mechanism, Output, Rack, Relation, Summary, energy_unit, inertia_unit
from mechsheet.sheet.columns.lowering import Assignment, Assignments, lowered
from mechsheet.sheet.plan import MEANING, Plan
from mechsheet.sheet.shown import unit_of_column
from mechsheet.synthesis.writing import says
from mechsheet.units import NUMBER, behind_number, unit_of
from mechsheet.words.catalogue import ENGLISH, LANGUAGES, text_in, words


def overview_text(mechanism: Mechanism) -> str:
    """Links, mobility, groups with their modes, what the sketch left open, and what the first sheet says of it all."""
    compiled = told(mechanism)
    equations, degrees = compiled.equations, mobility(graph_of(mechanism))
    lines = [
        mechanism.title.of(mechanism.language),
        say("links: {names}", names=", ".join(f"{link.number} {link.name}" for link in mechanism.links)),
        say("mobility {count}, driver {symbols}", count=degrees, symbols=_all(mechanism.driven_symbols)),
    ]
    lines += [_tie(mechanism, relation) for relation in mechanism.relations]
    lines += [
        say("redundant: {link}, left out of the solution; {length} is how long it would have to be",
            link=each.link.name, length=each.symbol)
        for each in mechanism.redundant
    ]  # fmt: skip
    for group in equations.groups:
        lines += _group(group)
    lines += _columns(equations)
    if equations.shown_forces and _stands(mechanism):
        lines.append(say("speed 0: static forces"))
    if (wheel := compiled.flywheel) is not None and mechanism.dynamics is not None:
        energy, inertia = (unit(mechanism.dynamics, mechanism.length_unit) for unit in (energy_unit, inertia_unit))
        message = say(
            "flywheel: mean torque {mean:.6g} {torque}, change of energy {change:.6g} {energy}, "
            "moment of inertia {inertia:.6g} {unit}",
            mean=wheel.mean, torque=equations.of(equations.efforts[0]).unit.text, change=wheel.change, energy=energy,
            inertia=wheel.inertia, unit=inertia,
        )  # fmt: skip
        lines.append(message)
    if mechanism.outputs:
        lines.append(say("outputs: {names}", names=", ".join(output.symbol for output in mechanism.outputs)))
    if numbers := [_single(compiled, single) for single in mechanism.motion_numbers]:
        lines.append(say("over the whole sweep: {numbers}", numbers=", ".join(numbers)))
    lines.append(verdict(compiled))
    return "\n".join(text_in(line, mechanism.language) for line in lines)


def _all(symbols: Sequence[str]) -> str:
    """`a, b and c`."""
    *others, last = symbols
    return say("{first} and {last}", first=", ".join(others), last=last) if others else last


def _group(group: Group) -> list[str]:
    """A group with its mode; of one that is solved by Newton's method the assemblies that there are, and its passes."""
    shown = {"number": group.number, "kind": group.kind, "links": group.label}
    if group.system is not None:
        line = say(
            "group {number} {kind}: {links}  {mode} = {value} of {count}, by Newton's method",
            **shown, mode=group.mode, value=group.mode_value, count=len(group.assemblies),
        )  # fmt: skip
        assemblies = [
            say("  {number}: {words}", number=number, words=one) for number, one in enumerate(group.assemblies, 1)
        ]
        return [line, *assemblies, say("  {passes} passes a row", passes=group.system.passes)]
    if not group.mode:
        return [say("group {number} {kind}: {links}", **shown)]
    return [
        say("group {number} {kind}: {links}  {mode} = {value:+d} ({words})", **shown, mode=group.mode,
            value=group.mode_value, words=group.mode_words)
    ]  # fmt: skip


def _columns(equations: Equations) -> Sequence[str]:
    """The columns by what they are."""
    of_role = {role: [one.symbol for one in equations.columns if one.role == role] for role in ("variable", "rate")}
    lines = [say("variables: {symbols}", symbols=", ".join(of_role["variable"]))]
    if of_role["rate"]:
        lines.append(say("velocities and accelerations: {symbols}", symbols=", ".join(of_role["rate"])))
    if equations.shown_forces:
        lines.append(say("forces: {symbols}", symbols=", ".join(equations.shown_forces)))
    return lines


WITHOUT = ("verdict.boundless", "verdict.gaps", "verdict.several")
"""Why a summary has no number, as its words end."""


def _single(compiled: Compiled, single: Summary | Output) -> str:
    """`mu_min = 33.89 °`: a summary, or an output of summaries, as the first sheet has it."""
    plan = compiled.plan
    spot = plan.places.summaries[single.symbol]
    value, said = compiled.value(spot), str(compiled.value(replace(spot, col=MEANING)))
    if not isinstance(value, float):
        why = _ending(plan, said, WITHOUT).strip(" ()") or text_in(say("none"), plan.mechanism.language)
        return f"{single.symbol}: {why}"
    unit = plan.mechanism.shown(single.unit) if isinstance(single, Output) else unit_of_column(plan, single.of)
    return f"{single.symbol} = {value:.6g}{behind_number(unit.text)}{_ending(plan, said, DOUBTS)}"


def _ending(plan: Plan, said: str, keys: Sequence[str]) -> str:
    """The words by which a text ends, of those of these keys; "" for none."""
    return next((plan.text(key) for key in keys if said.endswith(plan.text(key))), "")


def _tie(mechanism: Mechanism, relation: Relation) -> str:
    """`gear wheel on crank: ratio -0.5, phase 30 deg (as sketched, or 0: the description gives none)`."""
    values = dimension_values(mechanism)
    rack = isinstance(relation, Rack)
    unit = unit_of(mechanism.length_unit, mechanism.length_unit) if rack else mechanism.angle_unit
    phase = unit.to_shown(number(relation.phase, values))
    if isinstance(relation, Rack):
        what = say("rack {first} on {second}", first=relation.joint, second=relation.link)
        own = say("radius {number:.6g}", number=number(relation.radius, values))
    else:
        what = say("gear {first} on {second}", first=relation.link, second=relation.on)
        if relation.kind == "belt":
            what = say("belt {first} on {second}", first=relation.link, second=relation.on)
        own = say("ratio {number:.6g}", number=number(relation.ratio, values))
    arm = "" if relation.arm == mechanism.ground.name else say(", arm {link}", link=relation.arm)
    read = say(" (as sketched, or 0: the description gives none)") if relation.read_off else ""
    return say(
        "{what}{arm}: {own}, phase {phase:.6g} {unit}{read}",
        what=what, arm=arm, own=own, phase=phase, unit=unit.symbol, read=read,
    )  # fmt: skip


def _stands(mechanism: Mechanism) -> bool:
    """Whether the driver has no speed, or the speed 0 and no acceleration, in every row."""
    driver = mechanism.driver
    if driver.speed is None:
        return True
    values = dimension_values(mechanism)
    rates = [rate for rate in (driver.speed, driver.acceleration) if rate is not None]
    return all(isinstance(rate, Symbol) and values.get(rate.name) == 0 for rate in rates)


def equations_text(mechanism: Mechanism) -> str:
    """All equations, one a line, by group; constants first."""
    equations, language = lowered(mechanism, told(mechanism).equations), mechanism.language
    lines = [*_synthesis_lines(mechanism), text_in(say("constants"), language), *map(_line, equations.constants)]
    given = [(0, "", f"  {symbol} = {print_formula(node, 'text')}") for symbol, node in given_by_law(mechanism).items()]
    columns = [(equation.group, _what(equation), _line(equation, language)) for equation in equations.columns]
    for (group, what), parts in groupby([*given, *columns], key=lambda part: part[:2]):
        lines += ["", text_in(_group_heading(equations, group), language) + text_in(what, language)]
        lines += [line for _, _, line in parts]
    return "\n".join(lines)


def _what(equation: Assignment) -> str:
    """What a group's heading says of such columns."""
    if equation.role in FORCES:
        return say(", forces")
    return say(", velocities and accelerations") if equation.role in RATES else ""


def _synthesis_lines(mechanism: Mechanism) -> list[str]:
    """The steps of the synthesis, and the dimensions that it gives; nothing where there is none."""
    task = mechanism.synthesis
    if task is None:
        return []
    own = {dim.symbol: dim for dim in mechanism.dimensions}
    steps = (own[symbol] for symbol in (*task.steps, *task.taken))
    lines = [
        f"  {dim.symbol} = {print_formula(says(dim.value), 'text')}"
        for dim in steps
        if not isinstance(dim.value, float)
    ]
    return [text_in(say("synthesis: {kind}", kind=task.kind), mechanism.language), *lines, ""]


def given_by_law(mechanism: Mechanism) -> dict[str, Node]:
    """The time of a motion law in row n, and the driver's value then; nothing where it moves by none."""
    law = mechanism.driver.law
    if law is None:
        return {}
    time = al.div(al.mul(Symbol("n"), Symbol(law.duration)), al.number(law.rows - 1.0))
    return {TIME: time, mechanism.driver.symbol: law.value}


def _group_heading(equations: Assignments, number: int) -> str:
    if number == 0:
        return say("driver")
    if number < 0:
        return say("outputs")
    group = equations.groups[number - 1]
    return say("group {number} {kind}: {links}", number=number, kind=group.kind, links=group.label)


def _line(equation: Assignment, language: str = ENGLISH) -> str:
    line = f"  {equation.symbol} = {print_formula(equation.expression, 'text')}"
    if equation.first is None:
        return line
    first = say("first row: {expression}", expression=print_formula(equation.first, "text"))
    return f"{line}    ({text_in(first, language)})"


def equations_json(mechanism: Mechanism) -> str:
    """The equations as a JSON list."""
    rows: list[dict[str, object]] = [
        {
            "symbol": symbol,
            "expression": print_formula(node, "text"),
            "kind": "driver",
            "unit": (mechanism.given_unit(symbol) or NUMBER).kind,
            "group": 0,
            "label": {
                language: words(language, "given.t" if symbol == TIME else "notes.driver") for language in LANGUAGES
            },
        }
        for symbol, node in given_by_law(mechanism).items()
    ]
    rows += [
        {
            "symbol": equation.symbol,
            "expression": print_formula(equation.expression, "text"),
            "kind": equation.role,
            "unit": equation.unit.symbol if equation.unit.kind == "label" else equation.unit.kind,
            "group": equation.group,
            "label": {language: equation.label.of(language) for language in LANGUAGES},
        }
        for equation in lowered(mechanism, compiled_of(mechanism).equations).all
    ]
    return json.dumps(rows, ensure_ascii=False, indent=1)


def cells_text(mechanism: Mechanism) -> str:
    """Names, constants and formulas of the workbook: see `cells_of_workbook`."""
    return cells_of_workbook(told(mechanism).workbook)


def cells_of_workbook(workbook: Workbook) -> str:
    """A stable dump: names, then sheet by sheet the constants with their values, the fills with their first formula, and
    the charts with the number of their series."""
    lines = [f"name {name.name} = {name.sheet}!{cell_name(name.row, name.col)}" for name in workbook.names]
    for sheet in workbook.sheets:
        lines.append(f"sheet {sheet.title}{' (hidden)' if sheet.hidden else ''}")
        for cell in sorted(sheet.cells, key=lambda cell: (cell.row, cell.col)):
            if cell.content is not None:
                lines.append(f"  {cell_name(cell.row, cell.col)}: {cell.value!r}")
        for fill in sorted(sheet.fills, key=lambda fill: (fill.row, fill.col)):
            area = cell_name(fill.row, fill.col)
            if fill.rows * fill.cols > 1:
                area += f":{cell_name(fill.row + fill.rows - 1, fill.col + fill.cols - 1)}"
            lines.append(f"  {area} = {print_formula(fill.formula, 'excel')}")
        lines += [f"  chart {chart.title!r}: {len(chart.series)} series" for chart in sheet.charts]
    return "\n".join(lines)


def cells_json(mechanism: Mechanism) -> str:
    """{"sheet": {"A1": value}} of every cell."""
    from mechsheet.library.recalculation import json_value

    sheets: dict[str, dict[str, object]] = {}
    for sheet in told(mechanism).workbook.sheets:
        cells: dict[str, object] = {}
        for cell in sheet.cells:
            if cell.content is not None:
                cells[cell_name(cell.row, cell.col)] = cell.value
        for fill in sheet.fills:
            for row in range(fill.row, fill.row + fill.rows):
                for col in range(fill.col, fill.col + fill.cols):
                    cells[cell_name(row, col)] = json_value(fill.value(row, col))
        sheets[sheet.title] = cells
    return json.dumps(sheets, ensure_ascii=False)


def variables_of(mechanism: Mechanism, further: bool = False) -> dict[str, list[float | None]]:
    """Driver, variables, points, rates and outputs, row by row, as people read them (degrees); None where there is none.

    further  whether with every other name that an output may read
    """
    compiled = compiled_of(mechanism)
    columns, _ = motion_of(compiled)
    columns = further_of(compiled)[0] | columns if further else columns
    return {
        name: [value if math.isfinite(value) else None for value in column.tolist()] for name, column in columns.items()
    }


def variables_json(mechanism: Mechanism) -> str:
    """{"theta13": [...], "C.x": [...]}: every name that an output may read."""
    return json.dumps(variables_of(mechanism, further=True), ensure_ascii=False)


def variables_csv(mechanism: Mechanism) -> str:
    """One row per position; empty where it does not exist."""
    columns = variables_of(mechanism)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for row in zip(*columns.values(), strict=True):
        writer.writerow(["" if value is None else repr(value) for value in row])
    return text.getvalue()


# --- dimensions -------------------------------------------------------------------------------------------------------

DIGITS = 6
"""Of the rounded values in the table."""


@dataclass(frozen=True, slots=True)
class Value:
    """A dimension in its own unit; None where it has no value: the task has no solution.

    exact  as it is found;  used  as the mechanism has it: rounded, where the synthesis rounds
    """

    name: str
    exact: float | None
    used: float | None
    unit: str
    words: str


def values_of(mechanism: Mechanism) -> list[Value]:
    """The mechanism's own dimensions, then the task of its synthesis, its steps and results."""
    numbers = dimension_values(mechanism)
    own = {dim.symbol: dim for dim in mechanism.dimensions}
    task = mechanism.synthesis
    if task is not None and not all(math.isfinite(numbers[symbol]) for symbol in task.ends):
        # without a solution nothing is a result, nor what the task gives of it
        numbers |= dict.fromkeys((*task.results.values(), *task.taken), math.nan)
    exact = {} if task is None else {name: task.results[result] for name, result in task.taken.items()}
    shown = {symbol: _value(mechanism, dim, exact.get(symbol, symbol), numbers) for symbol, dim in own.items()}
    names = [dim.symbol for dim in mechanism.dimensions if dim.path[:1] != ("synthesis",)]
    if task is None:
        return [shown[name] for name in names]
    of_task = [symbol for symbol in (*task.inputs, *task.steps) if symbol not in exact.values()]
    found = [shown[name] for name in (*names, *of_task)]
    there = {value.name for value in found}
    return found + [replace(shown[symbol], name=name) for name, symbol in task.results.items() if name not in there]


def _value(mechanism: Mechanism, dim: Dimension, exact: str, numbers: dict[str, float]) -> Value:
    def number(symbol: str) -> float | None:
        value = numbers[symbol]
        return dim.unit.written(value) if math.isfinite(value) else None

    words = dim.label.of(mechanism.language) if dim.label else ""
    return Value(dim.symbol, number(exact), number(dim.symbol), dim.unit.text, words)


def dimensions_json(mechanism: Mechanism) -> str:
    """{"a1": 100.0, ...}: exact values in their own units, null where there is none."""
    return json.dumps({value.name: value.exact for value in values_of(mechanism)}, ensure_ascii=False)


def dimensions_text(mechanism: Mechanism) -> str:
    """A table: name, exact value to six digits, the value that is used, unit, meaning."""
    values = values_of(mechanism)
    rounds = mechanism.synthesis is not None
    language = mechanism.language
    name, exact, unit = (words(language, f"head.{key}") for key in ("symbol", "value", "unit"))
    head = (name, exact, words(language, "synthesis.used") if rounds else "", unit, "")
    task = mechanism.synthesis
    taken = set() if task is None else {*task.taken, *(task.results[name] for name in task.mode.values())}

    def shown(number: float | None) -> str:
        return none if number is None else f"{number:.{DIGITS}g}"

    none = text_in(say("no value"), language)
    rows = [head] + [
        (value.name, shown(value.exact), shown(value.used) if value.name in taken else "", value.unit, value.words)
        for value in values
    ]
    widths = [max(len(row[col]) for row in rows) for col in range(len(head))]
    lines = []
    for row in rows:
        name, exact, used, unit, meaning = row
        cells = [name.ljust(widths[0]), exact.rjust(widths[1])]
        cells += [used.rjust(widths[2])] if rounds else []
        lines.append("  ".join((*cells, unit.ljust(widths[3]), meaning)).rstrip())
    return "\n".join(lines)
