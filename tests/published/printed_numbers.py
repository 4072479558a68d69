"""The text's published numbers, and its own formulas, transcribed as printed."""

from __future__ import annotations

import csv
import tomllib
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from folders import ROOT, TEMPLATES
from mechsheet.description import Overrides, load
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism

Array = NDArray[np.float64]

DATA = ROOT / "tests" / "data" / "published"

CUT_PI = 3.1415926
"""The text's PI."""

SETTINGS = (20, 50, 100, 150, 200, 250)
"""s1 in the columns of the pump's table."""


@cache
def worked_values() -> dict[str, Any]:
    """Single values printed in the text."""
    return tomllib.loads((DATA / "worked-values.toml").read_text(encoding="utf-8"))


def table(name: str) -> Array:
    """A published table without its heading."""
    with (DATA / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    return np.array(rows[1:], dtype=float)


def template(name: str, **overrides: str) -> tuple[Mechanism, Equations]:
    """A template, with dimensions changed, and its equations."""
    mechanism = load(TEMPLATES / f"{name}.toml", Overrides(overrides))
    return mechanism, solve(mechanism)


def at(mechanism: Mechanism, equations: Equations, driver: Array) -> dict[str, Array]:
    """All variables at the given driver values."""
    return sweep(mechanism, equations, np.asarray(driver, dtype=float))


def dimensions(name: str) -> dict[str, float]:
    """A template's dimensions in internal units."""
    return dimension_values(load(TEMPLATES / f"{name}.toml"))


def pump_as_printed(degrees: Array, s1: float, sign: float, pi: float) -> Array:
    """s15 by the text's solution of the pump, with s sin(phi) = sign s1 + a2 sin(theta12).

    pi enters twice in the text's routines: in the conversion to radians and in AçıCos (arccos by way of the arctangent).
    """
    a2, a3, a4, b1, c4 = 55.0, 240.0, 165.0, 185.0, 70.0
    theta = degrees * pi / 180
    x, y = b1 + a2 * np.cos(theta), sign * s1 + a2 * np.sin(theta)
    s, phi = np.hypot(x, y), np.arctan2(y, x)
    cosine = (a4**2 + s**2 - a3**2) / (2 * a4 * s)
    psi = pi / 2 - np.arctan(cosine / np.sqrt(1 - cosine**2))
    arm = phi - psi  # direction B0B; the slot is parallel to it, c4 aside
    along = (s1 - c4 * np.cos(arm)) / -np.sin(arm)
    return np.asarray(b1 - c4 * np.sin(arm) - along * np.cos(arm))


def four_bar_theta14_config(theta12: Array, config: int) -> Array:
    """The text's DörtÇubuk: phi - Config psi, ground along x."""
    a1, a2, a3, a4 = (worked_values()["four-bar"]["dimensions"][name] for name in ("a1", "a2", "a3", "a4"))
    x, y = a2 * np.cos(theta12) - a1, a2 * np.sin(theta12)
    s, phi = np.hypot(x, y), np.arctan2(y, x)
    psi = np.arccos((a4**2 + s**2 - a3**2) / (2 * a4 * s))
    return np.asarray(phi - config * psi)
