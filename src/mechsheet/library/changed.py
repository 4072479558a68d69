"""Reading a description with what a caller changes: dimensions, assembly modes, the driver's step and its rows.

All of it is written into the description's text, so that it travels in the workbook: modes as a sketch that means them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from mechsheet import description
from mechsheet.description.locate import located
from mechsheet.description.overrides import Overrides, in_order, name_of, option_of
from mechsheet.description.quoting import quoted
from mechsheet.description.report import suggestion
from mechsheet.description.text.numbers import typed_number
from mechsheet.description.text.origin import with_origin
from mechsheet.description.text.source import parse, parse_as_meant, read_text
from mechsheet.diagnostics import DescriptionError, Fault, MechanismError, MechsheetError, readable_name
from mechsheet.library.phases_from_sketch import with_phases
from mechsheet.library.redundant_links import with_redundant
from mechsheet.model import Mechanism
from mechsheet.said import say

if TYPE_CHECKING:
    from mechsheet.kinematics.equations import Group

MOST = 16
"""Assemblies of one group."""

_MODE = re.compile(r"mode[_0-9]*", re.IGNORECASE)
"""What means an assembly mode where no dimension is called so."""


def load(
    path: str | Path,
    overrides: Overrides | None = None,
    language: str | None = None,
    rows: str | None = None,
    step: str | None = None,
) -> Mechanism:
    """The mechanism that a file describes, with changes: see `loads`."""
    found = loads(read_text(path), readable_name(path), overrides, language, rows, step)
    return replace(found, file=Path(path).stem)


def loads(
    text: str,
    file: str = "<text>",
    overrides: Overrides | None = None,
    language: str | None = None,
    rows: str | None = None,
    step: str | None = None,
) -> Mechanism:
    """The mechanism that a text describes, with changes; `file` is what messages call it.

    overrides   dimension -> value, or assembly mode -> 1 or -1 (`mode_1`), as texts: see `description.overrides`
    rows, step  of the driver's sweep, as texts: see `description.sweep`

    Raises DescriptionError with every fault, MechanismError when the modes cannot be told apart by a sketch.
    """
    pairs = in_order(overrides or ())
    modes = _modes_in(pairs, text, file)
    if modes:
        found = _with_settings(text, file, pairs, modes, language, rows, step)
    else:
        found = with_phases(
            with_redundant(description.loads(text, file, pairs, language, rows=rows, step=step), file), file
        )
        if pairs:
            found = replace(found, before=_unchanged(text, file))
    return replace(found, text=with_origin(found.text, text, file))


def _with_settings(
    text: str,
    file: str,
    pairs: Sequence[tuple[str, str]],
    modes: Sequence[tuple[str, str]],
    language: str | None,
    rows: str | None,
    step: str | None,
) -> Mechanism:
    """With pairs of which some mean assembly modes."""
    faults = [fault for name, value in modes if (fault := _value_fault(name, value, file)) is not None]
    rest = [pair for pair in pairs if pair not in modes]
    try:
        mechanism = with_phases(
            with_redundant(description.loads(text, file, rest, language, rows=rows, step=step), file), file
        )
        faults += _name_faults(modes, mechanism, file)
    except MechsheetError as error:
        with suppress(MechsheetError):  # wrong names are told beside what else is wrong
            faults += _name_faults(modes, description.loads(text, file), file)
        raise DescriptionError([*faults, *error.faults]) from error
    if faults:
        raise DescriptionError(faults)
    return _with_modes(mechanism, {name_of(name): round(float(value)) for name, value in modes}, file)


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
    hint = "; ".join(f"{number}: {words.en}" for number, words in enumerate(group.assemblies, 1))
    message = say(
        "{name} is the number of one of 1 assembly, not {value}"
        if len(group.assemblies) == 1
        else "{name} is the number of one of {count} assemblies, not {value}",
        name=name,
        count=len(group.assemblies),
        value=quoted(value),
    )
    return Fault(message, file, key=option_of(f"{name}={value}"), hint=hint)


def _name_faults(pairs: Sequence[tuple[str, str]], mechanism: Mechanism, file: str) -> list[Fault]:
    """Modes that no group has, and values that a group of two assemblies cannot have. Raises MechanismError for what is no
    mechanism."""
    from mechsheet.kinematics.solve import solve_unpicked

    try:
        groups = solve_unpicked(mechanism).groups
    except MechanismError as error:
        raise located(error, mechanism.text, file) from error
    known = [group.mode for group in groups if group.mode]
    dyads = {group.mode for group in groups if group.system is None}
    task = mechanism.synthesis
    found = [
        Fault(
            say("the assembly mode {name} is found by the synthesis", name=quoted(name)),
            file,
            key=option_of(f"{name}={value}"),
            hint=say("change its task instead, or take it out of [assembly]"),
        )
        for name, value in pairs
        if task is not None and name_of(name) in task.mode
    ]
    misfits = [
        _no_mode(name, value, file)
        for name, value in pairs
        if name_of(name) in dyads and _value_fault(name, value, file) is None and abs(float(value)) != 1
    ]
    numbered = {group.mode: group for group in groups if group.system is not None}
    misfits += [
        _no_number(numbered[name_of(name)], name, value, file)
        for name, value in pairs
        if name_of(name) in numbered
        and _value_fault(name, value, file) is None
        and not 1 <= float(value) <= len(numbered[name_of(name)].assemblies)
    ]
    return (
        found
        + misfits
        + [
            Fault(
                say("no group of links has the assembly mode {name}", name=quoted(name)),
                file,
                key=option_of(f"{name}={value}"),
                hint=suggestion(name_of(name), known, "modes"),
            )
            for name, value in pairs
            if name_of(name) not in known
        ]
    )


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
            raise located(error, mechanism.text, file) from error
    modes = {group.mode: group.mode_value for group in groups if group.mode} | dict(wanted)
    try:
        source = with_modes(parse(mechanism.text, file), modes)
    except MechanismError as error:
        options = ", ".join(f"{mode}={value}" for mode, value in wanted.items())
        raise MechanismError(Fault(fault.message, file, key=option_of(options)) for fault in error.faults) from error
    found = description.loads(source.text, file)
    return replace(found, sketch=replace(found.sketch, doubted=False), redundant=mechanism.redundant)
