"""`mechsheet export`: the same equations for other programs."""

from __future__ import annotations

from pathlib import Path

import click

from .common import SET, at_lines_of, described, progress

STANDARD_OUTPUT = Path("-")


class WithKinds(click.Command):
    """The command whose help ends with the list of kinds, read only then."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """One line for each kind."""
        from mechsheet.exporting import KINDS

        with formatter.section("Kinds"):
            formatter.write_dl([(kind.name, kind.about) for kind in KINDS.values()])


@click.command(cls=WithKinds)
@click.argument("description", type=click.Path(path_type=Path))
@click.option("--to", "kind", required=True, metavar="KIND", help="What to write: see below.")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), help="File to write, or - to print it; with --frames, a folder."
)
@click.option("--at", type=float, metavar="VALUE", help="Position: a value of the driver, in its unit.")
@click.option("--frames", type=int, metavar="N", help="Draw N positions of the sweep, one file each.")
@click.option("--language", type=click.Choice(["en", "tr"]), help="Language of the file.")
@SET
def export(
    description: Path,
    kind: str,
    output: Path | None,
    at: float | None,
    frames: int | None,
    language: str | None,
    settings: tuple[str, ...],
) -> None:
    """Write the solved mechanism for another program.

    \b
    mechsheet export four-bar.toml --to csv              four-bar.csv
    mechsheet export four-bar.toml --to octave           four_bar.m
    mechsheet export four-bar.toml --to latex --at 60    the solution, with numbers for one position
    mechsheet export four-bar.toml --to dxf --frames 12  twelve drawings in the folder four-bar
    """
    from mechsheet.exporting import export as write
    from mechsheet.exporting import exported, kind_of

    wanted = kind_of(kind)
    mechanism = described(description, settings, language)
    if output == STANDARD_OUTPUT and frames is None:
        with at_lines_of(mechanism, description):
            content = exported(mechanism, wanted.name, at)
        click.echo(content, nl=False)
        return
    with progress(description.name) as say, at_lines_of(mechanism, description):
        say(f"writing {wanted.name}")
        written = write(mechanism, wanted.name, output, at, frames)
    for file in written:
        click.echo(file.as_posix())
