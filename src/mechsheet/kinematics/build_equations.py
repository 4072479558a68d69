"""From a mechanism to its equations: the driver, the groups in order, the outputs; modes picked by the sketch."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Node, Number, Symbol, symbols
from livesheet.said import Words, say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.assur import Drive, Dyad, Order, Pin, order_of
from mechsheet.kinematics.cams.segments import write_segments
from mechsheet.kinematics.dimensions import dimension_values, largest_given
from mechsheet.kinematics.driving import driver_values, given_values, listed_values
from mechsheet.kinematics.dyads.lines import solve_prp, solve_rpp
from mechsheet.kinematics.dyads.right_triangles import solve_rpr, solve_rrp
from mechsheet.kinematics.dyads.solved import Determinant, Solved
from mechsheet.kinematics.dyads.triangles import member, sketched_mode, solve_rrr, solve_within
from mechsheet.kinematics.equations import Equation, Equations, Group, Loop, System, assembly_of, validate
from mechsheet.kinematics.gear_relations import Tied
from mechsheet.kinematics.graph import Graph, graph_of
from mechsheet.kinematics.ledger import CLOSING, Ledger, given_names
from mechsheet.kinematics.loops import loops_of
from mechsheet.kinematics.mobility import check_mobility
from mechsheet.kinematics.modes import NeverClosesError, cannot_follow, cannot_show, pick_mode, way
from mechsheet.kinematics.nearest import NOTHING_MEANT, Choice, Meant, Nearest
from mechsheet.kinematics.newton.chains import Chain
from mechsheet.kinematics.newton.newton_equations import ChainWriter, Solution
from mechsheet.kinematics.newton.picking import pick_assembly, words_of
from mechsheet.kinematics.newton.steps import settled
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.points_in_link import angle_of, cartesian, number
from mechsheet.kinematics.poses import Member, Poses
from mechsheet.kinematics.rates.coefficients import Written, add_rates, wanted
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import FurtherDriver, Label, Mechanism, Quantity
from mechsheet.units import ANGLE, LENGTH
from mechsheet.words.equations import phrase

PROBED_ROWS = 200
"""Rows at the start, and as many again spread over the rest, on which modes are picked."""


@dataclass(frozen=True, slots=True)
class Found:
    """What is known when all positions and rates are written down: what forces are found from.

    chains  by its number each group that Newton's method solves
    """

    poses: Poses
    order: Order
    rates: Written
    chains: Mapping[int, Solution]


Further: TypeAlias = Callable[[Found], None]
"""Writes the forces' equations into the ledger, behind those of positions and rates and before the outputs."""


def write_stepped(
    mechanism: Mechanism, modes: Mapping[str, int] | None = None, further: Further | None = None
) -> Equations:
    """As `write_equations`, with as many Newton steps as the rows need; without `modes` the sketch picks all of them."""
    equations = write_equations(mechanism, modes or {}, further)
    if not any(group.system for group in equations.groups):
        return equations
    return settled(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)), sweep)


def write_equations(
    mechanism: Mechanism, modes: Mapping[str, int] | None, further: Further | None = None, outputs: bool = True
) -> Equations:
    """The equations of a mechanism, in order of solution.

    modes    those that are given, the sketch picks the others; None: none is picked, every mode is +1
    further  what else is to be written; without it outputs of forces are left out
    outputs  whether outputs are to be written
    Raises MechanismError: a synthesis without a solution, MobilityError, what no order of solution is known for, and where
    modes are picked BetweenModesError and NeverClosesError.
    """
    _check_solved(mechanism)
    graph = graph_of(mechanism)
    check_mobility(mechanism, graph)
    order = order_of(mechanism, graph)
    dimensions = dimension_values(mechanism)
    poses = _begun(mechanism, graph, order, dimensions)
    ledger = poses.ledger
    groups = _Groups(poses, order, dimensions, modes)
    if modes is not None:
        groups.take(_sketched(mechanism, graph, order, dimensions, modes))
    groups.write()
    _note_lengths(poses)
    rates = Written({}, {})
    if wanted(mechanism):
        rates = add_rates(poses, order, [solved for _, solved, _, _ in groups.found], groups.chains)
    if further is not None:
        further(Found(poses, order, rates, groups.chains))
    if outputs:
        _outputs(mechanism, ledger, whole=further is not None)
    inputs = [dim.symbol for dim in mechanism.dimensions]
    law = mechanism.driver.law
    task = mechanism.synthesis
    positive = {*ledger.positive, *((law.duration,) if law else ()), *(task.positive if task else ())}
    result = Equations(
        tuple(ledger.constants),
        tuple(ledger.columns),
        groups.with_loops(),
        tuple(symbol for symbol in (*inputs, mechanism.driver.symbol) if symbol in positive),
        ledger.tolerance.name if isinstance(ledger.tolerance, Symbol) else "",
        {link.name: poses.link_pose(link.name) for link in mechanism.links},
        rates.fits,
        rates.turning,
        tuple(_listed(driver) for driver in mechanism.drivers if driver.values),
        _tied(poses, order),
    )
    validate(result, (*dimensions, mechanism.driver.symbol, *mechanism.given_by_row))
    return result


