"""A link that nobody has marked as redundant: where one is, and it does not matter which, it is marked in the text."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

from mechsheet import description
from mechsheet.description.text.rewrite import with_value
from mechsheet.description.text.source import parse
from mechsheet.diagnostics import MechsheetError
from mechsheet.model import Mechanism


def with_redundant(mechanism: Mechanism, file: str = "<text>") -> Mechanism:
    """The mechanism with a redundant link left out of what has to be solved; as it is where none is found.

    The mark (`redundant = true`) stands in its text, and so travels in the workbook. `file` is what messages call the text.
    """
    from mechsheet.kinematics.graph import graph_of
    from mechsheet.kinematics.mobility import mobility

    if mobility(graph_of(mechanism)) != len(mechanism.drivers):
        return mechanism
    from mechsheet.kinematics.redundancy import redundant_links

    names = redundant_links(mechanism)
    for name in names:
        with suppress(MechsheetError):  # one whose points are given by distances cannot be marked
            source = with_value(parse(mechanism.text, file), ("links", name, "redundant"), "true")
            found = description.loads(source.text, file)
            also = tuple(other for other in names if other != name)
            marked = tuple(replace(each, also=also) if each.link.name == name else each for each in found.redundant)
            sketch = replace(found.sketch, doubted=mechanism.sketch.doubted)
            return replace(found, redundant=marked, sketch=sketch, file=mechanism.file)
    return mechanism
