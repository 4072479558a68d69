"""Workbooks as .ods: written, read, and written back with other values."""
