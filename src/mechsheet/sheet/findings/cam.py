"""What is said of a cam: pressure angle, the sharpest place of its profile, leaps between segments.

All is said of the rows as they stand. A column that has no number in some row is asked for its numbers only.
"""

from __future__ import annotations

from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, Text
from livesheet.formula.scalar import evaluate
from mechsheet.model import LAWS_THAT_LEAP, TAU, Segment, Segments
from mechsheet.sheet.findings.finding import Finding, Level, Line, bad, good, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.quoted import ALL, SHOWN, formula, joined
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import places

LEAPT = 1e-9
"""A step of a derivative, in sizes a radian, that is more than rounding."""

_NUMBERS = ">-1E+300"
"""What every number is."""


class PressureAngle(Finding):
    """The largest pressure angle, either way."""

    key, placed = "pressure_angle", True

    def line(self, on: Reading) -> Line:
        value, column = on.value(self.key), Symbol(f"{ALL}alpha")
        largest = formula('MAX(MAXIFS(all,all,">0"),-MINIFS(all,all,"<0"))', all=column)
        cam, unit = on.plan.mechanism.cam, on.plan.mechanism.angle_unit
        usual = al.as_node(cam.pressure_angle if cam else 0.0)
        known = (
            Symbol(SHOWN + usual.name)
            if isinstance(usual, Symbol)
            else formula("DEGREES(x)" if unit.in_degrees else "x", x=usual)
        )
        limit = on.plan.at.bind(known, on.plan.main)
        words = formula("IF(value>limit,much,fine)", value=value, limit=limit, much=on.text(f"{self.key}.much"),
                        fine=on.text(f"{self.key}.fine"))  # fmt: skip
        row = "IFERROR(MATCH(value,all,0),MATCH(-value,all,0))"
        return Line(
            rich("alpha"), largest, on.where_it_closes(words), unit.text, places(on.plan, "angle"),
            place=on.driver_in_row(row, value=value, all=column),
            levels=(look("value>limit", value=value, limit=limit), good("value<=limit", value=value, limit=limit)),
        )  # fmt: skip


class LeastRadius(Finding):
    """The least radius of curvature where the profile is convex; where there is none left the cutter cuts too much away."""

    key, placed = "least_rho", True

    def line(self, on: Reading) -> Line:
        plan, value, column, curved = on.plan, on.value(self.key), Symbol(f"{ALL}rho"), Symbol(f"{ALL}kappa")
        cam = plan.mechanism.cam
        roller = cam is not None and cam.radius is not None
        convex = ',curved,">0"' if roller else ""
        least = formula(f'MINIFS(all,all,"{_NUMBERS}"{convex})', all=column, curved=curved)
        fine: Node = Text(on.text(f"{self.key}.fine"))
        undercut: Node = Text(on.text(f"{self.key}.undercut"))
        if roller:
            hollow = formula('COUNTIFS(curved,"<0")', curved=curved)
            cutter = formula(f'-MAXIFS(all,all,"{_NUMBERS}",curved,"<0")', all=column, curved=curved)
            concave = joined(on.text(f"{self.key}.concave"), " ", formula("ROUND(cutter,2)", cutter=cutter))
            fine = joined(fine, formula('IF(hollow>0,concave,"")', hollow=hollow, concave=concave))
        elif cam is not None and not plan.mechanism.drivers[0].link:  # rho grows as the base circle does
            radius = plan.at.bind(al.as_node(cam.base_radius), plan.main)
            needed = formula("ROUND(radius-value,3)", radius=radius, value=value)
            undercut = joined(undercut, on.text(f"{self.key}.needed"), " ", needed)
        words = formula("IF(value>0,fine,undercut)", value=value, fine=fine, undercut=undercut)
        return Line(
            rich("rho"), least, on.where_it_closes(words), plan.mechanism.length_unit, places(plan, "length"),
            place=on.driver_in_row("MATCH(value,all,0)", value=value, all=column),
            levels=(bad("value<=0", value=value), good("value>0", value=value)),
        )  # fmt: skip


class Leaping(Finding):
    """Angles at which a derivative of the motion leaps: where segments meet, and in the middle of a parabolic one."""

    def __init__(self, key: str, motion: Segments, order: int, kind: Literal["bad", "look"]) -> None:
        self.key, self.motion, self.order, self.kind = key, motion, order, kind

    def line(self, on: Reading) -> Line:
        cell, most = on.value(self.key), al.number(LEAPT * on.plan.size)
        count: Node = al.ZERO
        where: list[Node | str] = []
        degrees = on.plan.mechanism.angle_unit.in_degrees
        for angle, step in _steps(self.motion, self.order):
            leaps = formula("ABS(step)>most", step=step, most=most)
            count = al.add(count, formula("IF(leaps,1,0)", leaps=leaps))
            shown = formula("ROUND(DEGREES(angle),2)" if degrees else "ROUND(angle,4)", angle=angle)
            where.append(formula('IF(leaps,at,"")', leaps=leaps, at=joined(" ", shown, on.unit)))
        some = joined(on.text(self.key), *where) if where else Text("")
        words = formula("IF(count=0,none,some)", count=cell, none=on.text(f"{self.key}.none"), some=some)
        return Line(
            on.text(f"{self.key}.symbol"), count, words,
            levels=(Level(self.kind, formula("count>0", count=cell)), good("count=0", count=cell)),
        )  # fmt: skip


def _steps(motion: Segments, order: int) -> list[tuple[Node, Node]]:
    """Where a derivative may leap, and by how much."""
    found: list[tuple[Node, Node]] = []
    parts = motion.parts
    before: Node = al.ZERO
    if motion.closed:
        before = _at_end(parts, -1, order, 1.0)
    for place, part in enumerate(parts):
        found.append((part.begins, al.sub(_at_end(parts, place, order, 0.0), before)))
        if order == 2 and part.law == "parabolic":
            twice = al.mul(al.number(8.0), al.div(part.by, al.square(part.over)))
            found.append((al.add(part.begins, al.div(part.over, al.TWO)), twice))
        before = _at_end(parts, place, order, 1.0)
    return [(angle, step) for angle, step in found if not al.is_zero(step)]


def _at_end(parts: tuple[Segment, ...], place: int, order: int, tau: float) -> Node:
    part = parts[place]
    factor = evaluate(part.way[order], {TAU: tau}) if part.law in LAWS_THAT_LEAP else 0.0
    if abs(factor) < LEAPT:
        return al.ZERO
    over = part.over if order == 1 else al.square(part.over)
    return al.mul(al.number(factor), al.div(part.by, over))