def _begun(mechanism: Mechanism, graph: Graph, order: Order, dimensions: dict[str, float]) -> Poses:
    """Where the groups are to be written: what is driven is known."""
    poses = Poses(mechanism, graph, _ledger(mechanism, dimensions))
    _further_drivers(mechanism, poses.ledger)
    _pairs(poses, order)
    return poses


def _sketched(
    mechanism: Mechanism, graph: Graph, order: Order, dimensions: dict[str, float], given: Mapping[str, int]
) -> Meant:
    """The modes that the sketch decides for several groups together; a group that is alone decides by itself.

    given  modes that are given
    """
    task = mechanism.synthesis
    if mechanism.sketch.at is not None:
        return NOTHING_MEANT
    if task is not None and any(isinstance(group, Chain) for group in order.groups):
        return NOTHING_MEANT  # the task knows
    if len(order.groups) < 2 and not any(dyad.frame for dyad in order.dyads):
        return NOTHING_MEANT
    poses = _begun(mechanism, graph, order, dimensions)
    groups = _Groups(poses, order, dimensions, given, choosing=False)
    groups.write()
    return Nearest(mechanism, poses.ledger, groups.choices, dimensions).modes()


class _Groups:
    """The groups of a mechanism in order of solution: their equations, and the assembly of each.

    modes     as of `write_equations`
    choosing  False: the equations alone are asked for, and between which assemblies there is a choice (`choices`)
    """

    def __init__(
        self,
        poses: Poses,
        order: Order,
        dimensions: dict[str, float],
        modes: Mapping[str, int] | None,
        choosing: bool = True,
    ) -> None:
        self.poses = poses
        self.order = order
        self.dimensions = dimensions
        self.choosing = choosing
        self.picked = modes is not None
        self.given = dict(modes or {})
        self.choices: list[Choice] = []
        self.found: list[tuple[Dyad | Chain, Solved, int, bool]] = []
        """Each with its assembly, and whether that was left open."""
        self.chains: dict[int, Solution] = {}
        self._opened: list[str] = []
        self._left_out = {each.link.name for each in poses.mechanism.redundant}

    def write(self) -> None:
        """Write what is driven, what gears hold, and the groups."""
        for step in self.order.steps:
            match step:
                case Drive():
                    self.poses.drive(step)
                case Tied():
                    self.poses.tie(step, self.order.drives)
                case Chain():
                    self._chain(step)
                case Dyad():
                    self._dyad(step)

    def take(self, meant: Meant) -> None:
        """Take the modes that the whole sketch means, but for those that a later row may tell."""
        self._opened = [*meant.open]
        self.given |= {mode: value for mode, value in meant.modes.items() if mode not in meant.unasked}

    def with_loops(self) -> tuple[Group, ...]:
        """All groups, each with its loop closure."""
        loops = loops_of(self.poses, self.order.steps)
        return _groups(self.poses.mechanism, self.found, loops)

    def _chain(self, chain: Chain) -> None:
        """A group without a closed form."""
        mechanism, ledger = self.poses.mechanism, self.poses.ledger
        self.poses.settle_turns()  # of what is driven; those of the group are known once it has been solved
        ledger.group += 1
        start = len(ledger.columns)
        solution = self.chains[ledger.group] = ChainWriter(self.poses, chain).write()
        if not self.choosing:
            self.poses.turned.clear()  # nothing is solved: turns that a gear reads are counted in each assembly
            self._choice(solution.system.mode, solution.system.variables[0], None, solution.label, solution.system)
            return
        mode, at = self.given.get(solution.system.mode), mechanism.sketch.at

        def near(home: float) -> Mapping[str, float]:
            if mechanism.synthesis is not None:
                return _of_task(mechanism, home)
            sketched_at = number(at or 0.0, self.dimensions)
            return _traced(mechanism, sketched_at, home, solution.system.variables, solution.label)

        of_task = mechanism.synthesis is not None and mechanism.solution.force
        shown = near if (at is not None or of_task) and self.picked else None
        system, assembly, is_open = pick_assembly(
            mechanism, ledger, solution, start, self.dimensions, mode if self.picked else 1, shown
        )
        self.poses.settle_turns()
        solved = Solved(
            system.mode, words_of(mechanism, system, ledger), system.variables[0], Symbol(system.determinant),
            solution.pins, system.variables, solution.label,
            Determinant(Symbol(system.determinant), 0, False, None), system=system,
        )  # fmt: skip
        self.found.append((chain, solved, assembly, is_open or system.mode in self._opened))

    def _dyad(self, dyad: Dyad) -> None:
        mechanism, ledger = self.poses.mechanism, self.poses.ledger
        ledger.group += 1
        start = len(ledger.columns)
        solved = _solve_dyad(self.poses, dyad)
        if not self.choosing:
            leaning = sketched_mode(mechanism.sketch, dyad, self.dimensions) if dyad.frame else None
            self.poses.settle_turns()
            self._choice(solved.mode, solved.closes, self._known_mode(dyad, solved), solved.label, leaning=leaning)
            return
        value, is_open = 1, True
        if self.picked:
            self._look_at_sketch(solved)
            mode = self._known_mode(dyad, solved)
            value, is_open = pick_mode(mechanism, ledger, solved, start, self.dimensions, mode)
            is_open = is_open or solved.mode in self._opened
        self.poses.settle_turns()
        self.found.append((dyad, solved, assembly_of(value), is_open))

    def _choice(
        self,
        mode: str,
        closes: str,
        known: int | None,
        label: Words,
        system: System | None = None,
        leaning: int | None = None,
    ) -> None:
        """Note that there is one, where `known` does not say which."""
        given = self.given.get(mode, known)
        self.choices.append(Choice(self.poses.ledger.group, mode, closes, given, system, label, leaning))

    def _look_at_sketch(self, solved: Solved) -> None:
        """Where the sketch says at which driver value it was drawn, it gives the modes of all groups there."""
        mechanism = self.poses.mechanism
        if mechanism.sketch.at is None or not solved.mode or solved.mode in self.given:
            return
        shown = _shown(mechanism, mechanism.sketch.at)
        self._opened = [group.mode for group in shown if group.open]
        # the numbers of more than two assemblies are those of the first row
        self.given = {group.mode: group.mode_value for group in shown if group.system is None} | dict(self.given)

    def _known_mode(self, dyad: Dyad, solved: Solved) -> int | None:
        """The mode that need not be picked by the sketch of this group."""
        mechanism = self.poses.mechanism
        if solved.mode in self.given:
            return self.given[solved.mode]
        found = _mode_of_task(mechanism, solved)
        if found is not None:
            return round(number(found, self.dimensions))
        # the length of a link that is left out, from the first pin to the second, is no negative number
        return 1 if self._left_out.intersection(dyad.bodies) else None


