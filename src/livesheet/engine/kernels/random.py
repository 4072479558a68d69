"""Random numbers: the same ones in every run of the program."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...formula.nodes import Missing
from ..interpreter.calling import Args, one_number
from ..interpreter.closures import Evaluation
from ..values.cells import (
    MOST_LISTED,
    NUM,
    VALUE,
    Cells,
    Frame,
    VaryingSizeError,
    error,
    finished,
    first_error,
    too_large,
)
from ..values.coerce import caught, numbers_of, truths_of

_GENERATOR = np.random.default_rng(1900)


def rand(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """RAND: a number in 0 to below 1 for every cell."""
    del ev, args, spread
    return Cells(_GENERATOR.random(frame.shape))


def randbetween(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """RANDBETWEEN: a whole number between two bounds, both included."""
    parts = [numbers_of(ev.value(arg, frame, spread), ev.texts) for arg in args]
    low, high = np.ceil(parts[0][0]), np.floor(parts[1][0])
    shape = np.broadcast_shapes(np.shape(low), np.shape(high), frame.shape)
    codes = np.where(low > high, np.uint8(NUM), np.uint8(0))
    return finished(
        np.floor(_GENERATOR.random(shape) * (high - low + 1)) + low, first_error(parts[0][1], parts[1][1], codes)
    )


def randarray(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """RANDARRAY(rows, columns, least, most, whole numbers)."""
    del spread
    if frame.rows > 1 or frame.cols > 1:
        raise VaryingSizeError
    found = []
    for place, default in enumerate((1.0, 1.0, 0.0, 1.0)):
        left_out = place >= len(args) or isinstance(args[place], Missing)
        found.append(default if left_out else one_number(ev, args[place], frame, spread=False))
    whole = len(args) > 4 and bool(np.all(truths_of(ev.value(args[4], frame), ev.texts)[0]))
    height, width, low, high = math.trunc(found[0]), math.trunc(found[1]), found[2], found[3]
    if height < 1 or width < 1 or low > high:
        return error(VALUE)
    if height * width > MOST_LISTED:
        raise too_large(height, width)
    numbers = _GENERATOR.random((height, width, 1, 1))
    return Cells(np.floor(numbers * (high - low + 1)) + low if whole else numbers * (high - low) + low)


KERNELS: dict[str, Any] = {"RAND": rand, "RANDBETWEEN": randbetween, "RANDARRAY": caught(randarray)}
