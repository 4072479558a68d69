"""The dyads PRP and RPP: two known lines meet. One solution, no mode.

    B1 + k1 d1 = B2 + k2 d2,    e = B2 - B1,    D = sin(delta2 - delta1)
    k1 = (e_x sin(delta2) - e_y cos(delta2)) / D,    k2 = (e_x sin(delta1) - e_y cos(delta1)) / D

PRP: both links slide on known lines, so both angles are known; the inner pin is where its two lines meet.
RPP: the outer slide gives the second link's angle, the inner slide the first's; the lines are those of the two slides.
Parallel lines do not meet, or coincide and leave the position undetermined: #N/A. Source: Cramer's rule.
"""

from __future__ import annotations

from dataclasses import dataclass

from livesheet.diagnostics import Fault
from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Call, Node, Symbol
from livesheet.formula.vectors import Vector, cross
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.assur import Dyad, Pin
from mechsheet.kinematics.dyads.solved import ONE_ASSEMBLY, Solved, lines_cross
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.graph import Slide
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.points_in_link import angle_of
from mechsheet.kinematics.poses import Guide, Poses
from mechsheet.units import LENGTH, NUMBER
from mechsheet.words.equations import phrase

PARALLEL = 1e-12
"""Lines whose directions differ by less [rad] count as parallel."""


@dataclass(frozen=True, slots=True)
class _Meeting:
    """Two lines with displacements of these names meet k1 and k2 along them; `sine`: D.

    closes    symbol that is a number where they meet, "" where they always do
    parallel  the condition for lines that coincide
    """

    names: tuple[str, str]
    k1: Node
    k2: Node
    sine: Node
    closes: str
    parallel: Node | None

    def solved(self, poses: Poses, dyad: Dyad, pin: str, turned: bool) -> Solved:
        """What is known of the dyad."""
        label = phrase("group_two_slides", links=poses.both(dyad), pin=pin, slides=", ".join(self.names))
        return Solved(
            "", ONE_ASSEMBLY, self.closes or self.names[0], None, (pin,), self.names, label,
            lines_cross(self.sine, turned), degenerate=self.parallel,
        )  # fmt: skip


def _meet(ledger: Ledger, e: Vector, delta1: Angle, delta2: Angle, names: tuple[str, str]) -> _Meeting:
    """Raises MechanismError for lines that are parallel whatever the dimensions."""
    sine = al.sin(delta2 - delta1)
    e_x = ledger.hoist("e_x", e[0], LENGTH, phrase("between_lines", axis="x"))
    e_y = ledger.hoist("e_y", e[1], LENGTH, phrase("between_lines", axis="y"))

    def across(delta: Angle) -> Node:
        return cross((e_x, e_y), (al.cos(delta), al.sin(delta)))

    fixed = al.value_of(sine)
    parallel: Node | None = None
    if fixed is not None and abs(fixed) < PARALLEL:
        message = say(
            "the lines of {first} and {second} are parallel in every position: they never meet",
            first=names[0], second=names[1],
        )  # fmt: skip
        raise MechanismError(Fault(message, key="joints", hint=say("change the angle of one of them")))
    if fixed is not None:
        d: Node = sine
        closes = ""
    else:
        sine = ledger.hoist("D_0", sine, NUMBER, phrase("sine_between_lines"))
        crossing = Condition(Call("ABS", (sine,)), al.number(PARALLEL))
        column = ledger.column("D", sine, NUMBER, phrase("sine_where_they_meet"), [crossing])
        parallel = Call("AND", (crossing.fails, al.less(Call("ABS", (across(delta2),)), ledger.tolerance)))
        d, closes = column, column.name
    return _Meeting(names, al.div(across(delta2), d), al.div(across(delta1), d), d, closes, parallel)