def _check_solved(mechanism: Mechanism) -> None:
    """Raise MechanismError with the reason where a synthesis finds no dimensions."""
    task = mechanism.synthesis
    if task is None:
        return
    values = dimension_values(mechanism)
    if all(math.isfinite(values[symbol]) for symbol in task.taken):
        return
    why = next((words for symbol, words in task.reasons if not math.isfinite(values[symbol])), None)
    message = say("the task has no solution") if why is None else say("{why}", why=why)
    raise MechanismError(Fault(message, key="synthesis", hint=say("give it another one")))


def _mode_of_task(mechanism: Mechanism, solved: Solved) -> Node | None:
    """The mode that a synthesis finds, as a group counts it: a task goes from the driven link to the other."""
    task = mechanism.synthesis
    if task is None or solved.mode not in task.mode:
        return None
    mode = Symbol(task.results[task.mode[solved.mode]])
    return mode if counts_from_driven(mechanism, solved.pins) else al.neg(mode)


def counts_from_driven(mechanism: Mechanism, pins: Sequence[str]) -> bool:
    """Whether the mode of a group with such pins is counted from the driven link to the other, as a task counts it."""
    driven = next((link for link in mechanism.links if link.name == mechanism.driver.link), None)
    return driven is None or pins[0] in driven.points


def _at_rest(mechanism: Mechanism, values: tuple[Quantity, ...]) -> Mechanism:
    """Positions alone, at these values of the driver. Outputs stay, for their names are taken, but may read what is gone."""
    driver = replace(mechanism.driver, values=values, law=None, speeds=(), accelerations=(), times=(), speed=None)
    return replace(mechanism, driver=driver, dynamics=None)


