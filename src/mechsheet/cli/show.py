"""`mechsheet show`: print what was understood."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from livesheet.diagnostics import readable_name

from .common import JSON, at_lines_of, change_options, described, progress
from .helping import Explained
from .streams import print_file


@click.command(cls=Explained, short_help="Show how a description is understood: equations, verdicts.")
@click.argument("description", type=click.Path(path_type=Path))
@change_options
@click.option("--equations", "what", flag_value="equations", help="The equations, in order of solution.")
@click.option("--cells", "what", flag_value="cells", help="Every cell of the workbook.")
@click.option(
    "--verdicts",
    "what",
    flag_value="verdicts",
    help="What the first sheet says, by names of its cells; searched.",
)
@click.option(
    "--tolerance",
    "what",
    flag_value="tolerance",
    help="What the tolerances add up to: worst case, root sum of squares, share of each dimension.",
)
@click.option(
    "--dimensions",
    "what",
    flag_value="dimensions",
    help="Every dimension with its value; with --json exact values, null where a task has no solution.",
)
@JSON
@click.option("--csv", "as_csv", is_flag=True, help="Print the variables as CSV.")
def show(description: Path, what: str | None, as_json: bool, as_csv: bool, **changes: Any) -> None:
    """Print how a description was understood: groups and variables, equations, dimensions, cells, verdicts, or bands.

    \b
    mechsheet show four-bar.toml
    mechsheet show four-bar.toml --equations
    mechsheet show four-bar.toml --verdicts --json
    mechsheet show mine.toml --tolerance
    mechsheet show function-generator.toml --dimensions --json
    mechsheet show four-bar.toml --json
    """
    from mechsheet.library import dimensions, tolerances, verdicts
    from mechsheet.library import show as shows

    mechanism = described(description, **changes)
    with at_lines_of(mechanism, description), progress(description.name) as tell:
        tell("solving")
        if what == "equations":
            text = shows.equations_json(mechanism) if as_json else shows.equations_text(mechanism)
        elif what == "cells":
            text = shows.cells_json(mechanism) if as_json else shows.cells_text(mechanism)
        elif what == "dimensions":
            text = dimensions.dimensions_json(mechanism) if as_json else dimensions.dimensions_text(mechanism)
        elif what == "verdicts":
            text = verdicts.verdicts_json(mechanism) if as_json else verdicts.verdicts_text(mechanism)
        elif what == "tolerance":
            printed = tolerances.bands_json if as_json else tolerances.bands_text
            text = printed(mechanism, readable_name(description))
        elif as_json:
            text = shows.variables_json(mechanism)
        elif as_csv:
            text = shows.variables_csv(mechanism)
        else:
            text = shows.overview_text(mechanism)
    if as_json or as_csv:
        print_file(text if text.endswith("\n") else f"{text}\n")
    else:
        click.echo(text, nl=not text.endswith("\n"))
