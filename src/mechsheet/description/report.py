"""Gathering faults while reading goes on, those found later told at the same lines, and the words that all messages have."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, Final, Literal

from livesheet.diagnostics import Fault, near_miss
from livesheet.formula.names import folded
from livesheet.said import Said, say
from mechsheet.description.text.index import Path
from mechsheet.description.text.source import Source, parse
from mechsheet.diagnostics import MechanismError, quoted


class Bad(Enum):
    """Stands in the data where a fault has been reported, so that nothing is said about it a second time."""

    BAD = "bad"


BAD: Final = Bad.BAD


@dataclass(slots=True)
class Report:
    """The faults found so far in one source."""

    source: Source
    faults: list[Fault] = field(default_factory=list)

    def at(self, path: Path, message: Said, hint: str = "") -> None:
        """Report a fault at `path`; hints are said, too."""
        self.faults.append(self.source.fault(path, message, hint))

    def sound(self, *parts: str) -> bool:
        """True while no fault lies in these top-level tables."""
        return not any(fault.key.startswith(parts) for fault in self.faults)

    def in_order(self) -> list[Fault]:
        """All faults in the order of their lines, each once."""
        return sorted(dict.fromkeys(self.faults), key=lambda fault: fault.line or 0)


def suggestion(word: str, allowed: Iterable[str], what: str) -> Said:
    """`did you mean "crank"? links: ground, crank, coupler, rocker`."""
    names = list(allowed)
    near = next((say('did you mean "{name}"?', name=name) for name in names if folded(name) == folded(word)), say(""))
    near = near or near_miss(word, names)
    shown = ", ".join(names[:20]) + (", …" if len(names) > 20 else "")
    of = what if isinstance(what, Said) else say(what)
    list_of = say("{what}: {names}", what=of, names=shown) if names else say("{what}: none", what=of)
    return say("{near} {all}", near=near, all=list_of) if near else list_of


def within(text: str, name: str) -> str:
    """`in "a2 + x": `, before what is said of a name in a text; nothing where the name is the whole of it."""
    return "" if name == text.strip() else say("in {text}: ", text=quoted(text))


def listed(names: Iterable[str], last: Literal["and", "or"] = "and") -> str:
    """`"a", "b" and "c"`."""
    quoted = [f'"{name}"' for name in names]
    if len(quoted) < 2:
        return "".join(quoted)
    pattern = "{first} and {last}" if last == "and" else "{first} or {last}"
    return say(pattern, first=", ".join(quoted[:-1]), last=quoted[-1])


def alternatives(texts: Sequence[str], long: bool = False) -> str:
    """`a or b or c`; long ones that hold an `and` themselves are set apart by commas, too."""
    whole = texts[0]
    for text in texts[1:]:
        whole = say("{first}, or {last}" if long else "{first} or {last}", first=whole, last=text)
    return whole


def found(value: Any) -> str:
    """What a TOML value is, in words."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return f"{value:.12g}" if isinstance(value, float) or abs(value) < 1e15 else say("a huge number")
    if isinstance(value, str):
        return say("the text {text}", text=quoted(value))
    if isinstance(value, list):
        return say("a list of {count}", count=len(value)) if value else say("an empty list")
    return say("a table") if isinstance(value, dict) else say("a date or time")


def located(error: MechanismError, text: str, file: str) -> MechanismError:
    """The same error, each fault at the line of its key in the description `text`, called `file`."""
    source = parse(text, file)

    def place(fault: Fault) -> Fault:
        if fault.file or not fault.key:
            return fault
        path = tuple(int(part) if part.isdecimal() else part for part in fault.key.split("."))
        return source.fault(path, fault.message, fault.hint)

    return MechanismError(place(fault) for fault in error.faults)
