"""Functions as a module of Basic: VBA for Excel, and LibreOffice Basic. ASCII bytes; the same text runs in both.

What differs between the two is avoided: -x ^ 2 is written with parentheses, an error value is asked for at once (LibreOffice
counts with it), xlErrNA is declared (LibreOffice does not know it), pi is computed (the editor of Excel cuts constants to 15
digits). A position that does not exist is CVErr(xlErrNA): #N/A in Excel, the text "Error 2042" in LibreOffice.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.exporting.functions.all_functions import Function, functions_of
from mechsheet.exporting.functions.basic_body import KEYWORDS, Body, comment, rule, wrapped
from mechsheet.exporting.functions.basic_solvers import declarations, procedures, solver_calls, solver_names
from mechsheet.exporting.functions.routines import Parameter, Source
from mechsheet.exporting.functions.solvers import Solver, solvers_of
from mechsheet.exporting.job import Job
from mechsheet.exporting.lowering import Step
from mechsheet.exporting.program import brought, identifiers
from mechsheet.kinematics.doubts.sketched import tell
from mechsheet.model import Mechanism
from mechsheet.units import Unit
from mechsheet.words.catalogue import words

ANGLE = """\
    If {x} > 0 Then
        {name} = Atn({y} / {x})
    ElseIf {x} < 0 Then
        If {y} < 0 Then {name} = Atn({y} / {x}) - PiValue() Else {name} = Atn({y} / {x}) + PiValue()
    ElseIf {y} = 0 Then
        {name} = CVErr(xlErrNA)
    Else
        {name} = Sgn({y}) * PiValue() / 2
    End If
