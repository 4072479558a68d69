"""`mechsheet plot`: draw the mechanism."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from mechsheet.arguments.outputs import folder_ready

from .common import (
    FILE,
    Explained,
    at_lines_of,
    change_options,
    described,
    language_option,
    output_file,
    output_option,
    progress,
    say_written,
)


@click.command(cls=Explained, short_help="Draw it: a picture, an animation, a web page, a report.")
@click.argument("description", type=FILE)
@click.option("--at", type=float, metavar="VALUE", help="Position: a value of the driver, in its unit.")
@output_option("File to write: .svg, .png, .gif, .html or .pdf.")
@language_option("Language of the picture.")
@click.option("--vectors", is_flag=True, help="Velocities, accelerations and joint forces as arrows.")
@change_options
def plot(
    description: Path, at: float | None, output: str | None, language: str | None, vectors: bool, **changes: Any
) -> None:
    """Draw the mechanism: a picture, an animation, a web page with a slider, or a report on paper.

    \b
    mechsheet plot four-bar.toml --at 60               four-bar.svg
    mechsheet plot four-bar.toml --at 60 -o fb.png     a picture
    mechsheet plot four-bar.toml -o fb.gif             an animation of the sweep
    mechsheet plot four-bar.toml -o fb.html            a page with a slider
    mechsheet plot four-bar.toml -o fb.pdf             a report on paper
    mechsheet plot engine.toml --at 60 --vectors       with velocities and forces

    All but the web page need matplotlib: pip install "mechsheet[plot]"
    """
    from mechsheet.plotting import plot as draw

    mechanism = described(description, language=language, **changes)
    path = output_file(output, f"{mechanism.stem}.svg", (description,))
    with progress(description.name) as tell, at_lines_of(mechanism, description), folder_ready(output):
        tell("drawing")
        draw(mechanism, path, at, vectors=vectors)
    say_written([path])
