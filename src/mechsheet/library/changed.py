"""Reading a description with what a caller changes (`Overrides`), and with what it leaves to its links and its sketch.

All of it is written into the description's text, so that it travels in the workbook: modes as a sketch that means them,
links that nobody has marked as redundant with such a mark, phases of gears in the turn in which they are sketched.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from livesheet.diagnostics import Fault, readable_name
from livesheet.said import say
from mechsheet import description
from mechsheet.description.overrides import AS_IT_IS, Overrides, name_of, option_of
from mechsheet.description.reader import read_again, with_settings
from mechsheet.description.report import located, suggestion
from mechsheet.description.text.numbers import typed_number
from mechsheet.description.text.rewrite import number_text, with_origin, with_value
from mechsheet.description.text.source import parse, parse_as_meant, read_text
from mechsheet.diagnostics import DescriptionError, MechanismError, MechsheetError, quoted
from mechsheet.model import Gear, Mechanism

if TYPE_CHECKING:
    from mechsheet.kinematics.equations import Group

MOST = 16
"""Assemblies of one group."""

DEGREES_WRITTEN = 1
"""Decimals of a phase [deg] that is read off a sketch; of other ones two more."""

_MODE = re.compile(r"mode[_0-9]*", re.IGNORECASE)
"""What means an assembly mode where no dimension is called so."""


def load(path: str | Path, overrides: Overrides = AS_IT_IS) -> Mechanism:
    """The mechanism that a file describes, with changes: see `loads`."""
    return replace(loads(read_text(path), readable_name(path), overrides), file=Path(path).stem)


def loads(text: str, file: str = "<text>", overrides: Overrides = AS_IT_IS) -> Mechanism:
    """The mechanism that a text describes, with changes; `file` is what messages call it.

    Among the values may be assembly modes: `mode_1` -> 1 or -1.

    Raises DescriptionError with every fault, MechanismError when the modes cannot be told apart by a sketch.
    """
    modes = _modes_in(overrides.pairs, text, file)
    rest = [pair for pair in overrides.pairs if pair not in modes]
    own = replace(overrides, values=rest, layout=None, tolerance=False)
    faults = [fault for name, value in modes if (fault := _value_fault(name, value, file)) is not None]
    try:
        found = _with_phases(_with_redundant(description.loads(text, file, own), file), file)
        faults += _faults_of_modes(modes, found, file)
    except MechsheetError as error:
        if not modes:
            raise
        with suppress(MechsheetError):  # wrong names are told beside what else is wrong
            faults += _faults_of_modes(modes, description.loads(text, file), file)
        raise DescriptionError([*faults, *error.faults]) from error
    if faults:
        raise DescriptionError(faults)
    if modes:
        found = _with_modes(found, {name_of(name): round(float(value)) for name, value in modes}, file)
    elif rest:
        found = replace(found, before=_unchanged(text, file))
    found = replace(found, text=with_origin(found.text, text, file))
    return with_settings(found, overrides, file)


def _unchanged(text: str, file: str) -> Mechanism | None:
    """The mechanism without changes; None where only these make it one."""
    with suppress(MechsheetError):
        return description.loads(text, file)
    return None


def _modes_in(pairs: Sequence[tuple[str, str]], text: str, file: str) -> list[tuple[str, str]]:
    """The pairs that mean assembly modes: a dimension of that name comes first."""
    named = [pair for pair in pairs if _MODE.fullmatch(name_of(pair[0]))]
    if not named:
        return []
    dimensions = parse_as_meant(text, file)[0].data.get("dimensions")
    taken = dimensions if isinstance(dimensions, dict) else {}
    return [pair for pair in named if name_of(pair[0]) not in taken]


def _value_fault(name: str, value: str, file: str) -> Fault | None:
    number = typed_number(value)
    if number is not None and not number.unit and not number.why and float(number.text) in (*range(1, MOST + 1), -1):
        return None  # of a group of more than two assemblies the number of one
    return _no_mode(name, value, file, number.hint if number and number.why and not number.unit else "")


def _no_mode(name: str, value: str, file: str, hint: str = "") -> Fault:
    return Fault(
        say("an assembly mode is 1 or -1, not {value}", value=quoted(value)),
        file,
        key=option_of(f"{name}={value}"),
        hint=hint,
    )


def _no_number(group: Group, name: str, value: str, file: str) -> Fault:
    hint = "; ".join(f"{number}: {words.of('en')}" for number, words in enumerate(group.assemblies, 1))
    message = say(
        "{name} is the number of one of 1 assembly, not {value}"
        if len(group.assemblies) == 1
        else "{name} is the number of one of {count} assemblies, not {value}",
        name=name,
        count=len(group.assemblies),
        value=quoted(value),
    )
    return Fault(message, file, key=option_of(f"{name}={value}"), hint=hint)


def _faults_of_modes(pairs: Sequence[tuple[str, str]], mechanism: Mechanism, file: str) -> list[Fault]:
    """Modes that no group has, and values that its group cannot have. Raises MechanismError for what is no mechanism."""
    if not pairs:
        return []
    from mechsheet.kinematics.solve import solve_unpicked

    try:
        groups = {group.mode: group for group in solve_unpicked(mechanism).groups if group.mode}
    except MechanismError as error:
        raise located(error, mechanism.listing, file) from error
    by_task = () if mechanism.synthesis is None else mechanism.synthesis.mode
    found = (_fault_of_mode(name, value, groups, by_task, file) for name, value in pairs)
    return [fault for fault in found if fault is not None]


def _fault_of_mode(
    given: str, value: str, groups: Mapping[str, Group], by_task: Collection[str], file: str
) -> Fault | None:
    name, option = name_of(given), option_of(f"{given}={value}")
    if name in by_task:
        message = say("the assembly mode {name} is found by the synthesis", name=quoted(given))
        return Fault(message, file, key=option, hint=say("change its task instead, or take it out of [assembly]"))
    if name not in groups:
        message = say("no group of links has the assembly mode {name}", name=quoted(given))
        return Fault(message, file, key=option, hint=suggestion(name, [*groups], "modes"))
    group = groups[name]
    if _value_fault(given, value, file) is not None:
        return None  # told already
    if group.system is None:
        return None if abs(float(value)) == 1 else _no_mode(given, value, file)
    return None if 1 <= float(value) <= len(group.assemblies) else _no_number(group, given, value, file)


def _with_modes(mechanism: Mechanism, wanted: Mapping[str, int], file: str) -> Mechanism:
    """The mechanism with some modes; the other groups keep theirs."""
    from mechsheet.kinematics.solve import solve
    from mechsheet.library.modes_from_sketch import with_modes

    try:
        groups = solve(mechanism).groups
    except MechanismError:  # the sketch may lie between two modes of which one is given
        try:
            groups = solve(mechanism, wanted).groups
        except MechanismError as error:
            raise located(error, mechanism.listing, file) from error
    modes = {group.mode: group.mode_value for group in groups if group.mode} | dict(wanted)
    try:
        source = with_modes(parse(mechanism.text, file), modes)
    except MechanismError as error:
        options = ", ".join(f"{mode}={value}" for mode, value in wanted.items())
        raise MechanismError(Fault(fault.message, file, key=option_of(options)) for fault in error.faults) from error
    found = read_again(mechanism, source)
    return replace(found, sketch=replace(found.sketch, doubted=False))


# --- what nobody has said ------------------------------------------------------------------------------------------


def _with_redundant(mechanism: Mechanism, file: str) -> Mechanism:
    """The mechanism with redundant links left out of what has to be solved, where there are any and it does not matter
    which; else as it is."""
    from mechsheet.kinematics.graph import graph_of
    from mechsheet.kinematics.mobility import mobility

    if mobility(graph_of(mechanism)) > len(mechanism.drivers):
        return mechanism
    from mechsheet.kinematics.redundancy import redundant_links

    sets = redundant_links(mechanism)
    for names in sets:
        with suppress(MechsheetError):  # one whose points are given by distances cannot be marked
            source = parse(mechanism.text, file)
            for name in names:
                source = with_value(source, ("links", name, "redundant"), "true")
            found = read_again(mechanism, source)
            marked = tuple(
                replace(each, also=_instead(each.link.name, names, sets)) if each.link.name in names else each
                for each in found.redundant
            )
            return replace(found, redundant=marked)
    return mechanism


def _instead(name: str, left_out: Collection[str], sets: Sequence[Collection[str]]) -> tuple[str, ...]:
    """The links that would do as well in the place of one of those that are left out."""
    rest = {*left_out} - {name}
    others = [other for each in sets for other in each if {*each} == rest | {other} and other != name]
    return tuple(dict.fromkeys(others))


def _with_phases(mechanism: Mechanism, file: str) -> Mechanism:
    """The mechanism with the phases that its sketch shows, where those that were read off it are of another turn.

    A sketch shows an angle, not in which of its turns it is: with a ratio of 0.5 a turn more of one wheel is half a turn of
    the other. The turns follow from the motion, from the first position to the one that is sketched.
    """
    if not any(relation.read_off for relation in mechanism.relations):
        return mechanism
    from mechsheet.kinematics.doubts.sketched import out_of_phase
    from mechsheet.kinematics.solve import solve

    try:
        off = {
            each.relation.order: each for each in out_of_phase(mechanism, solve(mechanism)) if each.relation.read_off
        }
        if not off:
            return mechanism
        source = parse(mechanism.text, file)
        for order, each in off.items():
            phase = each.meant(mechanism)
            if isinstance(each.relation, Gear):
                phase = round(phase, DEGREES_WRITTEN if mechanism.angle_unit.in_degrees else DEGREES_WRITTEN + 2)
            source = with_value(source, ("joints", order, "phase"), number_text(phase))
        return read_again(mechanism, source)
    except MechsheetError:  # whoever solves it hears why
        return mechanism
