"""What the generated code calls beside numpy; `TroubleError` hands the rows to the interpreter."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..kernels.math import rounded


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
