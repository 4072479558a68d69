"""Joint forces and the driver's effort, group by group in reverse order of solution."""
