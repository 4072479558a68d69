"""mechsheet: a planar mechanism in, a proven spreadsheet workbook out.

>>> import mechsheet
>>> mechanism = mechsheet.load("templates/four-bar.toml")     # doctest: +SKIP
>>> mechsheet.build(mechanism, "workbooks")                   # doctest: +SKIP
>>> mechsheet.check("workbooks/four-bar.xlsx").agrees         # doctest: +SKIP
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from livesheet.on_demand import listed, names_of
from mechsheet.version import __version__

if TYPE_CHECKING:
    from mechsheet.checking import Comparison, Report, check
    from mechsheet.diagnostics import MechsheetError
    from mechsheet.exporting import export
    from mechsheet.homework.audit import Audit, audit
    from mechsheet.homework.classroom.exercise import exercise
    from mechsheet.homework.classroom.marks import Marks, mark
    from mechsheet.library.building import build, compile_workbook
    from mechsheet.library.linkage import Linkage, Motion, load, loads, template
    from mechsheet.library.recalculation import Result, recalc
    from mechsheet.library.session import Session, open_book
    from mechsheet.library.studying import study
    from mechsheet.library.verdicts import Band, Verdict
    from mechsheet.model import Mechanism
    from mechsheet.plotting import plot

_HOMES = {
    "audit": "homework.audit",
    "Audit": "homework.audit",
    "exercise": "homework.classroom.exercise",
    "mark": "homework.classroom.marks",
    "Marks": "homework.classroom.marks",
    "build": "library.building",
    "compile_workbook": "library.building",
    "check": "checking",
    "Comparison": "checking",
    "Report": "checking",
    "export": "exporting",
    "load": "library.linkage",
    "loads": "library.linkage",
    "template": "library.linkage",
    "Linkage": "library.linkage",
    "Motion": "library.linkage",
    "Verdict": "library.verdicts",
    "Band": "library.verdicts",
    "MechsheetError": "diagnostics",
    "Mechanism": "model",
    "plot": "plotting",
    "open_book": "library.session",
    "recalc": "library.recalculation",
    "Result": "library.recalculation",
    "Session": "library.session",
    "study": "library.studying",
}
"""Name -> module: imported when first used, so that `mechsheet --help` need not load numpy."""

__all__ = [
    "Audit",
    "Band",
    "Comparison",
    "Linkage",
    "Marks",
    "Mechanism",
    "MechsheetError",
    "Motion",
    "Report",
    "Result",
    "Session",
    "Verdict",
    "__version__",
    "audit",
    "build",
    "check",
    "compile_workbook",
    "exercise",
    "export",
    "load",
    "loads",
    "mark",
    "open_book",
    "plot",
    "recalc",
    "study",
    "template",
]

__getattr__ = names_of(__name__, _HOMES)
__dir__ = listed(__all__)
