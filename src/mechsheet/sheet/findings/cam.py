"""What is said of a cam: how it presses, how sharp its profile is, how fast its follower becomes, leaps between segments."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from itertools import pairwise
from typing import Literal

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Text
from livesheet.formula.scalar import evaluate
from mechsheet.kinematics.cams.segments import way_over
from mechsheet.kinematics.numeric import Array, value
from mechsheet.kinematics.search import Extremes
from mechsheet.model import (
    BASE,
    CONTACT,
    LAWS_THAT_LEAP,
    TAU,
    Cam,
    FurtherDriver,
    Mechanism,
    Segment,
    Segments,
    Spring,
    Way,
)
from mechsheet.sheet.findings.finding import Finding, Level, Line, bad, good, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import EXACT, Expected, SearchedMotion
from mechsheet.sheet.over_rows import AS_LARGE, row_of_size
from mechsheet.sheet.quoted import ALL, SHOWN, formula, joined
from mechsheet.sheet.shown import rich, shown_unit, unit_of_column
from mechsheet.sheet.table.positions import decimals_of_kind, decimals_of_unit

SAME = 1e-12
"""Two values that differ by so small a part of themselves are one."""

LEAPT = 1e-9
"""A step of a derivative, in sizes a radian, that is more than rounding."""

PIECES = 5 * EXACT
"""So much of its range an extreme may be off: where pieces of a law meet probes settle less fast."""

POLE = 1e3
"""What reaches so many times beyond its rows has a pole between them: a search finds no extreme."""

NEAR = 1e-6
"""A search looks so far [parts of a segment] before and behind a place for a leap, and asks nothing of words that a value
decides which is so near, as a part of itself, to where they change."""

STEEP = 1e-3
"""A law changes by less within that; a leap of one is larger."""

TAUS = np.linspace(0.0, 1.0, 4001)
"""Parts of a segment at which a search looks how fast it becomes."""

TRAPEZOID, SINE = 8 * math.pi / (2 + math.pi), 4 * math.pi / (4 + math.pi)
FACTORS: dict[str, tuple[float, float, float]] = {
    "dwell": (0.0, 0.0, 0.0),
    "uniform": (1.0, 0.0, 0.0),
    "parabolic": (2.0, 4.0, 0.0),
    "harmonic": (math.pi / 2, math.pi**2 / 2, math.pi**3 / 2),
    "cycloidal": (2.0, 2 * math.pi, 4 * math.pi**2),
    "3-4-5": (1.875, 10 / math.sqrt(3), 60.0),
    "4-5-6-7": (2.1875, 84 / 25 * math.sqrt(5), 52.5),
    "modified trapezoid": (2.0, TRAPEZOID, 4 * math.pi * TRAPEZOID),
    "modified sine": (SINE, math.pi * SINE, 4 * math.pi**2 * SINE),
}
"""The largest f', f'', f''' of each law, leaps at its ends aside."""


class PressureAngle(Finding):
    """The largest pressure angle, either way; of a face that slides it is the same everywhere, and has no place."""

    key, by_rows = "pressure_angle", True
    needs = ("rates",)

    def __init__(self, cam: Cam, changes: bool) -> None:
        self.cam, self.placed = cam, changes

    def line(self, on: Reading) -> Line:
        value = on.value(self.key)
        largest, place = on.largest_size(self.key, "alpha")
        unit, usual = on.plan.mechanism.angle_unit, al.as_node(self.cam.pressure_angle)
        shown = "DEGREES(x)" if unit.in_degrees else "x"
        known = Symbol(SHOWN + usual.name) if isinstance(usual, Symbol) else formula(shown, x=usual)
        limit = on.plan.at.bind(known, on.plan.main)
        much = on.text(f"{self.key}.much") + ("" if self.cam.offset is not None else on.text("cam.study"))
        words = formula("IF(value>limit,much,fine)&doubt", value=value, limit=limit, much=much,
                        fine=on.text(f"{self.key}.fine"), doubt=_doubt(on, "alpha", "max", "min"))  # fmt: skip
        return Line(
            rich("alpha"), largest, on.where_it_closes(words), unit.text, decimals_of_kind(on.plan, "angle"), occurs=place,
            levels=(look("value>limit", value=value, limit=limit), good("value<=limit", value=value, limit=limit)),
        )  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        found, allowed = _extremes(motion, self.key, "alpha")
        if found is None:
            return {}
        low, at_low, high, at_high = found
        most, place = (abs(high), at_high) if abs(high) >= abs(low) else (abs(low), at_low)
        scale, limit = motion.angle_scale, _number(motion, self.cam.pressure_angle)
        words = _either(motion, most, limit, f"{self.key}.fine", f"{self.key}.much")
        expected = {self.key: Expected([most * scale], allowed * scale, words=words)}
        if not self.placed:
            return expected
        return expected | motion.where(
            self.key, place, lambda rows: most - np.abs(motion.search.known(rows)["alpha"]), allowed
        )


class LeastRadius(Finding):
    """The least radius of curvature where the profile is convex; where there is none left the cutter cuts too much away.

    A roller's is 1/kappa - r where the pitch curve is bent most.
    """

    key, placed, by_rows = "least_rho", True, True
    needs = ("rates",)

    def __init__(self, cam: Cam) -> None:
        self.cam = cam

    def line(self, on: Reading) -> Line:
        plan, value, cam = on.plan, on.value(self.key), self.cam
        fine: Node = Text(on.text(f"{self.key}.fine"))
        what_would_do: Node = Text(on.text("cam.study"))
        if cam.radius is None:
            doubt = _doubt(on, "rho", "min")
            least, place = on.extreme("min", "rho")
            if cam.decides_start and not plan.mechanism.drivers[0].link:  # rho grows as the base circle does
                radius = plan.at.bind(al.as_node(cam.base_radius), plan.main)
                needed = formula("ROUNDUP(radius-value,3)", radius=radius, value=value)
                what_would_do = joined(on.text(f"{self.key}.needed"), " ", needed)
        else:
            doubt = _doubt(on, "kappa", "max")
            bent, place = on.extreme("max", "kappa")
            roller = plan.at.bind(al.as_node(cam.radius), plan.main)
            least = formula("IF(bent>0,1/bent-roller,NA())", bent=bent, roller=roller)
            hollow, _ = on.extreme("min", "kappa")
            cutter = formula("ROUNDDOWN(roller-1/hollow,2)", roller=roller, hollow=hollow)
            concave = joined(on.text(f"{self.key}.concave"), " ", cutter)
            fine = joined(fine, formula('IF(hollow<0,concave,"")', hollow=hollow, concave=concave))
        undercut = joined(on.text(f"{self.key}.undercut"), what_would_do)
        words = formula("IF(IFERROR(value<=0,FALSE),undercut,fine)&doubt", value=value, fine=fine, undercut=undercut,
                        doubt=doubt)  # fmt: skip
        return Line(
            rich("rho"), least, on.where_it_closes(words), plan.mechanism.length_unit, decimals_of_kind(plan, "length"),
            occurs=place,
            levels=(bad("value<=0", value=value), good("value>0", value=value)),
        )  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        face = self.cam.radius is None
        symbol = "rho" if face else "kappa"
        found, allowed = _extremes(motion, self.key, symbol)
        if found is None:
            return {}
        best, place = found[:2] if face else found[2:]
        least, missed, sense = best, allowed, -1.0 if face else 1.0
        if not face:
            if best <= 0:
                return {self.key: Expected([])}
            roller = _number(motion, self.cam.radius or 0.0)
            least, missed = 1 / best - roller, allowed / best**2
        words = _either(motion, least, 0.0, f"{self.key}.undercut", f"{self.key}.fine", missed)
        return {self.key: Expected([least], missed, words=words)} | motion.where(
            self.key, place, lambda rows: sense * (best - motion.search.known(rows)[symbol]), allowed
        )


class NeededBase(Finding):
    """The radius of the base circle with which the largest pressure angle of a slide's roller is just the usual one."""

    key, placed, by_rows = "needed_base", True, True
    needs = ("rates",)

    def line(self, on: Reading) -> Line:
        plan = on.plan
        needed, place = on.extreme("max", BASE)
        words = joined(on.text(self.key), _doubt(on, BASE, "max"))
        return Line(
            rich("r_b"), needed, on.where_it_closes(words), plan.mechanism.length_unit, decimals_of_kind(plan, "length"),
            occurs=place,
        )  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        found, allowed = _extremes(motion, self.key, BASE)
        if found is None:
            return {}
        most, place = found[2:]
        return {self.key: Expected([most], allowed)} | motion.where(
            self.key, place, lambda rows: most - motion.search.known(rows)[BASE], allowed
        )


