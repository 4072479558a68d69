"""From a description to finished workbooks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mechsheet.model import Mechanism
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.workbook import Workbook

FORMATS = ("xlsx", "ods")
FUNCTIONS = ("basic", "lambda")
"""Extra workbooks whose tables call functions of their own."""


def compile_workbook(mechanism: Mechanism) -> tuple[Workbook, Plan]:
    """The workbook of a mechanism with every value computed, and the plan that says where everything stands.

    Raises MechanismError when the mechanism cannot be solved.
    """
    from mechsheet.compute import computed
    from mechsheet.kinematics.sketched import tell
    from mechsheet.kinematics.solve import solve
    from mechsheet.sheet.layout import lay_out

    equations = solve(mechanism)
    tell(mechanism, equations)
    workbook, plan = lay_out(mechanism, equations)
    return computed(workbook), plan


def build(
    mechanism: Mechanism,
    folder: str | Path = ".",
    formats: Sequence[str] = FORMATS[:1],
    functions: Sequence[str] = (),
) -> list[Path]:
    """Write the mechanism's workbook into `folder`, once for each format, and return the files written.

    functions  extra files: "basic" (`NAME-basic.ods`, needs macros), "lambda" (`NAME-lambda.xlsx`, needs Excel 365)
    The folder is made when it is not there yet (but not its parents: a misspelt path is told).
    A file is written beside its place and moved into it: a failure leaves the old one whole (OutputError).
    """
    from mechsheet.formats import write
    from mechsheet.formats.archive import make_folder

    workbook, _ = compile_workbook(mechanism)
    make_folder(Path(folder))
    paths = [Path(folder) / f"{mechanism.name}.{suffix}" for suffix in formats]
    for path in paths:
        write(workbook, path)
    for form in functions:
        from mechsheet.compute import computed
        from mechsheet.exporting.workbooks import FORMS, functions_workbook

        extra = Path(folder) / f"{mechanism.name}{FORMS[form].suffix}"
        workbook, _ = functions_workbook(mechanism, form)
        write(computed(workbook), extra)
        paths.append(extra)
    return paths
