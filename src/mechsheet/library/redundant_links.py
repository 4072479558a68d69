"""Links that nobody has marked as redundant: where there are any, and it does not matter which, the text marks them."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import replace

from mechsheet.description.reader import read_again
from mechsheet.description.text.rewrite import with_value
from mechsheet.description.text.source import parse
from mechsheet.diagnostics import MechsheetError
from mechsheet.model import Mechanism


def with_redundant(mechanism: Mechanism, file: str = "<text>") -> Mechanism:
    """The mechanism with redundant links left out of what has to be solved; as it is where none are found.

    The mark (`redundant = true`) stands in its text, and so travels in the workbook. `file` is what messages call the text.
    """
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
            found = read_again(mechanism, source.text, file)
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
