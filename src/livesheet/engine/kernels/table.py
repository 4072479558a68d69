"""The array code of every function in `formula/functions.txt`; each module of kernels is loaded when a formula needs it.

A kernel takes (evaluator, argument trees, frame, spread) and returns cells; see `interpreter/evaluator.py` for the words. A
module may hold three tables: KERNELS; MAPS, functions of numbers and truth values over arrays; PLAIN, functions of Python
values (`interpreter/calling.py`). What SciPy computes stands in modules of their own, for it is not always installed.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any, TypeAlias

import numpy as np

from ...formula.functions import FUNCTIONS, Function
from ...formula.nodes import Node
from ..interpreter.calling import called
from ..interpreter.closures import Evaluation
from ..values.cells import BOOLEAN, VALUE, Cells, Frame
from ..values.coerce import truths_of

Kernel: TypeAlias = Callable[[Evaluation, tuple[Node, ...], Frame, bool], Cells]


def _without_flags(cells: Cells) -> Cells:
    """Values in which truth values are #VALUE!."""
    if cells.codes is None or not np.count_nonzero(cells.codes == BOOLEAN):
        return cells
    return Cells(cells.numbers, np.where(cells.codes == BOOLEAN, np.uint8(VALUE), cells.codes))


def _mapped(row: Function, function: Callable[..., Any]) -> Kernel:
    """A function of numbers and truth values (1 and 0), cell by cell; an argument left empty is 0."""

    def kernel(ev: Evaluation, args: tuple[Node, ...], frame: Frame, spread: bool) -> Cells:
        cells = [ev.value(arg, frame, spread) for arg in args]
        for place, kind in enumerate(row.kinds_of(len(args))):
            if kind == "p":
                cells[place] = _without_flags(cells[place])
            elif kind == "b":
                mask, errors = truths_of(cells[place], ev.texts)
                cells[place] = Cells(np.asarray(mask, np.float64), errors)
        return ev.mapped(ev.around.arithmetic.functions.get(row.name, function), tuple(cells))

    return kernel


def kernels_in(module: str) -> dict[str, Kernel]:
    """All kernels of a module, by function."""
    tables = import_module(f".{module}", __package__)
    found: dict[str, Kernel] = dict(getattr(tables, "KERNELS", {}))
    found.update({name: _mapped(FUNCTIONS[name], function) for name, function in getattr(tables, "MAPS", {}).items()})
    found.update({name: called(FUNCTIONS[name], function) for name, function in getattr(tables, "PLAIN", {}).items()})
    return found


class _Kernels(dict[str, Kernel]):
    """Function -> kernel, for all of FUNCTIONS; what has been asked for stays."""

    def __missing__(self, name: str) -> Kernel:
        self.update(kernels_in(FUNCTIONS[name].module))
        return self[name]

    def __contains__(self, name: object) -> bool:
        return name in FUNCTIONS


KERNELS = _Kernels()

_OF_SCIPY = ("distributions", "special")
"""Modules whose kernels call SciPy, which the extra `statistics` brings: a mechanism's workbook needs none of them."""


@cache
def _scipy_is_there() -> bool:
    return find_spec("scipy") is not None


def lacks_scipy(name: str) -> bool:
    """Whether a function of FUNCTIONS cannot be computed here because SciPy is not installed."""
    return FUNCTIONS[name].module in _OF_SCIPY and not _scipy_is_there()
