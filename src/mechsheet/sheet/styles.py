"""The look of the workbook: one catalogue."""

from __future__ import annotations

from dataclasses import replace

from livesheet.workbook import Dash, Style
from mechsheet.shapes import colors

INK, QUIET, RULE = "1F2933", "6B7280", "C5CBD3"
INPUT_FILL, DERIVED_FILL, HEAD_FILL, BAND_FILL, ROW_FILL = "FFF7D6", "F1F3F5", "1F4E79", "D6E4F0", "FFE7A3"
INPUT_INK = "0B4FA8"
GOOD_FILL, WARN_FILL, BAD_FILL, NONE_FILL = "DDF1DD", "FFE9B8", "F9D4D0", "E3E5E8"
SERIES = colors.SERIES
"""Colours of curves, in order."""
DASHES: tuple[Dash, ...] = ("solid", "dash", "dot")
"""Lines of curves, in order: some of the colours are of one grey in print."""


def dash_of_curve(index: int) -> Dash:
    """The line of a curve, counted from 0: shifted by one after each round, so that blues and greens do not share theirs."""
    return DASHES[(index + index // len(DASHES)) % len(DASHES)]


TITLE = Style("mechsheet title", bold=True, size=16, color=HEAD_FILL)
SUBTITLE = Style("mechsheet subtitle", italic=True, color=QUIET)
SECTION = Style("mechsheet section", bold=True, size=11, color="FFFFFF", fill=HEAD_FILL)
HEAD = Style(
    "mechsheet head", bold=True, color=INK, fill=BAND_FILL, border="bottom", align="center", valign="center", wrap=True
)
HEAD_LEFT = replace(HEAD, name="mechsheet head left", align="left")
FORMULA_TEXT = Style(
    "mechsheet formula text", italic=True, size=9, color=QUIET, align="left", valign="top", wrap=True,
    border="thin", border_color="E5E7EB",  # neighbours would read as one
)  # fmt: skip
SYMBOL = Style("mechsheet symbol", color=INK, align="left", border="thin", border_color=RULE)
LABEL = Style("mechsheet label", color=INK, align="left", indent=1, border="thin", border_color=RULE)
LABEL_LINES = replace(LABEL, name="mechsheet label lines", wrap=True)
LABEL_SAID = replace(LABEL, name="mechsheet label said", shrink=True)
"""A text that a formula writes: nobody knows how long it will be."""
UNIT = Style("mechsheet unit", color=QUIET, align="left", indent=1, border="thin", border_color=RULE)
NOTE = Style("mechsheet note", color=QUIET, italic=True, valign="top", wrap=True)
NOTE_TEXT = Style("mechsheet text", color=INK, align="left", valign="top", wrap=True)
NOTE_CELL = Style(
    "mechsheet text line", color=INK, align="left", valign="top", wrap=True, border="bottom", border_color="E3E7EB"
)
INPUT = Style(
    "mechsheet input",
    color=INPUT_INK,
    fill=INPUT_FILL,
    border="thin",
    border_color="B08900",
    align="right",
    locked=False,
)
RESULT = Style("mechsheet result", color=INK, fill=DERIVED_FILL, border="thin", border_color=RULE, align="right")
COLUMN = Style("mechsheet column", color=INK, align="right")
INNER = Style("mechsheet inner column", color=QUIET, align="right")
STATUS = Style("mechsheet status", color=INK, align="left", indent=1)
VERDICT = Style("mechsheet verdict", color=INK, border="thin", border_color=RULE, align="left", indent=1)
LINE = Style(
    "mechsheet verdict line", bold=True, color=INK, fill=DERIVED_FILL, border="thin", border_color=RULE, align="left",
    valign="center", wrap=True, indent=1,
)  # fmt: skip
LEGEND = Style("mechsheet legend", color=QUIET, size=8, align="left", shrink=True, indent=1)
MARK = Style("mechsheet mark", color=INK, size=8, align="center")
DETERMINANT = "0.000E+00"
ERROR = Style("mechsheet error", color=INK, align="right", number_format="0.0E+00")
GOOD = Style("mechsheet good", color="1B5E20", fill=GOOD_FILL, bold=True)
WARN = Style("mechsheet warning", color="7A4F00", fill=WARN_FILL, bold=True)
BAD = Style("mechsheet bad", color="8E1B10", fill=BAD_FILL, bold=True)
MISSING = Style("mechsheet no position", color="9AA0A6", fill=NONE_FILL)
CURRENT = Style("mechsheet current row", color=INK, fill=ROW_FILL, bold=True)


def decimals(style: Style, places: int) -> Style:
    """The style with a number format of so many decimals; the value below keeps all its digits."""
    return replace(style, number_format="0." + "0" * places if places > 0 else "0", name="")


def numbered(style: Style, number_format: str) -> Style:
    """The style with a number format of its own."""
    return replace(style, number_format=number_format, name="")


def centred(style: Style) -> Style:
    """The style with its text in the middle."""
    return replace(style, align="center", name="")
