"""[dynamics], [[loads]], masses and [flywheel], and the names of all forces."""
