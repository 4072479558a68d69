"""A task in words: the derived dimensions, the links and where their points lie, the joints, the driver, what is asked.

Everything that the asked quantities follow from is said, in the description's symbols; no word of a frame of a link's own.
Symbols and names of points are set as the figure has them (`Names`): θ with 13 lowered, A with 0 lowered.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Number, Symbol, symbols, with_symbols
from livesheet.workbook import Rich
from mechsheet import reference
from mechsheet.compiled import Compiled
from mechsheet.homework.agreement import DEGREE
from mechsheet.homework.classroom.directions import Direction, Directions, SpokenAngle, spoken
from mechsheet.homework.expected_values import asked_of
from mechsheet.homework.headings import aliases_of, called
from mechsheet.kinematics.equations import FORCES
from mechsheet.model import (
    Cartesian,
    Dimension,
    Distances,
    Gear,
    GivenPoint,
    Joint,
    Link,
    Polar,
    Quantity,
    Rack,
    Summary,
)
from mechsheet.sheet.mathematics import Part, merged, written
from mechsheet.units import DEG, Unit
from mechsheet.words.catalogue import said, words
from mechsheet.words.equations import body_words, given_words, link_words
from mechsheet.words.symbols import parts as letters
from mechsheet.words.symbols import plain

Line = list[Part]
_QUANTITY = "\0"
"""Stands for a summary's quantity in its words, until it is set as a symbol."""
NEXT: Part = (";  ", "")


