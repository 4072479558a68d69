"""vba: a module of functions to import into Excel or LibreOffice, for every variable of the mechanism."""

from __future__ import annotations

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.exporting.functions.all_functions import Function, functions_of
from mechsheet.exporting.functions.basic import function_names, module
from mechsheet.exporting.functions.routines import Source
from mechsheet.exporting.functions.solvers import solvers_of
from mechsheet.exporting.job import Job
from mechsheet.exporting.refusing import refuse_synthesis
from mechsheet.kinematics.doubts.sketched import tell
from mechsheet.words.catalogue import words

MOST_ARGUMENTS = 60


def write(job: Job) -> list[bytes]:
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
