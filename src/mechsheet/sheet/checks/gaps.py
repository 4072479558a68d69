"""How far a group's links are from fitting together in a row: measured as with a ruler, from lengths and points alone.

Of each link the distances of its points against those of the description; of each sliding joint how far its point is from
where the displacement puts it on the line. Lengths and places come from the description (`geometry`), not from the
equations, so that a damaged formula cannot vouch for itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, walk
from livesheet.formula.printer import longest_spelling, print_formula
from mechsheet.kinematics.points_in_link import angle_of
from mechsheet.model import Joint, Link
from mechsheet.sheet.geometry import base_point, distance, measured_pairs, place
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
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
    return formula('IFERROR(most,"")', most=al.nested("MAX", parts))


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
