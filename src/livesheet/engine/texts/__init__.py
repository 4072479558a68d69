"""What texts say and show: patterns, criteria, number formats, the calendar."""
