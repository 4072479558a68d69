"""`mechsheet draw`: a page in the browser on which a mechanism is drawn and moved."""

from __future__ import annotations

import contextlib
import webbrowser
from pathlib import Path

import click

from livesheet.diagnostics import Fault, readable_name
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError

from .common import FILE, Explained, language_option
from .speaking import told


@click.command(cls=Explained, short_help="Draw a mechanism with the mouse, in the browser.")
@click.argument("description", required=False, type=FILE)
@language_option("Language of the page.  [default: the browser's]")
@click.option("--no-browser", is_flag=True, help="Print the address and open nothing.")
def draw(description: Path | None, language: str | None, no_browser: bool) -> None:
    """Draw a mechanism with the mouse: a page on this machine, beside its text.

    \b
    mechsheet draw                      start with an empty sheet
    mechsheet draw four-bar.toml        draw, move and change a mechanism

    The page is served to this machine only and needs no network. To end, close the page or press
    Ctrl-C.
    """
    from mechsheet.description.text.source import read_text
    from mechsheet.drawing_page.answers import Studio
    from mechsheet.drawing_page.server import DrawingServer

    if description is not None:
        if description.suffix.lower() != ".toml":
            hint = say("a workbook carries its description inside: mechsheet pull WORKBOOK -o mine.toml")
            raise MechsheetError(Fault(say("name a description, a .toml file"), readable_name(description), hint=hint))
        if description.exists():
            read_text(description)  # a folder, or no text: said here, not on the page
        elif not description.parent.is_dir():
            raise MechsheetError(Fault(say("its folder is not there"), readable_name(description)))
    server = DrawingServer(Studio(description, Path.cwd(), language))
    server.start()
    click.echo(server.address)
    click.echo(told(say("Close the page to end, or press Ctrl-C here.")), err=True)
    if not no_browser and not webbrowser.open(server.address):
        click.echo(told(say("No browser was found: open the address above in one on this machine.")), err=True)
    with contextlib.suppress(KeyboardInterrupt):
        server.wait()
    server.stop()