class FaceLength(Finding):
    """How long a flat face must be at least: from where to where along it the cam touches it."""

    key, by_rows = "face_length", True
    needs = ("rates",)

    def __init__(self, cam: Cam) -> None:
        self.cam = cam

    def line(self, on: Reading) -> Line:
        plan = on.plan
        (most, _), (least, _) = on.extreme("max", "contact"), on.extreme("min", "contact")
        before, between, after = on.text(self.key, least="#", most="#", point=self.cam.point).split("#")
        low, high = formula("ROUND(least,2)", least=least), formula("ROUND(most,2)", most=most)
        words = joined(before, low, between, high, after, _doubt(on, "contact", "max", "min"))
        return Line(
            on.text(f"{self.key}.symbol"), formula("most-least", most=most, least=least), on.where_it_closes(words),
            plan.mechanism.length_unit, decimals_of_kind(plan, "length"),
        )  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        found, allowed = _extremes(motion, self.key, "contact")
        return {} if found is None else {self.key: Expected([found[2] - found[0]], 2 * allowed)}


def profile_findings(cam: Cam, found: Collection[str]) -> Iterator[Finding]:
    """How a cam presses, and whether its profile can be made; `found`: symbols of columns that change."""
    yield PressureAngle(cam, "alpha" in found)
    if cam.offset is not None:
        yield NeededBase()
    yield LeastRadius(cam)
    if cam.radius is None:
        yield FaceLength(cam)


