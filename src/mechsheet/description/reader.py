"""From TOML text to `model.Mechanism`: the parts in the order in which they need one another, all faults at once."""

from __future__ import annotations

import unicodedata
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

from mechsheet.description import dimensions, gears, joints, links, redundant, results
from mechsheet.description import outputs as further_outputs
from mechsheet.description.asked import exercise, study, synthesis, tolerances
from mechsheet.description.driving import driver, drivers, rates
from mechsheet.description.driving.sweep import with_sweep
from mechsheet.description.forces import dynamics, flywheel, force_names
from mechsheet.description.head import choice, part, scope_of
from mechsheet.description.overrides import Overrides, with_values
from mechsheet.description.quoting import quoted
from mechsheet.description.report import Report
from mechsheet.description.rewrite import with_value
from mechsheet.description.schema import DESCRIPTION, FORMAT
from mechsheet.description.scope import words
from mechsheet.description.shape import fit
from mechsheet.description.sketched_angles import SketchedAngles
from mechsheet.description.source import Source, parse_as_meant, read_text
from mechsheet.diagnostics import DescriptionError, Fault, readable_name
from mechsheet.model import Mechanism, Solution, Words
from mechsheet.said import say

LANGUAGES = ("en", "tr")
LAYOUTS = ("sheets", "page")
_DEVICES = {"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(1, 10))}


def load(path: str | FilePath, overrides: Overrides | None = None, language: str | None = None) -> Mechanism:
    """The mechanism that a file describes.

    path       a description, format 1
    overrides  dimension -> number or expression as text, in their order: {"a1": "65"}; see `with_values`
    language   "en" or "tr", in place of the description's own

    Raises DescriptionError with every fault found, each with file, line and key. `Mechanism.text` is the file with the
    overrides written into it, so that reading it again gives the same mechanism.
    """
    return replace(loads(read_text(path), readable_name(path), overrides, language), file=FilePath(path).stem)


def loads(
    text: str,
    file: str = "<text>",
    overrides: Overrides | None = None,
    language: str | None = None,
    *,
    rows: str | None = None,
    step: str | None = None,
) -> Mechanism:
    """The mechanism that a text describes; `file` is what messages call it. See `load`.

    step, rows  of the driver's sweep, as text: see `with_sweep`
    """
    source, faults = parse_as_meant(text, file)
    mistyped = {fault.line for fault in faults}
    if language is not None and language not in LANGUAGES:
        faults.append(
            Fault(say("unknown language {language}", language=quoted(language)), hint=say('languages: "en", "tr"'))
        )
    if not faults:
        source, faults_of_values = with_values(source, overrides or ())
        source, faults_of_sweep = with_sweep(source, rows, step)
        faults += faults_of_values + faults_of_sweep
    _check_format(source)
    report = Report(source)
    mechanism = _read(source, report)
    # What else is wrong with a line that was mistyped may come from how it was taken.
    faults += [fault for fault in report.in_order() if fault.line is None or fault.line not in mistyped]
    if faults or mechanism is None:
        raise DescriptionError(sorted(faults, key=lambda fault: fault.line or 0))
    if language is not None and language != mechanism.language:
        mechanism = loads(with_value(source, ("workbook", "language"), f'"{language}"').text, file)
    if overrides:
        mechanism = replace(mechanism, sketch=replace(mechanism.sketch, doubted=False))
    return mechanism


def with_layout(mechanism: Mechanism, layout: str | None, file: str = "<text>") -> Mechanism:
    """The mechanism with a layout of its workbook, "sheets" or "page", in place of its description's own (None: that).

    It stands in its text, too; `file` is what messages call that. Raises DescriptionError for a layout that is not known,
    or that cannot hold what the description asks for.
    """
    if layout is None or layout == mechanism.layout:
        return mechanism
    if layout not in LAYOUTS:
        raise DescriptionError(
            Fault(say("unknown layout {layout}", layout=quoted(layout)), hint=say('layouts: "sheets", "page"'))
        )
    source, _ = parse_as_meant(mechanism.text, file)
    found = loads(with_value(source, ("workbook", "layout"), f'"{layout}"').text, file)
    sketch = replace(found.sketch, doubted=mechanism.sketch.doubted)
    return replace(found, file=mechanism.file, sketch=sketch)


def with_tolerance(mechanism: Mechanism, file: str = "<text>") -> Mechanism:
    """The mechanism with bands of all its outputs and summaries, where its description asks for none.

    It stands in its text, too; `file` is what messages call that. Raises DescriptionError where nothing can have a band.
    """
    if mechanism.bands is not None:
        return mechanism
    source, _ = parse_as_meant(mechanism.text, file)
    own = source.text.rstrip()
    try:
        found = loads(f"{own}\n\n[tolerance]\n", file)
    except DescriptionError as error:
        last = own.count("\n") + 1  # who asks by an option has no line [tolerance] to look at
        told = [replace(each, line=None, source="") if (each.line or 0) > last else each for each in error.faults]
        raise DescriptionError(told) from None
    sketch = replace(found.sketch, doubted=mechanism.sketch.doubted)
    return replace(found, file=mechanism.file, sketch=sketch)


def _check_format(source: Source) -> None:
    """Another version is one fault: what else differs would only be noise."""
    version = source.data.get("format", FORMAT)
    if isinstance(version, int) and version != FORMAT:
        raise DescriptionError(
            source.fault(
                ("format",),
                say(
                    "format {given} is not known: this program reads format {format}",
                    given=str(version).lower(),
                    format=FORMAT,
                ),
            )
        )


def _read(source: Source, report: Report) -> Mechanism | None:
    data = fit(source.data, DESCRIPTION, (), report)
    head = part(data, "mechanism", {})
    scope = scope_of(head, report)
    given, bodies = part(data, "dimensions", {}), part(data, "links", {})
    outputs, summary = part(data, "outputs", {}), part(data, "summary", {})

    bare_links = links.declare(bodies, scope)  # first: a dimension that takes an angle's name is the one to rename
    task = synthesis.read(data.get("synthesis"), given, scope, (*outputs, *summary))
    dimensions.declare(given, scope, task.units)
    scope.outputs.extend(outputs)  # known by name in messages, before they are entered after all variables
    table = (*task.dimensions, *dimensions.read(given, scope, task))
    made = links.read(bodies, bare_links, scope)
    ends = joints.Ends(bodies, made, scope)
    sliding = joints.read(part(data, "joints", []), ends, scope)
    made, sliding, redundant_links = redundant.read(data, made, sliding, ends, scope)
    driven = driver.read(data["driver"], made, sliding, ends, scope) if made else None
    further, values = drivers.read(part(data, "drivers", []), driven, made, sliding, ends, scope) if made else ((), ())
    table = (*table, *values)
    if made and report.sound("links", "joints"):
        links.check_connected(made, sliding, scope)

    rates.declare(made, sliding, driven, data["driver"], scope)
    motion = rates.motion(data["driver"], made, driven, scope) if driven else None
    if driven and motion:
        driven = replace(
            driven,
            speed=motion.speed,
            acceleration=motion.acceleration,
            law=motion.law,
            speeds=motion.speeds,
            accelerations=motion.accelerations,
        )
        table = (*table, *motion.dimensions)
    drivers.check_speeds(driven, further, scope)
    driven = drivers.listed(driven, further, scope) if driven else None

    sketched = part(data, "assembly", {})
    sketch = results.sketch(sketched, driven, scope)
    shown = SketchedAngles(made, sliding, driven, further, sketch, scope)
    relations, values = gears.read(part(data, "joints", []), ends, made, sliding, shown, scope) if made else ((), ())
    table = (*table, *values)

    loads = part(data, "loads", [])
    force_names.declare(bodies, loads, made, sliding, driven, further, relations, scope)
    masses, cells = dynamics.read(bodies, part(data, "dynamics", {}), loads, made, scope)
    table = (*table, *cells)

    results.declare(outputs, summary, scope)
    of_rows, of_motion = further_outputs.outputs(outputs, driven, scope)
    workbook, solution = part(data, "workbook", {}), part(data, "solution", {})
    wheel = part(data, "flywheel", {})
    flywheel.declare(wheel, scope)
    if driven:
        table = (
            *table,
            *flywheel.read(wheel, masses, driven, made, table, choice(workbook, "layout", "sheets"), scope),
        )
    parts: dict[str, Any] = {
        "sketch": sketch,
        "relations": relations,
        "redundant": redundant_links,
        "drivers": further,
        "outputs": of_rows,
        "motion_outputs": of_motion,
        "summaries": results.summaries(summary, scope),
        "charts": results.charts(part(data, "charts", []), scope),
        "tables": results.tables(part(data, "tables", []), driven, scope),
        "language": choice(workbook, "language", "en"),
        "layout": (layout := choice(workbook, "layout", "sheets")),
        "drawn": workbook.get("drawing", True) is not False,
        "rate_points": rates.points(part(data, "rates", {}), scope),
        "dynamics": masses,
        "solution": Solution(passes=solution.get("passes"), force=solution.get("force", False) is True),
        "synthesis": synthesis.with_modes(task.synthesis, sketched, scope),
        "exercise": exercise.read(part(data, "exercise", {}), summary, scope),
        "study": study.read(part(data, "study", {}), bodies, summary, scope),
        "references": choice(workbook, "references", "anchors" if layout == "page" else "names"),
    }
    parts["bands"] = tolerances.read(data, table, [*([driven] if driven else []), *further], layout, scope)
    drivers.check_tables(further, parts["tables"], scope)
    name = _name(head, report)
    if report.faults or driven is None:
        return None
    return Mechanism(
        name=name,
        title=words(head.get("title")) or Words(name, name),
        source=words(head.get("source")) or Words("", ""),
        length_unit=scope.length_unit,
        angle_unit=scope.angle_unit,
        dimensions=table,
        links=made,
        joints=sliding,
        driver=driven,
        text=source.text,
        **parts,
    )


def _name(head: dict[str, Any], report: Report) -> str:
    """The stem of the files: legal on every system."""
    name = choice(head, "name", "")
    path = ("mechanism", "name")
    fits = all(sign in "-_" or unicodedata.category(sign)[0] == "L" or sign.isdecimal() for sign in name)
    if not fits or name.startswith("-"):
        message = say(
            "{name} must begin with a letter, a digit or _ and go on with letters, digits, - and _", name=quoted(name)
        )
        report.at(path, message, say("it becomes the stem of file names"))
    elif name.lower() in _DEVICES:
        report.at(
            path, say("{name} cannot be the stem of a file: Windows keeps that name for a device", name=quoted(name))
        )
    return name
