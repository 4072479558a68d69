"""What is checked in every row: whether the links fit together, in the same assembly, and velocities and forces found twice.

Gaps are measured as with a ruler: of each link the distances of its points against those of the description; of each
sliding joint how far its point is from where the displacement puts it on the line. Lengths and places come from the
description (`geometry`), not from the equations, so that a damaged formula cannot vouch for itself.

Velocities and accelerations fit where both ways round each group give its closing point the same ones: measured from
points, velocities and accelerations, not by the equations that these were found from. As a length: the difference over
the angular velocities in it (their squares and the angular accelerations). What a cam moves rests at times, where all of
these are 0 or rounding, as each program has it: there it is over a small part of the cam's own.

A group that Newton's method solves stays in its assembly where each unknown goes on nearly as it went. The determinant's
sign is asked where the position itself is (`lowering`): a row with the other sign is none. Among assemblies of one sign a
leap shows in the unknowns: from row to row each changes as in the rows before, up to `LEAP`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import islice
from typing import Literal, TypeAlias

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, Symbol, symbols, walk
from livesheet.formula.printer import longest_spelling, print_formula
from mechsheet.kinematics.equations import JOINT_FORCES
from mechsheet.kinematics.newton.changed_dimensions import LEAP
from mechsheet.kinematics.points_in_link import angle_of
from mechsheet.model import Joint, Link
from mechsheet.sheet.geometry import base_point, distance, largest_length, measured_pairs, place
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.units import ANGLE, LENGTH, Unit
from mechsheet.words.equations import link_words

LONGEST = 380
"""Characters of one formula; what does not fit takes a further column."""


def gap_columns(plan: Plan, sheet: str, row: int) -> list[tuple[int, Node]]:
    """(number of the group, largest gap) of each column, as formulas of `sheet` for a row of the table of positions.

    An empty text in rows where the group is not joined.
    """
    found = []
    for number in range(1, len(plan.equations.groups) + 1) or [0]:
        parts = [plan.at.bind(part, sheet, row) for part in _parts(plan, number)]
        found += [(number, _largest(chunk)) for chunk in chunks_of(parts)]
    return found


def chunks_of(parts: Sequence[Node]) -> list[list[Node]]:
    """The parts in runs whose spellings stay below a length together."""
    runs: list[list[Node]] = []
    room = 0
    for part in parts:
        length = longest_spelling(part) + 1
        if not runs or length > room:
            runs.append([])
            room = LONGEST - 20
        runs[-1].append(part)
        room -= length
    return runs


def _largest(parts: Sequence[Node]) -> Node:
    return formula('IFERROR(most,"")', most=al.largest(parts))


def _parts(plan: Plan, number: int) -> list[Node]:
    """Differences of lengths, over columns and dimensions. The driven link is measured with the first group's loop."""
    mechanism = plan.mechanism
    order = {name: group.number for group in plan.equations.groups for name in group.links}
    found = []
    for link in mechanism.whole_links[1:]:
        if max(1, order.get(link.name, 0)) == max(1, number):
            found += _lengths(link)
    for joint in mechanism.joints:
        if max(1, order.get(joint.link, 0), order.get(joint.on, 0)) == max(1, number):
            found += _slide(plan, joint)
    return found


