"""`mechsheet build`: descriptions to workbooks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from livesheet.diagnostics import Fault, OutputError, readable_name
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError

from .common import (
    FILE,
    FORMATS_COMPLETED,
    STANDARD_INPUT,
    STANDARD_OUTPUT,
    Explained,
    OutputName,
    at_lines_of,
    change_options,
    described,
    language_option,
    progress,
    same_file,
    say_written,
)
from .speaking import note

if TYPE_CHECKING:
    from mechsheet.library.building import Target


@click.command(cls=Explained, short_help="Write the workbooks of descriptions.")
@click.argument("descriptions", nargs=-1, required=True, type=FILE)
@click.option(
    "-o",
    "--output",
    type=OutputName(),
    default=".",
    help="File to write (out.xlsx: its ending is the format), or folder to write into: an existing one, a name that ends "
    "with /, or a new name without an ending.",
)
@click.option(
    "--format", "formats", shell_complete=FORMATS_COMPLETED, help="xlsx, ods, or both with a comma.  [default: xlsx]"
)
@language_option("Language of the workbook.")
@click.option("--layout", type=click.Choice(["sheets", "page"]), help="Several sheets, or all on one.")
@click.option("--tolerance", is_flag=True, help="Bands of all outputs and summaries by the dimensions' tolerances.")
@click.option(
    "--functions",
    metavar="basic,lambda,vba",
    default="",
    help="Extra files whose tables call functions: in Basic (.ods, macros), as LAMBDA (.xlsx, Excel 365), in VBA (.xlsx, "
    "and a module to import).",
)
@click.option("--design", metavar="FOLDER:N", help="Use the dimensions of a design from a study (mechsheet study).")
@click.option("--force", is_flag=True, help="Overwrite even what somebody has changed since it was built.")
@change_options
def build(
    descriptions: tuple[Path, ...],
    output: str,
    formats: str | None,
    language: str | None,
    layout: str | None,
    tolerance: bool,
    functions: str,
    design: str | None,
    force: bool,
    **changes: Any,
) -> None:
    """Write the workbooks of descriptions, each named after its description.

    \b
    mechsheet build mine.toml                                  mine.xlsx
    mechsheet build mine.toml -o out.ods --rows 73 --set "a2=40*1.1"
    mechsheet build *.toml -o workbooks/ --format xlsx,ods
    mechsheet build adjustable-pump.toml --functions lambda    an extra file

    A workbook in which somebody has saved changes is left as it is, unless you say --force.
    """
    from mechsheet.library.building import refuse_edited, targets, told, write_all
    from mechsheet.library.verdicts import verdict

    if output == STANDARD_OUTPUT:
        raise OutputError(
            Fault(say("a workbook is written to a file, not printed"), key="-o", hint=say("for example -o out.xlsx"))
        )
    paths = _each_once(descriptions)
    mechanisms = []
    for path in paths:
        own = changes if design is None else _of_design(path, design, changes)
        mechanisms.append(described(path, language=language, layout=layout, tolerance=tolerance, **own))
    wanted = [targets(mechanism, output, formats, functions) for mechanism in mechanisms]
    _refuse_shared(paths, wanted)
    if not force:
        refuse_edited(target for files in wanted for target in files)
    for path, mechanism, files in zip(paths, mechanisms, wanted, strict=True):
        with progress(path.name) as tell, at_lines_of(mechanism, path):
            tell("building")
            compiled = told(mechanism)
            written = write_all(compiled, files, output)
        say_written(written)
        click.echo(f"{readable_name(path)}: {verdict(compiled)}", err=True)


def _of_design(path: Path, design: str, changes: dict[str, Any]) -> dict[str, Any]:
    """The changes that make a description a design of a study, and those asked for besides."""
    from mechsheet.kinematics.dimensions import dimension_values
    from mechsheet.kinematics.driving import driver_values
    from mechsheet.library.studying import design_of

    if path == STANDARD_INPUT:
        raise MechsheetError(Fault(say("a design is built from a file"), key="design"))
    pairs, rows, text = design_of(design)
    plain = described(path)
    own = str(len(driver_values(plain, dimension_values(plain))))
    swept = rows if rows and rows != own and changes["rows"] is None and changes["step"] is None else None
    if described(path, rows=swept).text != text:
        note(
            say(
                "{file} differs from the description of the study: the design is built as it says now",
                file=readable_name(path),
            )
        )
    settings = (*(f"{name}={value}" for name, value in pairs), *changes["settings"])
    return changes | {"settings": settings, "rows": swept or changes["rows"]}


def _each_once(descriptions: Sequence[Path]) -> list[Path]:
    """The descriptions without those that are named twice (`*.toml mine.toml`)."""
    found: list[Path] = []
    for path in descriptions:
        if not any(path == other or same_file(path, other) for other in found):
            found.append(path)
    return found


def _refuse_shared(paths: Sequence[Path], wanted: Sequence[Sequence[Target]]) -> None:
    """Raise OutputError when two descriptions would write one file, or one would be overwritten itself.

    Names that differ in capitals only are one file on many systems.
    """
    faults: list[Fault] = []
    owners: dict[str, Path] = {}
    for path, files in zip(paths, wanted, strict=True):
        for target in files:
            shown = readable_name(target.path)
            owner = owners.setdefault(shown.casefold(), path)
            if owner is not path:
                names = f"{readable_name(owner)} and {readable_name(path)}"
                hint = say("build them one by one, each with its own -o")
                faults.append(Fault(say("{names} would both be written into this file", names=names), shown, hint=hint))
            if any(other != STANDARD_INPUT and same_file(target.path, other) for other in paths):
                hint = say("name another file with -o")
                faults.append(Fault(say("is read here: it is not overwritten"), shown, hint=hint))
    if faults:
        raise MechsheetError(faults)