class Statement:
    """The lines of a task."""

    def __init__(self, compiled: Compiled, asked: Sequence[str]) -> None:
        self.compiled, self.asked = compiled, asked
        self.mechanism = compiled.mechanism
        self.language = compiled.mechanism.language
        self.directions = Directions(self.mechanism)
        self.needed = _needed(compiled, asked)
        roles = {each.symbol: each.role for each in compiled.equations.columns}
        self.forces = any(roles.get(symbol) in FORCES for symbol in self.needed)

    def text(self, key: str, **parts: object) -> str:
        """Words of a task."""
        return said(self.language, f"task.{key}", **parts)

    def math(self, node: Node) -> Line:
        """A formula as mathematics."""
        return list(written(node, self.language).parts)

    def angle(self, quantity: Quantity) -> Line:
        """An angle that a description gives."""
        return self._sum(self._spoken(quantity))

    def _spoken(self, quantity: Quantity) -> SpokenAngle:
        """The same as a sum; a plain number is said in degrees in any case."""
        number = quantity if isinstance(quantity, float) else al.value_of(quantity)
        if number is not None:
            return spoken(al.number(number), True)
        return spoken(al.as_node(quantity), self.mechanism.angle_unit.in_degrees)

    def _sum(self, angle: SpokenAngle) -> Line:
        return self.math(angle.node) if angle.terms else [("0°", "")]

    def head(self, symbol: str, unit: Unit) -> str:
        """A symbol with the unit in which it is shown: `error [deg]`."""
        shown = self.mechanism.shown(unit).text.replace(DEG.text, DEG.symbol)
        return f"{symbol} [{shown}]" if shown else symbol

    def asked_head(self, symbol: str) -> str:
        """The same of what is asked: a column, or a summary, which has the unit of its column."""
        of = next((one.of for one in self.mechanism.summaries if one.symbol == symbol), symbol)
        return self.head(symbol, self.compiled.equations.unit_of(self.mechanism, of))

    def rows(self) -> NDArray[np.float64]:
        """The driver's values, as people read them."""
        values = reference.driver_values(self.mechanism, reference.dimension_values(self.mechanism))
        return np.asarray(self.mechanism.driver.unit.to_shown(values), float)

    def given(self) -> Iterator[tuple[Dimension, float, str]]:
        """What is typed, in the unit shown: the dimensions, also those that a synthesis has found, and of speeds, masses and
        loads those that the asked quantities follow from."""
        values = reference.dimension_values(self.mechanism)
        for dim in self.mechanism.dimensions:
            found = self.mechanism.synthesis is not None and not dim.written and not dim.path
            if found or (isinstance(dim.value, float) and (not dim.path or dim.symbol in self.needed)):
                yield dim, round(float(dim.unit.to_shown(values[dim.symbol])), 10), self._label(dim)

    def derived(self) -> Iterator[tuple[Dimension, Rich]]:
        """What follows from the dimensions: `rod [mm] = track - 2*arm*sin(beta)`; of speeds, masses and loads that are
        given by them those that the asked quantities follow from."""
        for dim in self.mechanism.dimensions:
            told = dim.symbol in self.needed and dim.path[0] != "synthesis" if dim.path else bool(dim.written)
            if told and not isinstance(dim.value, float):
                yield dim, self._defined(self.head(dim.symbol, dim.unit), dim.value, self._label(dim))

    def _label(self, dim: Dimension) -> str:
        """What a dimension is called."""
        if dim.label is not None:
            return dim.label.of(self.language)
        known = dim.path[:1] not in ((), ("synthesis",)) and "center" not in dim.path
        return given_words(self.mechanism, self.language, dim) if known else ""

    def links(self) -> Iterator[Rich]:
        """Each link: its number and name, its points."""
        for link in self.mechanism.whole_links:
            ground = link is self.mechanism.ground
            head = f"{link.number}  {link_words(link).of(self.language)}: "
            pieces = self._fixed(link) if ground else self._points(link)
            yield Rich(((head, ""), *pieces, *self._mass_centre(link)))

    def joints(self) -> Iterator[Rich]:
        """How the links are joined, and what turns with what."""
        yield Rich(((self.text("pins"), ""),))
        for joint in self.mechanism.sliding:
            yield Rich(tuple(self._joint(joint)))
        angle = {link.name: link.angle_symbol for link in self.mechanism.links[1:]}
        for relation in self.mechanism.relations:
            arm = Symbol(angle[relation.arm]) if relation.arm in angle else Number(0.0)

            def turned(name: str, arm: Node = arm) -> Node:
                return al.sub(Symbol(angle[name]) if name in angle else Number(0.0), arm)

            if isinstance(relation, Gear):
                left, right = turned(relation.link), al.mul(relation.ratio, turned(relation.on))
            else:
                assert isinstance(relation, Rack)
                left, right = Symbol(relation.joint), al.mul(relation.radius, turned(relation.link))
            yield Rich((*self.math(left), (" = ", ""), *self.math(al.add(right, relation.phase))))

    def loads(self) -> Iterator[Rich]:
        """What acts, where forces are asked for: gravity, loads, springs."""
        dynamics = self.mechanism.dynamics
        if dynamics is None or not self.forces:
            return
        if not all(map(al.is_zero, dynamics.gravity)):
            yield Rich(((f"{self.text('gravity')} ", ""), *self._pair(*dynamics.gravity)))
        for load in dynamics.loads:
            link = self.mechanism.link(load.link)
            on = self.text("on", link=link_words(link).of(self.language))
            if load.force is None:
                assert load.torque is not None
                yield Rich(((f"{self.text('torque')} ", ""), *self.math(load.torque), (f" {on}", "")))
                continue
            place = [(load.point, "")] if isinstance(load.point, str) else self._place(link, load.name, load.point)[1:]
            turned = [(f", {self.text('axis')} ", ""), *self.direction(link)] if load.in_link else []
            line: Line = [(f"{self.text('force')} ", ""), *self._pair(*load.force), *turned]
            yield Rich((*line, (f" {on}, {self.text('at')} ", ""), *place))
        for spring in dynamics.springs:
            between = "–".join(point for _, point in spring.ends)
            line = [(f"{self.text('spring', between=between)}: ", "")]
            for key, node in (
                ("stiffness", spring.stiffness),
                ("free", spring.free_length),
                ("damping", spring.damping),
            ):
                line += [*([(", ", "")] if key != "stiffness" else []), (f"{self.text(key)} ", ""), *self.math(node)]
            yield Rich(tuple(line))

    def driver(self) -> Iterator[Rich]:
        """What is driven, from where its angle counts; of a cam what it does, and how it is made."""
        if self.mechanism.follower is not None:
            yield from _cam_lines(self)
            return
        for driver in self.mechanism.all_drivers:
            line: Line = [(f"{self.text('driven')} {driver.symbol}", "")]
            link = next((one for one in self.mechanism.links if one.name == driver.link), None)
            if link is not None:
                base = driver.relative_to or self.mechanism.ground.name
                other = self.mechanism.link(base)
                line += [(": ", ""), *self.direction(link)]
                if other is not self.mechanism.ground:
                    line += [(f" {self.text('against')} ", ""), *self.direction(other)]
                else:
                    line += self._zero(driver.symbol, link)
            follows = getattr(driver, "follows", None)
            if follows is not None:
                line += [(f";  {driver.symbol} = ", ""), *self.math(follows)]
            yield Rich(tuple(line))

    def assemblies(self) -> Iterator[Rich]:
        """Which assembly is meant. Of links that are solved all at once it is told by numbers: they would be an answer."""
        for group in self.compiled.equations.groups:
            if group.mode and group.system is None:
                yield Rich(((f"{self.text('assembly')}: {group.mode_words.of(self.language)}", ""),))

    def meanings(self) -> Iterator[Rich]:
        """What each asked quantity is, behind the outputs that it follows from, which are no names of the figure."""
        meant = {each.symbol: each.label.of(self.language) for each in self.compiled.equations.columns}
        angles = {link.angle_symbol: link for link in self.mechanism.links[1:]}
        outputs = {output.symbol: output for output in (*self.mechanism.outputs, *self.mechanism.motion_outputs)}
        summaries = {summary.symbol: summary for summary in self.mechanism.summaries}
        read = {name: [one for one in symbols(each.formula) if one in outputs] for name, each in outputs.items()}
        for symbol in self._in_order(read | {name: [one.of] for name, one in summaries.items()}):
            if symbol in summaries:
                yield Rich(((f"{symbol}: ", ""), *self._taken(summaries[symbol])))
            elif symbol in outputs:
                output = outputs[symbol]
                label = output.label.of(self.language) if output.label else ""
                yield self._defined(self.head(symbol, output.unit), output.formula, label)
            elif symbol in angles:
                yield Rich(((f"{symbol}: ", ""), *self.direction(angles[symbol]), (f"  ({meant.get(symbol, '')})", "")))
            elif meant.get(symbol):
                counted = _sign_of(self, symbol)
                yield Rich(((f"{symbol}: {meant[symbol]}{f'; {counted}' if counted else ''}", ""),))
        yield Rich(((self.text("angles"), ""),))

    def _in_order(self, before: Mapping[str, Sequence[str]]) -> dict[str, None]:
        """What is asked, each behind what has to be known `before` it."""
        found: dict[str, None] = {}

        def meet(symbol: str) -> None:
            for name in before.get(symbol, ()):
                meet(name)
            found[symbol] = None

        for symbol in self.asked:
            meet(symbol)
        return found

    def marks(self) -> Iterator[Rich]:
        """How many marks each has, where the description says it."""
        if self.mechanism.exercise is not None and self.mechanism.exercise.asked:
            listed = ", ".join(f"{symbol}: {marks:g}" for symbol, marks in asked_of(self.mechanism).marks.items())
            yield Rich(((self.text("marks", listed=listed), ""),))

    # --- parts of lines -----------------------------------------------------------------------------------------------

    def _pair(self, x: Node, y: Node) -> Line:
        return [("(", ""), *self.math(x), ("; ", ""), *self.math(y), (")", "")]

    def _mass_centre(self, link: Link) -> Line:
        """Where the mass centre of a link lies, where forces are asked for."""
        masses = self.mechanism.dynamics.masses if self.mechanism.dynamics is not None and self.forces else ()
        for mass in masses:
            if mass.link == link.name:
                centre = f"G{link.number}"
                at = mass.center
                return [NEXT, (f"{centre} = {at}", "")] if isinstance(at, str) else self._place(link, centre, at)
        return []

    def _place(self, link: Link, name: str, place: GivenPoint) -> Line:
        return self._distances(name, place) if isinstance(place, Distances) else self._point(link, name, place)

    def _defined(self, head: str, formula: Node, label: str) -> Rich:
        return Rich(((f"{head} = ", ""), *self.math(formula), *([(f"  ({label})", "")] if label else [])))

    def _taken(self, summary: Summary) -> Line:
        """What a summary takes, its quantity set as a symbol: `largest amount` is no amount that is large."""
        taken = words(self.language, f"take.{summary.take.key}", symbol=_QUANTITY)
        before, after = taken.split(_QUANTITY)
        label = f"  ({summary.label.of(self.language)})" if summary.label else ""
        return [(before, ""), *self.math(Symbol(summary.of)), (after + label, "")]

    def direction(self, link: Link) -> Line:
        """From which line the angle of a link counts."""
        known = self.directions.of[link.name]
        if known is None:
            return [(self.text("related"), "")]
        if known.joint is not None:
            return [(self.text("way", symbol=known.joint.symbol), ""), *self._less(known)]
        return [(self.text("direction", along=f"{known.start}→{known.end}"), ""), *self._less(known)]

    def _less(self, known: Direction) -> Line:
        """What is to be added to a direction, or taken off."""
        less = self._turned(known)
        if not less.terms:
            return []
        if less.minus:
            return [(f" {self.text('and')} ", ""), *self._sum(less.negated())]
        brackets = ("", "") if less.terms == 1 else ("(", ")")
        return [(f" {self.text('less')} {brackets[0]}", ""), *self._sum(less), (brackets[1], "")]

    def _turned(self, known: Direction) -> SpokenAngle:
        """The direction of a link's points where its angle is 0."""
        return self._spoken(float(known.less) * DEGREE if isinstance(known.less, int) else known.less)

    def _zero(self, symbol: str, link: Link) -> Line:
        """Where the angle of a driven link is 0, if its points do not lie along x there."""
        known = self.directions.of[link.name]
        if known is None or known.joint is not None or not (turned := self._turned(known)).terms:
            return []
        told = self.text("zero", symbol=symbol, along=f"{known.start}→{known.end}")
        return [(f";  {told} ", ""), *self._sum(turned)]

    def _fixed(self, link: Link) -> Line:
        """The points of the ground, in the coordinates of the figure."""
        line: Line = []
        for name, place in link.points.items():
            match place:
                case Cartesian(x, y):
                    inside = [*self.math(al.as_node(x)), ("; ", ""), *self.math(al.as_node(y))]
                case Polar(r, angle):
                    inside = [("r = ", ""), *self.math(al.as_node(r)), (", ∠ ", ""), *self.angle(angle)]
                case Distances():
                    inside = self._distances(name, place)[1:]
            line += [*([NEXT] if line else []), (f"{name} (", ""), *inside, (")", "")]
        return [*line, (f"  ({self.text('axes')})", "")]

    def _points(self, link: Link) -> Line:
        """The points of a moving link by lengths along a line between two of them, and to the left of it."""
        line: Line = [(", ".join(link.points), "")]
        for name, place in link.points.items():
            line += self._place(link, name, place)
        return line

    def _point(self, link: Link, name: str, place: Cartesian | Polar) -> Line:
        start, end, (along, left) = self.directions.place(link, place)
        if name == start:
            return []
        if end and name == end:
            return [NEXT, (f"{start}{end} = ", ""), *self.math(along)]
        turn = self.directions.turned(link, place)
        if turn is not None and isinstance(place, Polar):
            by = self._spoken(turn)
            way = "clockwise" if by.negative and by.terms else "turned"
            told = self.text(way, line=f"{start}→{end}" if end else link.angle_symbol)
            return [
                NEXT,
                (f"{start}{name} = ", ""),
                *self.math(al.as_node(place.r)),
                (f", {told} ", ""),
                *self._sum(by.negated() if way == "clockwise" else by),
            ]
        return [NEXT, (f"{start}→{name}: ", ""), *self._along(link, end, start, along, left)]

    def _along(self, link: Link, end: str, start: str, along: Node, left: Node) -> Line:
        """How far along the way between two points, and to the left of it."""
        line: Line = []
        for way, key in ((along, "along"), (left, "left")):
            if not al.is_zero(way):
                told = self.text(key, line=f"{start}→{end}" if end else link.angle_symbol)
                line += [*([(", ", "")] if line else []), *self.math(way), (f" {told}", "")]
        return line

    def _distances(self, name: str, place: Distances) -> Line:
        side = words(self.language, f"notes.{place.side}", first=place.first, second=place.second)
        line: Line = [NEXT, (f"{name}{place.first} = ", ""), *self.math(al.as_node(place.first_distance))]
        line += [(f", {name}{place.second} = ", ""), *self.math(al.as_node(place.second_distance))]
        return [*line, (f", {side}", "")]

    def _joint(self, joint: Joint) -> Line:
        """A sliding joint: what slides where, from where its displacement counts."""
        names = {key: body_words(self.mechanism, name) for key, name in (("link", joint.link), ("on", joint.on))}
        spoken = {key: name.of(self.language) for key, name in names.items()}
        on = self.mechanism.link(joint.on)
        line: Line = [(words(self.language, f"notes.{joint.kind}", point=joint.point, **spoken) + " ", "")]
        ground = on is self.mechanism.ground
        if isinstance(joint.through, str):
            line.append((joint.through, ""))
        elif ground:
            x, y = (self.math(al.as_node(part)) for part in joint.through)
            line += [("(", ""), *x, ("; ", ""), *y, (")", "")]
        else:
            start, end, (along, left) = self.directions.place(on, Cartesian(*joint.through))
            line += [
                (f"({self.text('from_point', start=start)} ", ""),
                *self._along(on, end, start, along, left),
                (")", ""),
            ]
        line += [(f", {self.text('way_of_line')} ", ""), *self.angle(joint.angle)]
        if not ground:
            line += [(f" {self.text('from')} {on.angle_symbol}", "")]
        return [*line, (f"; {self.text('slide', symbol=joint.symbol, point=joint.point)}", "")]


