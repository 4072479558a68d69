"""Gathering faults while reading goes on, and the words that all messages share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, Final

from mechsheet.description.index import Path
from mechsheet.description.quoting import quoted
from mechsheet.description.source import Source
from mechsheet.diagnostics import Fault, near_miss
from mechsheet.formula.names import folded


class Bad(Enum):
    """Stands in the data where a fault has been reported, so that nothing is said about it a second time."""

    BAD = "bad"


BAD: Final = Bad.BAD


@dataclass(slots=True)
class Report:
    """The faults found so far in one source."""

    source: Source
    faults: list[Fault] = field(default_factory=list)

    def at(self, path: Path, message: str, hint: str = "") -> None:
        """Report a fault at `path`."""
        self.faults.append(self.source.fault(path, message, hint))

    def sound(self, *parts: str) -> bool:
        """True while no fault lies in these top-level tables."""
        return not any(fault.key.startswith(parts) for fault in self.faults)

    def in_order(self) -> list[Fault]:
        """All faults in the order of their lines, each once."""
        return sorted(dict.fromkeys(self.faults), key=lambda fault: fault.line or 0)


def suggestion(word: str, allowed: Iterable[str], what: str) -> str:
    """`did you mean "crank"? links: ground, crank, coupler, rocker`."""
    names = list(allowed)
    near = next((f'did you mean "{name}"?' for name in names if folded(name) == folded(word)), "")
    shown = ", ".join(names[:20]) + (", …" if len(names) > 20 else "")
    return " ".join(filter(None, (near or near_miss(word, names), f"{what}: {shown}" if names else f"{what}: none")))


def listed(names: Iterable[str], last: str = "and") -> str:
    """`"a", "b" and "c"`."""
    quoted = [f'"{name}"' for name in names]
    return f" {last} ".join(filter(None, (", ".join(quoted[:-1]), quoted[-1])))


def found(value: Any) -> str:
    """What a TOML value is, in words."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return f"{value:.12g}" if isinstance(value, float) or abs(value) < 1e15 else "a huge number"
    if isinstance(value, str):
        return f"the text {quoted(value)}"
    if isinstance(value, list):
        return f"a list of {len(value)}" if value else "an empty list"
    return "a table" if isinstance(value, dict) else "a date or time"