"""
"""The direction of a vector, which Basic does not have: the arc tangent in its quadrant."""


def module(
    functions: Sequence[Function], opening: Iterable[str], name: str, language: str, solvers: Sequence[Solver] = ()
) -> str:
    """The module's text, lines ended by a line feed.

    opening  lines of the comment at its head
    name     what the module is called; "" leaves that line out (LibreOffice keeps the name elsewhere)
    solvers  of groups that Newton's method solves: the functions call them
    """
    names = function_names(functions)
    own = solver_names(solvers, names.values())
    calls = {function.key: _call(names[function.key], len(function.parameters)) for function in functions}
    calls |= solver_calls(solvers, own)
    parts = [f'Attribute VB_Name = "{name}"'] if name else []
    parts += ["Option Explicit", "", *(comment(line) for line in opening), ""]
    parts += ["Private Const xlErrNA As Long = 2042", ""]
    parts += [line for solver in solvers for line in declarations(solver, own[solver.number])]
    for basic, title in ((True, "basic"), (False, "mechanism")):
        chosen = [function for function in functions if function.basic == basic]
        if not chosen:
            continue
        parts += [rule(words(language, f"basic.{title}")), ""]
        if not basic:
            parts += [*_parameters(chosen[0], language), ""]
        parts += [_Writer(function, names, calls, own.values(), language).text() for function in chosen]
    if solvers:
        parts += [rule(words(language, "basic.solvers")), ""]
        parts += [procedures(solver, own, calls, names.values(), language) for solver in solvers]
    parts += [rule(words(language, "basic.helpers")), "", brought("basic.bas")]
    return "\n".join(parts)


def _call(name: str, count: int) -> str:
    return f"{name}({', '.join(f'{{{index}}}' for index in range(count))})"


def _parameters(function: Function, language: str) -> list[str]:
    """The parameters that all functions of a mechanism share."""
    lines = [comment(words(language, "basic.parameters"))]
    for part, shown in zip(function.routine.parameters, function.parameters, strict=True):
        default = function.modes.get(part.symbol)
        omitted = words(language, "basic.left_out", default=default) if default else ""
        lines.append(comment(f"    {shown}: {part.label.of(language)}{_unit(part.unit)}{omitted}"))
    return lines


def function_names(functions: Sequence[Function]) -> dict[str, str]:
    """Key of a function -> its name in Basic."""
    keys = {function.name: function.key for function in functions}
    return {keys[shown]: name for shown, name in identifiers(keys, KEYWORDS).items()}


class _Writer(Body):
    """One function, line by line."""

    def __init__(
        self,
        function: Function,
        names: Mapping[str, str],
        calls: Mapping[str, str],
        taken: Iterable[str],
        language: str,
    ) -> None:
        super().__init__(calls, [*names.values(), *taken])
        self.function = function
        self.language = language
        self.name = names[function.key]
        for part, shown in zip(function.routine.parameters, function.parameters, strict=True):
            self.called(part.symbol, shown)

    def text(self) -> str:
        """The function with the comment over it."""
        routine = self.function.routine
        parameters = [self.names[part.symbol] for part in routine.parameters]
        given = [f"ByVal {self.names[part.symbol]} As Double" for part in routine.parameters if not self.optional(part)]
        left_out = [self.names[part.symbol] for part in routine.parameters if self.optional(part)]
        given += [f"Optional ByVal {name} As Variant" for name in left_out]
        if routine.key == "angle":
            self.lines += ANGLE.format(name=self.name, x=parameters[0], y=parameters[1]).splitlines()
        else:
            self.body()
        head = wrapped(f"Public Function {self.name}({', '.join(given)}) As Variant", "    ")
        ending = []
        if self.jumps:
            ending = ["    Exit Function", "NoPosition:", f"    {self.name} = CVErr(xlErrNA)"]
        return "\n".join([*self.comment(), *head, *self.declarations(), *self.lines, *ending, "End Function", ""])

    def optional(self, part: Parameter) -> bool:
        """True for a configuration that may be left out."""
        return part.symbol in self.function.modes

    def comment(self) -> list[str]:
        """What the function is, and its parameters (those of a mechanism stand at the head of its functions)."""
        routine = self.function.routine
        lines = [comment(routine.about.of(self.language) + _unit(routine.unit))]
        if self.function.basic:
            for part in routine.parameters:
                lines.append(
                    comment(f"    {self.names[part.symbol]}: {part.label.of(self.language)}{_unit(part.unit)}")
                )
        return lines

    def declarations(self) -> list[str]:
        """Variables, the way out, and the configurations that were left out."""
        lines = self.declared()
        if self.jumps:
            lines.append("    On Error GoTo NoPosition")
        for symbol, value in self.function.modes.items():
            lines.append(f"    If IsMissing({self.names[symbol]}) Then {self.names[symbol]} = {value}")
        return lines

    def body(self) -> None:
        """The steps and the result."""
        routine = self.function.routine
        self.jumps = bool(routine.steps)
        self.steps(routine.steps)
        self.assign(self.name, Step(self.name, routine.result, routine.missing), declared=True)


def _unit(unit: Unit) -> str:
    return f" [{unit.symbol}]" if unit.kind == "angle" else ""


def refuse_synthesis(mechanism: Mechanism, what: str) -> None:
    """Raise MechanismError where dimensions are found from a task: functions take lengths, not tasks."""
    if mechanism.synthesis is not None:
        message = say("{what} take dimensions, and those of this mechanism are found by a synthesis", what=what)
        hint = say("give the dimensions as numbers (`show --dimensions` prints them); other exports have the synthesis")
        raise MechanismError(Fault(message, key="synthesis", hint=hint))


MOST_ARGUMENTS = 60


def vba(job: Job) -> list[bytes]:
    """The module: ASCII, lines ended as Windows does. Raises MechanismError for more dimensions than VBA takes arguments."""
    mechanism = job.mechanism
    language = mechanism.language
    refuse_synthesis(mechanism, say("functions in Basic"))
    compiled = job.compiled
    tell(mechanism, compiled.equations)
    source = Source(compiled)
    functions = functions_of(source, language)
    count = len(source.parameters())
    if count > MOST_ARGUMENTS:
        fault = say(
            "functions of {count} arguments (dimensions, driver, configurations): VBA takes {most}",
            count=count,
            most=MOST_ARGUMENTS,
        )
        raise MechanismError(
            Fault(fault, key="dimensions", hint=say("write dimensions that never change as plain numbers"))
        )
    names = function_names(functions)
    taken = {name.casefold() for name in names.values()}
    # Excel does not find a function that has the name of its module.
    name = f"{job.name}_module" if job.name.casefold() in taken else job.name
    opening = introduction(source, functions, language)
    solvers = solvers_of(source, compiled)
    return [module(functions, opening, name, language, solvers).replace("\n", "\r\n").encode("ascii")]


def introduction(source: Source, functions: tuple[Function, ...], language: str) -> list[str]:
    """The comment at the head of the module."""
    mechanism = source.mechanism
    function = functions[-1]
    arguments = ", ".join(name for part, name in zip(function.routine.parameters, function.parameters, strict=True)
                          if part.symbol not in function.modes)  # fmt: skip
    in_degrees = any(part.unit.in_degrees for part in function.routine.parameters)
    name = function_names(functions)[function.key]
    return words(
        language, "basic.introduction", title=mechanism.title, source=mechanism.source, unit=mechanism.length_unit,
        degrees=words(language, "basic.degrees", name=name) if in_degrees else "", example=f"{name}({arguments})",
    ).split("\n")  # fmt: skip
