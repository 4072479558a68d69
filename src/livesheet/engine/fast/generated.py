"""What all generated code has in common: the values that it needs, and what is computed once before the rows.

`TroubleError` hands the rows to the interpreter.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from ..kernels.math import FAST, Arithmetic, rounded
from ..layout import Layout
from ..values.cells import NEAR
from .lowering import Effect, Lowering, Value
from .scalars import SINGLE


class TroubleError(Exception):
    """Something is not a plain number: the interpreter must do these rows."""


def _pick(line: Any, place: Any) -> Any:
    """INDEX: the cell at a place counted from 1."""
    if np.ndim(place) == 0:
        if not 1 <= place < len(line) + 1:
            raise TroubleError
        return line.item(int(place) - 1)
    if not ((place >= 1) & (place < len(line) + 1)).all():
        raise TroubleError
    return line[place.astype(np.intp) - 1]


def power_of(base: float, exponent: float, raised: Callable[..., Any] = np.power) -> float:
    """One number to the power of another, whatever that is."""
    if base == 0:
        raise TroubleError
    return float(np.square(base)) if exponent == 2 else float(raised(base, exponent))


HELPERS: dict[str, Callable[..., Any]] = {
    "pick": _pick, "rounded": rounded, "power_of": power_of,
}  # fmt: skip


def roots(effect: Effect) -> list[int]:
    """The values that an effect looks at."""
    if effect.what == "somewhere" and isinstance(effect.data, int):
        return [effect.value, effect.data]
    return [effect.value]


class Usage:
    """What the emitter must know before it writes the first line."""

    def __init__(self, lowering: Lowering) -> None:
        self.lowering = lowering
        self.values = lowering.values
        self.needed = self._needed()
        self.items = [item for item in lowering.order if isinstance(item, Effect) or item in self.needed]
        self.uses = self._uses()
        self.last = self._last_uses()
        self.outputs = self._outputs()

    def _needed(self) -> set[int]:
        stack = [v for item in self.lowering.order if isinstance(item, Effect) for v in roots(item)]
        found: set[int] = set()
        while stack:
            number = stack.pop()
            if number not in found:
                found.add(number)
                stack.extend(self.values[number].args)
        return found

    def _uses(self) -> dict[int, int]:
        uses = dict.fromkeys(self.needed, 0)
        for item in self.items:
            for number in roots(item) if isinstance(item, Effect) else self.values[item].args:
                uses[number] += 1
        return uses

    def _last_uses(self) -> dict[int, int]:
        last: dict[int, int] = {}
        for place, item in enumerate(self.items):
            for number in roots(item) if isinstance(item, Effect) else self.values[item].args:
                last[number] = place
        return last

    def _outputs(self) -> dict[int, int]:
        """Value -> where the column begins into whose cells it is computed directly."""
        found: dict[int, int] = {}
        for item in self.lowering.order:
            if isinstance(item, Effect) and item.what == "store" and isinstance(item.data, int):
                value = self.values[item.value]
                if value.along and value.op not in ("column", "count") and item.value not in found:
                    found[item.value] = item.data
        for number in list(found):
            value = self.values[number]
            if value.op == "snap" and self.uses[value.args[0]] == 1:
                found[value.args[0]] = found[number]
        return found


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
