"""The kinds of export: one module and one line each."""

from __future__ import annotations

from mechsheet.exporting import dxf, geogebra, latex, markdown, octave, python, svg, table
from mechsheet.exporting.functions import vba
from mechsheet.exporting.job import Kind

_ROWS = (
    Kind("octave", ".m", "arrays, animated drawing and curves: GNU Octave, MATLAB", octave.write, identifier=True),
    Kind("python", ".py", "a numpy module that needs nothing else", python.write, identifier=True),
    Kind("geogebra", ".ggb", "a construction that moves, with sliders, for GeoGebra", geogebra.write),
    Kind("vba", ".bas", "a module of functions for Excel and LibreOffice", vba.write, identifier=True),
    Kind("latex", ".tex", "the solution as a textbook writes it, for one position", latex.write, positions=True),
    Kind("markdown", ".md", "the same in Markdown", markdown.write, positions=True),
    Kind("csv", ".csv", "the variables over the sweep, with units", table.write),
    Kind(
        "svg",
        ".svg",
        "drawings of positions, true coordinates",
        svg.write,
        positions=True,
        frames=True,
        behind="-drawing",
    ),
    Kind("dxf", ".dxf", "drawings for CAD (needs mechsheet[dxf])", dxf.write, positions=True, frames=True),
)

KINDS = {kind.name: kind for kind in _ROWS}
"""Name -> kind, in the order of the help."""