def solve_prp(poses: Poses, dyad: Dyad) -> Solved:
    """Write the equations of a PRP dyad down."""
    first, second, inner = dyad.outer[0], dyad.outer[1], dyad.inner
    if not (isinstance(first, Slide) and isinstance(second, Slide) and isinstance(inner, Pin)):
        raise TypeError(f"not a PRP dyad: {dyad}")
    guides = (poses.guide(first, dyad.first), poses.guide(second, dyad.second))
    starts = [
        _pin_line(poses, assembly, guide, inner.point)
        for assembly, guide in zip((dyad.first, dyad.second), guides, strict=True)
    ]
    e = (al.sub(starts[1][0], starts[0][0]), al.sub(starts[1][1], starts[0][1]))
    names = guides[0].symbol, guides[1].symbol
    meeting = _meet(poses.ledger, e, guides[0].delta, guides[1].delta, names)
    for guide, k in zip(guides, (meeting.k1, meeting.k2), strict=True):
        poses.displacement(guide.symbol, guide.signed(k))
    for assembly, guide in zip((dyad.first, dyad.second), guides, strict=True):
        poses.fix_on_guide(assembly, guide, Symbol(guide.symbol))
    return meeting.solved(poses, dyad, inner.point, turned=guides[0].sign == guides[1].sign)


def _pin_line(poses: Poses, assembly: tuple[str, ...], guide: Guide, pin: str) -> tuple[Node, Node]:
    """Where the pin would be at displacement 0 of the assembly's guide."""
    x, y = (poses.point(assembly, pin) - guide.moving).turned(guide.angle)
    return al.add(guide.x, x), al.add(guide.y, y)


def solve_rpp(poses: Poses, dyad: Dyad) -> Solved:
    """Write the equations of an RPP dyad down."""
    outer, slide, inner = dyad.outer[0], dyad.outer[1], dyad.inner
    if not (isinstance(outer, Pin) and isinstance(slide, Slide) and isinstance(inner, Slide)):
        raise TypeError(f"not an RPP dyad: {dyad}")
    ledger, joint = poses.ledger, inner.joint
    guide = poses.guide(slide, dyad.second)
    line_turn = angle_of(joint.angle)
    on_second = inner.on in dyad.second
    if on_second:  # the first link's point moves on a line of the second
        delta = guide.angle + poses.members[inner.on].angle + line_turn
        angle = delta + angle_of(joint.orientation) - poses.members[inner.body].angle
        own, fixed = poses.own_point(inner.body, joint.point), poses.through(joint)
        sign = 1
    else:  # a line of the first link moves on a point of the second
        delta = guide.angle + poses.members[inner.body].angle - angle_of(joint.orientation)
        angle = delta - line_turn - poses.members[inner.on].angle
        own, fixed = poses.through(joint), poses.own_point(inner.body, joint.point)
        sign = -1
    delta = ledger.hoist_angle(f"delta_{joint.symbol}", delta, phrase("direction_of", what=joint.symbol))
    poses.directions[joint.symbol] = delta
    first_body, second_body = (inner.body, inner.on) if on_second else (inner.on, inner.body)
    own = poses.in_assembly(first_body, own, "slide")
    fixed = poses.in_assembly(second_body, fixed, "guide")
    p = outer.point
    x1, y1 = (own - poses.point(dyad.first, p)).turned(angle)
    x2, y2 = (fixed - guide.moving).turned(guide.angle)
    xp, yp = poses.xy[p]
    e = (al.sub(al.add(xp, x1), al.add(guide.x, x2)), al.sub(al.add(yp, y1), al.add(guide.y, y2)))
    # guide + k1 d1 + (fixed) + sign s d2 = P + (own):  k1 d1 = e - k2 d2 with k2 = sign s, so k2 enters with a minus.
    meeting = _meet(ledger, e, guide.delta, delta, (guide.symbol, joint.symbol))
    poses.displacement(guide.symbol, guide.signed(meeting.k1))
    poses.displacement(joint.symbol, al.neg(meeting.k2) if sign > 0 else meeting.k2)
    poses.fix_on_guide(dyad.second, guide, Symbol(guide.symbol))
    poses.fix(dyad.first, angle, poses.point(dyad.first, p), xp, yp)
    return meeting.solved(poses, dyad, p, turned=guide.sign != sign)
