"""Velocities and accelerations, and derivatives by dimensions: how bodies move, influence coefficients, their columns."""
