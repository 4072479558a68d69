"""The workbook stays small: cells, columns, and formulas short enough to be read."""

from dataclasses import replace

import pytest
from claims import ROOT

from mechsheet.description import load
from mechsheet.formula.nodes import Call, Node, children
from mechsheet.formula.printer import print_formula
from mechsheet.kinematics.solve import solve
from mechsheet.sheet.layout import lay_out
from mechsheet.sheet.positions import heading

TEMPLATES = sorted((ROOT / "templates").glob("*.toml"))
