"""What the kinds of synthesis share: a writer of steps, `symbol = expression`, in the one expression tree.

A kind writes its steps as a textbook does, in the description's own notation, over names of its own. A name that is
taken by a dimension of the mechanism becomes `a2_given` where the task gives it and `a2_exact` where it is a result: the
dimension `a2` itself is the result as the mechanism uses it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, with_symbols
from livesheet.formula.parser import parse_description
from livesheet.said import Words
from mechsheet.model import Dimension, TaskPlace
from mechsheet.units import Unit
from mechsheet.words.catalogue import is_key
from mechsheet.words.equations import step_words

PLACE = ("synthesis",)
"""What the places of all dimensions of a synthesis begin with."""

DETERMINED = "1e-12"
"""A determinant of sines and cosines below it is nothing but rounding: the equations do not decide."""


@dataclass(frozen=True, slots=True)
class Units:
    """The units in which the task's lengths, angles and plain numbers are read."""

    length: Unit
    angle: Unit
    number: Unit


@dataclass(frozen=True, slots=True)
class Task:
    """What a description says below [synthesis], checked.

    given     where it stands -> the number in internal units
    positive  keys whose numbers must be greater than 0
    chosen    see `Synthesis.chosen`
    function  the function to be generated, over `x`
    """

    given: Mapping[TaskPlace, float]
    positive: Collection[str] = ()
    chosen: Mapping[str, str] = field(default_factory=dict)
    function: Node | None = None

    def has(self, *place: str | int) -> bool:
        """Whether the task says something there."""
        return place in self.given

    @property
    def points(self) -> int:
        """How many precision points there are."""
        return int(self.chosen["points"])


class Writer:
    """Collects the dimensions of a synthesis, in order.

    own    names of the mechanism's own dimensions, outputs and summaries
    plain  those of its dimensions that are numbers: they give what the task leaves out
    """

    def __init__(self, task: Task, units: Units, own: Collection[str], plain: Collection[str]) -> None:
        self.task, self.units = task, units
        self.own, self.plain = frozenset(own), frozenset(plain)
        self.dimensions: list[Dimension] = []
        self.inputs: dict[TaskPlace, str] = {}
        self.steps: list[str] = []
        self.sides: list[str] = []
        self.results: dict[str, str] = {}
        self.positive: list[str] = []
        self.reasons: list[tuple[str, Words]] = []
        self.names: dict[str, str] = {}
        self.roots: dict[str, tuple[str, str, str]] = {}

    # ---- what is given

    def length(self, name: str, *place: str | int, words: str = "", **parts: object) -> None:
        """An input that is a length; it stands at `place`, or under its own name; `words` is the key of what it is."""
        self._input(name, place or (name,), self.units.length, words, parts)

    def angle(self, name: str, *place: str | int, words: str = "", **parts: object) -> None:
        """An input that is an angle."""
        self._input(name, place or (name,), self.units.angle, words, parts)

    def number(self, name: str, *place: str | int, words: str = "", **parts: object) -> None:
        """An input that is a plain number."""
        self._input(name, place or (name,), self.units.number, words, parts)

    def _input(self, name: str, place: TaskPlace, unit: Unit, words: str, parts: Mapping[str, object]) -> None:
        if place not in self.task.given and name in self.plain:
            self.names[name] = name  # a dimension of the mechanism gives it
            return
        symbol = self._named(name, "given")
        value = self.task.given[place]
        label = step_words(words or str(place[0]), **parts)
        shown = unit.written(value)
        self.dimensions.append(Dimension(symbol, value, unit, label, shown=shown, path=(*PLACE, *place)))
        self.inputs[place] = symbol
        if place[0] in self.task.positive:
            self.positive.append(symbol)

    # ---- what follows

    def step(self, name: str, text: str, unit: Unit, words: str, needs: str = "", **parts: object) -> None:
        """`name = text`; `words` is the key of what it is.

        needs  what must be greater than 0 for it to exist: else it is #N/A
        """
        self._derived(self._named(name, "step"), self.parsed(text), unit, words, needs, parts)

    def result(self, name: str, text: str, unit: Unit, words: str, needs: str = "", **parts: object) -> None:
        """A step that the mechanism may take as a dimension."""
        symbol = self._named(name, "exact")
        self._derived(symbol, self.parsed(text), unit, words, needs, parts)
        self.results[name] = symbol

    def also(self, name: str) -> None:
        """An input or a step that is a result as it is, too."""
        self.results[name] = self.names[name]

    def one_of_two(self, name: str) -> None:
        """A step that is 1 or −1: on which of two sides something lies, which of two assemblies is meant."""
        self.sides.append(self.names[name])

    def node(self, name: str, node: Node, unit: Unit, words: str, **parts: object) -> None:
        """A step whose expression is given as a tree; it need not have a value."""
        symbol = self._named(name, "step")
        self._derived(symbol, node, unit, words, "", parts)
        self._reason(symbol, words)

    def rounding(self, symbol: str) -> Dimension:
        """What lengths are rounded to."""
        value = self.task.given["round",]
        return Dimension(symbol, value, self.units.length, step_words("round"), shown=value, path=(*PLACE, "round"))

    def _derived(
        self, symbol: str, node: Node, unit: Unit, words: str, needs: str, parts: Mapping[str, object]
    ) -> None:
        if needs:
            node = where(self.parsed(needs), node)
            self._reason(symbol, words)
        self.dimensions.append(Dimension(symbol, node, unit, step_words(words, **parts), path=PLACE))
        self.steps.append(symbol)

    def _reason(self, symbol: str, words: str) -> None:
        """Why the step has no value, where there are words for it."""
        if is_key(f"step.none.{words}"):
            self.reasons.append((symbol, step_words(f"none.{words}")))

    def _named(self, name: str, kind: str) -> str:
        symbol = f"{name}_{kind}" if name in self.own else name
        self.names[name] = symbol
        return symbol

    def parsed(self, text: str) -> Node:
        """The tree of an expression over the kind's own names."""
        return with_symbols(parse_description(text), {name: Symbol(symbol) for name, symbol in self.names.items()})


