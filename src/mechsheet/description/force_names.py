"""What forces, mass centres and what is found from all of them are called, where a description has masses or loads."""

from __future__ import annotations

import itertools
from collections.abc import Collection
from typing import Any

from livesheet.said import Said, say
from mechsheet.description.kinds import ANY, LENGTH
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import (
    POINT_RATES,
    SHAKING,
    Cam,
    Driver,
    FurtherDriver,
    Joint,
    Link,
    Relation,
    center_symbol,
    pair_symbol,
)
from mechsheet.model.names import joint_forces

WEIGHTS = ("mass", "center", "inertia")
"""Keys of a link that has a mass."""

POWER, SHAKES = "driver's power", "shaking force"
CENTER, CENTER_MOVES = "mass centre", "velocity or acceleration of a mass centre"
MOMENTS = ("couple", "driving torque", "torque of a belt")
OF_MOTION = (POWER, SHAKES, CENTER_MOVES)
"""What there is only where the driver has a speed."""


def first_key(bodies: dict[str, Any], loads: list[Any]) -> Path | None:
    """Where the first mass or load stands; None where there is none."""
    for name in bodies:
        for key in keys_of(bodies, name):
            return ("links", name, key)
    return ("loads", 0) if loads else None


def keys_of(bodies: dict[str, Any], name: str) -> list[str]:
    """The keys of a link that give it a mass."""
    entry = bodies.get(name)
    return [key for key in WEIGHTS if isinstance(entry, dict) and key in entry]


def declare(
    bodies: dict[str, Any], loads: list[Any], links: tuple[Link, ...], joints: tuple[Joint, ...], driver: Driver | None,
    further: tuple[FurtherDriver, ...], relations: tuple[Relation, ...], cam: Cam | None, scope: Scope,
) -> None:  # fmt: skip
    """Enter all these names, which must be free, where there are masses or loads."""
    path = first_key(bodies, loads)
    if path is None:
        return
    for name, what in joint_forces(links, joints, driver, further, relations, cam).items():
        scope.forces[name] = what
        scope.kinds[name] = ANY
        if "." not in name:
            scope.symbols.claim(name, what, path, say("rename it: the description has masses or loads"))
            _no_point(
                name,
                say("the point has the name of a joint force: {name}.x would be a part of either", name=name),
                scope,
            )
    _note_undriven(links, [*further, *([driver] if driver else [])], scope)
    if driver is not None and "power" not in (
        *scope.units,
        *scope.outputs,
    ):  # a name of the description's own comes first
        scope.forces["power"] = POWER
        scope.kinds["power"] = ANY
    _declare_masses(bodies, links, scope)


def _note_undriven(links: tuple[Link, ...], drivers: list[Driver | FurtherDriver], scope: Scope) -> None:
    """The efforts that there would be, were each pin driven: who names one may have forgotten its driver."""
    numbers = {link.name: link.number for link in links}
    driven = {frozenset((each.link, each.relative_to or links[0].name)) for each in drivers}
    for owners in scope.points.values():
        for against, link in itertools.permutations((name for name in owners if name in numbers), 2):
            if frozenset((against, link)) not in driven:
                scope.undriven[pair_symbol("T", numbers[against], numbers[link])] = (link, against)


def _declare_masses(bodies: dict[str, Any], links: Collection[Link], scope: Scope) -> None:
    """The shaking force; mass centres that are no points of their links."""
    weighed = [link for link in list(links)[1:] if keys_of(bodies, link.name)]
    if any({"mass", "inertia"} & {*keys_of(bodies, link.name)} for link in weighed):
        scope.forces |= dict.fromkeys(SHAKING, SHAKES)
        scope.kinds |= dict.fromkeys(SHAKING, ANY)
        _no_point(
            "shaking", say("the point has the name of the shaking force: shaking.x would be a part of either"), scope
        )
    for link in weighed:
        center = bodies[link.name].get("center")
        name = center_symbol(link.number)
        if center is None and len(link.points) == 1:
            center = next(iter(link.points))
        if "mass" not in bodies[link.name] or center is None:
            continue
        if isinstance(center, str):
            scope.centers[name] = center
            continue
        for part in ("x", "y", *POINT_RATES):
            scope.forces[f"{name}.{part}"] = CENTER if part in ("x", "y") else CENTER_MOVES
            scope.kinds[f"{name}.{part}"] = LENGTH if part in ("x", "y") else ANY
        other = say(
            "the point has the name of the mass centre of {link}: {name}.x would be a part of either",
            link=quoted(link.name),
            name=name,
        )
        hint = say('rename it, or write center = "{name}" where it is the mass centre', name=name)
        _no_point(name, other, scope, hint)


def _no_point(name: str, message: Said, scope: Scope, hint: str = "") -> None:
    for link in scope.points.get(name, ())[:1]:
        scope.report.at(("links", link, "points", name), message, hint or say("rename it"))
