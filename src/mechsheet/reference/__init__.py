"""Reference solution of a mechanism: Newton's method on link poses, straight from the model.

It knows nothing of equations, formulas, cells or the groups that the workbook is solved by; it judges them.
"""

from .cams import profile
from .forces import forces
from .geometry import dimension_values, driver_values
from .outputs import POLE, further, outputs, variables
from .poses import assemblies, nearby, solve
from .rates import by_time, rates
from .residual import residuals, worst
from .solution import Solution, reached

__all__ = [
    "POLE",
    "Solution",
    "assemblies",
    "by_time",
    "dimension_values",
    "driver_values",
    "forces",
    "further",
    "nearby",
    "outputs",
    "profile",
    "rates",
    "reached",
    "residuals",
    "solve",
    "variables",
    "worst",
]
