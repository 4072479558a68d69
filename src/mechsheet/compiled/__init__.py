"""A mechanism compiled: its equations, their values, its workbook. Nobody solves twice."""

from mechsheet.compiled.mechanism import Compiled, compiled_of

__all__ = ["Compiled", "compiled_of"]