def _shown(mechanism: Mechanism, at: Quantity) -> tuple[Group, ...]:
    """The groups, with their modes, as the sketch shows them at the driver value `at`, which need not be a row."""
    there = standing(mechanism, number(at, dimension_values(mechanism)))
    there = replace(there, sketch=replace(mechanism.sketch, at=None))
    try:
        return write_equations(there, {}, outputs=False).groups
    except NeverClosesError as error:
        raise cannot_show(error.links) from error


def standing(mechanism: Mechanism, at: float) -> Mechanism:
    """The mechanism with one row, at this value of the driver; positions are all that is asked for."""
    return replace(_at_rest(mechanism, (at,)), drivers=_listed_at(mechanism, np.array([at])))


def _listed_at(mechanism: Mechanism, path: Array) -> tuple[FurtherDriver, ...]:
    """What is driven besides, those that are listed row by row at other values of the driver."""
    listed = listed_values(mechanism, dimension_values(mechanism), path)
    return tuple(
        replace(other, values=tuple(float(value) for value in listed[other.symbol])) if other.values else other
        for other in mechanism.drivers
    )


def _further_drivers(mechanism: Mechanism, ledger: Ledger) -> None:
    """The values of what is driven besides, where they follow from the driver or are the same in every row."""
    for driver in mechanism.drivers:
        if driver.segments is not None:
            write_segments(driver, mechanism.driver.symbol, ledger)
        elif driver.follows is not None:
            unit = LENGTH if driver.joint else ANGLE
            ledger.define(driver.symbol, driver.follows, unit, phrase("further_driver"), "variable")


def _tied(poses: Poses, order: Order) -> tuple[str, ...]:
    """Symbols of what further drivers and ties decide."""
    held = [held for step in order.steps if isinstance(step, Tied) for held in step.bodies]
    links = poses.links
    angles = [links[each.variable].angle_symbol if each.variable in links else each.variable for each in held]
    return (*(driver.symbol for driver in poses.mechanism.drivers), *angles)


def _listed(driver: FurtherDriver) -> Equation:
    unit = LENGTH if driver.joint else ANGLE
    return Equation(driver.symbol, Symbol(driver.symbol), "driver", unit, phrase("further_driver"))


def _ledger(mechanism: Mechanism, dimensions: dict[str, float]) -> Ledger:
    given = given_values(mechanism, dimensions)
    rows = following = len(given[mechanism.driver.symbol])
    if rows > 2 * PROBED_ROWS:
        following = PROBED_ROWS
        rest = np.linspace(PROBED_ROWS, rows - 1, PROBED_ROWS).astype(int)
        given = {name: np.concatenate([column[:PROBED_ROWS], column[rest]]) for name, column in given.items()}
    ledger = Ledger(dimensions, mechanism.driver.symbol, given, given_names(mechanism))
    ledger.following = following
    ledger.tolerance = ledger.define(
        ledger.reserve("tol"),
        al.mul(Number(CLOSING), largest_given(mechanism)),
        LENGTH,
        phrase("tolerance"),
        "constant",
    )
    return ledger


def _solve_dyad(poses: Poses, dyad: Dyad) -> Solved:
    if dyad.frame:
        return solve_within(poses, dyad)
    match dyad.kind:
        case "RRR":
            return solve_rrr(poses, dyad)
        case "RRP":
            return solve_rrp(poses, dyad)
        case "RPR":
            return solve_rpr(poses, dyad)
        case "PRP":
            return solve_prp(poses, dyad)
        case "RPP":
            return solve_rpp(poses, dyad)


def _of_task(mechanism: Mechanism, home: float) -> Mapping[str, float]:
    """Values at the driver's value `home` in the assembly that a task finds: it knows those of dyads."""
    there = replace(_at_rest(mechanism, (home,)), solution=replace(mechanism.solution, force=False))
    equations = write_equations(there, {}, outputs=False)
    return {name: float(column[0]) for name, column in sweep(there, equations, np.array([home])).items()}


def _traced(
    mechanism: Mechanism, at: float, home: float, variables: Sequence[str], links: Words
) -> Mapping[str, float]:
    """Values at the driver's value `home` of the position that the sketch shows at `at`, followed in small steps."""
    path = way(at, home, not mechanism.driver.joint)
    still = _at_rest(mechanism, tuple(float(value) for value in path))
    followed = replace(still, drivers=_listed_at(mechanism, path), sketch=replace(mechanism.sketch, at=None))
    values = sweep(followed, write_equations(followed, {}, outputs=False), path)
    closes = np.all(np.isfinite([values[name] for name in variables]), axis=0).tolist()
    if not closes[0]:
        raise cannot_show(links)
    if not all(closes):  # behind a place where it comes apart Newton's method may find any assembly
        raise cannot_follow(links, mechanism.driver, at, path[closes.index(False)])
    return {name: float(values[name][-1]) for name in variables}


