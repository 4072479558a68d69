"""Newton's method in Basic: a group's solver as procedures of the module, and the variables that it keeps.

What is kept between calls is how far the way has been gone: the places on it are the same for all calls, so a value does not
depend on what was asked before. Hundreds of cells that follow one another then cost some passes each. LibreOffice keeps
variables from call to call only if they are Global, and shares these between modules: their names begin as the functions do.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Number, Symbol, symbols
from livesheet.formula.printer import print_formula
from mechsheet.exporting.functions.basic_body import KEYWORDS, Body, comment, shown_name, wrapped
from mechsheet.exporting.functions.routines import unknown_key
from mechsheet.exporting.functions.solvers import Block, Solver
from mechsheet.exporting.lowering import Step
from mechsheet.exporting.program import brought, identifiers
from mechsheet.kinematics.newton.changed_dimensions import LEAP, STEADY, TREND
from mechsheet.kinematics.newton.system import CLOSED, FIRST_PASSES, LED, SETTLED
from mechsheet.words.catalogue import words

FARTHEST = 40_000
"""Steps of the drivers: what lies farther away is #N/A."""

LOCALS = (
    "again", "arguments", "asked", "before", "correction", "determinant", "earlier", "far", "first", "found", "given",
    "here", "i", "index", "other", "pass", "place", "residual", "same", "share", "steady", "steps", "stride", "x",
)  # fmt: skip
"""Variables of the procedures."""

PARTS = (
    "asked", "before", "Begin", "begun", "found", "Given", "Go", "home", "kept", "last", "made", "Pass", "Return", "sign",
    "Step", "Still", "stride", "there", "x",
)  # fmt: skip
"""What follows a solver's name and _ in the names of its procedures, and of the variables that it keeps."""


def solver_names(solvers: Sequence[Solver], taken: Collection[str]) -> dict[int, str]:
    """Number of a group -> what its procedures begin with; none of these is like a name that is taken."""
    numbers = {solver.name: solver.number for solver in solvers}
    beginnings = [name.rpartition("_")[0] for name in taken]
    return {numbers[key]: name for key, name in identifiers(numbers, [*KEYWORDS, *taken, *beginnings]).items()}


def solver_calls(solvers: Sequence[Solver], names: Mapping[int, str]) -> dict[str, str]:
    """How each unknown is asked for, by what trees call it."""
    found = {}
    for solver in solvers:
        arguments = ", ".join(f"{{{index}}}" for index in range(len(solver.asked)))
        for index, key in enumerate(solver.keys):
            found[key] = f"{names[solver.number]}({index}, Array({arguments}))"
    return found


def declarations(solver: Solver, name: str) -> list[str]:
    """The variables of the module, which VBA wants before the first procedure."""
    unknowns, drives = len(solver.keys) - 1, len(solver.drives) - 1
    return [
        f"Global {name}_kept As Boolean, {name}_begun As Boolean, {name}_found As Boolean",
        f"Global {name}_asked({len(solver.asked) - 1}) As Double, {name}_there({len(solver.still.results)}) As Double",
        f"Global {name}_home({unknowns}) As Double, {name}_sign As Double",
        f"Global {name}_stride({drives}) As Double, {name}_made As Long",
        f"Global {name}_last({unknowns}) As Double, {name}_before({unknowns}) As Double, {name}_x({unknowns}) As Double",
        "",
    ]


def procedures(
    solver: Solver, names: Mapping[int, str], calls: Mapping[str, str], taken: Iterable[str], language: str
) -> str:
    """The procedures of a group, with a comment over the first."""
    return "\n".join(_Writer(solver, names, calls, taken).lines(language))


