"""`mechsheet new`: start from a packaged description."""

from __future__ import annotations

from pathlib import Path

import click

from mechsheet.diagnostics import Fault, MechsheetError


def _templates(context: click.Context, parameter: click.Parameter, begun: str) -> list[str]:
    """The templates' names that a shell may complete."""
    from mechsheet.description.templates import template_names

    return [name for name in template_names() if name.startswith(begun)]


@click.command()
@click.argument("template", required=False, shell_complete=_templates)
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
