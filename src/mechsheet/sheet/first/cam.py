"""What the first sheet says of a cam: pressure angle, the sharpest place of its profile, leaps between segments.

All is said of the rows as they stand. A column that has no number in some row is asked for its numbers only.
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, Text
from livesheet.formula.scalar import evaluate
from livesheet.workbook import Style
from mechsheet.model import LAWS_THAT_LEAP, TAU, Segment, Segments
from mechsheet.sheet import styles
from mechsheet.sheet.classification import segments_of
from mechsheet.sheet.first.verdict_lines import VerdictLines
from mechsheet.sheet.quoted import ALL, SHOWN, formula, joined
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import places

LEAPT = 1e-9
"""A step of a derivative, in sizes a radian, that is more than rounding."""

_NUMBERS = ">-1E+300"
"""What every number is."""


def write(block: VerdictLines) -> None:
    """The lines."""
    mechanism = block.plan.mechanism
    if mechanism.cam is not None:
        _pressure(block)
        _sharpest(block)
    motion = segments_of(mechanism)
    if motion is not None:
        _leaps(block, motion, 1, "velocity_leaps", styles.BAD)
        _leaps(block, motion, 2, "acceleration_leaps", styles.WARN)


def _pressure(block: VerdictLines) -> None:
    """The largest pressure angle, either way."""
    key, column = "pressure_angle", Symbol(f"{ALL}alpha")
    value = formula('MAX(MAXIFS(all,all,">0"),-MINIFS(all,all,"<0"))', all=column)
    cam, degrees = block.plan.mechanism.cam, block.plan.mechanism.angle_unit.in_degrees
    usual = al.as_node(cam.pressure_angle if cam else 0.0)
    known = (
        Symbol(SHOWN + usual.name) if isinstance(usual, Symbol) else formula("DEGREES(x)" if degrees else "x", x=usual)
    )
    limit = block.plan.at.bind(known, block.plan.main)
    words = formula("IF(value>limit,much,fine)", value=block.value(key), limit=limit, much=block.text(f"{key}.much"),
                    fine=block.text(f"{key}.fine"))  # fmt: skip
    unit = block.plan.mechanism.angle_unit
    block.line(key, rich("alpha"), unit.text, value, places(block.plan, "angle"), block.where_it_closes(words))
    there = "IFERROR(MATCH(value,all,0),MATCH(-value,all,0))"
    block.at(key, _place(block, there, value=block.value(key), all=column))
    block.colour(key, "value>limit", styles.WARN, value=block.value(key), limit=limit)
    block.colour(key, "value<=limit", styles.GOOD, value=block.value(key), limit=limit)


def _sharpest(block: VerdictLines) -> None:
    """The least radius of curvature where the profile is convex; where there is none left the cutter cuts too much away."""
    plan, key, column = block.plan, "least_rho", Symbol(f"{ALL}rho")
    cam = plan.mechanism.cam
    roller = cam is not None and cam.radius is not None
    curved = Symbol(f"{ALL}kappa")
    value = (
        formula(f'MINIFS(all,all,"{_NUMBERS}",curved,">0")', all=column, curved=curved)
        if roller
        else formula(f'MINIFS(all,all,"{_NUMBERS}")', all=column)
    )
    cell = block.value(key)
    fine: Node = Text(block.text(f"{key}.fine"))
    undercut: Node = Text(block.text(f"{key}.undercut"))
    if roller:
        hollow = formula('COUNTIFS(curved,"<0")', curved=curved)
        cutter = formula(f'-MAXIFS(all,all,"{_NUMBERS}",curved,"<0")', all=column, curved=curved)
        concave = joined(block.text(f"{key}.concave"), " ", formula("ROUND(cutter,2)", cutter=cutter))
        fine = joined(fine, formula('IF(hollow>0,concave,"")', hollow=hollow, concave=concave))
    elif plan.mechanism.cam is not None and not plan.mechanism.drivers[0].link:  # rho grows as the base circle does
        radius = plan.at.bind(al.as_node(plan.mechanism.cam.base_radius), plan.main)
        needed = formula("ROUND(radius-value,3)", radius=radius, value=cell)
        undercut = joined(undercut, block.text(f"{key}.needed"), " ", needed)
    words = formula("IF(value>0,fine,undercut)", value=cell, fine=fine, undercut=undercut)
    style = styles.decimals(styles.RESULT, places(plan, "length"))
    block.line(key, rich("rho"), plan.mechanism.length_unit, value, style, block.where_it_closes(words))
    block.at(key, _place(block, "MATCH(value,all,0)", value=cell, all=column))
    block.colour(key, "value<=0", styles.BAD, value=cell)
    block.colour(key, "value>0", styles.GOOD, value=cell)


def _place(block: VerdictLines, row: str, **holes: Node) -> Node:
    drivers = Symbol(ALL + block.plan.mechanism.driver.symbol)
    return formula(f'IFERROR(INDEX(drivers,{row}),"")', drivers=drivers, **holes)


def _leaps(block: VerdictLines, motion: Segments, order: int, key: str, style: Style) -> None:
    """Angles at which a derivative leaps: where segments meet, and in the middle of a parabolic one."""
    most = al.number(LEAPT * block.plan.size)
    count: Node = al.ZERO
    where: list[Node | str] = []
    degrees = block.plan.mechanism.angle_unit.in_degrees
    for angle, step in _steps(motion, order):
        leaps = formula("ABS(step)>most", step=step, most=most)
        count = al.add(count, formula("IF(leaps,1,0)", leaps=leaps))
        shown = formula("ROUND(DEGREES(angle),2)" if degrees else "ROUND(angle,4)", angle=angle)
        where.append(formula('IF(leaps,at,"")', leaps=leaps, at=joined(" ", shown, block.unit)))
    some = joined(block.text(key), *where) if where else Text("")
    words = formula("IF(count=0,none,some)", count=block.value(key), none=block.text(f"{key}.none"), some=some)
    block.line(key, block.text(f"{key}.symbol"), "", count, 0, words)
    block.colour(key, "count>0", style, count=block.value(key))
    block.colour(key, "count=0", styles.GOOD, count=block.value(key))


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
