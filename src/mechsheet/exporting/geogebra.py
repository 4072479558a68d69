"""geogebra: a construction that moves, for GeoGebra: sliders, points by the equations, the list of shapes, paths as loci.

A .ggb file is an archive with one text, geogebra.xml: elements in the order in which they are computed. Each is an
expression in GeoGebra's own language, so that a person can read and change it there; a position that does not exist is
undefined, and what is drawn of it disappears. Angles are radians, as the equations have them; a text shows them in degrees.
"""

from __future__ import annotations

import io
import math
import re
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

from livesheet.formula.nodes import Node, Symbol, symbols, transform
from livesheet.formula.printer import number_text, print_formula
from livesheet.formula.vectors import Vector
from livesheet.said import say
from mechsheet.exporting.functions.routines import Parameter, Source, folded, needed_for
from mechsheet.exporting.job import Job
from mechsheet.exporting.lowering import missing_where
from mechsheet.exporting.program import one_line
from mechsheet.kinematics.angle_branch import WINDOWED
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.equations import need_closed_form
from mechsheet.plotting.sampling import sample
from mechsheet.shapes.forms import HALF, Mark, Shape, place_of
from mechsheet.shapes.positions import Positions, longest
from mechsheet.words.catalogue import words
from mechsheet.words.equations import body_words
from mechsheet.words.symbols import GREEK, parts, plain

WIDTH, HEIGHT = 1000, 700
"""The view [pixels]; of it SLIDERS at the left are for sliders."""
SLIDERS, SLIDER_STEP, MOST_SLIDERS = 260, 45, 14
"""Width, distance and number of the sliders that are shown; those of further dimensions are in the algebra view only."""

_GUI = """<gui>
<perspectives>
<perspective id="tmp">
<panes>
<pane location="" divider="0.23" orientation="1"/>
</panes>
<views>
<view id="1" visible="true" inframe="false" stylebar="false" location="1" size="1000" window="100,100,600,400"/>
<view id="2" visible="true" inframe="false" stylebar="false" location="3" size="300" tab="ALGEBRA" window="100,100,250,400"/>
</views>
<toolbar show="true" items="0 73 62 | 1 501 67" position="1" help="false"/>
<input show="false" cmd="true" top="algebra"/>
</perspective>
</perspectives>
</gui>
"""
"""The list of numbers and points at the left takes a quarter of the window."""

LINK = 3.0
"""How wide a link's line is: GeoGebra paints no bars [points]."""

STEPS = 200
"""Into so many steps at least the range of a slider is divided, each 1, 2 or 5 times a power of ten."""

_SUBSCRIPT = re.compile(r"([^\W\d_]+)(\d+)")
_SPELLED = {letter: name for name, letter in reversed(GREEK.items())} | {"′": "d", "″": "dd"}
_RESERVED = frozenset(
    ("e", "i", "pi", "x", "y", "z", "r", "t", "xAxis", "yAxis", "true", "false", "undefined", "ℯ", "ί")
)
"""What GeoGebra reads as constants, coordinates and variables of curves."""


