"""Functions of a mechanism as plain data: parameters, steps in order, a result. Printers spell them out.

A routine is made from the list of equations. What the equations define in the row above is taken as in the first row of a
sweep, and an angle whose turns a table would count is taken into the turn that it has there (`sheet.tables`): a function
knows one position only. A step that stands for a missing position (`IF(…, NA(), …)`) ends the function with #N/A.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, Node, Symbol, symbols, transform, walk
from mechsheet.kinematics.equations import Equations
from mechsheet.model import Mechanism, Words
from mechsheet.sheet.expansion import definitions, substituted
from mechsheet.sheet.plan import Plan, plan_of
from mechsheet.sheet.windows import WINDOWED, with_windows
from mechsheet.units import NUMBER, Unit


@dataclass(frozen=True, slots=True)
class Parameter:
    """An argument, in `unit`: angles mostly in radians, whatever people read."""

    symbol: str
    label: Words
    unit: Unit


@dataclass(frozen=True, slots=True)
class Step:
    """`symbol = expression`, over parameters and the steps before it."""

    symbol: str
    expression: Node

    @property
    def missing(self) -> Node | None:
        """The condition under which the step has no number, where it is written `IF(condition, NA(), value)`."""
        match self.expression:
            case Call("IF", (condition, Call("NA", ()), _)):
                return condition
        return None


@dataclass(frozen=True, slots=True)
class Routine:
    """A function. `key` is what trees call it; `guards`: steps that must be numbers although the result reads them not."""

    key: str
    about: Words
    parameters: tuple[Parameter, ...]
    steps: tuple[Step, ...]
    result: Node
    unit: Unit
    guards: tuple[str, ...] = ()


class Source:
    """A mechanism with its equations as rules, from which routines are taken."""

    def __init__(self, mechanism: Mechanism, equations: Equations) -> None:
        self.mechanism = mechanism
        self.plan: Plan = plan_of(mechanism, equations)
        self.equations = self.plan.equations
        self.rules = with_windows(self.plan, definitions(mechanism, self.equations))
        self.modes = {group.mode: group.mode_value for group in equations.groups if group.mode}

    def parameters(self) -> tuple[Parameter, ...]:
        """The dimensions that are given, the driver, the assembly modes."""
        given = [
            Parameter(dim.symbol, dim.label or Words(dim.symbol, dim.symbol), dim.unit.internal)
            for dim in self.mechanism.dimensions
            if not dim.derived
        ]
        driver = self.mechanism.driver
        given.append(Parameter(driver.symbol, Words("driver", "tahrik"), driver.unit.internal))
        words = {group.mode: group.label for group in self.equations.groups if group.mode}
        return (*given, *(Parameter(mode, label, NUMBER) for mode, label in words.items()))

    def variables(self) -> tuple[str, ...]:
        """What has a function: link angles, displacements, moving points and outputs, in order of solution."""
        driver = self.mechanism.driver.symbol
        kinds = ("variable", "point", "output")
        return tuple(eq.symbol for eq in self.equations.columns if eq.role in kinds and eq.symbol != driver)

    def routine(self, key: str, symbol: str, about: Words, order: Sequence[str] = (), windowed: bool = True) -> Routine:
        """The function of a variable.

        order     symbols of the parameters, where they are not those of `parameters`: all that the variable depends on
        windowed  an angle comes in the turn in which the table of positions has it; else as its equation gives it
        """
        window = WINDOWED.format(symbol=symbol)
        wanted = window if windowed and window in self.rules else symbol
        closing = [group.closes for group in self.equations.groups if _can_be_missing(self.rules.get(group.closes))]
        own = _needed([wanted], self.rules)
        needed = _needed([wanted, *closing], self.rules)
        rules = {name: rule for name, rule in self.rules.items() if name in needed}
        parameters = {parameter.symbol: parameter for parameter in self.parameters()}
        steps, result = tidied(rules, wanted, {name: Symbol(name) for name in parameters})
        return Routine(
            key,
            about,
            tuple(parameters[name] for name in order or parameters),
            steps,
            result,
            self.mechanism.shown(self.equations.of(symbol).unit.internal),
            tuple(name for name in closing if name not in own),
        )


def tidied(rules: Mapping[str, Node], wanted: str, given: Mapping[str, Node]) -> tuple[tuple[Step, ...], Node]:
    """Steps and result of rules in order: numbers, other names of a symbol and the first row's turns are put in place."""
    forms = dict(given)
    steps: list[Step] = []
    last = list(rules)[-1]
    for symbol, rule in rules.items():
        expression = _decided(substituted(rule, forms))
        if al.is_simple(expression):
            forms[symbol] = expression
        elif symbol == wanted == last and not _can_be_missing(expression):
            return tuple(steps), expression
        else:
            forms[symbol] = Symbol(symbol)
            steps.append(Step(symbol, expression))
    return tuple(steps), forms[wanted]


def with_names(routine: Routine, renamed: Mapping[str, str]) -> Routine:
    """The routine with other symbols."""

    def change(part: Node) -> Node:
        return Symbol(renamed[part.name]) if isinstance(part, Symbol) and part.name in renamed else part

    def name(symbol: str) -> str:
        return renamed.get(symbol, symbol)

    return replace(
        routine,
        parameters=tuple(replace(part, symbol=name(part.symbol)) for part in routine.parameters),
        steps=tuple(Step(name(step.symbol), transform(step.expression, change)) for step in routine.steps),
        result=transform(routine.result, change),
        guards=tuple(name(symbol) for symbol in routine.guards),
    )


def guarded(routine: Routine, result: Node, forms: Mapping[str, Node]) -> Node:
    """The result, or #N/A where one of the guards is no number."""
    if not routine.guards:
        return result
    tests = tuple(Call("ISNUMBER", (forms[name],)) for name in routine.guards)
    return Call("IF", (tests[0] if len(tests) == 1 else Call("AND", tests), result, Call("NA")))


def _decided(node: Node) -> Node:
    """ISNUMBER decided (a step that has no number ends the function before another asks for it), 0/2 left out."""

    def change(part: Node) -> Node:
        match part:
            case Call("IF", (Call("ISNUMBER", (Symbol(),)), value, _)):
                return value
            case Binary("/", left, right):
                return al.div(left, right)
            case Binary("+", left, right):
                return al.add(left, right)
            case Binary("-", left, right):
                return al.sub(left, right)
        return part

    return transform(node, change)


def _can_be_missing(rule: Node | None) -> bool:
    return rule is not None and any(isinstance(part, Call) and part.name == "NA" for part in walk(rule))


def _needed(wanted: Iterable[str], rules: Mapping[str, Node]) -> set[str]:
    stack = list(wanted)
    found = set(stack)
    while stack:
        rule = rules.get(stack.pop())
        fresh = [] if rule is None else [name for name in symbols(rule) if name not in found]
        found.update(fresh)
        stack += fresh
    return found


def with_values(routine: Routine, values: Mapping[str, Node]) -> Routine:
    """The routine with parameters replaced by numbers."""
    rules = {step.symbol: step.expression for step in routine.steps} | {"result": routine.result}
    left = tuple(parameter for parameter in routine.parameters if parameter.symbol not in values)
    given = {parameter.symbol: Symbol(parameter.symbol) for parameter in left} | dict(values)
    steps, result = tidied(rules, "result", given)
    return replace(routine, parameters=left, steps=steps, result=result)