class ContactForce(Finding):
    """The least force of the cam on its follower: where it would have to pull, the follower lifts off."""

    key, placed, by_rows, tells_place = "contact_force", True, True, True

    def line(self, on: Reading) -> Line:
        value = on.value(self.key)
        least, place = on.extreme("min", CONTACT)
        unit = on.plan.equations.of(CONTACT).unit
        before, between, after = on.text(f"{self.key}.lifts", place="#", force="#").split("#")
        at = on.driver_text(on.beside(self.key, place))
        lifts = joined(before, at, between, formula("ROUND(value,2)", value=value), f" {unit.text}{after}")
        words = formula("IF(value<0,lifts,stays)&doubt", value=value, lifts=lifts, stays=on.text(f"{self.key}.stays"),
                        doubt=_doubt(on, CONTACT, "min"))  # fmt: skip
        return Line(
            rich(CONTACT), least, on.where_it_closes(words), unit.text, decimals_of_unit(on.plan, unit), occurs=place,
            levels=(bad("value<0", value=value), good("value>=0", value=value)),
        )  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        found, allowed = _extremes(motion, self.key, CONTACT)
        if found is None:
            return {}
        least, place = found[:2]
        unit = unit_of_column(motion.plan, CONTACT)
        lifts = motion.plan.text("verdict.contact_force.lifts", place="#", force="#").split("#")[0]
        stays = motion.plan.text("verdict.contact_force.stays")
        words = [lifts] if least < -allowed else [stays] if least > allowed else [lifts, stays]
        return {self.key: Expected([unit.to_shown(least)], unit.to_shown(allowed), words=words)} | motion.where(
            self.key, place, lambda rows: motion.search.known(rows)[CONTACT] - least, allowed
        )


