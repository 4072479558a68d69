"""The packages that studies need beside mechsheet's own: a clear message where one is missing."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from functools import cache
from importlib import import_module, metadata
from typing import Any

import numpy as np

from mechsheet.extras import missing_package
from mechsheet.version import __version__


def arrow() -> Any:
    """pyarrow, with its Parquet files. Raises MissingProgramError."""
    found = _package("pyarrow", "study")
    import_module("pyarrow.parquet")
    return found


def distributed() -> Any:
    """Dask's scheduler and client. Raises MissingProgramError."""
    return _package("distributed", "dask")


def sobol() -> Any:
    """SciPy's sequences of low discrepancy. Raises MissingProgramError."""
    return _package("scipy.stats", "study").qmc


def _package(name: str, extra: str) -> Any:
    try:
        return import_module(name)
    except ImportError as problem:
        raise missing_package(name.partition(".")[0], extra) from problem


def _release(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError as problem:
        raise missing_package(name, "study") from problem


@cache
def versions() -> dict[str, str]:
    """What decides the bytes of a result: releases, and how numpy computes on this processor."""
    packages = ("numpy", "scipy", "pyarrow")
    return {"mechsheet": __version__} | {name: _release(name) for name in packages} | {"arithmetic": arithmetic()}


def unlike(wanted: Mapping[str, str], found: Mapping[str, str]) -> str:
    """What `versions` found differ in from those wanted, for a message: "numpy 1.0 (here 2.1)"."""
    return ", ".join(
        f"{name} {found.get(name, '?')} (here {wanted[name]})" for name in wanted if found.get(name) != wanted[name]
    )


def arithmetic() -> str:
    """A digest of what numpy's elementary functions give on this machine.

    Their last bits hang on the processor, for they use its widest instructions: millions of designs want numpy's speed,
    where a workbook is computed by `portable`. A study is computed by machines that agree in this digest, and says its own.
    """
    x = np.linspace(-7.0, 7.0, 4_099)
    unit = np.linspace(-1.0, 1.0, 4_099)
    above = np.linspace(0.01, 9.0, 4_099)
    results = [np.sin(x), np.cos(x), np.tan(x), np.arctan(x), np.arctan2(unit, x), np.arcsin(unit), np.arccos(unit)]
    results += [np.exp(x), np.log(above), np.power(above, 1.7)]
    return hashlib.sha256(b"".join(each.tobytes() for each in results)).hexdigest()[:16]
