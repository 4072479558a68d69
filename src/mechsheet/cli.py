"""The command line: thin. Each command calls the library and prints; what can be piped goes to standard output.

Exit codes: 0 done and all agree, 1 something differs, 2 the input cannot be read or used.
"""

from __future__ import annotations

import contextlib
import json
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mechsheet import __version__
from mechsheet.diagnostics import Fault, MechanismError, MechsheetError, near_miss, readable_name

if TYPE_CHECKING:
    from mechsheet.model import Mechanism

CONTEXT = {"help_option_names": ["-h", "--help"], "max_content_width": 100}


class Commands(click.Group):
    """The group of commands: suggests near misses, and turns a user's mistakes into messages."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """As click does, with a suggestion for a misspelt command."""
        name = args[0] if args else ""
        if name and not name.startswith("-") and self.get_command(ctx, name) is None:
            hint = near_miss(name, self.list_commands(ctx)) or f"commands: {', '.join(self.list_commands(ctx))}"
            ctx.fail(f'no command is called "{name}": {hint}')
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; a MechsheetError ends it with code 2 and one message per fault."""
        try:
            return super().invoke(ctx)
        except MechsheetError as error:
            click.echo(str(error), err=True)
            ctx.exit(2)


@click.group(cls=Commands, context_settings=CONTEXT)
@click.version_option(__version__, prog_name="mechsheet")
def main() -> None:
    """Compile the description of a planar mechanism into a proven spreadsheet workbook.

    \b
    mechsheet new four-bar -o mine.toml      start from a packaged description
    mechsheet build mine.toml                write four-bar.xlsx
    mechsheet check four-bar.xlsx            recalculate it and compare with the numpy reference
    """


@contextlib.contextmanager
def _at_lines_of(mechanism: Mechanism, path: Path) -> Iterator[None]:
    """What is wrong with a mechanism is told with the description's file and line."""
    try:
        yield
    except MechanismError as error:
        from mechsheet.description.locate import located

        raise located(error, mechanism.text, readable_name(path)) from error


