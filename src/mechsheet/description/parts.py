"""What can be read of a description that is not finished: links, points, sliding joints, whether it is sound or not.

Whoever draws a mechanism has no driver yet, or a link that hangs on nothing. The same modules read it as read a finished
description; what they find wrong is the reader's to tell (`loads`), here it is only left out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from mechsheet.description import dimensions, joints, links, sketch
from mechsheet.description.asked import synthesis
from mechsheet.description.driving import driver
from mechsheet.description.grammar import Key, Named
from mechsheet.description.report import BAD, Report
from mechsheet.description.schema import DESCRIPTION, LINK
from mechsheet.description.scope import part, scope_of
from mechsheet.description.shape import fit
from mechsheet.description.text.source import Source
from mechsheet.model import Dimension, Driver, Joint, Link, Sketch
from mechsheet.units import Unit

UNFINISHED = replace(DESCRIPTION, keys={**DESCRIPTION.keys, "links": Key(Named(LINK, "link"), "rigid links")})
"""A description with any number of links: what is drawn begins with the ground alone."""


@dataclass(frozen=True, slots=True)
class Parts:
    """The readable parts of a description.

    numbers    dimension -> its value in internal units; only those that have one
    orders     name of a sliding joint -> its place among the joints of the file, from 0
    relations  how many gears, belts and racks it lists
    driver     None where there is none yet, or a faulty one
    """

    dimensions: tuple[Dimension, ...]
    numbers: Mapping[str, float]
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    orders: Mapping[str, int]
    driver: Driver | None
    sketch: Sketch
    relations: int
    length_unit: str
    angle_unit: Unit

    def link(self, name: str) -> Link | None:
        """The link of that name."""
        return next((link for link in self.links if link.name == name), None)

    def links_at(self, point: str) -> tuple[Link, ...]:
        """The links that name a point."""
        return tuple(link for link in self.links if point in link.points)


def parts_of(source: Source) -> Parts:
    """The parts of a description of which the text is sound TOML. Faults are nobody's here."""
    report = Report(source)
    data = fit(source.data, UNFINISHED, (), report)
    scope = scope_of(part(data, "mechanism", {}), report)
    given, bodies = dimensions.spelled_out(part(data, "dimensions", {}), scope), part(data, "links", {})
    listed = part(data, "joints", [])
    bare = links.declare(bodies, scope)
    dimensions.declare(given, scope)
    table = dimensions.read(given, scope, synthesis.Found())
    made = links.read(bodies, bare, scope)
    ends = joints.Ends(bodies, made, scope)
    sliding = joints.read(listed, ends, scope)
    motion = data.get("driver", BAD)
    driven = driver.read(motion, made, sliding, ends, scope) if made and motion is not BAD else None
    ties = sum(1 for entry in listed if entry is not BAD and entry["type"] in joints.RELATIONS)
    return Parts(
        table,
        {symbol: value for symbol, value in scope.numbers.items() if math.isfinite(value)},
        made,
        sliding,
        _orders(sliding, listed),
        driven,
        sketch.read(part(data, "assembly", {}), driven, scope),
        ties,
        scope.length_unit,
        scope.angle_unit,
    )


def _orders(sliding: tuple[Joint, ...], listed: list[Any]) -> dict[str, int]:
    """Where each sliding joint stands: faulty ones, gears, belts and racks stand between them."""
    found: dict[str, int] = {}
    for joint in sliding:
        for order, entry in enumerate(listed):
            if order in found.values() or entry is BAD or entry["type"] != joint.kind:
                continue
            if (entry["point"], entry["on"], entry.get("symbol", joint.symbol)) == (
                joint.point,
                joint.on,
                joint.symbol,
            ):
                found[joint.name] = order
                break
    return found
