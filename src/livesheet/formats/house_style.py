"""Fonts, sizes and colours that both formats share, so that the twins look alike."""

from __future__ import annotations

FONT = "Arial"
"""Installed or replaced by a font of the same widths wherever a spreadsheet program runs."""
FONT_SIZE = 10
ROW_PIXELS, COLUMN_PIXELS = 17, 64
"""A row and a column without a size of their own, in that font."""
DIGIT_PIXELS, EXCEL_DIGIT_PIXELS, PADDING_PIXELS = 7.4, 7, 5
"""A column of n characters is n digits and a padding wide. Excel rounds a digit of this font to 7 pixels, LibreOffice not:
the columns of an .xlsx are as wide there as those of an .ods."""

MARGIN_SIDE, MARGIN_TOP, MARGIN_END, MARGIN_HEADER = 0.6, 0.4, 0.6, 0.3
"""Of printed pages [inches]: left and right, above the cells, below them, where the footer is, and below that."""

TITLE_SIZE, TEXT_SIZE = 11, 10
"""Text of charts [points]."""
GRID_COLOR, AXIS_COLOR, TEXT_COLOR = "D9D9D9", "7F7F7F", "404040"
HAIR_LINE = 0.75
"""Width of axes and grid lines [points]."""

NOTE_PIXELS, NOTE_LINE_PIXELS, NOTE_LINE_CHARACTERS = 220, 15, 34
"""Width of a note over a cell, height of its lines, and what a line holds."""

COUNTRIES = {"en": "US", "tr": "TR"}
"""Country that goes with a language where a format wants both."""


def note_height(text: str) -> int:
    """Height [pixels] of a note large enough for its text."""
    lines = sum(1 + len(line) // NOTE_LINE_CHARACTERS for line in text.split("\n"))
    return (lines + 1) * NOTE_LINE_PIXELS


def excel_column_pixels(width: float) -> int:
    """Width of a column of `width` characters, to Excel's whole pixels."""
    return int(width * EXCEL_DIGIT_PIXELS + 0.5) + PADDING_PIXELS


def locale(language: str) -> str:
    """en-US for en; the language itself where its country is not known."""
    return f"{language}-{COUNTRIES[language]}" if language in COUNTRIES else language
