"""Functions of a mechanism as plain data: parameters, steps in order, a result. Printers spell them out.

A function knows one position only. So the direction of a vector is that within half a turn, and an angle that a table would
count in turns is taken into the turn that it has there (`kinematics.angle_branch`). A step that has no number ends the
function with #N/A. What Newton's method finds is a call of a procedure that begins where the table does (`solvers`): angles
go on from there, turns and all.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, children, renamed, transform
from livesheet.formula.written import pairwise
from livesheet.said import Words
from mechsheet.compiled import Compiled
from mechsheet.exporting.lowering import Lowering, Step
from mechsheet.kinematics.angle_branch import WINDOWED, AngleBranch, branches_of, reading_taken
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.model import Label
from mechsheet.units import NUMBER, Unit
from mechsheet.words.catalogue import Phrase
from mechsheet.words.equations import phrase


@dataclass(frozen=True, slots=True)
class Parameter:
    """An argument, in `unit`: angles mostly in radians, whatever people read."""

    symbol: str
    label: Words
    unit: Unit


@dataclass(frozen=True, slots=True)
class Routine:
    """A function. `key` is what trees call it; `guards`: steps that must be numbers although the result reads them not.

    missing  true where the result has no number (an elementary function; those with steps end at one of these)
    """

    key: str
    about: Words
    parameters: tuple[Parameter, ...]
    steps: tuple[Step, ...]
    result: Node
    unit: Unit
    guards: tuple[str, ...] = ()
    missing: Node | None = None


def unknown_key(symbol: str) -> str:
    """What trees call the procedure that finds an unknown by Newton's method; it takes all parameters."""
    return f"Newton's method for {symbol}"


