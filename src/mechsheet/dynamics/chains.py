"""Reactions of a group that Newton's method solves: what its equations hold, by the transposed Jacobian.

Let the unknown x_j of a carrier change alone. What acts on the carrier and on those that are reached over it does the work
Q_j then, and is held by the links between the carriers alone, each along its own equation, with an intensity L_i:

    J^T L = Q        Q_j = sum of (X-A) x F + sum of T about the carrier's pin A, or sum of F . d along its line

With S and M(P) of a link between two carriers (`acting`), w from its first pin P to its second Q, l = |w|:

    two pins     force on it at Q: L w - M(P) J w / l^2,      at P: -S minus that
    pin, line    force on it at P: L n - (S.d) d,             from the line: -(S.n) - L along n, couple about P -M(P)
    a pin of two carriers: (L_x, L_y) on the later one
    a gear or a rack: -L is its lambda (`teeth`)

then each carrier is held where it is reached, the last first. The determinant is that of the rates.
Source: the principle of virtual work; Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, chapter 13.
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, renamed
from livesheet.formula.vectors import Vector, dot, minus, negative, over, times, together, turned
from mechsheet.dynamics.acting import Acting, ActingForces, Force, moment_of, sum_of
from mechsheet.dynamics.joints import Joints
from mechsheet.dynamics.teeth import Teeth
from mechsheet.kinematics.graph import Assembly
from mechsheet.kinematics.newton.chains import Binary, Carrier
from mechsheet.kinematics.newton.newton_equations import Solution, Span, holder
from mechsheet.kinematics.newton.rates import solved
from mechsheet.model import Gear
from mechsheet.units import NUMBER
from mechsheet.words.equations import phrase


class ChainReactions:
    """Of one group of a mechanism.

    hung  by body what links between carriers are known to exert on it, whatever the intensities
    """

    def __init__(self, solution: Solution, acting: ActingForces, joints: Joints, teeth: Teeth) -> None:
        self.solution, self.chain, self.system = solution, solution.chain, solution.system
        self.acting, self.joints, self.teeth = acting, joints, teeth
        self.poses, self.motions, self.columns = acting.poses, acting.motions, acting.columns
        self.hung: dict[str, Acting] = {}
        self.sums: dict[Assembly, Vector] = {}
        self.moments: dict[Assembly, Node] = {}
        self.across: dict[Assembly, Vector] = {}

    def write(self, det: Node) -> None:
        """All joints of the group; `det` is what its rates are divided by."""
        for binary in self.chain.binaries:
            self._known_of(binary)
        held = iter(self._intensities(det))
        for binary in self.chain.binaries:
            self._held(binary, next(held))
        for point, _, other in self.chain.shut:
            body = self.motions.with_point(other, point)
            self.joints.outer(point, body, (next(held), next(held)))
        for relation in self.chain.relations:
            effort = al.neg(next(held))
            if isinstance(relation, Gear):
                effort = al.mul(effort, self.columns.metre)
            self.teeth.exert(relation, effort)
        for carrier in reversed(self.chain.carriers):
            self._reached(carrier)

    # --- what is known of the links between the carriers --------------------------------------------------------

    def _at(self, point: str) -> Vector:
        return self.poses.xy[point]

    def _known_of(self, binary: Binary) -> None:
        """S, M(P), and what they make it exert on the two bodies that it joins."""
        assembly, first, second = binary.assembly, binary.pin, binary.other
        p = self._at(first)
        total = self.sums[assembly] = together(self.acting.total(body) for body in assembly)
        moment = self.moments[assembly] = al.total(self.acting.moment(body, p) for body in assembly)
        if isinstance(second, str):
            across = self.across[assembly] = self._across(assembly, self.solution.spans[assembly], moment)
            self._hang(holder(self.poses, self.chain, first, assembly), Force(minus(total, across), p))
            self._hang(holder(self.poses, self.chain, second, assembly), Force(across, self._at(second)))
            return
        d = self.motions.direction(second)
        n = turned(d)
        self._hang(holder(self.poses, self.chain, first, assembly), Force(times(dot(total, d), d), p))
        self._hang(second.beyond(assembly), Force(times(dot(total, n), n), p), moment)

    def _across(self, assembly: Assembly, span: Span, moment: Node) -> Vector:
        """The part across the way of what a link exerts at its second pin: M(P) J w / l^2."""
        turning = over(moment, al.mul(al.square(span.length), self.columns.metre))
        label = phrase("across_link", link=self.poses.name(assembly))
        turning = self.columns.grey(f"m_{self.acting.number(assembly[0])}", turning, NUMBER, label)
        return times(turning, turned(span.way))

    def _hang(self, body: str, force: Force, couple: Node = al.ZERO) -> None:
        self.hung.setdefault(body, Acting()).add(force, couple)

    # --- the intensities ----------------------------------------------------------------------------------------

    def _intensities(self, det: Node) -> list[Node]:
        columns = self.columns
        efforts = [self._along(carrier) for carrier in self.chain.carriers]
        turning = all(isinstance(carrier.reached, str) for carrier in self.chain.carriers)
        if turning:
            det = al.mul(det, columns.metre)
        else:
            efforts = [
                over(effort, columns.metre) if isinstance(carrier.reached, str) else effort
                for carrier, effort in zip(self.chain.carriers, efforts, strict=True)
            ]
        found = solved(self.system, efforts, transposed=True)
        label = phrase("newton_minor")
        minors: dict[str, str] = {}
        for name, node in found.minors:
            column = columns.grey(name, renamed(node, minors), NUMBER, label)
            minors[name] = _name(column)
        intensities = []
        for number, node in enumerate(found.numerators, 1):
            words = phrase("held_by", number=str(number))
            tail = f"_{self._group}" if self._group > 1 else ""
            intensities.append(columns.grey(f"lambda_{number}{tail}", over(renamed(node, minors), det), NUMBER, words))
        return intensities

    @property
    def _group(self) -> int:
        return self.poses.ledger.group

    def _along(self, carrier: Carrier) -> Node:
        """Q of a carrier's unknown."""
        forces, couples = self._felt(carrier)
        number = self.acting.number(carrier.assembly[0])
        joint = carrier.reached
        what = self.poses.name(carrier.assembly)
        if isinstance(joint, str):
            return self.acting.torque(f"Q{number}", moment_of(forces, self._at(joint)), couples, what)
        along = dot(sum_of(forces), self.motions.direction(joint))
        if joint.body not in carrier.assembly:
            along = al.neg(along)
        return self.columns.grey(f"Q{number}", along, self.columns.force, phrase("sum_along", link=what))

    def _felt(self, carrier: Carrier) -> tuple[list[Force], list[Node]]:
        """What acts on a carrier, with what those that are reached over it hand on: over a pin no couple, for an angle is
        counted from the ground and does not change with that of the carrier below; over a slide all, for both turn alike."""
        forces: list[Force] = []
        couples: list[Node] = []
        for body in carrier.assembly:
            own, hung = self.acting.of(body), self.hung.get(body, Acting())
            forces += [*own.forces, *hung.forces]
            couples += [*own.couples, *hung.couples]
        for other in self.chain.carriers:
            joint = other.reached
            if other == carrier or self._below(other) not in carrier.assembly:
                continue
            handed, turning = self._felt(other)
            if isinstance(joint, str):
                forces.append(Force(sum_of(handed), self._at(joint)))
            else:
                forces += handed
                couples += turning
        return forces, couples

    def _below(self, carrier: Carrier) -> str:
        """The body from which a carrier is reached."""
        joint = carrier.reached
        if isinstance(joint, str):
            return holder(self.poses, self.chain, joint, carrier.assembly)
        return joint.beyond(carrier.assembly)

    # --- the joints ---------------------------------------------------------------------------------------------

    def _held(self, binary: Binary, intensity: Node) -> None:
        assembly, first, second = binary.assembly, binary.pin, binary.other
        at_first = self.motions.with_point(assembly, first)
        total = self.sums[assembly]
        if isinstance(second, str):
            span = self.solution.spans[assembly]
            force = minus(times(intensity, span.way), self.across[assembly])
            force = self.joints.outer(second, self.motions.with_point(assembly, second), force)
            self.joints.outer(first, at_first, minus(negative(total), force))
            return
        d = self.motions.direction(second)
        n = turned(d)
        self.joints.outer(first, at_first, minus(times(intensity, n), times(dot(total, d), d)))
        normal = al.neg(al.add(dot(total, n), intensity))
        self.joints.slide(second, second.side(assembly), normal, al.neg(self.moments[assembly]), self._at(first))

    def _reached(self, carrier: Carrier) -> None:
        """Where a carrier is reached it is held against all else that acts on it by now."""
        assembly, joint = carrier.assembly, carrier.reached
        total = negative(together(self.acting.total(body) for body in assembly))
        if isinstance(joint, str):
            self.joints.outer(joint, self.motions.with_point(assembly, joint), total)
            return
        at = self._at(joint.joint.point)
        couple = al.neg(al.total(self.acting.moment(body, at) for body in assembly))
        normal = dot(total, turned(self.motions.direction(joint)))
        self.joints.slide(joint, joint.side(assembly), normal, couple, at)


def _name(column: Node) -> str:
    if not isinstance(column, Symbol):
        raise TypeError(f"a minor without a column: {column}")
    return column.name
