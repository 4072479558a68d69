"""What the first sheet can say about a mechanism: four-bar loops, links that swing or turn, slides, force transmission.

Found in the mechanism and its groups, before any cell has a place; `findings` say it as live formulas.
"""

from __future__ import annotations

import math
from collections.abc import Set
from dataclasses import dataclass
from itertools import combinations

from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.equations import Group
from mechsheet.model import BASE, CONTACT, Joint, Link, Mechanism, Synthesis
from mechsheet.sheet.columns.lowering import Assignments


@dataclass(frozen=True, slots=True)
class FourBar:
    """A loop of the ground, a link pivoted to it, and the two links of an RRR group: pins start, first, inner, end.

    `start` and `end` are the fixed pivots of `first` and `last`; `coupler` joins the pins `pin` and `inner`.
    """

    group: int
    start: str
    pin: str
    inner: str
    end: str
    first: Link
    coupler: Link
    last: Link

    @property
    def name(self) -> str:
        """The loop by its pins: A0ABB0."""
        return f"{self.start}{self.pin}{self.inner}{self.end}"

    def sides(self, ground: Link) -> tuple[tuple[Link, str, str], ...]:
        """Ground, first link, coupler and last link, each with the two pins that it joins."""
        return (
            (ground, self.start, self.end),
            (self.first, self.start, self.pin),
            (self.coupler, self.pin, self.inner),
            (self.last, self.end, self.inner),
        )


@dataclass(frozen=True, slots=True)
class Classification:
    """All that can be said.

    swings        links pivoted to the ground that the sweep moves, without the driven one
    strokes       sliding joints on the ground, without the driven one
    returning     symbols of those swings and strokes that move nothing further; they have a time ratio if the driver turns
    transmission  groups that have an angle of transmission, and that the sweep moves
    limits        True where some group can come apart, or its lines turn parallel
    rates         True where there are velocities
    forces        True where there are masses or loads;  besides: the efforts of further drivers then
    flywheel      True where the description asks for one
    newton        True where a group is solved by Newton's method
    task          from which dimensions are found
    cam           columns of a cam whose largest or smallest values are said, and that change
    """

    four_bars: tuple[FourBar, ...]
    swings: tuple[Link, ...]
    strokes: tuple[Joint, ...]
    returning: tuple[str, ...]
    transmission: tuple[Group, ...]
    limits: bool
    rates: bool = False
    forces: bool = False
    flywheel: bool = False
    newton: bool = False
    task: Synthesis | None = None
    cam: tuple[str, ...] = ()
    besides: tuple[str, ...] = ()

    @property
    def extremes(self) -> tuple[str, ...]:
        """Symbols whose smallest and largest values the lines need."""
        swings = [link.angle_symbol for link in self.swings]
        strokes = [joint.symbol for joint in self.strokes]
        groups = [group.transmission for group in self.transmission]
        return tuple(dict.fromkeys([*swings, *strokes, *groups, *self.cam]))


def classification(mechanism: Mechanism, equations: Assignments) -> Classification:
    """What can be said about a mechanism."""
    ground = mechanism.ground
    pivoted = [link for link in mechanism.links[1:] if any(point in ground.points for point in link.points)]
    driver = mechanism.driver
    loops = (_four_bar(mechanism, group, pivoted) for group in equations.groups if group.kind == "RRR")
    driven = mechanism.driven_symbols
    turned = mechanism.driven_link if driver.link else ""
    turning = [link for link in pivoted if link.name != turned and link.angle_symbol not in driven]
    names, still = {equation.symbol for equation in equations.columns}, _still(mechanism, equations)
    swings = tuple(link for link in turning if link.angle_symbol not in still)
    on_ground = (joint for joint in mechanism.joints if ground.name in (joint.on, joint.link))
    strokes = tuple(joint for joint in on_ground if joint.symbol not in driven)
    return Classification(
        tuple(loop for loop in loops if loop is not None),
        swings,
        strokes,
        _returning(mechanism, equations, swings, strokes),
        tuple(group for group in equations.groups if group.transmission in names - still),
        bool(equations.margins or equations.crossings),
        mechanism.driver.speed is not None and bool(equations.groups),
        bool(equations.equations.efforts),
        mechanism.flywheel is not None,
        any(group.system is not None for group in equations.groups),
        mechanism.synthesis,
        _of_cam(mechanism, equations, names - still),
        tuple(name for name in equations.equations.forces("besides") if name in names - still),
    )