def _groups(
    mechanism: Mechanism, found: list[tuple[Dyad | Chain, Solved, int, bool]], loops: tuple[Loop, ...]
) -> tuple[Group, ...]:
    return tuple(
        Group(
            index, dyad.kind, dyad.bodies, solved.pins, solved.unknowns, loop, solved.mode,
            solved.assemblies, assembly, solved.closes, solved.apart, is_open, solved.label,
            solved.transmission, solved.sides, solved.system, _mode_of_task(mechanism, solved),
            None if solved.system else _determinant(dyad, solved.determinant), solved.determinant.dead,
            solved.degenerate,
        )
        for index, ((dyad, solved, assembly, is_open), loop) in enumerate(zip(found, loops, strict=True), 1)
    )  # fmt: skip


def _determinant(dyad: Dyad | Chain, found: Determinant) -> Node:
    """That of the closure: where the driven pair is turned against the dyad's first link, and not the link against the pair,
    the unknowns are -q1 and q2 - q1, which turns the sign."""
    turned = isinstance(dyad, Dyad) and dyad.frame and dyad.whole[0] == dyad.first[0]
    return al.neg(found.product) if turned else found.product


def _pairs(poses: Poses, order: Order) -> None:
    """Both sides of a driven joint that is on nothing known move as one assembly: where they are in it."""
    alone = {step.bodies for step in order.steps if isinstance(step, Drive)}
    for drive in order.drives:
        if drive.bodies not in alone and drive.reverse().bodies not in alone:
            poses.members[drive.moving] = _in_pair(poses, drive)


def _in_pair(poses: Poses, drive: Drive) -> Member:
    """Where the moving side of a driven joint is in the frame of the other."""
    if isinstance(drive.joint, Pin):
        point = drive.joint.point
        base, own = poses.own_point(drive.base, point), poses.own_point(drive.moving, point)
        return member(poses.turn_of(drive), base, own)
    joint = drive.joint.joint
    line = angle_of(joint.angle)
    along = cartesian(Symbol(drive.symbol), al.ZERO).turned(line)
    start = poses.through(joint)
    end = cartesian(Symbol(drive.symbol), al.ZERO) if start.is_zero and line == Angle() else start + cartesian(*along)
    turn = line + angle_of(joint.orientation)
    return member(turn, end, poses.own_point(drive.moving, joint.point))


def _note_lengths(poses: Poses) -> None:
    """A moving link that joins two pins has a length, as the crank; where more pins are, they are places, of any sign.

    Raises MechanismError for a length that is given as 0 or less: the workbook's cell would refuse it.
    """
    given = {dim.symbol: dim for dim in poses.mechanism.dimensions if isinstance(dim.value, float)}
    faults = []
    for link in poses.mechanism.links[1:]:
        pins = [point for point, bodies in poses.graph.pins if link.name in bodies]
        wrong = given.get(poses.points[link.name].note_length(*pins)) if len(pins) == 2 else None
        if wrong is not None and not wrong.path:
            message = say(
                "{symbol} is the length of {link} from {start} to {end}: it must be greater than 0, not {value:.12g}",
                symbol=wrong.symbol, link=link.name, start=pins[0], end=pins[1], value=wrong.value,
            )  # fmt: skip
            hint = say("which way the link points at first is said by the driver's start or by the sketch")
            faults.append(Fault(message, key=f"dimensions.{wrong.symbol}", hint=hint))
    if faults:
        raise MechanismError(faults)


def _outputs(mechanism: Mechanism, ledger: Ledger, whole: bool) -> None:
    """Outputs over variables, points and dimensions; each may use the ones before it.

    whole  False where forces have not been written: outputs that read them are left out
    """
    ledger.group = -1
    faults = []
    for output in mechanism.outputs:
        unknown = [name for name in symbols(output.formula) if name not in ledger.values]
        if unknown and mechanism.dynamics is not None and not whole:
            continue
        if unknown:
            faults.append(
                Fault(say('"{name}" is not known here', name=unknown[0]), key=f"outputs.{output.symbol}.formula")
            )
            continue
        label = output.label or Label(output.symbol)
        ledger.define(output.symbol, output.formula, output.unit, label, "output")
    if faults:
        raise MechanismError(faults)
