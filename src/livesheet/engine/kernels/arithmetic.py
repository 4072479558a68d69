"""Which code the elementary functions have: numpy's, the fastest there is, or that of `portable`, the same everywhere.

Whoever recalculates a workbook wants its values at once, and a last digit that depends on the processor does no harm.
Whoever writes values into a file wants the same file everywhere, and can wait.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ... import portable
from .math import atan2, power


@dataclass(frozen=True, slots=True, eq=False)
class Arithmetic:
    """What stands instead of numpy's own code.

    functions   worksheet function, or ^ -> array code, as in `math.MAPS`
    operations  numpy's name of a function -> its code: of floats a float, of arrays an array; a last argument beyond is
                where the result goes, as numpy has it
    """

    functions: Mapping[str, Callable[..., Any]]
    operations: Mapping[str, Callable[..., Any]]


FAST = Arithmetic({}, {})

_OPERATIONS: dict[str, Callable[[Any], Any]] = {
    "sin": portable.sin, "cos": portable.cos, "tan": portable.tan, "arcsin": portable.arcsin,
    "arccos": portable.arccos, "arctan": portable.arctan, "exp": portable.exp, "log": portable.log,
    "log10": portable.log10,
}  # fmt: skip


def _placed(function: Callable[..., Any], takes: int) -> Callable[..., Any]:
    """A function that puts its result into an array where there is one argument more than it takes; of single numbers it
    raises FloatingPointError where the result is not finite, as numpy does."""

    def called(*args: Any) -> Any:
        if len(args) == takes:
            found = function(*args)
            if isinstance(found, float) and not math.isfinite(found):
                raise FloatingPointError("not a finite number")
            return found
        np.copyto(args[takes], function(*args[:takes]))
        return args[takes]

    return called


PORTABLE = Arithmetic(
    {
        "SIN": portable.sin, "COS": portable.cos, "TAN": portable.tan, "ASIN": portable.arcsin,
        "ACOS": portable.arccos, "ATAN": portable.arctan, "EXP": portable.exp, "LN": portable.log,
        "LOG10": portable.log10, "ATAN2": partial(atan2, direction=portable.arctan2),
        "POWER": partial(power, raised=portable.power), "^": partial(power, raised=portable.power),
    },
    {name: _placed(function, 1) for name, function in _OPERATIONS.items()}
    | {"arctan2": _placed(portable.arctan2, 2), "power": _placed(portable.power, 2)},
)  # fmt: skip
"""For all that descriptions and the workbooks made of them use; other functions are numpy's here too."""
