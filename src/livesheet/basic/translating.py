"""Functions in Basic as LAMBDAs: each statement is an expression that holds all that follows it.

A variable that gets a value is a new name of LET; branches that go on alike call what follows as a function of the variables
that they have changed; a loop is a function that is handed to itself. So nothing is ever changed, and only what is reached
is computed, as in Basic.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..diagnostics import Fault
from ..formula.book import DefinedName
from ..formula.functions import FUNCTIONS
from ..formula.nodes import Apply, Binary, Boolean, Call, ErrorValue, Local, Node, Number, Symbol, transform, walk
from ..said import reason, say
from .expressions import NotReadError, whole
from .reading import Assign, Do, Exit, For, Function, GoTo, If, Label, OnError, Statements

Values = Mapping[str, Node]
"""What each variable is at a place; what is not among them has no value yet and counts as 0."""

Follow = Callable[[Values], Node]

FAILED = ErrorValue("#VALUE!")
"""What Excel shows where a function breaks off."""


MOST_DEEP = 60
"""Conditions and loops one behind or within the other: each is some calls deep, in the formula too."""

MOST_BLOCKS = 3000
"""Blocks that are written down for a function: what follows a GoTo is written at each, so a few may ask for millions."""


def lambdas(functions: Sequence[Function], source: str = "") -> tuple[list[DefinedName], list[Fault]]:
    """The functions as names, and of each that is left out why."""
    found: list[DefinedName] = []
    faults: list[Fault] = []
    own = {function.name.lower(): function for function in functions}
    for function in functions:
        try:
            found.append(DefinedName(function.name, _Writer(function, own).formula()))
        except NotReadError as error:
            message = say(
                "the function {name} is left out: {found} is not read", name=function.name, found=reason(error)
            )
            faults.append(Fault(message, file=source, line=function.line, about="routine"))
    return found, faults


@dataclass(frozen=True, slots=True)
class _Around:
    """Where a statement stands.

    follow   what is done behind its block
    leave    what is done behind the innermost loop of each kind
    error    the label where errors go on
    gone     labels that were gone to already
    """

    follow: Follow
    leave: Mapping[str, Follow]
    error: str = ""
    gone: frozenset[str] = frozenset()

    def within(self, follow: Follow, leave: Mapping[str, Follow] | None = None) -> _Around:
        """The same with another end."""
        return _Around(follow, {**self.leave, **(leave or {})}, self.error, self.gone)


class _Writer:
    """One function."""

    def __init__(self, function: Function, own: Mapping[str, Function]) -> None:
        self.function, self.own = function, own
        self.result = function.name.lower()
        self.count = 0
        self.depth = self.blocks = 0

    def formula(self) -> Node:
        """The LAMBDA."""
        given = {part.name: Local(f"{part.name} given", part.optional) for part in self.function.parameters}
        start: dict[str, Node] = dict(given)
        for part in self.function.parameters:
            if part.name in self.function.whole:
                start[part.name] = whole(given[part.name])
        body = self.block(self.function.body, 0, start, _Around(self.end, {}))
        if _has_loop(self.function.body):
            body = _cell_by_cell(body)
        return Call("LAMBDA", (*given.values(), body))

    def end(self, values: Values) -> Node:
        """What the function gives."""
        return values.get(self.result, Number(0.0))

    def fresh(self, name: str) -> Local:
        """A name that no cell and no other value has."""
        self.count += 1
        return Local(f"{name} {self.count}")

    # --- statements ------------------------------------------------------------------------------------------------

    def block(self, statements: Statements, place: int, values: Values, around: _Around) -> Node:
        """What the statements from a place on give, with all that follows them."""
        self.blocks += 1
        if self.blocks > MOST_BLOCKS:
            raise NotReadError(say("a function that goes so many ways"))
        self.deeper()
        found = self._block(statements, place, values, around)
        self.depth -= 1
        return found

    def deeper(self) -> None:
        """One condition or loop more, up to the limit."""
        self.depth += 1
        if self.depth > MOST_DEEP:
            raise NotReadError(say("more than {most} conditions and loops behind each other", most=MOST_DEEP))

    def _block(self, statements: Statements, place: int, values: Values, around: _Around) -> Node:
        pairs: list[tuple[Local, Node]] = []
        checked: list[Node] = []
        while place < len(statements) and isinstance(statements[place], Assign):
            statement = statements[place]
            assert isinstance(statement, Assign)
            bound = self.bound(statement.value, values)
            local = self.fresh(statement.name)
            pairs.append((local, whole(bound) if statement.name in self.function.whole else bound))
            if broken := self.breaks_off(statement.value, local):
                checked.append(broken)
            before, values = values, {**values, statement.name: local}
            place += 1
            if checked and self.failed(before, around) != self.failed(values, around):
                break  # what is done about an error depends on where it happens
        if not pairs:
            return self.statement(statements, place, values, around)
        inner = self.block(statements, place, values, around)
        if checked:
            failing = checked[0] if len(checked) == 1 else Call("OR", tuple(checked))
            inner = Call("IF", (failing, self.failed(values, around), inner))
        return Call("LET", (*(part for pair in pairs for part in pair), inner))

    def statement(self, statements: Statements, place: int, values: Values, around: _Around) -> Node:
        if place == len(statements):
            return around.follow(values)
        statement = statements[place]

        def rest(known: Values) -> Node:
            return self.block(statements, place + 1, known, around)

        match statement:
            case If(branches, otherwise):
                return self.choice(branches, otherwise, values, around, rest)
            case For():
                return self.counted(statement, values, around, rest)
            case Do():
                return self.repeated(statement, values, around, rest)
            case Exit("function"):
                return self.end(values)
            case Exit(kind) if kind in around.leave:
                return around.leave[kind](values)
            case GoTo(label):
                return self.gone_to(label, values, around)
            case Label():
                return rest(values)
            case OnError(label):
                return self.block(
                    statements, place + 1, values, _Around(around.follow, around.leave, label, around.gone)
                )
        raise NotReadError(type(statement).__name__)

    def gone_to(self, label: str, values: Values, around: _Around) -> Node:
        """All from a label of the function on."""
        body = self.function.body
        at = next((at for at, each in enumerate(body) if isinstance(each, Label) and each.name == label), None)
        if at is None or label in around.gone:
            raise NotReadError(f"GoTo {label}")
        return self.block(body, at, values, _Around(self.end, {}, "", around.gone | {label}))

    def failed(self, values: Values, around: _Around) -> Node:
        """What is done about an error."""
        return self.gone_to(around.error, values, around) if around.error else FAILED

    def breaks_off(self, expression: Node, local: Local) -> Node | None:
        """Whether an assignment breaks off; an error as a value (of a function, of another variable) does not."""
        if isinstance(expression, Number | Boolean | ErrorValue | Symbol):
            return None
        if isinstance(expression, Call) and expression.name in self.own:
            return Call("ISERR", (local,))  # #N/A is what functions give on purpose
        return Call("ISERROR", (local,))

    def choice(
        self, branches: Sequence[tuple[Node, Statements]], otherwise: Statements, values: Values, around: _Around,
        rest: Follow,
    ) -> Node:  # fmt: skip
        """Branches, and what follows them as a function where several of them come to it."""
        parts = [*(body for _, body in branches), otherwise]
        if sum(not _always_leaves(body) for body in parts) <= 1:
            return self.chosen(branches, otherwise, values, around.within(rest))
        changed = sorted(set().union(*(_assigned(body) for body in parts)))
        call, defined = self.function_of("then", changed, values, rest)
        chosen = self.chosen(branches, otherwise, values, around.within(call))
        return Call("LET", (*defined, chosen))

    def chosen(
        self, branches: Sequence[tuple[Node, Statements]], otherwise: Statements, values: Values, around: _Around
    ) -> Node:
        if not branches:
            return self.block(otherwise, 0, values, around)
        condition, body = branches[0]
        local = self.fresh("condition")
        taken = self.block(body, 0, values, around)
        self.deeper()
        other = self.chosen(branches[1:], otherwise, values, around)
        self.depth -= 1
        asked = Call("IF", (local, taken, other))
        guarded = Call("IF", (Call("ISERROR", (local,)), self.failed(values, around), asked))
        return Call("LET", (local, self.bound(condition, values), guarded))

    def function_of(
        self, name: str, changed: Sequence[str], values: Values, rest: Follow
    ) -> tuple[Follow, tuple[Node, Node]]:
        """What follows as a function of the variables that were changed: how it is called, and its name with what it is."""
        local = self.fresh(name)
        own = {each: self.fresh(each) for each in changed}
        body = rest({**values, **own})

        def call(known: Values) -> Node:
            return Apply(local, tuple(known.get(each, Number(0.0)) for each in changed))

        return call, (local, Call("LAMBDA", (*own.values(), body)))

    def counted(self, loop: For, values: Values, around: _Around, rest: Follow) -> Node:
        """For: the variable beside the others that the loop changes."""
        last, step = self.fresh("last"), self.fresh("step")
        upwards = Binary("<=", Symbol(loop.name), last)
        downwards = Binary(">=", Symbol(loop.name), last)
        condition = Call("IF", (Binary(">=", step, Number(0.0)), upwards, downwards))
        again = (*loop.body, Assign(loop.name, Binary("+", Symbol(loop.name), step)))
        first = self.bound(loop.first, values)
        start = {**values, loop.name: whole(first) if loop.name in self.function.whole else first}
        rounds = self.rounds(condition, None, again, "for", start, around, rest)
        return Call("LET", (last, self.bound(loop.last, values), step, self.bound(loop.step, values), rounds))

    def repeated(self, loop: Do, values: Values, around: _Around, rest: Follow) -> Node:
        return self.rounds(loop.before, loop.after, loop.body, "do", values, around, rest)

    def rounds(
        self, before: Node | None, after: Node | None, body: Statements, kind: str, values: Values, around: _Around,
        rest: Follow,
    ) -> Node:  # fmt: skip
        """A loop: a function of what it changes, which is handed to itself."""
        changed = sorted(_assigned(body))
        leave, defined = self.function_of("after", changed, values, rest)
        loop, itself = self.fresh("loop"), self.fresh("itself")
        own = {each: self.fresh(each) for each in changed}

        def again(known: Values) -> Node:
            more = Apply(itself, (itself, *(known.get(each, Number(0.0)) for each in changed)))
            if after is None:
                return more
            return Call("IF", (self.bound(after, known), more, leave(known)))

        inside = {**values, **own}
        round_ = self.block(body, 0, inside, around.within(again, {kind: leave}))
        if before is not None:
            round_ = Call("IF", (self.bound(before, inside), round_, leave(inside)))
        started = Apply(loop, (loop, *(values.get(each, Number(0.0)) for each in changed)))
        return Call("LET", (*defined, loop, Call("LAMBDA", (itself, *own.values(), round_)), started))

    # --- expressions -------------------------------------------------------------------------------------------------

    def bound(self, expression: Node, values: Values) -> Node:
        """An expression over what its variables are."""

        def change(part: Node) -> Node:
            match part:
                case Symbol(name) if name in values:
                    return values[name]
                case Symbol(name) if name in self.function.constants:
                    return self.bound(self.function.constants[name], {})
                case Symbol(name):
                    called = self.own.get(name)
                    return Number(0.0) if called is None or name == self.result else Call(called.name, ())
                case Call(name, args) if name in self.own:
                    self.refuse_changed(self.own[name], expression)
                    return Call(self.own[name].name, args)
                case Call(name) if name not in FUNCTIONS:
                    raise NotReadError(name)
            return part

        return transform(expression, change)

    def refuse_changed(self, called: Function, expression: Node) -> None:
        """A function that assigns to its parameter changes the caller's variable, unless it is ByVal."""
        assigned = _assigned(called.body)
        changing = [at for at, part in enumerate(called.parameters) if part.name in assigned and not part.by_value]
        for part in walk(expression):
            if isinstance(part, Call) and part.name == called.name.lower():
                for at in changing:
                    if at < len(part.args) and isinstance(part.args[at], Symbol):
                        raise NotReadError(called.parameters[at].name)


