"""What is the same in all rows, in generated code: single numbers and ranges, computed once before the rows."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from ..kernels.arithmetic import FAST, Arithmetic
from ..layout import Layout
from ..values.cells import NEAR
from .helpers import HELPERS, TroubleError, power_of
from .lowering import Lowering, Value
from .scalars import SINGLE
from .usage import Usage

_TERMS = 64
"""Terms of a sum in the code: Python's compiler takes no chains of thousands."""

_UNFLAGGED = frozenset(("add", "subtract", "multiply", "divide", "square"))
"""Operations of Python floats that overflow in silence."""


class Singles:
    """Lines of code and the names of the values in them."""

    def __init__(self, lowering: Lowering, layout: Layout, arithmetic: Arithmetic = FAST) -> None:
        self.arithmetic = arithmetic
        self.lowering = lowering
        self.layout = layout
        self.values = lowering.values
        self.usage = Usage(lowering)
        self.lines: list[str] = []
        self.names: dict[int, str] = {}
        self.namespace: dict[str, Any] = {"TroubleError": TroubleError, "NEAR": NEAR, "isfinite": np.isfinite}

    def line(self, text: str) -> None:
        """One line of code."""
        self.lines.append(f"    {text}")

    def check_singles(self) -> None:
        """Stop where a single number has overflowed."""
        needed = sorted(self.usage.needed)
        self.check_finite(
            [self.names[n] for n in needed if not self.values[n].along and self.values[n].op in _UNFLAGGED]
        )

    def check_finite(self, names: list[str]) -> None:
        """Stop where one of some numbers is not finite, or their sum is not, which is rare."""
        for start in range(0, len(names), _TERMS):
            self.line(f"if not isfinite({' + '.join(names[start : start + _TERMS])}): raise TroubleError")

    def function(self, op: str) -> str:
        """The name of a numpy function, or of what stands for it."""
        self.namespace[op] = self.arithmetic.operations.get(op) or getattr(np, op)
        return op

    def helper(self, op: str) -> Callable[..., Any]:
        """What the code calls beside numpy."""
        raised = self.arithmetic.operations.get("power")
        return HELPERS[op] if raised is None or op != "power_of" else partial(power_of, raised=raised)

    def define(self, number: int) -> None:
        """A value that is the same in all rows: its name, and the code that computes it."""
        value = self.values[number]
        if value.kind in ("error", "true", "false"):
            return
        if value.op == "text":
            self.names[number] = f"({float(self.layout.texts.number(str(value.data)))})"
        elif value.op == "constant":
            self.names[number] = f"({value.data})"
        elif value.kind in ("line", "text line"):
            self._range(number, value)
        else:
            self._single(number, value)

    def _single(self, number: int, value: Value) -> None:
        args = [self.names[arg] for arg in value.args]
        if value.op == "cell":
            text = f"item({value.data})"
        elif value.op.startswith("line_"):
            text = f"float({args[0]}.{value.op[5:]}())"
        elif value.op in HELPERS:
            self.namespace[value.op] = self.helper(value.op)
            digits = f", {value.data}" if value.op == "rounded" else ""
            text = f"float({value.op}({', '.join(args)}{digits}))"
        elif value.op in SINGLE:
            text = SINGLE[value.op].format(*args)
        else:
            text = f"float({self.function(value.op)}({', '.join(args)}))"
        self.names[number] = f"s{number}"
        self.line(f"s{number} = {text}")

    def _range(self, number: int, value: Value) -> None:
        self.names[number] = f"l{number}"
        if value.op == "line" and isinstance(value.data, tuple):
            self.line(f"l{number} = numbers[{value.data[0]}:{value.data[1]}]")
        else:
            self.namespace[f"places{number}"] = np.array(value.data)
            self.line(f"l{number} = numbers[places{number}]")
