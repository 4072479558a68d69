"""From a description to finished workbooks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from livesheet.diagnostics import Fault, OutputError, near_miss, readable_name
from livesheet.said import say
from livesheet.workbook import Workbook
from mechsheet.description import Overrides
from mechsheet.description.reader import with_settings
from mechsheet.diagnostics import MechsheetError
from mechsheet.model import Mechanism
from mechsheet.sheet.plan import Plan

if TYPE_CHECKING:
    from mechsheet.compiled import Compiled

FORMATS = ("xlsx", "ods")
FUNCTIONS = ("basic", "lambda", "vba")
"""Extra workbooks whose tables call functions of their own."""
MODULE_BESIDE = "bas"
"""The module beside the one of these that calls VBA."""


@dataclass(frozen=True, slots=True)
class Target:
    """A file to be written; `form` is one of FORMATS, of FUNCTIONS for an extra one, or MODULE_BESIDE."""

    path: Path
    form: str


def compile_workbook(mechanism: Mechanism) -> tuple[Workbook, Plan]:
    """The workbook of a mechanism with every value computed, and the plan that says where everything stands.

    Raises MechanismError when the mechanism cannot be solved.
    """
    compiled = told(mechanism)
    return compiled.workbook, compiled.plan


def told(mechanism: Mechanism) -> Compiled:
    """The mechanism compiled; every doubt about its sketch is told as a warning."""
    from mechsheet.compiled import compiled_of
    from mechsheet.kinematics.doubts.sketched import tell

    compiled = compiled_of(mechanism)
    tell(mechanism, compiled.equations, stacklevel=4)  # whoever called the library
    return compiled


def build(
    mechanism: Mechanism,
    output: str | Path = ".",
    formats: str | Iterable[str] | None = None,
    functions: str | Iterable[str] = (),
    force: bool = False,
    layout: str | None = None,
    tolerance: bool = False,
) -> list[Path]:
    """Write the mechanism's workbook, once for each format, and return the files written.

    output     a file (`out.xlsx`; its ending is the format), or a folder: an existing one, a name that ends with a slash, or
               a name without an ending. In a folder the file is called as the description's, or by the mechanism's name when
               that came from no file. The folder is made when it is not there yet (but not its parents)
    formats    "xlsx", "ods", or several; "xlsx" without it
    functions  extra files: "basic" (`NAME-basic.ods`, needs macros), "lambda" (`NAME-lambda.xlsx`, needs Excel 365),
               "vba" (`NAME-vba.xlsx`, and `NAME-vba.bas` to import)
    layout     "sheets" or "page" (all on one sheet), in place of the description's own
    tolerance  with bands of all outputs and summaries, where the description asks for none
    force      also over a file that is not a workbook as `build` wrote it: somebody's work may be in it

    A file is written beside its place and moved into it: a failure leaves the old one whole. Raises MechanismError when
    the mechanism cannot be solved, OutputError when a file cannot be written or holds somebody's changes,
    MechsheetError for formats that are not known or do not fit the file.
    """
    mechanism = with_settings(mechanism, Overrides(layout=layout, tolerance=tolerance))
    wanted = targets(mechanism, output, formats, functions)
    if not force:
        refuse_edited(wanted)
    return write_all(told(mechanism), wanted, output)


def targets(
    mechanism: Mechanism,
    output: str | Path = ".",
    formats: str | Iterable[str] | None = None,
    functions: str | Iterable[str] = (),
) -> list[Target]:
    """The files that `build` would write. Raises MechsheetError as it does; writes nothing."""
    extra = _known(functions, FUNCTIONS, "functions", say("kind of functions"))
    given = None if formats is None else formats_given(formats, needed=not extra)
    path = Path(output)
    if is_folder(output):
        stem = path / mechanism.stem
        found = [Target(_ending(stem, f".{form}"), form) for form in given or FORMATS[:1]]
    else:
        form = _format_of(path, given)
        stem = path.with_suffix("") if path.suffix else path
        found = [Target(path, form)]
    if extra:
        from mechsheet.exporting.functions.workbooks import FORMS

        found += [Target(_ending(stem, FORMS[form].suffix), form) for form in extra]
        found += [Target(_ending(stem, "-vba.bas"), MODULE_BESIDE) for form in extra if form == "vba"]
    return found


def is_folder(output: str | Path) -> bool:
    """Whether workbooks go into a folder of that name: as for every output, and a new name without an ending."""
    from livesheet.replacing import is_stream
    from mechsheet.arguments.outputs import names_folder

    path = Path(output)
    return names_folder(output) or (not path.suffix and not is_stream(path))


def refuse_edited(wanted: Iterable[Target]) -> None:
    """Raise OutputError when files are there that `build` did not write as they are now."""
    from livesheet.formats.archive import is_untouched
    from livesheet.replacing import is_stream

    faults = []
    for target in wanted:
        path = target.path
        try:
            if (
                target.form == MODULE_BESIDE
                or is_stream(path)
                or not path.is_file()
                or path.stat().st_size == 0
                or is_untouched(path)
            ):
                continue
            message = say("is not as build wrote it (somebody has saved changes, or it is another file): left as it is")
        except (OSError, ValueError) as error:
            message = say(
                "cannot be replaced: {reason}", reason=error.strerror if isinstance(error, OSError) else error
            )
        hint = say("keep its changes with mechsheet pull, choose another name with -o, or overwrite it with --force")
        faults.append(Fault(message, readable_name(path), hint=hint))
    if faults:
        raise OutputError(faults)


def write_all(compiled: Compiled, wanted: Sequence[Target], output: str | Path = ".") -> list[Path]:
    """Write the workbook of a mechanism, and those with functions, into the files of `targets`."""
    from livesheet.formats import write
    from mechsheet.arguments.outputs import folder_ready

    folder = f"{output}/" if is_folder(output) else output
    with folder_ready(folder):
        for target in wanted:
            if target.form == MODULE_BESIDE:
                from livesheet.replacing import replace_file
                from mechsheet.exporting.functions.workbooks import functions_workbook, module_beside

                replace_file(target.path, module_beside(functions_workbook(compiled, "vba")))
            elif target.form in FUNCTIONS:
                from livesheet.evaluation import computed
                from mechsheet.exporting.functions.workbooks import functions_workbook, without_module

                found = computed(functions_workbook(compiled, target.form))
                write(without_module(found) if target.form == "vba" else found, target.path)
            else:
                write(compiled.workbook, target.path, target.form)
    return [target.path for target in wanted]


def formats_given(formats: str | Iterable[str], needed: bool = True) -> list[str]:
    """The formats of workbooks named, "xlsx,ods". Raises MechsheetError for others, and for none where one is `needed`."""
    found = _known(formats, FORMATS, "formats", say("format"))
    if needed and not found:
        raise MechsheetError(
            Fault(say("no format is named"), key="formats", hint=say("formats: {formats}", formats=", ".join(FORMATS)))
        )
    return found


def _known(given: str | Iterable[str], known: Sequence[str], key: str, what: str) -> list[str]:
    """The words of an argument, each once; a text may hold several with commas. Raises MechsheetError for others."""
    parts = given.split(",") if isinstance(given, str) else list(given) if isinstance(given, Iterable) else [given]
    words = dict.fromkeys(part.strip() if isinstance(part, str) else repr(part) for part in parts)
    wanted = [word for word in words if word]
    unknown = [word for word in wanted if word not in known]
    if unknown:
        hint = near_miss(unknown[0].lower(), known) or say("known: {names}", names=", ".join(known))
        raise MechsheetError(
            Fault(say('no {what} is called "{unknown}"', what=what, unknown=", ".join(unknown)), key=key, hint=hint)
        )
    return wanted


def _format_of(path: Path, given: Sequence[str] | None) -> str:
    """The format of a file that is named: its ending; what has none (a device) is written in the format that was given."""
    from livesheet.replacing import is_stream

    ending = path.suffix.lower().removeprefix(".")
    if ending in FORMATS:
        if given is not None and list(given) != [ending]:
            fault = say(
                "one file, and its ending says .{ending}: it cannot be {given}",
                ending=ending,
                given=" and ".join(given),
            )
            raise MechsheetError(Fault(fault, readable_name(path), key="formats", hint=_FOLDER_HINT))
        return ending
    if not is_stream(path):
        fault = say('a workbook ends with .xlsx or .ods, not with "{suffix}"', suffix=path.suffix)
        raise MechsheetError(
            Fault(fault, readable_name(path), key="output", hint=say("a folder of that name: {name}/", name=path.name))
        )
    if given is not None and len(given) > 1:
        raise MechsheetError(Fault(say("takes one workbook"), readable_name(path), key="formats"))
    return given[0] if given else FORMATS[0]


_FOLDER_HINT = say("for several formats name a folder, with a slash at its end")


def _ending(stem: Path, suffix: str) -> Path:
    """The path with something behind its name (a stem may hold dots of its own)."""
    return stem.with_name(stem.name + suffix)
