"""From TOML text to `model.Mechanism`: the parts in the order in which they need one another, all faults at once."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

from livesheet.diagnostics import readable_name
from livesheet.said import say
from mechsheet.description import cams, dimensions, dynamics, force_names, gears, joints, links, requests, sketch
from mechsheet.description import outputs as further_outputs
from mechsheet.description.asked import exercise, study, synthesis, tolerances
from mechsheet.description.driving import driver, rates, segments
from mechsheet.description.driving.sweep import with_sweep
from mechsheet.description.overrides import AS_IT_IS, Overrides, with_values
from mechsheet.description.report import Report
from mechsheet.description.schema import DESCRIPTION, FORMAT
from mechsheet.description.scope import choice, part, scope_of, words
from mechsheet.description.shape import fit
from mechsheet.description.sketch import SketchedAngles
from mechsheet.description.text.rewrite import with_origin, with_value
from mechsheet.description.text.source import Source, parse, parse_as_meant, read_text
from mechsheet.diagnostics import DescriptionError, quoted
from mechsheet.model import (
    Dimension,
    Driver,
    Dynamics,
    FurtherDriver,
    Joint,
    Label,
    Link,
    Mechanism,
    Sketch,
    Solution,
)


def load(path: str | FilePath, overrides: Overrides = AS_IT_IS) -> Mechanism:
    """The mechanism that a file describes, format 1, with changes.

    Raises DescriptionError with every fault found, each with file, line and key. `Mechanism.text` is the file with the
    overrides written into it, so that reading it again gives the same mechanism.
    """
    return replace(loads(read_text(path), readable_name(path), overrides), file=FilePath(path).stem)


def loads(text: str, file: str = "<text>", overrides: Overrides = AS_IT_IS) -> Mechanism:
    """The mechanism that a text describes; `file` is what messages call it. See `load`."""
    source, faults = parse_as_meant(text, file)
    mistyped = {fault.line for fault in faults}
    faults += overrides.faults
    if not faults:
        source, faults_of_values = with_values(source, overrides.pairs)
        source, faults_of_sweep = with_sweep(source, overrides.rows, overrides.step)
        faults += faults_of_values + faults_of_sweep
    _check_format(source)
    report = Report(source)
    mechanism = _read(source, report)
    # What else is wrong with a line that was mistyped may come from how it was taken.
    faults += [fault for fault in report.in_order() if fault.line is None or fault.line not in mistyped]
    if faults or mechanism is None:
        raise DescriptionError(sorted(faults, key=lambda fault: fault.line or 0))
    if overrides.values:
        mechanism = replace(mechanism, sketch=replace(mechanism.sketch, doubted=False))
    return with_settings(mechanism, overrides, file)


def read_again(mechanism: Mechanism, source: Source) -> Mechanism:
    """The mechanism whose text was changed to that of `source`; what stands in no text stays as it was.

    What is wrong with it is told at the lines of the text before: nobody has seen the one that was changed.
    """
    report = Report(parse(mechanism.listing, source.file))
    found = _read(source, report)
    if found is None:
        raise DescriptionError(report.in_order())
    also = {each.link.name: each.also for each in mechanism.redundant}
    return replace(
        found,
        file=mechanism.file,
        before=mechanism.before,
        sketch=replace(found.sketch, doubted=mechanism.sketch.doubted),
        redundant=tuple(replace(each, also=also.get(each.link.name)) for each in found.redundant),
    )


def with_settings(mechanism: Mechanism, overrides: Overrides, file: str = "<text>") -> Mechanism:
    """The mechanism with another language, another layout of its workbook, and bands, as far as these are asked for.

    All of it stands in its text, too; `file` is what messages call that. Raises DescriptionError for what is not known,
    for a layout that cannot hold what the description asks for, and where nothing can have a band.
    """
    if overrides.faults:
        raise DescriptionError(overrides.faults)
    keys = [key for key in ("language", "layout") if getattr(overrides, key) not in (None, getattr(mechanism, key))]
    bands = overrides.tolerance and mechanism.bands is None
    if not keys and not bands:
        return mechanism
    source = parse(mechanism.text, file)
    for key in keys:
        source = with_value(source, ("workbook", key), f'"{getattr(overrides, key)}"')
    if bands:
        own = source.text.rstrip()
        source = parse(with_origin(f"{own}\n\n[tolerance]\n", own, file), file)
    return read_again(mechanism, source)


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
    """The steps in the order in which they need one another; each goes on where an earlier one has found faults."""
    reading = _Reading(source, report)
    reading.dimensions_and_links()
    reading.driving()
    reading.sketch_and_gears()
    reading.forces()
    reading.asked()
    reading.workbook()
    return reading.mechanism()


class _Reading:
    """One description: what the steps have found so far.

    table  the dimensions, in the order of their cells;  links, joints: without those that a redundant link has
    parts  of the mechanism, by the names of its fields
    """

    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    driver: Driver | None = None
    further: tuple[FurtherDriver, ...] = ()
    sketch: Sketch
    masses: Dynamics | None

    def __init__(self, source: Source, report: Report) -> None:
        self.source, self.report = source, report
        self.data = fit(source.data, DESCRIPTION, (), report)
        self.head = self._part("mechanism", {})
        self.scope = scope_of(self.head, report)
        self.data = segments.with_cam(self.data, self.scope)
        self.outputs = further_outputs.spelled_out(self._part("outputs", {}))
        self.summary = self._part("summary", {})
        self.layout = choice(self._part("workbook", {}), "layout", "sheets")
        self.table: tuple[Dimension, ...] = ()
        self.parts: dict[str, Any] = {}

    def _part(self, key: str, empty: Any) -> Any:
        return part(self.data, key, empty)

    def dimensions_and_links(self) -> None:
        """Dimensions, with those of a synthesis; links and their points; joints."""
        bodies, scope = self._part("links", {}), self.scope
        given = dimensions.spelled_out(self._part("dimensions", {}), scope)
        bare = links.declare(bodies, scope)  # first: a dimension that takes an angle's name is the one to rename
        self.task = synthesis.read(self.data.get("synthesis"), given, scope, (*self.outputs, *self.summary))
        dimensions.declare(given, scope, self.task.units)
        scope.outputs.extend(self.outputs)  # known by name in messages, before they are entered after all variables
        self.table = (*self.task.dimensions, *dimensions.read(given, scope, self.task))
        made = links.read(bodies, bare, scope)
        self.ends = joints.Ends(bodies, made, scope)
        sliding = joints.read(self._part("joints", []), self.ends, scope)
        self.links, self.joints, self.parts["redundant"] = joints.read_redundant(
            self.data, made, sliding, self.ends, scope
        )

    def driving(self) -> None:
        """What is driven, and how fast."""
        made, sliding, given, scope = self.links, self.joints, self.data["driver"], self.scope
        if made:
            follower = self._cam() if segments.given(self.data) else ()
            if not segments.given(self.data):
                segments.check_alone(self.data, scope)
                self.driver = driver.read(given, made, sliding, self.ends, scope)
            listed = self._part("drivers", [])
            further, values = driver.read_further(listed, self.driver, made, sliding, self.ends, scope)
            self.further = (*follower, *further)
            self.table = (*self.table, *values)
            if self.report.sound("links", "joints"):
                links.check_connected(made, sliding, scope)
        rates.declare(made, sliding, self.driver, given, scope)
        moved = [each for each in self.further if each.segments is not None]
        scope.rates |= dict.fromkeys(name for each in moved for name in (each.by_angle[-1], each.by_time[-1]))
        scope.rates |= dict.fromkeys(scope.of_cam)
        motion = rates.motion(given, made, self.driver, scope) if self.driver else None
        if self.driver and motion:
            self.driver = motion.of(self.driver)
            self.table = (*self.table, *motion.dimensions)
        driver.check_speeds(self.driver, self.further, scope)
        self.driver = driver.listed(self.driver, self.further, scope) if self.driver else None

    def _cam(self) -> tuple[FurtherDriver, ...]:
        """The cam as the driver; what it moves."""
        given, ends, scope = self.data["driver"], self.ends, self.scope
        cam = self._part("cam", {})
        if self.links[-1].name not in segments.LINKS:  # a fault hides it
            scope.complete = False
            return ()
        shape = cams.read(cam, given, self.links, self.joints, ends, scope) if cam else None
        if shape is not None:
            self.parts["cam"] = shape.cam
            cams.declare(shape.cam, scope)
            self.table = (*self.table, *shape.dimensions)
        start = None if shape is None else shape.start
        moved = segments.read(given, cam, start, self.links, self.joints, ends, scope)
        if moved is None:
            return ()
        self.driver = moved.driver
        self.table = (*self.table, *moved.dimensions)
        return (moved.follower,)

    def sketch_and_gears(self) -> None:
        """The sketch, and the relations of gears, whose phases may be read from it."""
        made, sliding, scope = self.links, self.joints, self.scope
        self.sketch = sketch.read(self._part("assembly", {}), self.driver, scope)
        shown = SketchedAngles(made, sliding, self.driver, self.further, self.sketch, scope)
        given = self._part("joints", [])
        self.relations, values = gears.read(given, self.ends, made, sliding, shown, scope) if made else ((), ())
        self.table = (*self.table, *values)

    def forces(self) -> None:
        """Masses and loads."""
        bodies, loads, scope = self._part("links", {}), self._part("loads", []), self.scope
        cam = self.parts.get("cam")
        force_names.declare(
            bodies, loads, self.links, self.joints, self.driver, self.further, self.relations, cam, scope
        )
        self.masses, cells = dynamics.read(bodies, self._part("dynamics", {}), loads, self.links, self.joints, scope)
        self.table = (*self.table, *cells)

    def asked(self) -> None:
        """Outputs, summaries, charts and tables; a flywheel; an exercise and a study."""
        scope, bodies = self.scope, self._part("links", {})
        requests.declare(self.outputs, self.summary, scope)
        of_rows, of_motion = further_outputs.outputs(self.outputs, self.driver, scope)
        wheel = self._part("flywheel", {})
        dynamics.declare_flywheel(wheel, scope)
        if self.driver:
            own = dynamics.read_flywheel(wheel, self.masses, self.driver, self.links, self.table, self.layout, scope)
            self.table = (*self.table, *own)
        self.parts |= {
            "outputs": of_rows,
            "motion_outputs": of_motion,
            "summaries": requests.summaries(self.summary, scope),
            "charts": requests.charts(self._part("charts", []), self.driver, scope),
            "tables": requests.tables(self._part("tables", []), self.driver, scope),
            "rate_points": rates.points(self._part("rates", {}), scope),
            "synthesis": synthesis.with_modes(self.task.synthesis, self._part("assembly", {}), scope),
            "exercise": exercise.read(
                self._part("exercise", {}), self.summary, "" if self.driver is None else self.driver.symbol, scope
            ),
            "study": study.read(self._part("study", {}), bodies, self.summary, scope),
        }
        driver.check_tables(self.further, self.parts["tables"], scope)

    def workbook(self) -> None:
        """How the workbook is written, how what has no closed form is solved, and tolerances, of which a page has none."""
        workbook, solution = self._part("workbook", {}), self._part("solution", {})
        driven: tuple[Driver | FurtherDriver, ...] = (
            self.further if self.driver is None else (self.driver, *self.further)
        )
        self.parts |= {
            "language": choice(workbook, "language", "en"),
            "layout": self.layout,
            "drawn": workbook.get("drawing", True) is not False,
            "references": choice(workbook, "references", "anchors" if self.layout == "page" else "names"),
            "solution": Solution(passes=solution.get("passes"), force=solution.get("force", False) is True),
            "bands": tolerances.read(self.data, self.table, driven, self.layout, self.scope),
        }

    def mechanism(self) -> Mechanism | None:
        """All of it, where there is no fault."""
        name = _name(self.head, self.report)
        if self.report.faults or self.driver is None:
            return None
        return Mechanism(
            name=name,
            title=words(self.head.get("title")) or Label(name),
            source=words(self.head.get("source")) or Label(""),
            length_unit=self.scope.length_unit,
            angle_unit=self.scope.angle_unit,
            dimensions=self.table,
            links=self.links,
            joints=self.joints,
            driver=self.driver,
            drivers=self.further,
            relations=self.relations,
            sketch=self.sketch,
            dynamics=self.masses,
            text=self.source.text,
            listing=self.report.source.text,
            **self.parts,
        )


# --- names of files ---------------------------------------------------------------------------------------------------

_DEVICE = re.compile(r"(con|prn|aux|nul|(com|lpt)[0-9¹²³])(\..*)?", re.IGNORECASE)
_NEVER = re.compile(r'[<>:"/\\|?*\x00-\x1f]')


def is_device(name: str) -> bool:
    """Whether Windows takes a name for a device, whatever its ending: what is written there is lost."""
    return _DEVICE.fullmatch(name) is not None


def is_file_name(name: str) -> bool:
    """Whether a name is that of a file in a folder, on Linux, macOS and Windows alike: no path, no device, not hidden."""
    return not (_NEVER.search(name) or name.startswith(".") or name != name.rstrip(". ") or is_device(name))


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
    elif is_device(name):
        report.at(
            path, say("{name} cannot be the stem of a file: Windows keeps that name for a device", name=quoted(name))
        )
    return name