def _cell_by_cell(body: Node) -> Node:
    """The same, for one cell at a time, as REDUCE is computed: in a column of calls each row takes rounds of its own, and to
    follow all of them together costs more with every round."""
    return Call("REDUCE", (Number(0.0), Number(0.0), Call("LAMBDA", (Local("so far"), Local("one"), body))))


def _has_loop(statements: Statements) -> bool:
    for each in statements:
        match each:
            case For() | Do():
                return True
            case If(branches, otherwise) if any(map(_has_loop, (*(body for _, body in branches), otherwise))):
                return True
    return False


def _assigned(statements: Statements) -> frozenset[str]:
    """Variables that statements may change."""
    return frozenset(_names(statements))


def _names(statements: Statements) -> Iterator[str]:
    for each in statements:
        match each:
            case Assign(name):
                yield name
            case If(branches, otherwise):
                for _, body in branches:
                    yield from _names(body)
                yield from _names(otherwise)
            case For(name, body=body):
                yield name
                yield from _names(body)
            case Do(body=body):
                yield from _names(body)


def _always_leaves(statements: Iterable[object]) -> bool:
    """Whether what follows the statements is never come to from them."""
    for each in statements:
        match each:
            case Exit() | GoTo():
                return True
            case If(branches, otherwise) if otherwise:
                if all(_always_leaves(body) for body in (*(body for _, body in branches), otherwise)):
                    return True
    return False