def _lengths(link: Link) -> list[Node]:
    """The distances that the description gives, and those from the second point: they hold a link's points in place."""
    pairs = [*measured_pairs(link)]
    points = list(link.points)
    known = {frozenset(pair) for pair in pairs}
    further = [(points[1], point) for point in points[2:] if frozenset((points[1], point)) not in known]
    # of points laid off from others that are laid off themselves the distance is no formula to be read
    pairs += [pair for pair in further if _is_short(distance(link, *pair), LONGEST // 2)]
    return [
        formula(
            "ABS(SQRT((x_end-x_start)^2+(y_end-y_start)^2)-length)",
            **_coordinates("start", start), **_coordinates("end", end), length=distance(link, start, end),
        )
        for start, end in pairs
    ]  # fmt: skip


def _is_short(node: Node, most: int) -> bool:
    """Whether a formula has at most so many characters. Every node of it is one at least, and they are counted no further:
    what is laid off from others ten times over is a tree of millions."""
    return len([*islice(walk(node), most + 1)]) <= most and len(print_formula(node, "text")) <= most


def _coordinates(name: str, point: str) -> dict[str, Node]:
    return {f"x_{name}": Symbol(f"{point}.x"), f"y_{name}": Symbol(f"{point}.y")}


def _slide(plan: Plan, joint: Joint) -> list[Node]:
    """The distance of the joint's point from where its displacement puts it; nothing where the joint alone says where its
    carrier is."""
    links = {link.name: link for link in plan.mechanism.links}
    carrier = links[joint.on]
    angle = al.ZERO if carrier is plan.mechanism.ground else Symbol(carrier.angle_symbol)
    through = _through(plan, joint, carrier, angle)
    if through is None:
        return []
    direction = al.add(angle, angle_of(joint.angle).expression())
    return [
        formula(
            "SQRT((x_point-x_line-along*COS(direction))^2+(y_point-y_line-along*SIN(direction))^2)",
            **_coordinates("point", joint.point), x_line=through[0], y_line=through[1],
            along=Symbol(joint.symbol), direction=direction,
        )
    ]  # fmt: skip


def _through(plan: Plan, joint: Joint, carrier: Link, angle: Node) -> tuple[Node, Node] | None:
    """(x, y) of the point that the line passes, over columns."""
    if isinstance(joint.through, str):
        return Symbol(f"{joint.through}.x"), Symbol(f"{joint.through}.y")
    u, v = (al.as_node(quantity) for quantity in joint.through)
    if carrier is plan.mechanism.ground:
        return u, v
    base = base_point(carrier)
    if not base:
        return None
    base_u, base_v = place(carrier, base)
    u, v = al.sub(u, base_u), al.sub(v, base_v)
    turned = {"u": u, "v": v, "angle": angle, **_coordinates("base", base)}
    return (
        formula("x_base+u*COS(angle)-v*SIN(angle)", **turned),
        formula("y_base+u*SIN(angle)+v*COS(angle)", **turned),
    )


def misfits_of(plan: Plan) -> list[tuple[str, int]]:
    """What redundant links are called, and the group of which each is the first link."""
    groups = {name: group.number for group in plan.equations.groups for name in group.links}
    return [
        (link_words(each.link).of(plan.mechanism.language), groups[each.link.name]) for each in plan.mechanism.redundant
    ]


RESTING = 1e-9
"""What turns by less than this part of the cam's speed rests: all that is left of it is rounding."""

Rate: TypeAlias = Literal["velocity", "acceleration"]
Size: TypeAlias = Literal["velocity_size", "acceleration_size"]

Column: TypeAlias = tuple[Rate | Size, int, Node]

_BY_RATE: tuple[tuple[Rate, Size, str], ...] = (
    ("velocity", "velocity_size", "ABS(rate)"),
    ("acceleration", "acceleration_size", "rate^2"),
)
"""What is checked, by what it is measured, and how an angular velocity counts in that."""


def fit_columns(plan: Plan, sheet: str, row: int, begins: CellRef) -> list[Column]:
    """(what, number of the group, formula) of each column, as formulas of `sheet` for a row of the table.

    How fast the links of each group turn, then the largest difference measured by that: an empty text in rows without
    velocities. begins: the first cell of the first column.
    """
    found: list[Column] = []
    for what, scale, size in _BY_RATE:
        parts_of = {number: getattr(parts, what) for number, parts in plan.equations.equations.fits.items()}
        sizes = {}
        for number, parts in parts_of.items():
            sizes[number] = replace(begins, col=begins.col + len(found))
            node = plan.at.bind(_size(plan, what, number, parts, size), sheet, row)
            found.append((scale, number, formula('IFERROR(scale,"")', scale=node)))
        for number, parts in parts_of.items():
            whole = [
                formula("ABS(part)/scale", part=plan.at.bind(each, sheet, row), scale=sizes[number]) for each in parts
            ]
            found += [(what, number, _largest(chunk)) for chunk in chunks_of(whole)]
    return found


def _size(plan: Plan, what: Rate, number: int, parts: Sequence[Node], size: str) -> Node:
    """How fast the links of a group turn, which its differences are measured by: the sum over what is read of its own."""
    group = plan.equations.groups[number - 1]
    own = {*plan.mechanism.driver_rates, *(eq.symbol for eq in plan.equations.columns if eq.group == group.number)}
    known = _rates(plan)
    rates = [
        name for name in dict.fromkeys(name for part in parts for name in symbols(part)) if name in own & known.keys()
    ]
    speeds = [name for name in rates if known[name].per == 1]
    turning = {name: _turning(plan, name, known[name]) for name in rates}
    scale = al.total(formula(size, rate=turning[name]) for name in speeds)
    scale = al.total([scale, *(Call("ABS", (turning[name],)) for name in rates if name not in speeds)])
    if plan.mechanism.segments is not None:
        scale = formula("MAX(scale,rest*cam)", scale=scale, rest=RESTING, cam=_of_cam(plan, what))
    return scale


def _of_cam(plan: Plan, what: Rate) -> Node:
    speed, acceleration = (Symbol(name) for name in plan.mechanism.driver_rates)
    if what == "velocity":
        return formula("ABS(speed)", speed=speed)
    return formula("(speed^2+ABS(acceleration))", speed=speed, acceleration=acceleration)


def _rates(plan: Plan) -> dict[str, Unit]:
    """Velocities and accelerations, the driver's too; not coefficients of points, which stand for their velocities."""
    driver = LENGTH if plan.mechanism.driver.joint else ANGLE
    speed, acceleration = plan.mechanism.driver_rates
    found = {equation.symbol: equation.unit for equation in plan.equations.columns if equation.role == "rate"}
    return {speed: driver.per_time(), acceleration: driver.per_time().per_time()} | found


def _turning(plan: Plan, name: str, unit: Unit) -> Node:
    """A sliding velocity over the largest length, which is what an angular one would be."""
    if unit.kind == "angle":
        return Symbol(name)
    return formula("rate/(longest)", rate=Symbol(name), longest=largest_length(plan.equations))


ArrivedKind = Literal["assembly", "residual", "needed", "det"]


def assembly_columns(plan: Plan, sheet: str, begun: CellRef) -> list[tuple[ArrivedKind, int, Node]]:
    """(kind, number of the group, formula for the first row): 1 in a row that may be of another assembly than the one
    before, and of rows that have a position the residual, the passes needed, |det|.

    begun  how many stretches of positions have begun by the first row

    A row behind rows without a position counts as another assembly: nobody knows how the mechanism came there.
    """
    found: list[tuple[ArrivedKind, int, Node]] = []
    first = plan.at.first
    for group in plan.equations.groups:
        system = group.system
        if system is None:
            continue
        steps = []
        for name in system.variables:
            here, before, earlier = (plan.at.cell(name, sheet, first - back) for back in range(3))
            angle = plan.equations.of(name).unit.kind == "angle"
            most = plan.size * math.radians(LEAP)
            if angle:
                most = LEAP if plan.at.spots[name].degrees else round(math.radians(LEAP), 4)
            trend = formula("ABS(IFERROR(here-2*before+earlier,here-before))/most", here=here, before=before,
                            earlier=earlier, most=most)  # fmt: skip
            steps.append(trend)
        here, before = (plan.at.cell(system.variables[0], sheet, first - back) for back in (0, 1))
        node = formula(
            "IF(ISNUMBER(here),IF(ISNUMBER(before),IFERROR(IF(largest>1,1,0),0),IF(begun>1,1,0)),0)",
            here=here, before=before, begun=begun, largest=Call("MAX", tuple(steps)),
        )  # fmt: skip
        found.append(("assembly", group.number, node))
        kept: tuple[tuple[ArrivedKind, Node], ...] = (
            ("residual", plan.at.cell(system.residual, sheet, first)),
            ("needed", plan.places.starts[group.number].needed.in_row(first)),
            ("det", Call("ABS", (plan.at.cell(system.determinant, sheet, first),))),
        )
        for kind, cell in kept:
            found.append((kind, group.number, formula('IF(ISNUMBER(here),value,"")', here=here, value=cell)))
    return found


Effort = tuple[Literal["torque", "effort", "force"], int, Node]

AGREES = 1e-9
"""Efforts that differ by less than this part of the largest term are the same."""


def effort_columns(plan: Plan, sheet: str, row: int) -> list[Effort]:
    """(what, 0, formula of `sheet` for a row of the table); an empty text in rows without forces.

    torque  by how much the effort from the reactions and that by virtual work differ, as a part of itself and of the
            largest joint force (at the largest length, where it is a torque)
    """
    if not plan.efforts:
        return []
    effort, work = (Symbol(name) for name in plan.efforts)
    normal = plan.equations.equations.forces("normal")
    forces = tuple(
        Call("ABS", (Symbol(name),)) if name in normal else Symbol(name)
        for name in plan.equations.equations.forces(*JOINT_FORCES)
    )
    largest: Node = Call("MAX", forces) if forces else formula("0*effort", effort=effort)
    scale = largest
    if plan.equations.of(plan.efforts[0]).unit.kind == "moment":
        metre = plan.mechanism.dynamics.metre if plan.mechanism.dynamics else None
        scale = formula("metre*lever*force", metre=metre or 1.0, lever=largest_length(plan.equations), force=largest)
    differ = formula("ABS(effort-work)/MAX(ABS(effort)+scale,1E-300)", effort=effort, work=work, scale=scale)
    found: list[tuple[Literal["torque", "effort", "force"], Node]] = [
        ("torque", differ), ("effort", Call("ABS", (effort,))),
    ]  # fmt: skip
    if forces:
        found.append(("force", largest))
    return [(kind, 0, plan.at.bind(formula('IFERROR(value,"")', value=value), sheet, row)) for kind, value in found]
