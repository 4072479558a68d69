"""Gears as pitch circles with a mark, belts as the lines between their pulleys, racks as toothed bars.

Pitch radii follow from the distance of the axes and the ratio i: |i / (i - 1)| and |1 / (i - 1)| of it. Pulleys have
no size in the description: they are drawn in the ratio, together half as large as their distance.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, symbols
from livesheet.formula.scalar import evaluate
from livesheet.workbook import Series
from mechsheet.kinematics.equations import LinkPose
from mechsheet.model import Gear, Link, Mechanism, Rack
from mechsheet.sheet import styles
from mechsheet.sheet.checks.geometry import length_in_cells
from mechsheet.sheet.drawing.frames import CHART_X, CHART_Y, FIRST, NAME, SECOND, Frame, Page
from mechsheet.sheet.drawing.points import PointCells
from mechsheet.sheet.drawing.shapes import Guide, filled, local_path, series_of
from mechsheet.sheet.quoted import formula

CORNERS = 48
"""Of a circle."""

TEETH = 24
TOOTH = 0.014
"""Half the height of a rack's tooth, in the chart's units."""

WIDTH = 1.25
ALIKE = 1e-9
"""A ratio that differs from 1 by less has no pitch circles."""


@dataclass(frozen=True, slots=True)
class Wheel:
    """A circle about a point that turns with a link. `radius`: over dimensions and constants."""

    link: Link
    axis: str
    radius: Node

    @property
    def key(self) -> tuple[str, str, Node]:
        """What tells it from other wheels."""
        return self.link.name, self.axis, self.radius


@dataclass(frozen=True, slots=True)
class Belt:
    """Two pulleys, the one on `on` first; `crossed`: 1, or -1 where the belt is crossed."""

    wheels: tuple[Wheel, Wheel]
    crossed: float


def axis_between(wheel: Link, arm: Link) -> str:
    """The point about which a wheel turns on its arm."""
    return next(point for point in wheel.points if point in arm.points)


def wheels_of(
    mechanism: Mechanism, poses: Mapping[str, LinkPose], values: Mapping[str, float]
) -> tuple[list[Wheel], list[Belt]]:
    """All wheels, each once, and the belts; `values`: those of all dimensions."""
    links = {link.name: link for link in mechanism.links}
    wheels: list[Wheel] = []
    belts: list[Belt] = []
    for relation in mechanism.relations:
        wheel, arm = links[relation.link], links[relation.arm]
        if isinstance(relation, Rack):
            wheels.append(Wheel(wheel, axis_between(wheel, arm), Call("ABS", (relation.radius,))))
            continue
        pair = _pair(relation, links, poses, values)
        if pair is None:
            continue
        wheels += pair
        ratio = evaluate(relation.ratio, values)
        if relation.kind == "belt" or abs(ratio - 1) < ALIKE:
            belts.append(Belt(pair, 1.0 if ratio > 0 else -1.0))
    found: list[Wheel] = []
    for each in wheels:
        if not any(_alike(each, other, values) for other in found):
            found.append(each)
    return found, [
        Belt((_known(belt.wheels[0], found, values), _known(belt.wheels[1], found, values)), belt.crossed)
        for belt in belts
    ]


def _alike(one: Wheel, other: Wheel, values: Mapping[str, float]) -> bool:
    """Whether two circles are one: a planet has one pitch circle, with the sun and with the ring."""
    if one.link is not other.link or one.axis != other.axis:
        return False
    if one.radius == other.radius:
        return True
    if not {*symbols(one.radius), *symbols(other.radius)} <= values.keys():
        return False
    return math.isclose(evaluate(one.radius, values), evaluate(other.radius, values), rel_tol=ALIKE)


def _known(wheel: Wheel, found: Sequence[Wheel], values: Mapping[str, float]) -> Wheel:
    return next(other for other in found if _alike(wheel, other, values))


def _pair(
    gear: Gear, links: Mapping[str, Link], poses: Mapping[str, LinkPose], values: Mapping[str, float]
) -> tuple[Wheel, Wheel] | None:
    """Both wheels, the one on `on` first; None for wheels about one axis."""
    arm = links[gear.arm]
    on, link = links[gear.on], links[gear.link]
    start, end = axis_between(on, arm), axis_between(link, arm)
    if start == end:
        return None
    length = length_in_cells(arm, start, end, poses)
    if gear.kind == "gear" and abs(evaluate(gear.ratio, values) - 1) >= ALIKE:
        most = formula("ABS(ratio/(ratio-1))*length", ratio=gear.ratio, length=length)
        least = formula("length/ABS(ratio-1)", ratio=gear.ratio, length=length)
    else:
        most = formula("length*ABS(ratio)/(2+2*ABS(ratio))", ratio=gear.ratio, length=length)
        least = formula("length/(2+2*ABS(ratio))", ratio=gear.ratio, length=length)
    return Wheel(on, start, most), Wheel(link, end, least)


def shown_name(link: Link, page: Page) -> str:
    """What people call a link."""
    return link.label.of(page.plan.language) if link.label else link.name


class Wheels:
    """The wheels of one drawing, their radii and angles in cells."""

    def __init__(self, page: Page, values: Mapping[str, float]) -> None:
        plan = page.plan
        self.page = page
        self.wheels, self.belts = wheels_of(plan.mechanism, plan.equations.poses, values)
        self.radii: dict[tuple[str, str, Node], CellRef] = {}
        self.angles: dict[tuple[str, str, Node], CellRef] = {}
        if not self.wheels:
            return
        page.section(plan.text("drawing.wheels"), [plan.text("drawing.radius"), plan.text("drawing.angle")])
        for wheel in self.wheels:
            page.put(NAME, shown_name(wheel.link, page), styles.LABEL)
            self.radii[wheel.key] = page.formula(FIRST, plan.at.bind(wheel.radius, page.title))
            fixed = wheel.link is plan.mechanism.ground
            self.angles[wheel.key] = page.formula(
                SECOND, al.ZERO if fixed else page.at_position(wheel.link.angle_symbol)
            )
            page.row += 1

    def around(self, point: str) -> list[CellRef]:
        """The radii of the wheels about a point."""
        return [self.radii[wheel.key] for wheel in self.wheels if wheel.axis == point]

    def series(self, frame: Frame, cells: Mapping[str, PointCells], colors: Mapping[str, str]) -> list[Series]:
        """Circles and belts; `colors` of the links by name."""
        found = [self._circle(wheel, frame, cells[wheel.axis], colors[wheel.link.name]) for wheel in self.wheels]
        for belt in self.belts:
            found += [self._belt(belt, frame, cells, side) for side in (1.0, -1.0)]
        return found

    def _circle(self, wheel: Wheel, frame: Frame, centre: PointCells, color: str) -> Series:
        """From the centre to the mark on the rim, and once around."""
        page, start = self.page, self.page.row
        path = [(0.0, 0.0), *((360.0 * corner / CORNERS, 1.0) for corner in range(CORNERS + 1))]
        name = page.plan.text("drawing.wheel", link=shown_name(wheel.link, page))
        local_path(page, name, path)
        turned = {
            "turn": CellRef(start, FIRST, col_abs=True), "out": CellRef(start, SECOND, col_abs=True),
            "radius": al.div(self.radii[wheel.key], frame.half), "angle": self.angles[wheel.key],
        }  # fmt: skip
        x = formula("x+out*radius*COS(angle+RADIANS(turn))", x=centre.chart_x, **turned)
        y = formula("y+out*radius*SIN(angle+RADIANS(turn))", y=centre.chart_y, **turned)
        filled(page, start, x, y)
        return series_of(page, name, start, color, WIDTH)

    def _belt(self, belt: Belt, frame: Frame, cells: Mapping[str, PointCells], side: float) -> Series:
        """One of the two straight parts: where both circles have one tangent.

        With e the direction from the first axis to the second and n across it, both radii point along
        u = e cos b + n sin b, cos b = (r1 - r2) / distance, r2 with a minus for a crossed belt.
        """
        page, start = self.page, self.page.row
        one, other = belt.wheels
        a, b = cells[one.axis], cells[other.axis]
        first, second = (al.div(self.radii[wheel.key], frame.half) for wheel in belt.wheels)
        second = al.mul(al.number(belt.crossed), second)
        way = {"x_a": a.chart_x, "y_a": a.chart_y, "x_b": b.chart_x, "y_b": b.chart_y}
        square = formula("SUMSQ(x_b-x_a,y_b-y_a)", **way)
        cosine = page.formula(FIRST, formula("(one-other)/SQRT(square)", one=first, other=second, square=square))
        root = formula("SQRT(MAX(0,1-cosine^2))", cosine=cosine)
        page.formula(SECOND, al.neg(root) if side < 0 else root)
        sine = CellRef(page.row, SECOND, True, True)
        ux = formula("((x_b-x_a)*c-(y_b-y_a)*s)/SQRT(square)", c=cosine, s=sine, square=square, **way)
        uy = formula("((y_b-y_a)*c+(x_b-x_a)*s)/SQRT(square)", c=cosine, s=sine, square=square, **way)
        name = page.plan.text("drawing.belt", link=shown_name(other.link, page))
        for radius, at in ((first, a), (second, b)):
            page.put(NAME, name if page.row == start else "")
            page.formula(CHART_X, al.add(at.chart_x, al.mul(radius, ux)))
            page.formula(CHART_Y, al.add(at.chart_y, al.mul(radius, uy)))
            page.row += 1
        return series_of(page, name, start, styles.SERIES[0], WIDTH)


def racks(
    page: Page, frame: Frame, guides: Sequence[Guide], cells: Mapping[str, PointCells], colors: Mapping[str, str]
) -> list[Series]:
    """The toothed bars: on the pitch line, as long as the stroke and a little more, moving with what carries the teeth."""
    mechanism = page.plan.mechanism
    links = {link.name: link for link in mechanism.links}
    found = []
    for rack in (relation for relation in mechanism.relations if isinstance(relation, Rack)):
        guide = next(guide for guide in guides if guide.joint.symbol == rack.joint)
        moving = rack.arm == guide.joint.on
        bar = guide.joint.link if moving else guide.joint.on
        axis = cells[axis_between(links[rack.link], links[rack.arm])]
        start = page.row
        zigzag = [(step / (2 * TEETH), TOOTH if step % 2 else -TOOTH) for step in range(2 * TEETH + 1)]
        name = page.plan.text("drawing.rack", link=shown_name(links[bar], page))
        local_path(page, name, zigzag)
        bound = page.plan.at.bind(rack.radius, page.title)
        offset = al.mul(al.number(-1.0 if moving else 1.0), al.div(bound, frame.half))
        slid = al.div(page.at_position(rack.joint), frame.half)
        # from the pinion's axis along the line: what of the bar lies beside it in the other positions
        first = al.sub(slid, guide.end) if moving else al.sub(guide.start, slid)
        along = formula(
            "first+part*(end-start)",
            first=first,
            part=CellRef(start, FIRST, col_abs=True),
            end=guide.end,
            start=guide.start,
        )
        across = al.add(offset, CellRef(start, SECOND, col_abs=True))
        place = {"along": along, "across": across, "c": guide.cosine, "s": guide.sine}
        x = formula("x+along*c-across*s", x=axis.chart_x, **place)
        y = formula("y+along*s+across*c", y=axis.chart_y, **place)
        filled(page, start, x, y)
        found.append(series_of(page, name, start, colors[bar], WIDTH))
    return found