def write(job: Job) -> list[bytes]:
    """The file. Raises MechanismError for groups that have no closed form."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:  # of a fixed date, and not packed: the same bytes everywhere
        archive.writestr(zipfile.ZipInfo("geogebra.xml"), construction_of(job).text().encode())
    return [content.getvalue()]


def construction_of(job: Job) -> Construction:
    """The construction of a mechanism. Raises as `write` does."""
    compiled = job.compiled
    need_closed_form(compiled.equations, say("constructions for GeoGebra"))
    drawn = sample(job.mechanism, None, None)
    begun = {symbol: float(column[drawn.shown]) for symbol, column in drawn.values.items()}
    return Construction(Source(compiled), Positions(drawn), begun)


def label_of(symbol: str, more: str = "") -> str:
    """A symbol as GeoGebra writes labels: `theta12` is theta_{12}, `a2` a_2, `A0` A_0; the letters stay those typed.

    more  is appended to what stands below
    """
    letter, below = parts(symbol)
    if not below:
        found = _SUBSCRIPT.fullmatch(letter)
        letter, below = found.groups() if found else (letter, "")
    letter, below = re.sub(r"\W", "_", "".join(_SPELLED.get(each, each) for each in letter)), (below + more).lstrip(",")
    return f"{letter}_{below}" if len(below) == 1 else f"{letter}_{{{below}}}" if below else letter


@dataclass(frozen=True, slots=True)
class _Element:
    """One object of the construction: its expression (None: a slider holds its value), and how it is shown."""

    label: str
    expression: str | None
    kind: str
    shown: str = ""

    def text(self) -> str:
        """The lines of the file."""
        kind = ' type="point"' if self.kind == "point" else ""
        head = (
            ""
            if self.expression is None
            else (f'<expression label="{escape(self.label)}" exp="{escape(self.expression)}"{kind}/>\n')
        )
        return f'{head}<element type="{self.kind}" label="{escape(self.label)}">\n{self.shown}</element>\n'


HIDDEN = '<show object="false" label="false"/>\n<auxiliary val="true"/>\n'


class Construction:
    """The elements of a mechanism in the order of their computation.

    begun   all values at the first position
    labels  symbol -> what it is called;  places  the same of points (a quantity may have the name of a point)
    """

    def __init__(self, source: Source, positions: Positions, begun: Mapping[str, float]) -> None:
        self.source, self.positions, self.begun = source, positions, begun
        self.mechanism = source.mechanism
        self.labels: dict[str, str] = {}
        self.places: dict[str, str] = {}
        self._taken_labels = set(_RESERVED)
        self.points = list(dict.fromkeys(point for link in self.mechanism.links for point in link.points))
        # arrows of loads are left out: their lengths belong to the forces of the whole motion
        shapes = [shape for shape in positions.list.shapes if isinstance(shape, Shape) and shape.size is None]
        self.drawn = [shape for shape in shapes if shape.kind != "path"]
        self.traced = [shape for shape in shapes if shape.kind == "path"]
        for point in self.points:
            self.places[point] = self._take(label_of(point))
        self.forms: Mapping[str, Node] = {}
        self.there: set[str] = set()
        for symbol in source.branches:  # the angle that people read has the name, not the one within half a turn
            self.labels[WINDOWED.format(symbol=symbol)] = self._take(label_of(symbol))
            self.labels[symbol] = self._take(label_of(symbol, ",0"))
        self.elements = tuple(self._elements())

    def text(self) -> str:
        """geogebra.xml, with the mechanism right of the sliders at true scale."""
        window, mechanism = self.positions.window, self.mechanism
        scale = min(WIDTH - SLIDERS, HEIGHT) / (2 * window.half)
        left, top = SLIDERS + (WIDTH - SLIDERS) / 2 - window.x * scale, HEIGHT / 2 + window.y * scale
        title = escape(one_line(mechanism.title.of(mechanism.language)))
        return (
            f'<?xml version="1.0" encoding="utf-8"?>\n<geogebra format="5.0" app="classic">\n{_GUI}'
            f'<euclidianView>\n<size width="{WIDTH}" height="{HEIGHT}"/>\n'
            f'<coordSystem xZero="{number_text(left)}" yZero="{number_text(top)}" scale="{number_text(scale)}"'
            f' yscale="{number_text(scale)}"/>\n<evSettings axes="true" grid="false" pointCapturing="0"/>\n'
            '</euclidianView>\n<kernel>\n<continuous val="false"/>\n<decimals val="3"/>\n'
            f'<angleUnit val="degree"/>\n</kernel>\n<construction title="{title}" author="mechsheet" date="">\n'
            + "".join(element.text() for element in self.elements)
            + "</construction>\n</geogebra>\n"
        )

    def _elements(self) -> Iterator[_Element]:
        steps = self.source.steps
        numbers = {HALF.name: self.positions.window.half} | {
            extreme.symbol: self.positions.known(extreme.symbol) for extreme in self.positions.list.extremes
        }
        given = {part.symbol for part in self.source.parameters()} | numbers.keys()
        self.drawn = [shape for shape in self.drawn if needed_for(_reads(shape), steps) <= steps.keys() | given]
        drawn = {name for shape in self.drawn for name in _reads(shape)}
        wanted = [*self.source.variables(), *map(self._taken, self.source.branches), *drawn]
        wanted += [f"{point}.{axis}" for point in self.points for axis in "xy"]
        needed = needed_for([*wanted, *self.source.closing.values()], steps)
        rules = [step for name, step in steps.items() if name in needed]
        found, self.forms = folded(rules, {name: Symbol(name) for name in given})
        yield from self._sliders([part for part in self.source.parameters() if part.symbol in needed])
        for name, number in numbers.items():
            if name in drawn:
                yield self._number(name, number_text(number))
        yield from self._steps({step.symbol: missing_where(step.missing, step.expression) for step in found})
        for symbol in map(self._taken, self.source.variables()):
            if symbol not in self.there:  # the same as another, or a number: it has its name all the same
                yield self._number(symbol, self._text(self._form(symbol)))
        yield from self._shapes()
        yield self._said()

    def _take(self, wanted: str) -> str:
        """A label that nothing has yet."""
        letter, _, below = wanted.partition("_")
        found, number = wanted, 0
        while found in self._taken_labels:
            number += 1
            found = f"{letter}_{{{','.join(filter(None, (below.strip('{}'), str(number))))}}}"
        self._taken_labels.add(found)
        return found

    # --- numbers and points ------------------------------------------------------------------------------------------

    def _text(self, node: Node) -> str:
        """An expression; a coordinate of a point is read off the point."""

        def change(part: Node) -> Node:
            if isinstance(part, Symbol) and part.name not in self.labels:
                return self._form(part.name)  # another name for it, or a number
            return part

        return print_formula(transform(node, change), "geogebra", lambda part: self._read(part.name))

    def _read(self, symbol: str) -> str:
        if symbol in self.labels:
            return self.labels[symbol]
        point, _, axis = symbol.rpartition(".")
        return f"{axis}({self.places[point]})"

    def _number(self, symbol: str, expression: str) -> _Element:
        self.there.add(symbol)
        if symbol not in self.labels:
            self.labels[symbol] = self._take(label_of(symbol.removeprefix("#").replace(" ", "_")))
        return _Element(self.labels[symbol], expression, "numeric", HIDDEN)

    def _steps(self, steps: Mapping[str, Node]) -> Iterator[_Element]:
        """Numbers in order; a point, which holds two of the steps, as soon as all that its coordinates read is there."""
        waiting = {point: (f"{point}.x", f"{point}.y") for point in self.points}
        apart = {name for pair in waiting.values() if _needed_alone(pair, steps) for name in pair}
        in_points = {name for pair in waiting.values() for name in pair} - apart
        passed: set[str] = in_points - steps.keys() | apart
        yield from self._points(waiting, passed, steps)
        for symbol, node in steps.items():
            if symbol in in_points:
                passed.add(symbol)
            else:
                yield self._number(symbol, self._text(node))
            yield from self._points(waiting, passed, steps)

    def _points(
        self, waiting: dict[str, tuple[str, str]], passed: set[str], steps: Mapping[str, Node]
    ) -> Iterator[_Element]:
        """The points that need wait no longer."""
        for point, pair in list(waiting.items()):
            if not passed.issuperset(pair):
                continue
            x, y = (steps[name] if name in steps and name not in self.there else self._form(name) for name in pair)
            if self.there.issuperset([*symbols(x), *symbols(y)]):
                del waiting[point]
                self.there.update(pair)
                yield self._point(point, x, y)

    def _form(self, symbol: str) -> Node:
        return self.forms.get(symbol, Symbol(symbol))

    def _point(self, point: str, x: Node, y: Node) -> _Element:
        mark = next(
            (each for each in self.positions.list.shapes if isinstance(each, Mark) and each.at == place_of(point)), None
        )
        shown = f'<show object="{_yes(mark is not None)}" label="{_yes(mark is not None)}"/>\n'
        pin = mark is not None and mark.kind == "pin"
        shown += _color("404040") + f'<pointSize val="{5 if pin else 3}"/>\n<labelMode val="0"/>\n'
        return _Element(self.places[point], f"({self._text(x)}, {self._text(y)})", "point", shown)

    # --- sliders -----------------------------------------------------------------------------------------------------

    def _sliders(self, parameters: Iterable[Parameter]) -> Iterator[_Element]:
        mechanism = self.mechanism
        values = dimension_values(mechanism)
        size = max((abs(values[dim.symbol]) for dim in mechanism.dimensions if dim.unit.kind == "length"), default=1.0)
        modes = self.source.modes
        ordered = sorted(parameters, key=lambda part: part.symbol != mechanism.driver.symbol)  # the driver on top
        for place, part in enumerate(ordered):
            symbol = part.symbol
            self.there.add(symbol)
            self.labels[symbol] = self._take(label_of(symbol))
            if symbol in modes:
                ends, value = (-1.0, 1.0), float(modes[symbol])
            elif symbol in values:
                value = values[symbol]
                ends = _range(value, part.unit.kind, size)
            else:
                column = self.positions.compiled.values[symbol]
                ends, value = (float(column.min()), float(column.max())), self.begun[symbol]
            if part.unit.kind == "angle":
                ends = (math.degrees(ends[0]), math.degrees(ends[1]))
            width = ends[1] - ends[0]
            step = width if symbol in modes else longest(width / STEPS or 1.0)
            yield self._slider(symbol, value, (*ends, step), part.unit.kind == "angle", place)

    def _slider(
        self, symbol: str, value: float, numbers: tuple[float, float, float], angle: bool, place: int
    ) -> _Element:
        """A slider in its row; `numbers`: from where to where it goes, and its step, of an angle in degrees."""
        unit = "°" if angle else ""
        low, high, by = (f"{number_text(part)}{unit}" for part in numbers)
        top = 40 + SLIDER_STEP * place
        # unbounded, before the value is read: negative angles would be turned, and cut off at the end of the slider
        shown = ('<angleStyle val="3"/>\n' if angle else "") + f'<value val="{number_text(value)}"/>\n'
        letter, below = parts(symbol)
        caption = f"{letter}_{{{below}}} = %v" if below else f"{letter} = %v"
        shown += f'<show object="{_yes(place < MOST_SLIDERS)}" label="true"/>\n<labelMode val="3"/>\n'
        shown += f'<caption val="{escape(caption)}"/>\n'
        shown += (
            f'<slider min="{low}" max="{high}" absoluteScreenLocation="true" width="{SLIDERS - 90}" x="20" y="{top}"'
            ' fixed="true" horizontal="true" showAlgebra="true"/>\n'
            f'<animation step="{by}" speed="1" type="0" playing="false"/>\n'
        )
        return _Element(self.labels[symbol], None, "angle" if angle else "numeric", shown)

    # --- what is drawn -----------------------------------------------------------------------------------------------

    def _shapes(self) -> Iterator[_Element]:
        for number, shape in enumerate(self.drawn, 1):
            if shape.frame is None:
                yield self._line(shape, number, self._corners(shape.corners))
                continue
            frame = [self._take(f"{name}_{{f{number}}}") for name in ("O", "U", "V")]
            for label, vector in zip(frame, shape.vectors, strict=True):
                yield _Element(label, self._corner(vector), "point", HIDDEN)
            if shape.is_curve:
                yield from self._curve(shape, number, frame[0])
                continue
            path = ", ".join(f"({number_text(a)}, {number_text(b)})" for a, b in shape.path)
            along, k = self._take(f"L_{{f{number}}}"), "k"
            yield _Element(along, f"{{{path}}}", "list", HIDDEN)
            at = f"Element[{along}, {k}]"
            corner = f"{frame[0]} + x({at}) * {frame[1]} + y({at}) * {frame[2]}"
            yield self._line(shape, number, f"Sequence[{corner}, {k}, 1, {len(shape.path)}]")
        for shape in self.traced:
            (place,) = shape.corners
            point = next(name for name in self.points if place_of(name) == place)
            driver = self.labels[self.mechanism.driver.symbol]
            label = self._take(f"{self.places[point]}path")
            shown = (
                '<show object="true" label="false"/>\n' + _color(shape.color) + '<lineStyle thickness="3" type="0"/>\n'
            )
            yield _Element(label, f"Locus[{self.places[point]}, {driver}]", "locus", shown)

    def _curve(self, shape: Shape, number: int, middle: str) -> Iterator[_Element]:
        """A cam's curve: the locus of its place in the axes of the cam, turned with these.

        GeoGebra turns no locus, but the list of its points; they are as close to each other as the screen shows.
        """
        place, curve = (self._take(f"{name}_{{f{number}}}") for name in ("K", "L"))
        yield _Element(place, f"{middle} + {self._corner(shape.corners[0])}", "point", HIDDEN)
        yield _Element(curve, f"Locus[{place}, {self.labels[self.mechanism.driver.symbol]}]", "locus", HIDDEN)
        x, y = (self._text(part) for part in shape.vectors[1])
        yield self._line(shape, number, f"Rotate[First[{curve}, Length[{curve}]], atan2({y}, {x}), {middle}]")

    def _corners(self, corners: Sequence[Vector]) -> str:
        return "{" + ", ".join(self._corner(corner) for corner in corners) + "}"

    def _corner(self, corner: Vector) -> str:
        point = next((name for name in self.points if place_of(name) == corner), None)
        return self.places[point] if point else f"({self._text(corner[0])}, {self._text(corner[1])})"

    def _line(self, shape: Shape, number: int, corners: str) -> _Element:
        """Two corners are a segment, a closed line of points a polygon, anything else a line with corners."""
        shown = f'<show object="true" label="false"/>\n<auxiliary val="true"/>\n{_color(shape.color)}'
        width = LINK if shape.border else shape.width
        shown += f'<lineStyle thickness="{max(1, round(2 * width))}" type="0"/>\n'
        closed = len(shape.corners) > 3 and shape.corners[0] == shape.corners[-1]
        label = self._take(f"{'p' if closed else 'l'}_{{{number}}}")
        if len(shape.corners) == 2:
            return _Element(label, f"Segment[{corners[1:-1]}]", "segment", shown)
        return _Element(label, f"PolyLine[{corners}]", "polyline", shown)

    def _said(self) -> _Element:
        """What is said of a position: the variables in degrees and lengths, or which links cannot be joined."""
        equations, language = self.source.equations, self.mechanism.language
        lines = []
        for symbol in self.source.variables():
            if equations.of(symbol).role == "variable":
                unit = self.mechanism.shown(equations.of(symbol).unit)
                value = self._text(self._form(self._taken(symbol)))
                # over 1°, not times 180/pi: a slider of an angle would stay an angle, of which GeoGebra shows degrees
                value, behind = (f"({value}) / (1°)", "°") if unit.in_degrees else (value, f" {unit.text}")
                lines.append(f'"{plain(symbol)} = " + ({value}) + "{behind}"')
        said = ' + "\n" + '.join(lines) or '""'
        for group in reversed(equations.groups):
            if group.number not in self.source.closing:
                continue
            holder = self.source.closing[group.number]
            links = ", ".join(body_words(self.mechanism, name).of(language) for name in group.links)
            open_ = one_line(words(language, "status.open", links=links)).replace('"', "'")
            said = f'If[IsDefined[{self._text(self._form(holder))}], {said}, "{open_}"]'
        place = f'<absoluteScreenLocation x="{WIDTH - 220}" y="40"/>\n'
        shown = f'<show object="true" label="false"/>\n{_color("404040")}{place}'
        return _Element(self._take("said"), said, "text", shown)

    def _taken(self, symbol: str) -> str:
        """What people read: an angle in the turn in which the table has it."""
        return WINDOWED.format(symbol=symbol) if symbol in self.source.branches else symbol


def _reads(shape: Shape) -> set[str]:
    return {name for vector in (*shape.vectors, *shape.corners) for part in vector for name in symbols(part)}


def _needed_alone(pair: tuple[str, str], steps: Mapping[str, Node]) -> bool:
    """Whether a step up to the second coordinate's own reads the first: then both are numbers of their own."""
    order = [name for name in steps if name in pair]
    if len(order) < 2:
        return False
    names = list(steps)
    between = names[names.index(order[0]) + 1 : names.index(order[1]) + 1]
    return any(order[0] in symbols(steps[name]) for name in between)


def _yes(shown: bool) -> str:
    return "true" if shown else "false"


def _color(color: str) -> str:
    red, green, blue = (int(color[at : at + 2], 16) for at in (0, 2, 4))
    return f'<objColor r="{red}" g="{green}" b="{blue}" alpha="0"/>\n'


def _range(value: float, kind: str, size: float) -> tuple[float, float]:
    """Through which values a slider of a dimension goes: half a turn to either side, or up to twice a length."""
    if kind == "angle":
        return value - math.pi, value + math.pi
    far = 2 * abs(value) or size
    return (0.0, far) if value > 0 else (-far, far)
