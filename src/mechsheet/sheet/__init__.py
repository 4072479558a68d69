"""From the equations to a workbook as plain data: several sheets, or one page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from livesheet.on_demand import names_of

if TYPE_CHECKING:
    from mechsheet.sheet.layout import lay_out
    from mechsheet.sheet.page.layout import lay_out_page

__all__ = ["lay_out", "lay_out_page"]

__getattr__ = names_of(__name__, {"lay_out": "layout", "lay_out_page": "page.layout"})