class HoldingSpring(Finding):
    """The free length with which the spring between ground and follower just holds it: the two touch in the worst position.

    N (hold - L0) has the same sign in all rows where more preload presses more everywhere; else no free length is said.
    """

    key, by_rows = "holding_spring", True

    def __init__(self, spring: Spring, force_unit: str) -> None:
        self.spring, self.force_unit = spring, force_unit

    def line(self, on: Reading) -> Line:
        plan, value = on.plan, on.value(self.key)
        symbol = self.spring.hold
        free, stiff = (plan.at.bind(node, plan.main) for node in (self.spring.free_length, self.spring.stiffness))
        (most, _), (least, _) = on.extreme("max", symbol), on.extreme("min", symbol)

        def agree(lifted: str, pressed: str) -> Node:
            return formula(
                f'COUNTIFS(all,"<0",hold,"{lifted}"&free)+COUNTIFS(all,">0",hold,"{pressed}"&free)=0',
                all=Symbol(ALL + CONTACT), hold=Symbol(ALL + symbol), free=free,
            )  # fmt: skip

        needed = formula("IF(pushes,most,IF(pulls,least,NA()))", pushes=agree("<", ">"), pulls=agree(">", "<"),
                         most=most, least=least)  # fmt: skip
        more = joined(formula("ROUND(ABS(stiff*(value-free)),1)", stiff=stiff, value=value, free=free),
                      f" {self.force_unit}")  # fmt: skip
        lifts = formula("force<0", force=on.value(ContactForce.key))
        words = formula(
            'IFERROR(more&IF(lifts,lacks,spare)&IF(value=end,least,most)&doubt,"")', lifts=lifts, more=more, value=value,
            lacks=f" {on.text(f'{self.key}.lacks', spring=self.spring.name)} ",
            spare=f" {on.text(f'{self.key}.spare', spring=self.spring.name)} ",
            end=most, least=on.text(f"{self.key}.least"), most=on.text(f"{self.key}.most"),
            doubt=_doubt(on, CONTACT, "min"),
        )  # fmt: skip
        return Line(
            rich(symbol),
            needed,
            on.where_it_closes(words),
            plan.mechanism.length_unit,
            decimals_of_kind(plan, "length"),
        )

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        search, symbol = motion.search, self.spring.hold
        found, allowed = _extremes(motion, self.key, symbol)
        if found is None:
            return {}
        there = search.row_there & np.isfinite(search.in_rows(symbol))
        force, more = (
            search.in_rows(CONTACT)[there],
            search.in_rows(symbol)[there] - _number(motion, self.spring.free_length),
        )
        ends = [end for end, sign in ((found[2], 1.0), (found[0], -1.0)) if np.all(sign * force * more <= 0)]
        return {self.key: Expected(ends[:1], allowed)}


def contact_findings(mechanism: Mechanism, found: Collection[str]) -> Iterator[Finding]:
    """Where there are forces; `found` as above."""
    yield ContactForce()
    dynamics = mechanism.dynamics
    for spring in dynamics.springs if dynamics is not None else ():
        if spring.hold in found:
            yield HoldingSpring(spring, dynamics.force_unit if dynamics else "")


