"""The part [assembly]: the rough position of points, angles and displacements that tells assemblies apart."""

from __future__ import annotations

from typing import Any

from livesheet.said import say
from mechsheet.description.kinds import ANGLE, LENGTH
from mechsheet.description.links import pair
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Driver, Quantity, Sketch


def read(data: dict[str, Any], driver: Driver | None, scope: Scope) -> Sketch:
    """The rough position: points by [x, y], angles and displacements by a number; `at` is in the driver's unit."""
    points: dict[str, tuple[Quantity, Quantity]] = {}
    values: dict[str, Quantity] = {}
    at: Quantity | None = None
    for name, value in data.items():
        path: Path = ("assembly", name)
        if name == "at":
            if driver is not None and value is not BAD:
                at = scope.quantity(value, LENGTH if driver.joint else ANGLE, path)
        elif isinstance(value, dict):
            continue  # a mode that the synthesis says
        elif isinstance(value, list):
            if name not in scope.points:
                hint = suggestion(name, scope.points, "points")
                scope.report.at(path, say("no link has a point {name}", name=quoted(name)), hint)
            points[name] = pair(value, path, scope)
        elif value is not BAD and name in scope.variables:
            values[name] = scope.quantity(value, scope.kinds[name], path)
        elif value is not BAD and name in scope.points:
            scope.report.at(path, say("the point {name} is sketched as [x, y]", name=quoted(name)))
        elif value is not BAD and scope.complete:
            message = say("no point, link angle or displacement is called {name}", name=quoted(name))
            if name in scope.units or name in scope.outputs:
                message = say("{name} is no point, link angle or displacement", name=quoted(name))
            names = [*scope.points, *scope.variables]
            scope.report.at(path, message, suggestion(name, names, "allowed"))
    return Sketch(points, values, at)
