"""How large a flywheel must be: what the torque's deviations from its mean store and give back in a turn.

    E(theta) = integral of (T12 - mean), by trapezia;    J = (max E - min E) / (fluctuation omega^2)

E is what the flywheel has given: where it is largest the shaft turns slowest.
Source: Norton, Design of Machinery, chapter 11.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Mechanism


@dataclass(frozen=True, slots=True)
class Flywheel:
    """mean  of the torque;  energy  E row by row (n,);  change: its largest less its smallest;  inertia: the moment of
    inertia that is needed. Energy in the torque's unit, inertia in that over (rad/s)^2."""

    mean: float
    energy: Array
    change: float
    inertia: float


def flywheel(mechanism: Mechanism, equations: Equations, values: Mapping[str, Array]) -> Flywheel | None:
    """What a flywheel must do; None where none is asked for.

    values  of all symbols over a sweep, in internal units: the torque T12 (n,), NaN where a row has none, over the driver's
            angle (n,) [rad]; the coefficient of fluctuation and the driver's speed [rad/s]

    Where a row has no torque nothing but NaN comes out.
    """
    if mechanism.flywheel is None:
        return None
    torque, driver = values[equations.efforts[0]], values[mechanism.driver.symbol]
    work = np.concatenate([[0.0], np.cumsum((torque[1:] + torque[:-1]) / 2 * np.diff(driver))])
    mean = float(work[-1] / (driver[-1] - driver[0]))
    energy = work - mean * (driver - driver[0])
    change = float(np.ptp(energy))
    fluctuation, speed = (float(values[name][0]) for name in (mechanism.flywheel.symbol, mechanism.driver_rates[0]))
    return Flywheel(mean, energy, change, change / (fluctuation * speed**2))
