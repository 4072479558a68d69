"""Which points are drawn: pins, what moves, what leaves a path."""

from __future__ import annotations

from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.rates.coefficients import free_points
from mechsheet.model import Mechanism


def moving_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points of moving links that are not fixed, in the order of the description."""
    names = dict.fromkeys(point for link in mechanism.links[1:] for point in link.points)
    return tuple(point for point in names if point not in mechanism.ground.points)


def pins_of(mechanism: Mechanism) -> tuple[str, ...]:
    """Points with a revolute joint: shared by links, or gliding in the slot of a link."""
    count: dict[str, int] = {}
    for link in mechanism.links:
        for point in link.points:
            count[point] = count.get(point, 0) + 1
    slots = {joint.point for joint in mechanism.joints if joint.kind == "pin-slot"}
    return tuple(point for point, links in count.items() if links > 1 or point in slots)


def points_with_rates(mechanism: Mechanism, equations: Equations) -> tuple[str, ...]:
    """Points that have a velocity and an acceleration."""
    points = {point for link in mechanism.links for point in link.points}
    found = (column.symbol.rpartition(".") for column in equations.columns if column.role == "rate")
    return tuple(point for point, _, part in found if part == "v" and point in points)


# --- paths -----------------------------------------------------------------------------------------------------------


def tracing_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points of a single moving link (coupler points); without any, the moving joints."""
    points = dict.fromkeys(point for link in mechanism.links for point in link.points)
    return free_points(mechanism) or tuple(point for point in points if point not in mechanism.ground.points)


def remarkable_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Traced points whose paths are neither circles about a fixed pin nor straight guides."""
    fixed = set(mechanism.ground.points)
    plain_paths = {joint.point for joint in mechanism.joints if mechanism.ground.name == joint.on}
    guided = {each.link for each in mechanism.joints if each.kind == "prismatic" and each.on == mechanism.ground.name}
    for link in mechanism.links[1:]:
        if fixed & set(link.points) or link.name in guided:
            plain_paths |= set(link.points)
    return tuple(point for point in tracing_points(mechanism) if point not in plain_paths)


def traced_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points whose paths are drawn behind the mechanism: those that have a chart, else those that deserve one."""
    asked = dict.fromkeys(point for chart in mechanism.charts for point in chart.paths)
    if not asked and not mechanism.charts:
        asked = dict.fromkeys(remarkable_points(mechanism))
    return tuple(asked) or tracing_points(mechanism)
