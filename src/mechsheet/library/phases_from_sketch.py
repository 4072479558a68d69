"""Phases of gears, belts and racks that a description leaves to its sketch, where the turns of what they read count.

A sketch shows an angle, not in which of its turns it is: with a ratio of 0.5 a turn more of one wheel is half a turn of the
other. The turns follow from the motion, from the first position to the one that is sketched.
"""

from __future__ import annotations

from mechsheet.description.reader import read_again
from mechsheet.description.text.rewrite import number_text, with_value
from mechsheet.description.text.source import parse
from mechsheet.diagnostics import MechsheetError
from mechsheet.model import Gear, Mechanism

DEGREES_WRITTEN = 1
"""Decimals of a phase [deg] that is read off a sketch; of other ones two more."""


def with_phases(mechanism: Mechanism, file: str = "<text>") -> Mechanism:
    """The mechanism with the phases that its sketch shows, where those that were read off it are of another turn.

    They stand in its text, and so travel in the workbook. `file` is what messages call the text.
    """
    if not any(relation.read_off for relation in mechanism.relations):
        return mechanism
    from mechsheet.kinematics.sketched import out_of_phase
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
        return read_again(mechanism, source.text, file)
    except MechsheetError:  # whoever solves it hears why
        return mechanism
