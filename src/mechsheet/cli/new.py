"""`mechsheet new`: start from a packaged description."""

from __future__ import annotations

import click

from livesheet.said import say
from mechsheet.arguments.outputs import is_there

from .common import STANDARD_OUTPUT, Explained, completing, output_file, output_option, refuse_existing, write_text
from .speaking import spoken, told, wrote
from .streams import print_file


def _templates() -> tuple[str, ...]:
    from mechsheet.description.templates import template_names

    return tuple(template_names())


@click.command(cls=Explained)
@click.argument("template", required=False, shell_complete=completing(_templates))
@output_option("File to write; standard output without it.")
@click.option("--list", "show_list", is_flag=True, help="List the templates with their titles.")
def new(template: str | None, output: str | None, show_list: bool) -> None:
    """Start from a packaged description.

    \b
    mechsheet new --list
    mechsheet new four-bar -o mine.toml

    Where `mechsheet schema -o mechsheet.schema.json` was run, the first line of the new file names it for editors.
    """
    from mechsheet.description.json_schema import FILE
    from mechsheet.description.templates import template_text, template_titles

    if show_list or template is None:
        if output is not None:
            raise click.UsageError(told(say("-o needs a template: mechsheet new four-bar -o mine.toml")))
        titles = template_titles()
        width = max(len(name) for name in titles)
        for name, title in titles.items():
            click.echo(f"{name:<{width}}  {title.of(spoken())}")
        return
    first_line = f"#:schema {FILE}\n"
    text = template_text(template).removeprefix(first_line)
    if output in (None, STANDARD_OUTPUT):
        print_file(text)
        return
    file = output_file(output, f"{template.removesuffix('.toml')}.toml")
    refuse_existing(file)
    # Editors complain of a schema that is not there.
    text = first_line + text if is_there(file.parent / FILE) else text
    write_text(file, text, output)
    wrote(file.as_posix())
