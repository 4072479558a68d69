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
from mechsheet.kinematics.sketched import tell
from mechsheet.model import Words

INTRODUCTION = Words(
    """{title}
{source}

Written by mechsheet. Lengths in {unit}, angles in radians{degrees}.
A position that does not exist is #N/A in Excel, the text "Error 2042" in LibreOffice.
Excel: Alt+F11, File, Import File. LibreOffice: Tools, Macros, Edit Macros, import into the document's Standard library.
Then in a cell, for example: ={example}""",
    """{title}
{source}

mechsheet tarafından yazıldı. Uzunluklar {unit}, açılar radyan{degrees}.
Var olmayan bir konum Excel'de #YOK (#N/A), LibreOffice'te "Error 2042" yazısıdır.
Excel: Alt+F11, Dosya, Dosya Al. LibreOffice: Araçlar, Makrolar, Makroları Düzenle, belgenin Standard kütüphanesine alın.
Sonra bir hücrede, örneğin: ={example}""",
)


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
    degrees = Words(" ({name} takes degrees)", " ({name} derece alır)").of(language)
    name = function_names(functions)[function.key]
    text = INTRODUCTION.of(language).format(
        title=mechanism.title.of(language),
        source=mechanism.source.of(language),
        unit=mechanism.length_unit,
        degrees=degrees.format(name=name) if in_degrees else "",
        example=f"{name}({arguments})",
    )
    return text.split("\n")