class LargestRate(Finding):
    """The largest velocity, acceleration or jerk of what the cam moves, and of which segment it is: its factor times the way
    over a power of the angle. Where the cam turns evenly it is that of the laws, else of the rows."""

    placed = by_rows = True

    def __init__(self, follower: FurtherDriver, motion: Segments, order: int) -> None:
        self.follower, self.motion, self.order = follower, motion, order
        self.key = ("largest_velocity", "largest_acceleration", "largest_jerk")[order - 1]

    def line(self, on: Reading) -> Line:
        plan = on.plan
        symbol = plan.equations.equations.rates_of(self.follower)[self.order - 1]
        column, value = Symbol(ALL + symbol), on.value(self.key)
        rows = formula("MAX(all,-MIN(all))", all=column)
        parts = [plan.at.bind(self._largest(part), plan.main) for part in self.motion.parts]
        most = largest = al.nested("MAX", parts)
        power: Node = al.ONE
        if symbol in self.follower.by_time:
            speed, acceleration = (plan.at.bind(Symbol(name), plan.main) for name in plan.mechanism.driver_rates)
            power = formula(f"ABS(speed)^{self.order}", speed=speed)
            largest = formula("IF(acceleration=0,most*power,rows)", acceleration=acceleration, most=most, power=power,
                              rows=rows)  # fmt: skip
        words: Node = Text("")  # of uniform motions, whose acceleration is all leaps
        for number, (part, own) in reversed([*enumerate(zip(self.motion.parts, parts, strict=True), 1)]):
            if al.is_zero(own):
                continue
            law, factor = plan.text(f"segment.{part.law}"), f"{FACTORS[part.law][self.order - 1]:.5g}"
            said = on.text("largest_rate", number=number, law=law, factor=factor)
            words = formula("IF(ABS(value-own*power)<=rounding*value,said,other)", value=value, own=own, power=power,
                            rounding=SAME, said=said, other=words)  # fmt: skip
        unit = plan.equations.of(symbol).unit
        place = on.driver_in_row(row_of_size(column, rows))
        return Line(
            rich(symbol), largest, on.where_it_closes(words), shown_unit(plan, symbol), decimals_of_unit(plan, unit),
            occurs=place,
        )  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        search, plan = motion.search, motion.plan
        symbol = plan.equations.equations.rates_of(self.follower)[self.order - 1]
        if not search.count or symbol not in search.at:
            return {}
        in_rows = np.abs(search.in_rows(symbol))
        of_rows = float(np.nanmax(in_rows))
        row = 1.0 + int(np.argmax(in_rows >= of_rows * (1 - AS_LARGE)))
        each = [_fastest(motion, part, self.order) for part in self.motion.parts]
        power, evenly = 1.0, True
        if symbol in self.follower.by_time:
            speed, acceleration = (search.at[name][0] for name in plan.mechanism.driver_rates)
            power, evenly = abs(float(speed)) ** self.order, bool(acceleration == 0)
        most, unit = max(each) * power if evenly else of_rows, unit_of_column(plan, symbol)
        names = [
            plan.text("verdict.largest_rate", number=number, law=plan.text(f"segment.{part.law}"), factor="#").split("#")[0]
            for number, (part, own) in enumerate(zip(self.motion.parts, each, strict=True), 1)
            if 0 < max(each) * (1 - EXACT) <= own
        ]  # fmt: skip
        words = names if evenly else []
        found = {self.key: Expected([unit.to_shown(most)], max(EXACT * unit.to_shown(most), SAME), words=words)}
        if of_rows == 0:  # all rows are of a dwell, and none of them is the fastest
            return found | {f"{self.key}_at": Expected([], told=False)}

        def missed(rows: Array) -> Array:
            return of_rows - np.abs(search.known(rows)[symbol])

        return found | motion.where(self.key, row, missed, EXACT * of_rows)

    def _largest(self, part: Segment) -> Node:
        """The largest derivative by the cam's angle of a segment."""
        factor = FACTORS[part.law][self.order - 1]
        if factor == 0:
            return al.ZERO
        return al.div(al.mul(al.number(factor), Call("ABS", (part.by,))), Binary("^", part.over, Number(self.order)))


