"""What no column shows: every name that a description may read has its values, computed when somebody asks for one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mechsheet.compiled.mechanism import Compiled
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.numeric import Array
from mechsheet.model import ChartRequest
from mechsheet.model.names import names_of
from mechsheet.units import LENGTH


def further_of(compiled: Compiled) -> tuple[dict[str, Array], dict[str, str]]:
    """The values of all these names, row by row as people read them, and their units: see `motion_of`.

    The equations are written once more, as for a chart of all of them: a rate that nobody reads has no equation. Nothing
    where that is refused: a driver whose values are listed says nothing of its speed.
    """
    mechanism = compiled.mechanism
    names = names_of(mechanism)
    chart = ChartRequest(None, "", names, (), ())
    try:
        whole = Compiled(replace(mechanism, charts=(*mechanism.charts, chart)), compiled.modes)
        values, exists = whole.values, whole.closed
    except MechanismError:
        return {}, {}
    own = {equation.symbol: equation.unit for equation in whole.equations.all}
    own |= {dim.symbol: dim.unit for dim in mechanism.dimensions}
    fixed = {f"{point}.{axis}" for point in mechanism.ground.points for axis in "xy"}
    columns: dict[str, Array] = {}
    units: dict[str, str] = {}
    for name in names:
        if name not in values:
            continue
        unit = mechanism.shown(LENGTH if name in fixed else own[name])
        units[name] = unit.text
        there = exists & np.isfinite(values[name])
        columns[name] = np.where(there, unit.to_shown(values[name]), np.nan)
    return columns, units