@contextlib.contextmanager
def _progress(label: str) -> Iterator[Callable[[str], None]]:
    """Say on a terminal what is being done; nothing in a pipe."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return

    def say(what: str) -> None:
        click.echo(f"\r\033[K{label}: {what} …", nl=False, err=True)

    try:
        yield say
    finally:
        click.echo("\r\033[K", nl=False, err=True)


def _settings(pairs: tuple[str, ...]) -> dict[str, str]:
    """`a1=65` options as a mapping."""
    found = {}
    faults = []
    for pair in pairs:
        name, equals, value = pair.partition("=")
        if not equals or not name.strip() or not value.strip():
            faults.append(Fault(f'"{pair}" is not NAME=VALUE', key="--set", hint="for example --set a1=65"))
        found[name.strip()] = value.strip()
    if faults:
        raise MechsheetError(faults)
    return found


SET = click.option(
    "--set", "settings", multiple=True, metavar="NAME=VALUE", help="Change a dimension; may be repeated."
)
JSON = click.option("--json", "as_json", is_flag=True, help="Print JSON.")


@main.command()
@click.argument("template", required=False)
@click.option("-o", "--output", type=click.Path(path_type=Path), help="File to write; standard output without it.")
@click.option("--list", "show_list", is_flag=True, help="List the templates.")
def new(template: str | None, output: Path | None, show_list: bool) -> None:
    """Start from a packaged description.

    \b
    mechsheet new --list
    mechsheet new four-bar -o mine.toml
    """
    from mechsheet.description.templates import template_names, template_text

    if show_list or template is None:
        for name in template_names():
            click.echo(name)
        return
    text = template_text(template)
    if output is None:
        click.echo(text, nl=False)
        return
    if output.exists():
        raise MechsheetError(
            Fault("there is a file already: it is left as it is", str(output), hint="choose another name")
        )
    from mechsheet.formats.archive import replace_file

    replace_file(output, text.encode())
    click.echo(f"wrote {output.as_posix()}", err=True)


@main.command()
@click.argument("descriptions", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), default=Path(), help="Folder to write into.")
@click.option("--format", "formats", default="xlsx", show_default=True, help="xlsx, ods, or both with a comma.")
@click.option("--language", type=click.Choice(["en", "tr"]), help="Language of the workbook.")
@SET
def build(
    descriptions: tuple[Path, ...], output: Path, formats: str, language: str | None, settings: tuple[str, ...]
) -> None:
    """Write the workbooks of descriptions.

    \b
    mechsheet build four-bar.toml
    mechsheet build *.toml -o workbooks --format xlsx,ods --set a1=65
    """
    from mechsheet.building import FORMATS
    from mechsheet.building import build as build_workbooks
    from mechsheet.description import load

    wanted = [part.strip() for part in formats.split(",") if part.strip()]
    unknown = [part for part in wanted if part not in FORMATS]
    if unknown or not wanted:
        raise MechsheetError(
            Fault(f'no format is called "{", ".join(unknown)}"', key="--format", hint=f"formats: {', '.join(FORMATS)}")
        )
    changes = _settings(settings)
    mechanisms = [load(path, changes, language) for path in descriptions]
    for path, mechanism in zip(descriptions, mechanisms, strict=True):
        with _progress(path.name) as say, _at_lines_of(mechanism, path):
            say("building")
            written = build_workbooks(mechanism, output, wanted)
        for file in written:
            click.echo(file.as_posix())


@main.command()
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("--with", "programs", default="", help="Other judges: formulas, ironcalc, libreoffice, gnumeric.")
@JSON
def check(files: tuple[Path, ...], programs: str, as_json: bool) -> None:
    """Recalculate and compare: engine, stored values, numpy reference, other programs.

    \b
    mechsheet check four-bar.xlsx
    mechsheet check four-bar.toml --with libreoffice,ironcalc
    mechsheet check four-bar.xlsx four-bar.ods      also: are they the same, cell by cell?

    Exit code 0: all agree; 1: something differs; 2: cannot be read.
    """
    from mechsheet.checking import check as check_file
    from mechsheet.checking import with_twins

    judges = [part.strip() for part in programs.split(",") if part.strip()]
    reports = []
    faults: list[Fault] = []
    for file in files:
        with _progress(file.name) as say:
            try:
                reports.append(check_file(file, judges, say))
            except MechsheetError as error:
                faults += error.faults
    reports = with_twins(reports)
    if as_json:
        click.echo(json.dumps([report.as_dict() for report in reports], indent=2))
    else:
        for report in reports:
            _print_report(report)
    if faults:
        raise MechsheetError(faults)
    if not all(report.agrees for report in reports):
        sys.exit(1)


def _print_report(report: Any) -> None:
    click.echo(f"{report.file}: {'all agree' if report.agrees else 'SOMETHING DIFFERS'}")
    for item in report.comparisons:
        verdict = "agrees " if item.agrees else "DIFFERS"
        click.echo(f"  {item.judge:<14} {verdict} {item.cells:>8} values, worst {item.worst:9.2e}  {item.where}")
        if not item.agrees:
            click.echo(f"  {'':<14} {item.subject} {item.ours}, {item.judge} {item.theirs or 'nothing'}")
    for remark in report.remarks:
        click.echo(f"  note: {remark}")


@main.command()
@click.argument("workbook", type=click.Path(path_type=Path))
@SET
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Write the recalculated workbook there.")
@JSON
def recalc(workbook: Path, settings: tuple[str, ...], output: Path | None, as_json: bool) -> None:
    """Recalculate any workbook without a spreadsheet program.

    \b
    mechsheet recalc four-bar.xlsx --set a1=65 --json
    """
    from mechsheet.recalculation import recalc as recalculate

    result = recalculate(workbook, _settings(settings))
    if output is not None:
        result.write(output)
        click.echo(f"wrote {output.as_posix()}", err=True)
    if as_json:
        click.echo(json.dumps(result.as_dict(), ensure_ascii=False))
    elif output is None:
        for name, value in result.named().items():
            click.echo(f"{name} = {value}")


@main.command()
@click.argument("description", type=click.Path(path_type=Path))
@click.option("--at", type=float, metavar="VALUE", help="Position: a value of the driver, in its unit.")
@click.option("-o", "--output", type=click.Path(path_type=Path), help="File to write: .svg, .png, .gif or .html.")
@click.option("--language", type=click.Choice(["en", "tr"]), help="Language of the picture.")
@SET
def plot(
    description: Path, at: float | None, output: Path | None, language: str | None, settings: tuple[str, ...]
) -> None:
    """Draw the mechanism: a picture, an animation, or a web page with a slider.

    \b
    mechsheet plot four-bar.toml --at 60               four-bar.svg
    mechsheet plot four-bar.toml --at 60 -o fb.png     a picture
    mechsheet plot four-bar.toml -o fb.gif             an animation of the sweep
    mechsheet plot four-bar.toml -o fb.html            one page: slider, play button, curves

    Pictures and animations need matplotlib: pip install 'mechsheet[plot]'
    """
    from mechsheet.description import load
    from mechsheet.plotting import plot as draw

    mechanism = load(description, _settings(settings), language)
    path = output or Path(f"{mechanism.name}.svg")
    with _progress(description.name) as say, _at_lines_of(mechanism, description):
        say("drawing")
        draw(mechanism, path, at)
    click.echo(path.as_posix())


@main.command()
@click.argument("description", type=click.Path(path_type=Path))
@SET
@click.option("--equations", "what", flag_value="equations", help="The equations, in order of solution.")
@click.option("--cells", "what", flag_value="cells", help="Every cell of the workbook.")
@JSON
@click.option("--csv", "as_csv", is_flag=True, help="Print the variables as CSV.")
def show(description: Path, settings: tuple[str, ...], what: str | None, as_json: bool, as_csv: bool) -> None:
    """Print what was understood: the groups and variables, the equations, or the cells.

    \b
    mechsheet show four-bar.toml
    mechsheet show four-bar.toml --equations
    mechsheet show four-bar.toml --json
    """
    from mechsheet import show as shows
    from mechsheet.description import load

    mechanism = load(description, _settings(settings))
    with _at_lines_of(mechanism, description):
        if what == "equations":
            text = shows.equations_json(mechanism) if as_json else shows.equations_text(mechanism)
        elif what == "cells":
            text = shows.cells_json(mechanism) if as_json else shows.cells_text(mechanism)
        elif as_json:
            text = shows.variables_json(mechanism)
        elif as_csv:
            text = shows.variables_csv(mechanism)
        else:
            text = shows.overview_text(mechanism)
    click.echo(text, nl=not text.endswith("\n"))


if __name__ == "__main__":
    main()
