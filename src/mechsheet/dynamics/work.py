"""The driver's effort by virtual work: what weights, forces of inertia and loads do while the driver moves by a little.

    effort = -sum of (F . X' + T theta')        a prime is the derivative by the driver's variable

The efforts of further drivers are among the F and T; a cam's force does no work on cam and follower together. Forces act at
their own places, not in the sums that the reactions are found from: a second way to the same number.
Source: d'Alembert's principle; Soeylemez, Mechanisms, chapter 5.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.formula.vectors import Vector
from mechsheet.dynamics.acting import ActingForces
from mechsheet.kinematics.build_equations import Found
from mechsheet.units import Unit
from mechsheet.words.equations import phrase

LONGEST, AROUND = 250, 12
"""Characters of the formula, as of any in a table, and of what stands around its two sums: `-(metre*()+)`. What couples do
has half of it at most, what forces do all that is left."""


def own_works(
    acting: ActingForces,
    moved: Callable[[str, Vector], Vector],
    turned: Callable[[str], Node],
) -> tuple[list[Node], list[Node]]:
    """What weights, forces of inertia, loads and springs do, and what couples do: their terms.

    moved   how the place of a link moves that is at some coordinates;  turned  how a link turns
    """
    works: list[Node] = []
    turnings: list[Node] = []
    for link in acting.poses.mechanism.links[1:]:
        own = acting.of(link.name)
        for force in own.forces[: own.own[0]]:
            works += [al.mul(part, way) for part, way in zip(force.vector, moved(link.name, force.at), strict=True)]
        turnings += [al.mul(couple, turned(link.name)) for couple in own.couples[: own.own[1]]]
    return works, turnings


def effort_by_work(acting: ActingForces, found: Found, efforts: Mapping[str, str]) -> None:
    """Write the driver's effort down, beside the one from the reactions.

    efforts  the symbols of the efforts from the reactions, by that of what is driven: what further drivers do is known

    Raises ValueError where no influence coefficients have been written.
    """
    motions, columns = found.rates.by_driver, acting.columns
    if motions is None:
        raise ValueError("virtual work needs influence coefficients")
    mechanism = found.poses.mechanism
    works, turnings = own_works(
        acting, lambda link, at: motions.motion[link](at).first, lambda link: motions.turning[link].first
    )
    effort = efforts[mechanism.driver.symbol]
    for driver in mechanism.drivers:
        if driver.symbol not in efforts:  # a cam moves it
            continue
        other = al.mul(Symbol(efforts[driver.symbol]), motions.rates.of_drive(driver.symbol).first)
        (works if driver.joint else turnings).append(other)
    slides = bool(found.poses.mechanism.driver.joint)
    if slides:
        turnings = [al.div(turning, columns.metre) for turning in turnings]
    unit: Unit = columns.force if slides else columns.torque
    label = phrase("by_work")
    of_lengths = columns.force if slides else columns.of_lengths
    turning = columns.in_parts(al.total(turnings), unit, label, LONGEST // 2)
    room = LONGEST - AROUND - columns.lengths.of(turning)
    work = columns.in_parts(al.total(works), of_lengths, label, room)
    work = work if slides else al.mul(columns.metre, work)
    columns.written(
        f"{effort.removesuffix('.t')}.work", al.neg(al.add(work, turning)), unit, label, "work", longest=LONGEST
    )
