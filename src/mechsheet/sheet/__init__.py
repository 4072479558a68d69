"""From the equations to a workbook as plain data."""
