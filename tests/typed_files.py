"""Files in which numbers are typed as a person would, for other programs: nothing that is stored in them can be believed."""

from collections.abc import Mapping
from dataclasses import replace

from livesheet.formula.nodes import Scalar
from livesheet.workbook import Sheet, Workbook, with_values


def with_inputs(workbook: Workbook, typed: Mapping[tuple[str, int, int], Scalar]) -> Workbook:
    """The workbook with these cells' constants, 0 stored as the result of every formula."""
    left = dict(typed)

    def with_them(sheet: Sheet) -> Sheet:
        cells = (
            replace(cell, content=left.pop((sheet.title, cell.row, cell.col), cell.content)) for cell in sheet.cells
        )
        return replace(sheet, cells=tuple(cells))

    changed = replace(workbook, sheets=tuple(map(with_them, workbook.sheets)))
    assert not left, f"no cells to type into: {left}"
    fills = (fill for sheet in changed.sheets for fill in sheet.fills)
    return with_values(changed, ([0.0] * (fill.rows * fill.cols) for fill in fills))
