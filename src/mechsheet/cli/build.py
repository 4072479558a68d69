"""`mechsheet build`: descriptions to workbooks."""

from __future__ import annotations

from pathlib import Path

import click

from mechsheet.diagnostics import Fault, MechsheetError

from .common import SET, at_lines_of, described, progress


@click.command()
@click.argument("descriptions", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), default=Path(), help="Folder to write into.")
@click.option("--format", "formats", default="xlsx", show_default=True, help="xlsx, ods, or both with a comma.")
@click.option("--language", type=click.Choice(["en", "tr"]), help="Language of the workbook.")
@click.option(
    "--functions",
    metavar="basic,lambda",
    default="",
    help="Extra files whose tables call functions: in Basic (.ods, macros), as LAMBDA (.xlsx, Excel 365).",
)
@SET
def build(
    descriptions: tuple[Path, ...],
    output: Path,
    formats: str,
    language: str | None,
    functions: str,
    settings: tuple[str, ...],
) -> None:
    """Write the workbooks of descriptions.

    \b
    mechsheet build four-bar.toml
    mechsheet build *.toml -o workbooks --format xlsx,ods --set a1=65
    mechsheet build adjustable-pump.toml --functions lambda    adjustable-pump-lambda.xlsx too
    """
    from mechsheet.building import FORMATS, FUNCTIONS
    from mechsheet.building import build as build_workbooks

    wanted = _listed(formats)
    unknown = [part for part in wanted if part not in FORMATS]
    if unknown or not wanted:
        raise MechsheetError(
            Fault(f'no format is called "{", ".join(unknown)}"', key="--format", hint=f"formats: {', '.join(FORMATS)}")
        )
    extra = _listed(functions)
    unknown = [part for part in extra if part not in FUNCTIONS]
    if unknown:
        hint = f"functions are written as {' or '.join(FUNCTIONS)}"
        raise MechsheetError(Fault(f'no functions are called "{", ".join(unknown)}"', key="--functions", hint=hint))
    mechanisms = [described(path, settings, language) for path in descriptions]
    for path, mechanism in zip(descriptions, mechanisms, strict=True):
        with progress(path.name) as say, at_lines_of(mechanism, path):
            say("building")
            written = build_workbooks(mechanism, output, wanted, extra)
        for file in written:
            click.echo(file.as_posix())


def _listed(text: str) -> list[str]:
    """The words of an option, each once."""
    return list(dict.fromkeys(part.strip() for part in text.split(",") if part.strip()))