class _Writer:
    """The procedures of one group."""

    def __init__(
        self, solver: Solver, names: Mapping[int, str], calls: Mapping[str, str], taken: Iterable[str]
    ) -> None:
        self.solver, self.calls, self.name = solver, calls, names[solver.number]
        self.taken = [
            *LOCALS,
            *taken,
            *(f"{name}_{part}" for name in names.values() for part in PARTS),
            *names.values(),
        ]
        self.still, self.drives = len(solver.still.results), len(solver.drives)

    def lines(self, language: str) -> list[str]:
        """All of them."""
        solver, name = self.solver, self.name
        unknowns = ", ".join(shown_name(symbol) for symbol in solver.passing.given[: len(solver.keys)])
        about = words(language, "basic.solver", links=solver.label, unknowns=unknowns, led=LED)
        found = [comment(line) for line in about.split("\n")]
        differing = self._differing()
        for line in brought("basic_newton.bas").format(**self._counts()).splitlines():
            for each in differing[line] if line.startswith("@") else [line]:
                found += wrapped(each, "        ")
        count = len(solver.keys)
        corrections = [*_places("correction", count), "residual", "determinant"]
        still, given = (
            _places(array, len(block.results))
            for array, block in ((f"{name}_there", solver.still), ("given", solver.reading))
        )
        passed = [*_places("x", count), *_places("given", len(solver.passing.given) - count)]
        arrays = "x() As Double, given() As Double, correction() As Double"
        return [
            *found,
            "",
            *self._block("Still", "asked() As Double", solver.still, _places("asked", len(solver.asked)), still),
            *self._block(
                "Given", "here() As Double, given() As Double", solver.reading,
                _places("here", len(solver.reading.given)), given,
            ),
            *self._block(
                "Pass", f"{arrays}, residual As Double, determinant As Double", solver.passing, passed, corrections
            ),
        ]  # fmt: skip

    def _counts(self) -> dict[str, object]:
        """Numbers of `brought/basic_newton.bas`: the last index of each array, and what the method itself knows."""
        solver = self.solver
        return {
            "name": self.name,
            "arguments": len(solver.asked) - 1,
            "first": solver.first_drive,
            "last": solver.first_drive + self.drives - 1,
            "drives": self.drives - 1,
            "unknowns": len(solver.keys) - 1,
            "here": len(solver.reading.given) - 1,
            "given": len(solver.reading.results) - 1,
            "stays": self.still - 1,
            "still": self.still,
            "mode": solver.asked.index(solver.mode),
            "passes": solver.passes,
            "share": f"far - {self.name}_made" if self.drives == 1 else "1",
            "farthest": FARTHEST,
            "led": LED,
            "first_passes": FIRST_PASSES,
            "steady": STEADY,
            "settled": _number(SETTLED),
            "closed": _number(CLOSED),
        }

    def _differing(self) -> dict[str, list[str]]:
        """The lines there that stand for others, from group to group: a word with @."""
        solver, name = self.solver, self.name
        ways = [
            al.sub(Symbol(f"asked({solver.first_drive + at})"), drive.home) for at, drive in enumerate(solver.drives)
        ]
        parts = [al.div(Call("ABS", (way,)), drive.stride) for way, drive in zip(ways, solver.drives, strict=True)]
        if self.drives == 1:  # the places are the same however far it goes
            strides = [al.mul(Call("SIGN", (ways[0],)), solver.drives[0].stride)]
        else:
            strides = [al.div(way, Symbol("steps")) for way in ways]
        gone = Symbol(f"({name}_made + 1)")
        following = [
            al.add(drive.home, al.mul(gone, Symbol(f"stride({at})"))) for at, drive in enumerate(solver.drives)
        ]
        homes = [_said(drive.home) for drive in solver.drives]
        others = _places("other", len(solver.earlier))
        behind = _places("here", len(solver.reading.given))[self.still + self.drives :]
        trend = "If Not (Abs(x({0}) - 2 * before({0}) + earlier({0})) < {1}) Then Exit Function"
        leap = (
            f"If Not (Abs(x({{0}}) - {name}_last({{0}}) - share * ({name}_last({{0}}) - {name}_before({{0}}))) < {{1}}) "
            "Then Exit Function"
        )
        radians = LEAP * math.pi / 180
        return {
            "@far": _indented(1, [f"far = {_said(al.largest(parts))}"]),
            "@strides": _indented(1, [f"stride({at}) = {_said(node)}" for at, node in enumerate(strides)]),
            "@next": _indented(2, [f"place({at}) = {_said(node)}" for at, node in enumerate(following)]),
            "@declared": _indented(
                1, [f"Dim found As Variant, other({len(others) - 1}) As Double"] if others else []
            ),
            "@starts": self._starts(),
            "@at_home": _indented(
                1, [
                    *(f"here({self.still + at}) = {home}" for at, home in enumerate(homes)),
                    *self._earlier(homes, others),
                ],
            ),
            "@way": _indented(2, self._way(others)),
            "@trends": _indented(3, [trend.format(at, _number(TREND * scale)) for at, scale in enumerate(solver.scales)]),
            "@on_the_way": _indented(1, self._earlier(_places("place", self.drives), behind)),
            "@leaps": _indented(1, [leap.format(at, _number(radians * scale)) for at, scale in enumerate(solver.scales)]),
        }  # fmt: skip

    def _starts(self) -> list[str]:
        """The start values of each assembly."""
        lines = []
        for number, start in enumerate(self.solver.starts, 1):
            lines.append(f"    Case {number}")
            lines += _indented(2, [f"x({at}) = {_said(node)}" for at, node in enumerate(start)])
        return lines

    def _earlier(self, places: Sequence[str], targets: Sequence[str]) -> list[str]:
        """Unknowns of groups before, with the drivers at these places."""
        solver = self.solver
        arguments = [f"asked({at})" for at in range(len(solver.asked))]
        arguments[solver.first_drive : solver.first_drive + self.drives] = places
        lines = []
        for symbol, target in zip(solver.earlier, targets, strict=True):
            called = self.calls[unknown_key(symbol)].format(*arguments)
            lines += [f"found = {called}", "If IsError(found) Then Exit Function", f"{target} = found"]
        return lines

    def _way(self, others: Sequence[str]) -> list[str]:
        """What a pass is given follows from these, at a share of the way from what was described."""
        solver = self.solver
        given = solver.reading.given
        ends = dict(zip(given[: self.still], _places(f"{self.name}_there", self.still), strict=True))
        ends |= dict(zip(solver.earlier, others, strict=True))
        lines = []
        for symbol, end in ends.items():
            there: Node = Symbol(end)
            if symbol in solver.described:
                start = solver.described[symbol]
                there = al.add(start, al.mul(Symbol("share"), al.sub(there, start)))
            lines.append(f"here({given.index(symbol)}) = {_said(there)}")
        return lines

    def _block(
        self, part: str, parameters: str, block: Block, places: Sequence[str], targets: Sequence[str]
    ) -> list[str]:
        """A function of steps: True where they have numbers."""
        body = Body(self.calls, self.taken)
        read = {name for step in block.steps for name in step.reads}
        read.update(name for node in block.results for name in symbols(node))
        for symbol, place in zip(block.given, places, strict=True):
            if symbol in read:
                name = body.called(symbol, shown_name(symbol))
                body.types[name] = "Double"
                body.line(f"{name} = {place}")
        body.steps(block.steps)
        for target, node in zip(targets, block.results, strict=True):
            body.assign(target, Step(target, node), declared=True)
        own = f"{self.name}_{part}"
        return [
            *wrapped(f"Private Function {own}({parameters}) As Boolean", "    "),
            *body.declared(),
            "    On Error GoTo NoPosition",
            *body.lines,
            f"    {own} = True",
            "NoPosition:",
            "End Function",
            "",
        ]


def _places(array: str, count: int) -> list[str]:
    """The elements of an array."""
    return [f"{array}({index})" for index in range(count)]


def _indented(depth: int, lines: Iterable[str]) -> list[str]:
    return ["    " * depth + line for line in lines]


def _number(value: float) -> str:
    """A number with no more digits than the editor of Excel keeps."""
    return _said(Number(float(f"{value:.15g}")))


def _said(node: Node) -> str:
    """An expression whose symbols are names already."""
    return print_formula(node, "basic", lambda part: part.name, {})
