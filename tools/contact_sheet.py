"""All templates' drawings in one picture, to be looked at together: `python tools/contact_sheet.py sheet.png`."""

import sys
from math import ceil

from matplotlib.figure import Figure

from mechsheet.description import loads
from mechsheet.description.templates import template_names, template_text
from mechsheet.plotting.pictures import draw, settings
from mechsheet.plotting.sampling import sample
from mechsheet.plotting.scenes import Stage

ACROSS = 8
INCHES, DPI = 2.4, 100
"""The side of one drawing, and dots in an inch."""


def contact_sheet(names: list[str]) -> Figure:
    """The drawings in rows, each under its name, at the position that its workbook shows first."""
    down = ceil(len(names) / ACROSS)
    figure = Figure(figsize=(ACROSS * INCHES, down * INCHES))
    for number, name in enumerate(names):
        stage = Stage(sample(loads(template_text(name), name), None, "en"))
        axes = figure.add_subplot(down, ACROSS, number + 1)
        draw(axes, stage.drawing(stage.sample.shown), INCHES / 5)
        axes.set_title(name, fontsize=8)
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.97, 0.05, 0.12)
    return figure


if __name__ == "__main__":
    with settings():
        contact_sheet(list(template_names())).savefig(sys.argv[1], dpi=DPI)