def _of_cam(mechanism: Mechanism, equations: Assignments, moving: Set[str]) -> tuple[str, ...]:
    """How the follower is pressed, how sharp the profile is, what would hold the follower."""
    if mechanism.cam is None:
        return ()
    shape = ("rho", "contact") if mechanism.cam.radius is None else ("kappa", BASE)
    wanted = ("alpha", *shape, CONTACT, *equations.equations.forces("hold"))
    return tuple(name for name in wanted if name in moving)


def _still(mechanism: Mechanism, equations: Assignments) -> frozenset[str]:
    """Columns that are the same in every row, because they follow from dimensions alone: a driver that is set by hand."""
    given = {dimension.symbol for dimension in mechanism.dimensions} | {each.symbol for each in equations.constants}
    given |= {group.mode for group in equations.groups}
    still: set[str] = set()
    for column in equations.columns:
        before = set(column.reads_previous) - {column.symbol}  # an angle reads its own, to go on without a jump
        if (given | still).issuperset(before.union(column.reads)):
            still.add(column.symbol)
    return frozenset(still)


def _returning(
    mechanism: Mechanism, equations: Assignments, swings: tuple[Link, ...], strokes: tuple[Joint, ...]
) -> tuple[str, ...]:
    if mechanism.segments is not None:  # which may dwell at its ends, so that nobody knows when it turns back
        return ()
    newton = any(group.system is not None for group in equations.groups)  # no ratio of two times from rows alone
    if not mechanism.driver.link or not (mechanism.driver.stepped or _once_round(mechanism)) or newton:
        return ()
    final = _final_links(mechanism, equations)
    ground = mechanism.ground.name
    slides = [joint.symbol for joint in strokes if (joint.link if joint.on == ground else joint.on) in final]
    return (*(link.angle_symbol for link in swings if link.name in final), *slides)


def _once_round(mechanism: Mechanism) -> bool:
    """Whether a motion law leads the driver once round."""
    law = mechanism.driver.law
    if law is None:
        return False
    values = dimension_values(mechanism)
    return abs(abs(values[law.stop] - values[law.start]) - math.tau) < 1e-9


def _four_bar(mechanism: Mechanism, group: Group, pivoted: list[Link]) -> FourBar | None:
    """The loop that an RRR group closes with the ground and one more link that is pivoted to it."""
    fixed = mechanism.ground.points
    own = [link for link in mechanism.links if link.name in group.links]
    if len(own) != 2 or len(group.pins) != 3:
        return None
    p, q, inner = group.pins
    if (p in fixed) == (q in fixed):
        return None
    pin, end = (q, p) if p in fixed else (p, q)
    last = next((link for link in own if end in link.points and inner in link.points), None)
    coupler = next((link for link in own if pin in link.points and inner in link.points and link is not last), None)
    for first in pivoted:
        start = next((point for point in first.points if point in fixed and point != end), None)
        if first not in own and pin in first.points and start and last and coupler:
            return FourBar(group.number, start, pin, inner, end, first, coupler, last)
    return None


def _final_links(mechanism: Mechanism, equations: Assignments) -> frozenset[str]:
    """Links to which no link of a later group is joined."""
    order = {name: group.number for group in equations.groups for name in group.links}
    final = {link.name for link in mechanism.links[1:]}
    for one, other in _joined(mechanism):
        first, second = order.get(one, 0), order.get(other, 0)
        if first != second:
            final.discard(one if first < second else other)
    return frozenset(final)


def _joined(mechanism: Mechanism) -> list[tuple[str, str]]:
    """Pairs of links with a joint between them; a pin in a slot joins the slot's link to all that carry the pin."""
    carriers = {
        point: [link.name for link in mechanism.links if point in link.points]
        for link in mechanism.links
        for point in link.points
    }
    pairs = [pair for names in carriers.values() for pair in combinations(names, 2)]
    for joint in mechanism.joints:
        others = [joint.link] if joint.kind == "prismatic" else carriers[joint.point]
        pairs += [(joint.on, other) for other in others]
    return pairs
