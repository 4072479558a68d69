"""Packages that offer names out of their modules, and import a module when one of its names is first used (PEP 562)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from typing import Any


def listed(names: Iterable[str]) -> Callable[[], list[str]]:
    """The `__dir__` of a package: what it offers, and nothing that it needs for itself."""
    return lambda: sorted(names)


def names_of(package: str, homes: Mapping[str, str]) -> Callable[[str], Any]:
    """The `__getattr__` of a package: `homes` says which of its modules has a name."""

    def found(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(f"{package}.{homes[name]}"), name)

    return found