def where(margin: Node, node: Node) -> Node:
    """The expression where `margin` is greater than 0, else #N/A."""
    return Call("IF", (Binary(">", margin, Number(0.0)), node, Call("NA")))


def says(value: Node) -> Node:
    """An expression without the question whether it exists: as a textbook writes it."""
    match value:
        case Call("IF", (_, node, Call("NA"))):
            return node
    return value


def root(w: Writer, name: str, middle: bool = False) -> None:
    """Steps for a real root of  x^3 + b_cubic x^2 + c_cubic x + d_cubic = 0, whose last is `name`.

    The largest where there are three; `middle`: the one between the others, where there are three.
    """
    plain = w.units.number
    w.step("p_cubic", "c_cubic - b_cubic^2/3", plain, "depressed")
    w.step("q_cubic", "2*b_cubic^3/27 - b_cubic*c_cubic/3 + d_cubic", plain, "depressed")
    w.step("disc", "(q_cubic/2)^2 + (p_cubic/3)^3", plain, "discriminant")
    turn = " - 2*pi/3" if middle else ""
    cosine = "max(-1, min(1, 3*q_cubic/(2*p_cubic)*sqrt(-3/p_cubic)))"
    three = f"2*sqrt(-p_cubic/3)*cos(acos({cosine})/3{turn})"
    if middle:
        w.step("y_cubic", three, plain, "depressed_root", "-disc")
    else:
        w.step("w_cubic", "where(disc, -sign(q_cubic)*(abs(q_cubic)/2 + sqrt(disc))^(1/3), 0)", plain, "cardano")
        w.step("y_cubic", f"where(disc, w_cubic - p_cubic/(3*w_cubic), {three})", plain, "depressed_root")
    w.step("x_cubic", "y_cubic - b_cubic/3", plain, "cubic_root")
    value = "(((x_cubic + b_cubic)*x_cubic + c_cubic)*x_cubic + d_cubic)"
    slope = "((3*x_cubic + 2*b_cubic)*x_cubic + c_cubic)"
    w.step(name, f"x_cubic - {value}/{slope}", plain, "cubic_newton")
    w.roots[w.names[name]] = (w.names["b_cubic"], w.names["c_cubic"], w.names["d_cubic"])
