"""Elementary functions that give the same bits on every machine.

IEEE 754 says what +, -, *, / and the square root of two numbers are, to the last bit. It says nothing of sine, logarithm
and their like: the C libraries of two systems, two versions of one of them, and numpy's code for two kinds of processor
differ in the last digit. A workbook is to be the same file wherever it is built, so whatever is written into files, or
decides what is written, is computed by the functions of this room. They consist of operations that are exact in the sense
above, one after the other (never fused), and of whole numbers.

Each takes a number or an array and gives a float or an array, with the same bits either way. Outside its domain a function
is NaN. Errors: below 1 unit in the last place (`tests/portable` holds them against mpmath).

The polynomials interpolate at Chebyshev's points and were computed with 60 digits. How arguments are reduced and results put
together is the way of Sun Microsystems' fdlibm; J.-M. Muller, "Elementary Functions", chapters 9 to 11, explains it.
"""

from .arcs import arccos, arcsin, arctan, arctan2
from .circular import cos, sin, sin_and_cos, tan
from .powers import exp, log, log10, power
from .steps import hypot

__all__ = [
    "arccos",
    "arcsin",
    "arctan",
    "arctan2",
    "cos",
    "exp",
    "hypot",
    "log",
    "log10",
    "power",
    "sin",
    "sin_and_cos",
    "tan",
]
