"""Velocity and acceleration loop equations as a textbook writes them: the derivatives of a group's loop closure by time.

    r e^(i theta)   ->   (r' + i omega r) e^(i theta)   ->   (r'' - omega^2 r + i (alpha r + 2 omega r')) e^(i theta)

Source: Soeylemez, Mechanisms, sections 4.2 and 4.3.
"""

from __future__ import annotations

from collections.abc import Callable

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Node, Symbol, symbols
from livesheet.workbook import Rich
from mechsheet.kinematics.equations import Loop, Vector
from mechsheet.model import rate_symbols
from mechsheet.sheet.mathematics import Part, written
from mechsheet.sheet.plan import Plan
from mechsheet.words.symbols import plain

Rate = tuple[Node, Node]

NOTHING: Rate = (al.ZERO, al.ZERO)


class LoopRates:
    """The loops of a mechanism, differentiated by time."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        mechanism, equations = plan.mechanism, plan.equations.equations
        self.rules = {equation.symbol: equation.expression for equation in equations.all}
        self.known: dict[str, Rate] = dict(equations.turning)
        for joint in mechanism.joints:
            first, second = rate_symbols(joint.symbol, False)
            self.known[joint.symbol] = (Symbol(first), Symbol(second))
        driver = mechanism.driver_rates
        self.known[mechanism.driver.symbol] = (Symbol(driver[0]), Symbol(driver[1]))

    def velocities(self, loop: Loop) -> Rich:
        """The loop's first derivative."""
        return self._equation(loop, self._velocity)

    def accelerations(self, loop: Loop) -> Rich:
        """The loop's second derivative."""
        return self._equation(loop, self._acceleration)

    def _equation(self, loop: Loop, write: Callable[[Vector], list[Part]]) -> Rich:
        sides: list[list[Part]] = []
        for side in (loop.left, loop.right):
            terms = [term for vector in side if (term := write(vector))]
            joined: list[Part] = []
            for index, term in enumerate(terms):
                joined += [(" + ", ""), *term] if index else term
            sides.append(joined or [("0", "")])
        return Rich((*sides[0], (" = ", ""), *sides[1]))

    # --- one vector -------------------------------------------------------------------------------------------

    def _velocity(self, vector: Vector) -> list[Part]:
        length, (omega, _) = vector.length, self._rate(vector.angle.expression())
        slides, _ = self._rate(length)
        turns = al.mul(length, omega)
        return self._product([(slides, False), (turns, True)], vector)

    def _acceleration(self, vector: Vector) -> list[Part]:
        length, (omega, alpha) = vector.length, self._rate(vector.angle.expression())
        velocity, slides = self._rate(length)
        along = al.sub(slides, al.mul(length, al.square(omega)))
        across = al.add(al.mul(length, alpha), al.mul(al.TWO, al.mul(velocity, omega)))
        return self._product([(along, False), (across, True)], vector)

    def _product(self, factors: list[tuple[Node, bool]], vector: Vector) -> list[Part]:
        """(real + i imaginary) e^(i angle); nothing where both are 0."""
        left = [(node, across) for node, across in factors if not al.is_zero(node)]
        if not left:
            return []
        parts: list[Part] = []
        for index, (node, across) in enumerate(left):
            parts += [(" + ", "")] if index else []
            text = [*written(node, self.plan.language).parts]
            several = any(sign in word for word, kind in text for sign in ("+", "−") if not kind)
            inside: list[Part] = [("(", ""), *text, (")", "")] if across and several else text
            parts += [("i", "italic"), ("·", ""), *inside] if across else inside
        angle = vector.angle
        if angle.constant and angle.degrees == 0:
            return parts
        several = len(left) > 1 or any(sign in word for word, kind in parts for sign in (" + ", " − ") if not kind)
        whole: list[Part] = [("(", ""), *parts, (")", "")] if several else parts
        turn = written(angle.expression(), self.plan.language)
        return [*whole, ("·", ""), ("e", "italic"), ("i" + _raised(angle.expression(), turn), "super")]

    def _rate(self, node: Node) -> Rate:
        """First and second derivative of what is a sum of angles, or of displacements."""
        first: Node = al.ZERO
        second: Node = al.ZERO
        for name in symbols(node):
            once, twice = self.known[name] if name in self.known else self._followed(name)
            if not (al.is_zero(once) and al.is_zero(twice)):
                by = derivative(node, name)
                first, second = al.add(first, al.mul(by, once)), al.add(second, al.mul(by, twice))
        return first, second

    def _followed(self, name: str) -> Rate:
        """Of a symbol that stands for an expression."""
        return self._rate(self.rules[name]) if name in self.rules else NOTHING


def _raised(angle: Node, turn: Rich) -> str:
    """An angle as plain text, which can be set high."""
    if isinstance(angle, Symbol):
        return plain(angle.name)
    return f"({turn.plain})"
