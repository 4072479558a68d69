"""`mechsheet schema`: the JSON Schema of descriptions, for editors."""

from __future__ import annotations

import click

from livesheet.said import say

from .common import STANDARD_OUTPUT, Explained, output_file, output_option, write_text
from .speaking import wrote
from .streams import print_file


@click.command(cls=Explained, short_help="Print the JSON Schema of descriptions, for editors.")
@output_option("File to write; standard output without it.")
def schema(output: str | None) -> None:
    """Print the JSON Schema of descriptions: editors complete and check keys with it.

    \b
    mechsheet schema -o mechsheet.schema.json

    Put the file beside the descriptions. The first line of each is to name it: #:schema mechsheet.schema.json
    """
    from mechsheet.description.json_schema import FILE, json_schema_text

    text = json_schema_text()
    if output in (None, STANDARD_OUTPUT):
        print_file(text)
        return
    file = output_file(output, FILE)
    write_text(file, text, output)
    wrote(
        say("{name}; first line of a description beside it: #:schema {schema}", name=file.as_posix(), schema=file.name)
    )
