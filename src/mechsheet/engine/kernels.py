"""The array code of every function in `formula/functions.py`; a test holds the two tables to the same names.

A kernel takes (evaluator, argument trees, frame, spread) and returns cells; see `careful.py` for the words.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ..formula.nodes import Missing, Node
from . import kernels_fold, kernels_logic, kernels_lookup, kernels_math, kernels_text
from .frames import Frame
from .values import Cells

if TYPE_CHECKING:
    from .careful import Evaluator

Kernel: TypeAlias = Callable[["Evaluator", tuple[Node, ...], "Frame", bool], Cells]


def _mapped(function: Callable[..., Any]) -> Kernel:
    """A function of numbers, cell by cell; an argument left empty is 0."""

    def kernel(ev: Evaluator, args: tuple[Node, ...], frame: Frame, spread: bool) -> Cells:
        cells = tuple(
            Cells(np.float64(0)) if isinstance(arg, Missing) else ev.value(arg, frame, spread) for arg in args
        )
        return ev.mapped(function, cells)

    return kernel


KERNELS: dict[str, Kernel] = {
    **{name: _mapped(function) for name, function in kernels_math.MAPS.items()},
    **kernels_logic.KERNELS,
    **kernels_fold.KERNELS,
    **kernels_lookup.KERNELS,
    **kernels_text.KERNELS,
}
