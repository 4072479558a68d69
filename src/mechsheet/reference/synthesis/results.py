"""The results of a mechanism's task, by the names that its description gives them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from ...model import Synthesis
from ..expressions import number
from . import functions, quick_return


class Given:
    """What the task gives, in internal units."""

    def __init__(self, task: Synthesis, numbers: Mapping[str, float]) -> None:
        self.task, self.numbers = task, numbers

    def has(self, *place: str | int) -> bool:
        """Whether the task gives something there."""
        return place in self.task.task

    def at(self, *place: str | int) -> float:
        """The number that stands there."""
        return self.numbers[self.task.task[place]]

    def own(self, name: str) -> float:
        """A length that is given, by the task or as a dimension, and is a result as it is."""
        return self.numbers[self.task.results[name]]


def _function(given: Given) -> dict[str, float]:
    theta, psi = pairs(given)
    found = functions.function(theta, psi, given.own("a1"))
    sides = functions.sides(found, theta, psi)
    return {
        "a2": found.a2,
        "a3": found.a3,
        "a4": found.a4,
        "theta_offset": found.theta_offset,
        "psi_offset": found.psi_offset,
        "mode": (1.0 if np.sum(sides) > -0.5 else -1.0) if found.exists else math.nan,
    }


def pairs(given: Given) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(n,) and (n,) the pairs of angles of a function generator, radians; of a function those of Chebyshev's spacing."""
    count = int(given.task.chosen["points"])
    if given.task.function is None:
        theta = [given.at("theta", place) for place in range(count)]
        return np.array(theta), np.array([given.at("psi", place) for place in range(count)])
    wanted = given.task.function
    x = functions.chebyshev(given.at("x", 0), given.at("x", 1), count)
    f = np.array([number(wanted, {"x": float(place)}) for place in x])
    ends = [number(wanted, {"x": given.at("x", place)}) for place in (0, 1)]
    theta, psi = ([given.at(key, place) for place in (0, 1)] for key in ("theta", "psi"))
    in_proportion = (x - given.at("x", 0)) / (given.at("x", 1) - given.at("x", 0))
    risen = (f - ends[0]) / (ends[1] - ends[0])
    return theta[0] + (theta[1] - theta[0]) * in_proportion, psi[0] + (psi[1] - psi[0]) * risen


def _quick_return_lever(given: Given) -> dict[str, float]:
    stroke, ratio, crank = given.at("stroke"), given.at("time_ratio"), given.own("crank")
    found = quick_return.slotted_lever(stroke, ratio, crank)
    return {
        "centre": found.centre,
        "lever": found.lever,
        "half_swing": math.pi / 2 * (ratio - 1) / (ratio + 1),
        "swing": 2 * found.half_swing,
        "offset": quick_return.whitworth(ratio, crank),
    }


KINDS: Mapping[str, Callable[[Given], dict[str, float]]] = {
    "function": _function,
    "quick-return-lever": _quick_return_lever,
}


def results(task: Synthesis, numbers: Mapping[str, float]) -> dict[str, float]:
    """The symbol of each result that follows from the task -> its exact value in internal units; NaN where there is none.

    `numbers` are the values of the task's inputs, and of dimensions that give what it leaves out.
    """
    if not all(math.isfinite(numbers[symbol]) for symbol in task.inputs):
        return {symbol: math.nan for symbol in task.results.values() if symbol in task.steps}
    with np.errstate(all="ignore"):
        found = KINDS[task.kind](Given(task, numbers))
    return {task.results[name]: value for name, value in found.items()}
