"""The two-way tables that a description asks for."""
