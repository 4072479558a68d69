"""`mechsheet schema`: the JSON Schema of descriptions, for editors."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.option("-o", "--output", type=click.Path(path_type=Path), help="File to write; standard output without it.")
def schema(output: Path | None) -> None:
    """Print the JSON Schema of descriptions: editors complete and check keys with it.

    \b
    mechsheet schema -o mechsheet.schema.json     beside the descriptions, whose first line names it:
                                                  #:schema mechsheet.schema.json
    """
    from mechsheet.description.json_schema import json_schema_text

    text = json_schema_text()
    if output is None:
        click.echo(text, nl=False)
        return
    from mechsheet.formats.archive import replace_file

    replace_file(output, text.encode())
    click.echo(f"wrote {output.as_posix()}", err=True)
