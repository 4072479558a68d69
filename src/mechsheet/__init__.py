"""mechsheet: a planar mechanism in, a proven spreadsheet workbook out."""

__version__ = "0.1.0"
