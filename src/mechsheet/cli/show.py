"""`mechsheet show`: print what was understood."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from livesheet.diagnostics import readable_name

from .common import FILE, JSON, Explained, at_lines_of, change_options, described, progress
from .streams import print_file


@click.command(cls=Explained, short_help="Show how a description is understood: equations, verdicts.")
@click.argument("description", type=FILE)
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
    from mechsheet.library import show as shows
    from mechsheet.library.verdicts import bands_of, verdicts_of

    forms = {
        None: (shows.overview_text, shows.variables_csv if as_csv else shows.variables_json),
        "equations": (shows.equations_text, shows.equations_json),
        "cells": (shows.cells_text, shows.cells_json),
        "dimensions": (shows.dimensions_text, shows.dimensions_json),
    }
    mechanism = described(description, **changes)
    with at_lines_of(mechanism, description), progress(description.name) as tell:
        tell("solving")
        if what in forms:
            text = forms[what][as_json or (as_csv and what is None)](mechanism)
        else:
            named = verdicts_of(mechanism) if what == "verdicts" else bands_of(mechanism, readable_name(description))
            text = named.as_json() if as_json else str(named)
    if as_json or as_csv:
        print_file(text if text.endswith("\n") else f"{text}\n")
    else:
        click.echo(text, nl=not text.endswith("\n"))