class Source:
    """A mechanism with its equations as steps, from which routines are taken.

    steps    what every symbol that is not given equals at one position, by symbol, in order of solution
    solved   the unknowns that Newton's method finds, as the table calls them
    closing  the steps that have no number where a group cannot be joined, by the number of the group

    judged   without it any numbers are taken that close: for functions that belong to no mechanism
    """

    def __init__(self, compiled: Compiled, judged: bool = True) -> None:
        self.mechanism = compiled.mechanism
        self.equations = equations = compiled.equations
        self.modes = compiled.modes
        systems = [group.system for group in equations.groups if group.system is not None]
        self.solved = {
            name: own for system in systems for name, own in zip(system.variables, system.unknowns, strict=True)
        }
        lowering = Lowering(compiled)
        branches = branches_of(self.mechanism, equations, compiled.values)
        self.branches = {symbol: branch for symbol, branch in branches.items() if symbol not in self.solved}
        self.steps = self._steps(lowering, self.branches)
        if judged:  # no number while an input is none that the mechanism can have
            tolerance, impossible = self.steps[equations.tolerance], equations.impossible(self.mechanism.driver.symbol)
            self.steps[equations.tolerance] = replace(tolerance, missing=impossible)
        given = tuple(Symbol(part.symbol) for part in self.parameters())
        for symbol in self.solved:
            self.steps[symbol] = Step(symbol, Call(unknown_key(symbol), given))
        closing = {group.number: lowering.holders[group.closes] for group in equations.groups}
        self.closing = {
            group: name
            for group, name in closing.items()
            if name in self.solved or self.steps[name].missing is not None
        }

    def _steps(self, lowering: Lowering, branches: Mapping[str, AngleBranch]) -> dict[str, Step]:
        derived = {dim.symbol: dim.value for dim in self.mechanism.dimensions if not isinstance(dim.value, float)}
        found = {
            symbol: Step(symbol, derived[symbol]) for symbol in dimension_order(self.mechanism) if symbol in derived
        }
        unknowns = {own: name for name, own in self.solved.items()}
        for equation in self.equations.all:
            if equation.symbol in unknowns:  # found as the table has it; what its passes call it is the same
                name = unknowns[equation.symbol]
                found[name] = Step(name, equation.expression)
                found[equation.symbol] = Step(equation.symbol, Symbol(name))
                continue
            if equation.symbol in self.solved:
                continue
            reading = equation.role == "output" or equation.symbol in self.equations.tied
            for step in lowering.steps[equation.symbol]:
                expression = reading_taken(step.expression, branches) if reading else step.expression
                expression = expression if step.missing is None else al.rooted(expression)
                found[step.symbol] = Step(step.symbol, expression, step.missing)
            if equation.symbol in branches:
                taken = WINDOWED.format(symbol=equation.symbol)
                driver = Symbol(self.mechanism.driver.symbol)
                found[taken] = Step(taken, branches[equation.symbol].taken(Symbol(equation.symbol), driver))
        return found

    def parameters(self) -> tuple[Parameter, ...]:
        """The dimensions that are given, the driver, the assembly modes."""
        read = (
            needed_for(self.variables(), self.steps)
            if any(dim.driver_key for dim in self.mechanism.dimensions)
            else set()
        )
        given = [
            Parameter(dim.symbol, dim.label or Label(dim.symbol), dim.unit.internal)
            for dim in self.mechanism.dimensions
            if not dim.derived and (not dim.driver_key or dim.symbol in read)
        ]
        driver = self.mechanism.driver
        given.append(Parameter(driver.symbol, Phrase("function.driver"), driver.unit.internal))
        for symbol in self.mechanism.listed_symbols:
            besides = self.mechanism.driver_of(symbol)
            given.append(Parameter(symbol, phrase("further_driver"), besides.unit.internal))
        words = {group.mode: group.label for group in self.equations.groups if group.mode}
        return (*given, *(Parameter(mode, label, NUMBER) for mode, label in words.items()))

    def variables(self) -> tuple[str, ...]:
        """What has a function: link angles, displacements, moving points and outputs, in order of solution.

        What depends on the time of a motion, or on a listed speed, is no function of the position. Further drivers that are
        listed are parameters.
        """
        driver = self.mechanism.driver.symbol
        kinds = ("variable", "point", "output")
        found = (eq.symbol for eq in self.equations.columns if eq.role in kinds and eq.symbol != driver)
        by_row = {*self.mechanism.given_by_row} - {*self.mechanism.listed_symbols}
        return tuple(symbol for symbol in found if not by_row or not by_row & needed_for([symbol], self.steps))

    def routine(self, key: str, symbol: str, about: Words, order: Sequence[str] = (), windowed: bool = True) -> Routine:
        """The function of a variable.

        order     symbols of the parameters, where they are not those of `parameters`: all that the variable depends on
        windowed  an angle comes in the turn in which the table of positions has it; else as its equation gives it
        """
        taken = WINDOWED.format(symbol=symbol)
        wanted = taken if windowed and taken in self.steps else symbol
        own = needed_for([wanted], self.steps)
        needed = needed_for([wanted, *self.closing.values()], self.steps)
        parameters = {parameter.symbol: parameter for parameter in self.parameters()}
        used = [step for name, step in self.steps.items() if name in needed]
        steps, result = tidied(used, wanted, {name: Symbol(name) for name in parameters})
        return Routine(
            key,
            about,
            tuple(parameters[name] for name in order or parameters),
            steps,
            result,
            self.mechanism.shown(self.equations.of(symbol).unit.internal),
            tuple(name for name in self.closing.values() if name not in own),
        )


def tidied(rules: Sequence[Step], wanted: str, given: Mapping[str, Node]) -> tuple[tuple[Step, ...], Node]:
    """Steps and result of rules in order: numbers and other names of a symbol are put in place."""
    steps, forms = folded(rules, given)
    if steps and rules[-1].symbol == wanted == steps[-1].symbol and steps[-1].missing is None:
        return tuple(steps[:-1]), steps[-1].expression
    return tuple(steps), forms[wanted]


def folded(rules: Sequence[Step], given: Mapping[str, Node]) -> tuple[list[Step], dict[str, Node]]:
    """The steps that are left, and by what each symbol is read: itself, a number or another name."""
    forms = dict(given)
    steps: list[Step] = []
    for rule in rules:
        expression = _placed(rule.expression, forms)
        missing = None if rule.missing is None else _placed(rule.missing, forms)
        if missing is None and al.is_simple(expression):
            forms[rule.symbol] = expression
        else:
            forms[rule.symbol] = Symbol(rule.symbol)
            steps.append(Step(rule.symbol, expression, missing))
    return steps, forms


