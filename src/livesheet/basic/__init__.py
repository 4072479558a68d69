"""Functions written in Basic, read from a module's text as names for LAMBDA: nothing of it ever runs.

Read are functions of plain arithmetic with If, For, Do and While, Exit, GoTo of a label further down, On Error GoTo. What a
function does besides (arrays, objects, variables that keep their values, messages) refuses that function, not the others.
"""

from .reading import Function, decoded, functions_in
from .translating import lambdas

__all__ = ["Function", "decoded", "functions_in", "lambdas"]
