"""What both readers share: archives from anywhere, XML whose bytes are kept, runs of formulas, rows that repeat."""
