"""Workbooks of Excel 97 to 2003 (.xls, BIFF8): the container, its records, the tokens of formulas. Read, not written."""
