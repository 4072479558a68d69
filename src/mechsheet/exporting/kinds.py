"""The kinds of export: one module and one line each."""

from __future__ import annotations

from mechsheet.exporting import dxf, latex, markdown, octave, python, svg, table, vba
from mechsheet.exporting.job import Kind

_ROWS = (
    Kind("octave", ".m", "a function file for GNU Octave and MATLAB, with animated drawing", octave.write, identifier=True),
    Kind("python", ".py", "a numpy module that needs nothing else", python.write, identifier=True),
    Kind("vba", ".bas", "a module of functions for Excel and LibreOffice", vba.write, identifier=True),
    Kind("latex", ".tex", "the solution as a textbook writes it, with numbers for one position", latex.write, positions=True),
    Kind("markdown", ".md", "the same in Markdown", markdown.write, positions=True),
    Kind("csv", ".csv", "the variables over the sweep, with units", table.write),
    Kind("svg", ".svg", "drawings of positions, in the mechanism's coordinates", svg.write, positions=True, frames=True),
    Kind("dxf", ".dxf", "drawings of positions for CAD (needs mechsheet[dxf])", dxf.write, positions=True, frames=True),
)

KINDS = {kind.name: kind for kind in _ROWS}
"""Name -> kind, in the order of the help."""
