"""Functions that spreadsheets call: in Basic, as LAMBDA, and workbooks whose tables are such calls."""
