"""What is asked of a mechanism beside its motion: an exercise, a task that gives dimensions, a study, bands."""