def motion_findings(mechanism: Mechanism) -> Iterator[Finding]:
    """How fast the follower becomes, and where its motion leaps."""
    follower, motion = mechanism.follower, mechanism.segments
    if follower is not None and motion is not None:
        yield from (LargestRate(follower, motion, order) for order in (1, 2, 3))
        yield from (Leaping("velocity_leaps", motion, 1, "bad"), Leaping("acceleration_leaps", motion, 2, "look"))


class Leaping(Finding):
    """Angles at which a derivative of the motion leaps: where segments meet, and in the middle of a parabolic one."""

    by_rows = True

    def __init__(self, key: str, motion: Segments, order: int, kind: Literal["bad", "look"]) -> None:
        self.key, self.motion, self.order, self.kind = key, motion, order, kind

    def line(self, on: Reading) -> Line:
        cell, most = on.value(self.key), al.number(LEAPT * on.plan.size)
        count: Node = al.ZERO
        where: list[Node | str] = []
        degrees = on.plan.mechanism.angle_unit.in_degrees
        for angle, step, laws in _steps(self.motion, self.order):
            leaps = formula("ABS(step)>most", step=step, most=most)
            count = al.add(count, formula("IF(leaps,1,0)", leaps=leaps))
            shown = formula("ROUND(DEGREES(angle),2)" if degrees else "ROUND(angle,4)", angle=angle)
            named = " – ".join(on.plan.text(f"segment.{law}") for law in laws)
            where.append(formula('IF(leaps,at,"")', leaps=leaps, at=joined(" ", shown, on.unit, f" ({named})")))
        some = joined(on.text(self.key), *where) if where else Text("")
        words = formula("IF(count=0,none,some)", count=cell, none=on.text(f"{self.key}.none"), some=some)
        return Line(
            on.text(f"{self.key}.symbol"), count, words,
            levels=(Level(self.kind, formula("count>0", count=cell)), good("count=0", count=cell)),
        )  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        angles, most = _leaps(motion, self.motion, self.order), LEAPT * motion.plan.size
        count = sum(abs(step) > most for _, step in angles)
        key = self.key if count else f"{self.key}.none"
        return {self.key: Expected([float(count)], words=[motion.plan.text(f"verdict.{key}")])}


def _steps(motion: Segments, order: int) -> list[tuple[Node, Node, tuple[str, ...]]]:
    """Where a derivative may leap, by how much, and between which laws."""
    found: list[tuple[Node, Node, tuple[str, ...]]] = []
    parts = motion.parts
    before: Node = al.ZERO
    if motion.closed:
        before = _at_end(parts, -1, order, 1.0)
    for place, part in enumerate(parts):
        laws = (parts[place - 1].law, part.law) if place or motion.closed else (part.law,)
        found.append((part.begins, al.sub(_at_end(parts, place, order, 0.0), before), laws))
        if order == 2 and part.law == "parabolic":
            twice = al.mul(al.number(8.0), al.div(part.by, al.square(part.over)))
            found.append((al.add(part.begins, al.div(part.over, al.TWO)), twice, (part.law,)))
        before = _at_end(parts, place, order, 1.0)
    if not motion.closed:  # it stays where it ends
        last = parts[-1]
        found.append((al.add(last.begins, last.over), before, (last.law,)))
    return [each for each in found if not al.is_zero(each[1])]


def _at_end(parts: tuple[Segment, ...], place: int, order: int, tau: float) -> Node:
    part = parts[place]
    factor = evaluate(part.way[order], {TAU: tau}) if part.law in LAWS_THAT_LEAP else 0.0
    if abs(factor) < LEAPT:
        return al.ZERO
    over = part.over if order == 1 else al.square(part.over)
    return al.mul(al.number(factor), al.div(part.by, over))


def _doubt(on: Reading, symbol: str, *ways: Way) -> Node:
    """What is added where an extreme is to be doubted: beside a leap no probe comes as near as where all is smooth."""
    leaps = on.value("velocity_leaps")
    count: Node = leaps if symbol == "alpha" else al.add(leaps, on.value("acceleration_leaps"))
    return on.doubt(symbol, *ways, unsure=formula("count>0", count=count))