def _needed(compiled: Compiled, asked: Sequence[str]) -> set[str]:
    """All symbols that the asked quantities follow from."""
    read = {dim.symbol: dim.value for dim in compiled.mechanism.dimensions if not isinstance(dim.value, float)}
    read |= {each.symbol: each.expression for each in (*compiled.equations.constants, *compiled.equations.columns)}
    of = {summary.symbol: summary.of for summary in compiled.mechanism.summaries}
    found: set[str] = set()
    waiting = [of.get(symbol, symbol) for symbol in asked]
    while waiting:
        symbol = waiting.pop()
        if symbol not in found:
            found.add(symbol)
            waiting += symbols(read[symbol]) if symbol in read else ()
    return found


# --- symbols as the figure has them ----------------------------------------------------------------------------------


class Names:
    """The symbols of a mechanism, and the names of its points."""

    def __init__(self, compiled: Compiled) -> None:
        mechanism = compiled.mechanism
        points = {point for link in mechanism.links for point in link.points}
        self.symbols = {each.symbol for each in (*compiled.equations.constants, *compiled.equations.columns)}
        self.symbols |= {each.symbol for each in (*mechanism.dimensions, *mechanism.all_drivers)}
        self.symbols |= {output.symbol for output in (*mechanism.outputs, *mechanism.motion_outputs)}
        self.symbols |= {summary.symbol for summary in mechanism.summaries}
        symbol, point = (
            "|".join(re.escape(name) for name in sorted(names, key=len, reverse=True)) or "(?!)"
            for names in (self.symbols, points)
        )
        self.name = re.compile(rf"(?<![\w.])(?:(?:{symbol})(?![\w.])|(?:{point})+(?!\w))")
        self.point = re.compile(point)

    def _parts(self, name: str) -> list[str]:
        """The symbol, or the points of a name such as A0A."""
        return [name] if name in self.symbols else self.point.findall(name)

    def set(self, parts: Iterable[Part]) -> list[Part]:
        """The pieces of a line with every name in it set."""
        found: list[Part] = []
        for text, style in parts:
            at = 0
            for name in self.name.finditer(text) if not style else ():
                found.append((text[at : name.start()], ""))
                for letter, lowered in map(letters, self._parts(name[0])):
                    found += [(letter, ""), (lowered, "sub")]
                at = name.end()
            found.append((text[at:], style))
        return merged([(piece, style) for piece, style in found if piece])

    def rich(self, content: Rich | str) -> Rich:
        """The same for a cell."""
        return Rich(tuple(self.set(content.parts if isinstance(content, Rich) else [(content, "")])))

    def head(self, text: str, symbol: str) -> Rich | str:
        """What stands over a column or beside a cell, set as elsewhere if `mark` still reads the symbol in it."""
        found = self.rich(text)
        return found if called((found.plain,), aliases_of((symbol,))).alone else text

    def plain(self, text: str) -> str:
        """A text with its names set, where there is one size of letters."""
        return self.name.sub(lambda name: "".join(map(plain, self._parts(name[0]))), text)


