"""Which rows exist in branches and degenerate geometry, as LibreOffice finds them from the same file: to the last row."""

import pytest

from chosen import part
from degenerate_cases import cases
from livesheet.formats import write
from mechsheet.checking.programs import convert_with_libreoffice, stored_values
from mechsheet.description import loads
from mechsheet.library.building import compile_workbook
from mechsheet.sheet.plan import STATUS

pytestmark = pytest.mark.libreoffice


@pytest.mark.ci
def test_rows_that_exist(tmp_path):
    all_cases = [case for folder in ("branches", "degenerate") for case in cases(folder)]
    chosen = part((case for case in all_cases if not case.refused), 18)
    plans, paths = [], []
    for case in chosen:
        workbook, plan = compile_workbook(loads(case.description))
        paths.append(tmp_path / f"{case.name}.xlsx")
        plans.append(plan)
        write(workbook, paths[-1])
    folder = tmp_path / "libreoffice"
    folder.mkdir()
    for case, plan, answer in zip(chosen, plans, convert_with_libreoffice(paths, "xlsx", folder), strict=True):
        values = stored_values(answer)
        for row in range(plan.rows):
            status = values.get(plan.table, plan.at.first + row, STATUS)
            assert (status != plan.text("status.ok")) == (row in case.missing), (case.name, row, status)
