"""What a solution says by symbol: its variables, and the outputs that the description asks for."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from livesheet.formula.nodes import symbols

from .expressions import column
from .geometry import Array
from .solution import Solution, motion_of
from .whole_mechanism import further

POLE = 1e9
"""An output of so many times its unit (or the size, of a length) is one only because rounding has missed a pole."""


def variables(solution: Solution) -> dict[str, Array]:
    """Every variable and output over the sweep by its symbol: theta1N, displacements, the driver, `P.x`, `P.y`, outputs.

    NaN in rows that do not exist, except for the driver.
    """
    found = motion_of(solution, solution.poses, solution.displacements, solution.points)
    for symbol, result in outputs(solution, found).items():
        result[~solution.exists] = np.nan
        found[symbol] = result
    return found


def outputs(solution: Solution, found: Mapping[str, Array]) -> dict[str, Array]:
    """The outputs, for any values of the variables (`found`, as `variables` names them)."""
    values: dict[str, Array] = {name: np.array(value) for name, value in solution.dimensions.items()} | dict(found)
    own = {output.symbol for output in solution.mechanism.outputs}
    if not {name for output in solution.mechanism.outputs for name in symbols(output.formula)} <= values.keys() | own:
        values = further(solution) | values
    results: dict[str, Array] = {}
    for output in solution.mechanism.outputs:
        results[output.symbol] = values[output.symbol] = column(output.formula, values, len(solution.driver))
    return results