# a cam: how it turns, what it moves by which laws, what touches it, how its angles count


def _cam_lines(told: Statement) -> Iterator[Rich]:
    """The cam and its angle, the segments of the motion one after another, what the profile is made for."""
    mechanism = told.mechanism
    driver = mechanism.driver
    clockwise = driver.link == mechanism.ground.name  # seen from the cam the ground is driven
    turned = driver.relative_to if clockwise else driver.link
    center = next(iter(mechanism.link(turned).points))
    sense = told.text("cam.clockwise" if clockwise else "cam.counter_clockwise")
    yield Rich(((told.text("cam.turns", symbol=driver.symbol, center=center, sense=sense), ""),))
    follows: dict[str, Node] = {}
    for dim in mechanism.dimensions:
        if not isinstance(dim.value, float) and dim.path:  # a cell of the sheet, which nobody is given
            follows[dim.symbol] = with_symbols(dim.value, follows)
    found_by_base = {dim.symbol for dim in mechanism.dimensions if dim.path == ("cam", "start")}

    def math(node: Node) -> list[Part]:
        return told.math(al.tidied(with_symbols(node, follows)))

    follower, motion = mechanism.follower, mechanism.segments
    assert follower is not None and motion is not None
    on_base = isinstance(motion.start, Symbol) and motion.start.name in found_by_base
    begins: list[Part] = [(told.text("cam.on_base"), "")] if on_base else math(motion.start)
    yield Rich(((f"{told.text('cam.moves', symbol=follower.symbol)} ", ""), *begins))
    for number, part in enumerate(motion.parts, 1):
        law = words(told.language, f"segment.{part.law}")
        line: list[Part] = [(f"{number}. {law}: {told.text('cam.over')} ", ""), *math(part.over)]
        if part.law != "dwell":
            line += [(f", {told.text('cam.by')} ", ""), *math(part.by)]
        yield Rich(tuple(line))
    yield from _touching(told)


def _touching(told: Statement) -> Iterator[Rich]:
    cam, mechanism = told.mechanism.cam, told.mechanism
    if cam is None:
        return
    base = [(f"{told.text('cam.base')} ", ""), *told.math(al.as_node(cam.base_radius)), (";  ", "")]
    if cam.radius is not None:
        roller = [(f"{told.text('cam.roller', point=cam.point)} ", ""), *told.math(al.as_node(cam.radius))]
        yield Rich((*base, *roller))
        return
    link = mechanism.link(cam.follower)
    face = told.text("cam.face", link=link_words(link).of(told.language), point=cam.point)
    angle = al.add(al.as_node(cam.face), al.as_node(0.0))
    aside = [] if al.is_zero(angle) else [(f" {told.text('cam.turned')} ", ""), *told.angle(cam.face)]
    yield Rich((*base, (f"{face} ", ""), *told.direction(link), *aside))


def _sign_of(told: Statement, symbol: str) -> str:
    """How a column of the profile counts; "" for what needs no word."""
    if told.mechanism.cam is None or symbol not in ("alpha", "rho", "contact"):
        return ""
    return told.text(f"cam.sign.{symbol}")
