"""From a mechanism to its equations; where there are none, with a reason that helps.

`build_equations` writes the equations. What a fault may be mended by is found by solving other mechanisms: without a link,
at another position.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.build_equations import Further, standing, write_equations, write_stepped
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.doubts.sketched import with_position
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.mobility import MobilityError
from mechsheet.kinematics.modes import BetweenModesError, NeverClosesError
from mechsheet.kinematics.newton.singular_start import DeadStartError, with_neighbour
from mechsheet.kinematics.redundancy import redundancy_faults
from mechsheet.model import Mechanism


def solve(mechanism: Mechanism, modes: Mapping[str, int] | None = None, further: Further | None = None) -> Equations:
    """The equations of a mechanism, in order of solution.

    modes    assembly modes that are given instead of picked from the sketch, by symbol (`mode_1`)
    further  what else is to be written; without it outputs of forces are left out
    Raises MechanismError: mobility, a group that nothing here solves, a sketch between two modes, a group that never closes.
    """
    try:
        return write_stepped(mechanism, modes, further)
    except MobilityError as error:
        raise _with_redundant(error, mechanism) from error
    except DeadStartError as error:
        rows = [float(row) for row in driver_values(mechanism, dimension_values(mechanism))]
        raise with_neighbour(
            error, mechanism, rows, lambda at: write_equations(standing(mechanism, at), modes or {}, outputs=False)
        ) from error
    except (BetweenModesError, NeverClosesError) as error:
        if mechanism.sketch.at is not None or modes:
            raise
        raise MechanismError(with_position(fault, mechanism) for fault in error.faults) from error


def solve_unpicked(mechanism: Mechanism) -> Equations:
    """The equations with every mode +1, whatever the sketch says and even where nothing closes so."""
    try:
        return write_equations(mechanism, None)
    except MobilityError as error:
        raise _with_redundant(error, mechanism) from error


def _with_redundant(error: MobilityError, mechanism: Mechanism) -> MechanismError:
    """Of what moves although it is counted as rigid it is told what may be left out."""
    found = redundancy_faults(mechanism, error.missing) if error.missing > 0 else []
    if not found:
        return error
    hint = say("it moves all the same: some of its links or joints say what others say already")
    return MechanismError([replace(error.faults[0], hint=hint), *found])
