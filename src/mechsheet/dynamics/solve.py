"""The equations of a mechanism with its forces, where it has masses or loads."""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.dynamics.acting import ActingForces
from mechsheet.dynamics.reactions import Reactions
from mechsheet.dynamics.whole_mechanism import Wholes, effort_by_work
from mechsheet.kinematics.build_equations import Found
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.solve import solve as solve_motion
from mechsheet.model import Mechanism


def solve(mechanism: Mechanism, modes: Mapping[str, int] | None = None) -> Equations:
    """The equations of positions and rates (see `kinematics.solve.solve`), and those of the forces behind them."""
    return solve_motion(mechanism, modes, _add_forces)


def _add_forces(found: Found) -> None:
    if found.poses.mechanism.dynamics is None:
        return
    acting = ActingForces(found)
    efforts = Reactions(acting).write()
    effort_by_work(acting, efforts)
    Wholes(acting).write(efforts[found.order.drive.symbol])