# --- what a search finds -------------------------------------------------------------------------------------------------


def _number(motion: SearchedMotion, node: Node | float) -> float:
    """What dimensions make of an expression, in the units of the equations."""
    return float(value(al.as_node(node), motion.search.dimensions))


def _extremes(motion: SearchedMotion, key: str, symbol: str) -> tuple[Extremes | None, float]:
    """The extremes of a column of the cam, of the rows where the line speaks of these alone; None where nothing is sure.
    And by how much a number of them may be off: one that is about right by what lies between the rows, too.
    """
    search, rows_only = motion.search, motion.page or motion.says(key, "rows.only")
    elsewhere = motion.says(key, "beyond") or motion.says(key, "boundless")
    if symbol not in search.at or elsewhere or not (rows_only or motion.sure):
        return None, 0.0
    of_rows, found = search.extremes(symbol, rows_only=True), search.extremes(symbol, rows_only=rows_only)
    if found is None or of_rows is None or not found[2] - found[0] <= POLE * max(of_rows[2] - of_rows[0], SAME):
        return None, 0.0
    low, _, high, _ = found
    part = 0.0 if rows_only else max(motion.part(key), PIECES)
    allowed = part * (high - low) + NEAR * max(abs(low), abs(high)) + SAME
    if motion.says(key, "about"):
        allowed += max(of_rows[0] - low, high - of_rows[2])
    return found, allowed


def _either(
    motion: SearchedMotion, number: float, limit: float, below: str, above: str, near: float | None = None
) -> list[str]:
    """Which of two texts stands there: the first up to the limit; both where the number is too near to say."""
    close = abs(number - limit) <= (NEAR * max(abs(number), abs(limit)) if near is None else near)
    keys = [below, above] if close else [below] if number < limit else [above]
    return [motion.plan.text(f"verdict.{key}") for key in keys]


def _over(motion: SearchedMotion, part: Segment, order: int, taus: Array) -> Array:
    """A derivative of the motion by the cam's angle at parts of a segment, as numbers."""
    by, over = (_number(motion, node) for node in (part.by, part.over))
    return np.asarray(by / over**order * way_over(part, order, taus))


def _fastest(motion: SearchedMotion, part: Segment, order: int) -> float:
    """The largest derivative over a segment, whichever way."""
    sizes = np.abs(_over(motion, part, order, TAUS))
    near = TAUS[int(np.argmax(sizes))] + (TAUS - 0.5) * 2.0 * TAUS[1]  # and between its neighbours once more
    return float(max(sizes.max(), np.abs(_over(motion, part, order, np.clip(near, 0.0, 1.0))).max()))


def _leaps(motion: SearchedMotion, segments: Segments, order: int) -> list[tuple[float, float]]:
    """(angle, step) wherever a derivative leaps: within segments, and where two meet."""
    found: list[tuple[float, float]] = []
    ends: list[tuple[float, float]] = []
    for part in segments.parts:
        begins, over, by = (_number(motion, node) for node in (part.begins, part.over, part.by))
        first, last = _over(motion, part, order, np.array([0.0, 1.0]))
        ends.append((float(first), float(last)))
        inner = TAUS[1:-1]
        steps = _over(motion, part, order, inner + NEAR) - _over(motion, part, order, inner - NEAR)
        leaps = np.flatnonzero(np.abs(steps) > STEEP * abs(by) / over**order)
        found += [(begins + over * float(inner[at]), float(steps[at])) for at in leaps]
    rest = (0.0, 0.0)
    around = [ends[-1], *ends] if segments.closed else [rest, *ends, rest]
    begins_at = [*(part.begins for part in segments.parts), al.add(segments.parts[-1].begins, segments.parts[-1].over)]
    meeting = zip(begins_at, pairwise(around), strict=False)
    return found + [(_number(motion, at), after[0] - before[1]) for at, (before, after) in meeting]
