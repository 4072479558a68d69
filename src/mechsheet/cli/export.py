"""`mechsheet export`: the same equations for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.arguments.outputs import folder_ready
from mechsheet.diagnostics import MechsheetError

from .common import (
    FILE,
    STANDARD_OUTPUT,
    Explained,
    at_lines_of,
    change_options,
    completing,
    described,
    language_option,
    output_file,
    output_option,
    progress,
    say_written,
)
from .streams import print_file


class WithKinds(Explained):
    """The command whose help ends with the list of kinds, read only then, and the examples."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """One line for each kind."""
        from mechsheet.exporting import KINDS

        with formatter.section("Kinds"):
            formatter.write_dl([(kind.name, kind.about) for kind in KINDS.values()])
        super().format_epilog(ctx, formatter)


def _kinds() -> tuple[str, ...]:
    from mechsheet.exporting import KINDS

    return tuple(KINDS)


@click.command(cls=WithKinds)
@click.argument("description", type=FILE)
@click.option(
    "--to", "kind", required=True, metavar="KIND", shell_complete=completing(_kinds), help="What to write: see below."
)
@output_option("File to write, or - to print it; with --frames, a folder.")
@click.option("--at", type=float, metavar="VALUE", help="Position: a value of the driver, in its unit.")
@click.option("--frames", type=int, metavar="N", help="Draw N positions of the sweep, one file each.")
@language_option("Language of the file.")
@change_options
def export(
    description: Path,
    kind: str,
    output: str | None,
    at: float | None,
    frames: int | None,
    language: str | None,
    **changes: Any,
) -> None:
    """Write the solved mechanism for another program.

    \b
    mechsheet export four-bar.toml --to csv              four-bar.csv
    mechsheet export four-bar.toml --to octave           four_bar.m
    mechsheet export four-bar.toml --to latex --at 60    the solution
    mechsheet export four-bar.toml --to dxf --frames 12  twelve drawings
    """
    from mechsheet.exporting import default_name, exported, kind_of
    from mechsheet.exporting import export as write

    wanted = kind_of(kind)
    mechanism = described(description, language=language, **changes)
    if output == STANDARD_OUTPUT and frames is not None:
        raise MechsheetError(Fault(say("several files are not printed"), key="-o", hint=say("name a folder")))
    if output == STANDARD_OUTPUT:
        with at_lines_of(mechanism, description):
            content = exported(mechanism, wanted.name, at)
        print_file(content)
        return
    file = None if frames is not None else output_file(output, default_name(mechanism, wanted), (description,))
    with progress(description.name) as tell, at_lines_of(mechanism, description), folder_ready(output):
        tell(say("writing {what}", what=wanted.name))
        written = write(mechanism, wanted.name, output if file is None else file, at, frames)
    say_written(written)
