"""What somebody changed in a workbook that mechsheet built, and dimensions changed there back into its description."""
