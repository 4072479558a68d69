"""From a description to finished workbooks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mechsheet.model import Mechanism
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.workbook import Workbook

FORMATS = ("xlsx", "ods")


def compile_workbook(mechanism: Mechanism) -> tuple[Workbook, Plan]:
    """The workbook of a mechanism with every value computed, and the plan that says where everything stands.

    Raises MechanismError when the mechanism cannot be solved.
    """
    from mechsheet.compute import computed
    from mechsheet.kinematics.solve import solve
    from mechsheet.sheet.layout import lay_out

    workbook, plan = lay_out(mechanism, solve(mechanism))
    return computed(workbook), plan


def build(mechanism: Mechanism, folder: str | Path = ".", formats: Sequence[str] = FORMATS[:1]) -> list[Path]:
    """Write the mechanism's workbook into `folder`, once for each format, and return the files written.

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
    return paths
