"""The packages that studies need beside mechsheet's own: a clear message where one is missing."""

from __future__ import annotations

from importlib import import_module, metadata
from typing import Any

from mechsheet import __version__
from mechsheet.diagnostics import Fault, MissingProgramError


def arrow() -> Any:
    """pyarrow, with its Parquet files. Raises MissingProgramError."""
    found = _package("pyarrow", "study")
    import_module("pyarrow.parquet")
    return found


def distributed() -> Any:
    """Dask's scheduler and client. Raises MissingProgramError."""
    return _package("distributed", "dask")


def _package(name: str, extra: str) -> Any:
    try:
        return import_module(name)
    except ImportError as problem:
        hint = f"pip install 'mechsheet[{extra}]'"
        raise MissingProgramError(Fault(f"{name} is not installed", hint=hint, key=name)) from problem


def versions() -> dict[str, str]:
    """The releases that decide the bytes of a result."""
    packages = ("numpy", "scipy", "pyarrow")
    return {"mechsheet": __version__} | {name: metadata.version(name) for name in packages}