def mapped(routine: Routine, change: Callable[[Node], Node]) -> Routine:
    """The routine with every expression changed."""

    def condition(missing: Node | None) -> Node | None:
        return None if missing is None else change(missing)

    steps = tuple(Step(step.symbol, change(step.expression), condition(step.missing)) for step in routine.steps)
    return replace(routine, steps=steps, result=change(routine.result), missing=condition(routine.missing))


def with_names(routine: Routine, names: Mapping[str, str]) -> Routine:
    """The routine with other symbols."""

    def name(symbol: str) -> str:
        return names.get(symbol, symbol)

    routine = mapped(routine, lambda node: renamed(node, names))
    return replace(
        routine,
        parameters=tuple(replace(part, symbol=name(part.symbol)) for part in routine.parameters),
        steps=tuple(replace(step, symbol=name(step.symbol)) for step in routine.steps),
        guards=tuple(name(symbol) for symbol in routine.guards),
    )


def guarded(routine: Routine, result: Node, forms: Mapping[str, Node]) -> Node:
    """The result, or #N/A where one of the guards is no number."""
    if not routine.guards:
        return result
    tests = tuple(Call("ISNUMBER", (forms[name],)) for name in routine.guards)
    return Call("IF", (tests[0] if len(tests) == 1 else Call("AND", tests), result, Call("NA")))


def _placed(node: Node, forms: Mapping[str, Node]) -> Node:
    """An expression over its forms: what a form of 0 or 1 makes needless is left out."""

    def change(part: Node) -> Node:
        match part:
            case Symbol(name):
                return forms[name]
            case Binary("^", Call("SQRT", (square,)), Number(2.0)):
                return square
        return al.tidied(part)

    return transform(node, change)


def needed_for(wanted: Iterable[str], steps: Mapping[str, Step]) -> set[str]:
    """The symbols that some depend on, and these themselves."""
    stack = list(wanted)
    found = set(stack)
    while stack:
        step = steps.get(stack.pop())
        fresh = [] if step is None else [name for name in step.reads if name not in found]
        found.update(fresh)
        stack += fresh
    return found


def with_values(routine: Routine, values: Mapping[str, Node]) -> Routine:
    """The routine with parameters replaced by numbers."""
    rules = [*routine.steps, Step("result", routine.result)]
    left = tuple(parameter for parameter in routine.parameters if parameter.symbol not in values)
    given = {parameter.symbol: Symbol(parameter.symbol) for parameter in left} | dict(values)
    steps, result = tidied(rules, "result", given)
    return replace(routine, parameters=left, steps=steps, result=result)


def with_calls(routine: Routine, patterns: Sequence[Routine]) -> Routine:
    """The routine calling the patterns (routines without steps) where its expressions match them; the first that does."""
    always = [pattern for pattern in patterns if pattern.missing is None]
    sometimes = [pattern for pattern in patterns if pattern.missing is not None]

    def change(part: Node) -> Node:
        if isinstance(part, Call) and part.name == "SUMSQ":
            return pairwise(part)
        for pattern in always:
            found: dict[str, Node] = {}
            if matches(pattern.result, part, found):
                return _call(pattern, found)
        return part

    def called(step: Step) -> Step:
        for pattern in sometimes:
            found: dict[str, Node] = {}
            if pattern.missing is None or step.missing is None or not matches(pattern.missing, step.missing, found):
                continue
            if matches(pattern.result, step.expression, found):
                return Step(step.symbol, _call(pattern, found))
        return step

    routine = mapped(routine, lambda node: transform(node, change))
    return replace(routine, steps=tuple(called(step) for step in routine.steps))


def _call(pattern: Routine, found: dict[str, Node]) -> Call:
    return Call(pattern.key, tuple(found[parameter.symbol] for parameter in pattern.parameters))


def matches(pattern: Node, node: Node, found: dict[str, Node]) -> bool:
    """True when `node` is `pattern` with its symbols replaced, each by the same expression everywhere; they come in `found`.

    Patterns are a few levels deep, so recursion does.
    """
    if isinstance(pattern, Symbol):
        return found.setdefault(pattern.name, node) == node
    below, other = children(pattern), children(node)
    if type(pattern) is not type(node) or len(below) != len(other):
        return False
    if not below:
        return pattern == node
    same_head = all(getattr(pattern, name, "") == getattr(node, name, "") for name in ("op", "name"))
    return same_head and all(matches(one, two, found) for one, two in zip(below, other, strict=True))
