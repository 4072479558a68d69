"""mechsheet: a planar mechanism in, a proven spreadsheet workbook out.

>>> import mechsheet
>>> mechanism = mechsheet.load("templates/four-bar.toml")     # doctest: +SKIP
>>> mechsheet.build(mechanism, "workbooks")                   # doctest: +SKIP
>>> mechsheet.check("workbooks/four-bar.xlsx").agrees         # doctest: +SKIP
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from mechsheet.building import build, compile_workbook
    from mechsheet.checking import Comparison, Report, check
    from mechsheet.diagnostics import MechsheetError
    from mechsheet.exporting import export
    from mechsheet.linkage import Linkage, Motion, load, loads, template
    from mechsheet.model import Mechanism
    from mechsheet.plotting import plot
    from mechsheet.recalculation import Result, recalc
    from mechsheet.what_if import Session, open_book

_HOMES = {
    "build": "building",
    "compile_workbook": "building",
    "check": "checking",
    "Comparison": "checking",
    "Report": "checking",
    "export": "exporting",
    "load": "linkage",
    "loads": "linkage",
    "template": "linkage",
    "Linkage": "linkage",
    "Motion": "linkage",
    "MechsheetError": "diagnostics",
    "Mechanism": "model",
    "plot": "plotting",
    "open_book": "what_if",
    "recalc": "recalculation",
    "Result": "recalculation",
    "Session": "what_if",
}
"""Name -> module: imported when first used, so that `mechsheet --help` need not load numpy."""

__all__ = [
    "Comparison",
    "Linkage",
    "Mechanism",
    "MechsheetError",
    "Motion",
    "Report",
    "Result",
    "Session",
    "__version__",
    "build",
    "check",
    "compile_workbook",
    "export",
    "load",
    "loads",
    "open_book",
    "plot",
    "recalc",
    "template",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'mechsheet' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"mechsheet.{_HOMES[name]}"), name)
