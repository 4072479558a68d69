"""Workbooks as .xlsx: written, read, and written back with other values."""
