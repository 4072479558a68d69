"""The results of a mechanism's task, by the names that its description gives them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ...model import Synthesis
from ..expressions import number
from . import crank_rocker, functions, guidance, quick_return
from .guidance import NAN


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


def _dead_centres(given: Given) -> dict[str, float]:
    psi, a1 = given.at("psi"), given.own("a1")
    phi = given.at("phi") if given.has("phi") else crank_rocker.crank_turn(given.at("time_ratio"))
    if given.has("lam"):
        found = crank_rocker.by_lam(psi, phi, a1, given.at("lam"))
    elif given.has("a2"):
        found = crank_rocker.by_crank(psi, phi, a1, given.at("a2"))
    else:
        found = crank_rocker.best(psi, phi, a1)
    crank, rocker = crank_rocker.outer(psi, phi, found.lam) if found.exists else (NAN, NAN)
    return {
        "phi": phi,
        "time_ratio": phi / (2 * math.pi - phi),
        "lam": found.lam,
        "a2": found.a2,
        "a3": found.a3,
        "a4": found.a4,
        "theta_1": cmath.phase(crank),
        "psi_1": cmath.phase(rocker),
        "mode": math.copysign(1.0, crank.imag) if found.exists else math.nan,
        "mu_min": found.mu_min,
    }


def _quick_return_slider(given: Given) -> dict[str, float]:
    stroke, ratio = given.at("stroke"), given.at("time_ratio")
    if given.has("lam"):
        found = quick_return.by_lam(stroke, ratio, given.at("lam"))
    elif given.has("c"):
        found = quick_return.by_eccentricity(stroke, ratio, given.at("c"))
    elif given.has("a2"):
        found = quick_return.by_crank(stroke, ratio, given.at("a2"))
    else:
        found = quick_return.best(stroke, ratio)
    return {
        "alpha": math.pi * (ratio - 1) / (ratio + 1),
        "lam": found.lam,
        "a2": found.a2,
        "a3": found.a3,
        "c": found.c,
        "mu_min": found.mu_min,
    }


def _guidance(given: Given) -> dict[str, float]:
    poses = [
        guidance.Pose(complex(given.at("poses", n, 0), given.at("poses", n, 1)), given.at("poses", n, 2))
        for n in range(3)
    ]
    first, second = (crank_of(given, poses, name) for name in ("A", "B"))
    body = second.moving - first.moving
    own = (poses[0].place - first.moving) * abs(body) / body if body else NAN
    found = {
        "a1": abs(second.fixed - first.fixed),
        "a2": first.length,
        "a3": abs(body),
        "a4": second.length,
        "theta_1": cmath.phase(first.moving - first.fixed),
        "gamma_1": cmath.phase(body),
        "u_P": own.real,
        "v_P": own.imag,
    }
    for name, crank in (("A", first), ("B", second)):
        found |= {f"x_{name}": crank.moving.real, f"y_{name}": crank.moving.imag}
        found |= {f"x_{name}0": crank.fixed.real, f"y_{name}0": crank.fixed.imag}
        found |= {f"beta_{name}{n}": turn for n, turn in zip((2, 3), crank.turns, strict=True)}
    there = [guidance.carried(poses, crank.moving) for crank in (first, second)]
    sides = [((second.fixed - a).conjugate() * (b - a)).imag for a, b in zip(*there, strict=True)]
    found["mode"] = (1.0 if np.sum(np.sign(sides)) > -0.5 else -1.0) if first.exists and second.exists else math.nan
    return found


def crank_of(given: Given, poses: Sequence[guidance.Pose], name: str) -> guidance.Crank:
    """One of the two cranks that guide a body, by what is given of it."""
    if given.has(name, "turns", 0):
        return guidance.by_turns(poses, (given.at(name, "turns", 0), given.at(name, "turns", 1)))
    if given.has(name, "moving", 0):
        return guidance.by_moving(poses, complex(given.at(name, "moving", 0), given.at(name, "moving", 1)))
    return guidance.by_fixed(poses, complex(given.at(name, "fixed", 0), given.at(name, "fixed", 1)))


KINDS: Mapping[str, Callable[[Given], dict[str, float]]] = {
    "function": _function,
    "dead-centres": _dead_centres,
    "guidance": _guidance,
    "quick-return-slider": _quick_return_slider,
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
    return {task.results[name]: value for name, value in found.items() if task.results[name] in task.steps}
