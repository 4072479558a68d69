"""Random tasks of synthesis, as the table `[synthesis]` of a description has them, every choice from one seed.

Rounded to what a person would type. Most have a solution, none is chosen for having one.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

Task = dict[str, Any]

FOR_NOTHING = 0.08
"""So many tasks have no solution on purpose."""


def function(random: np.random.Generator) -> Task:
    """Pairs of angles, the output forwards or backwards; every fourth task has more of them than three."""
    count = int(random.choice([3, 3, 3, 4, 5, 6])) if random.random() < 0.75 else 3
    theta = random.uniform(-60, 120) + np.sort(random.uniform(0, 150, count)) + 8 * np.arange(count)
    psi = random.uniform(0, 180) + random.choice([1, -1]) * (
        np.sort(random.uniform(0, 100, count)) + 5 * np.arange(count)
    )
    if random.random() < FOR_NOTHING:  # the same pair twice, a turn apart
        theta[1], psi[1] = theta[0] + 360, psi[0]
    return {"kind": "function", "theta": rounded(theta), "psi": rounded(psi), "a1": length(random)}


def dead_centres(random: np.random.Generator) -> Task:
    """A swing with the crank's turn or the time ratio, and each of the three ways to choose among the solutions."""
    psi = round(float(random.uniform(15, 120)), 1)
    task: Task = {"kind": "dead-centres", "psi": psi, "a1": length(random)}
    phi = float(random.uniform(max(95 + psi / 2, 140), 240))
    if random.random() < 0.5:
        task["phi"] = round(phi, 1)
    else:
        task["time_ratio"] = round(phi / (360 - phi), 3)
    way = random.choice(["lam", "a2", "best"])
    if way == "lam":
        task["lam"] = round(float(math.exp(random.uniform(0.1, 2.5))), 3)
    elif way == "a2":
        task["a2"] = round(task["a1"] * float(random.uniform(0.1, 0.7)), 2)
    else:
        task["best"] = True
    return task


def guidance(random: np.random.Generator) -> Task:
    """Three poses, and for each pivot one of its three ways."""
    first = random.uniform(-50, 50, 2)
    first, steps = np.round(first), np.round(np.cumsum(random.uniform(-60, 60, (2, 2)), axis=0), 1)
    turns = np.cumsum(random.uniform(5, 60, 2)) * random.choice([1, -1])
    angle = random.uniform(-90, 90)
    if random.random() < FOR_NOTHING:  # the body only slides along a line
        steps[1], turns = 2 * steps[0], np.zeros(2)
    poses = [[*rounded(first), rounded([angle])[0]]]
    for step, turn in zip(steps, turns, strict=True):
        poses.append([*rounded(first + step), rounded([angle + turn])[0]])
    pivots = [pivot(random, first, side) for side in (-1, 1)]
    return {"kind": "guidance", "poses": poses, "A": pivots[0], "B": pivots[1]}


def pivot(random: np.random.Generator, near: np.ndarray, side: int) -> Task:
    way = str(random.choice(["moving", "fixed", "turns"]))
    if way == "turns":
        return {"turns": rounded(np.cumsum(random.uniform(10, 80, 2)) * random.choice([1, -1]))}
    away = np.array([side * random.uniform(10, 60), random.uniform(-60, 60)])
    return {way: rounded(near + away)}


def quick_return_slider(random: np.random.Generator) -> Task:
    """A stroke with its time ratio, and each of the four ways to choose among the solutions."""
    stroke = length(random)
    task: Task = {"kind": "quick-return-slider", "stroke": stroke, "time_ratio": ratio(random)}
    way = random.choice(["lam", "c", "a2", "best"])
    if way == "lam":
        task["lam"] = round(float(math.exp(random.uniform(0.1, 2.5))), 3)
    elif way == "c":
        task["c"] = round(stroke * float(random.uniform(0.02, 1.5)), 2)
    elif way == "a2":
        task["a2"] = round(stroke * float(random.uniform(0.2, 0.55)), 2)
    else:
        task["best"] = True
    return task


def quick_return_lever(random: np.random.Generator) -> Task:
    stroke = length(random)
    crank = round(stroke * float(random.uniform(0.1, 0.9)), 2)
    time_ratio = 0.9 if random.random() < FOR_NOTHING else ratio(random)
    return {"kind": "quick-return-lever", "stroke": stroke, "time_ratio": time_ratio, "crank": crank}


KINDS: dict[str, Callable[[np.random.Generator], Task]] = {
    "function": function,
    "dead-centres": dead_centres,
    "guidance": guidance,
    "quick-return-slider": quick_return_slider,
    "quick-return-lever": quick_return_lever,
}


def task(kind: str, seed: int) -> Task:
    """The task of a kind that belongs to a seed."""
    return KINDS[kind](np.random.default_rng([seed, *map(ord, kind)]))


TEMPLATES = {
    "function": "function-generator",
    "dead-centres": "crank-rocker-swing",
    "guidance": "rigid-body-guidance",
    "quick-return-slider": "quick-return-slider",
    "quick-return-lever": "quick-return-lever",
}
"""A packaged description for each kind."""

_TABLE = re.compile(r"^\[synthesis\]\n.*?(?=^\[)", re.MULTILINE | re.DOTALL)


def description(asked: Task) -> str:
    """The packaged description of a kind with another task."""
    text = (Path(__file__).parents[1] / "templates" / f"{TEMPLATES[asked['kind']]}.toml").read_text(encoding="utf-8")
    table = "".join(f"{key} = {toml(value)}\n" for key, value in asked.items())
    return _TABLE.sub(f"[synthesis]\n{table}\n", text, count=1)


def toml(value: Any) -> str:
    """A value as TOML writes it."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value).lower()


def length(random: np.random.Generator) -> float:
    return float(round(float(random.uniform(20, 300)), 1))


def ratio(random: np.random.Generator) -> float:
    return float(round(float(random.uniform(1.05, 2.5)), 2))


def rounded(values: Any) -> list[float]:
    return [float(round(float(value), 2)) for value in values]
