"""Recalculates any workbook: knows formulas and cells, nothing of mechanisms."""

from .incremental import Live
from .kernels.math import FAST, PORTABLE, Arithmetic
from .plan import Plan, compile_book, evaluate, steady_plan
from .results import Values

__all__ = ["FAST", "PORTABLE", "Arithmetic", "Live", "Plan", "Values", "compile_book", "evaluate", "steady_plan"]
