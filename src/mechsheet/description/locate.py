"""Faults found after reading (mobility, a sketch between two modes) told with the description's file and line."""

from __future__ import annotations

from livesheet.diagnostics import Fault
from mechsheet.description.text.source import parse
from mechsheet.diagnostics import MechanismError


def located(error: MechanismError, text: str, file: str) -> MechanismError:
    """The same error, each fault at the line of its key in the description `text`, called `file`."""
    source = parse(text, file)

    def place(fault: Fault) -> Fault:
        if fault.file or not fault.key:
            return fault
        path = tuple(int(part) if part.isdecimal() else part for part in fault.key.split("."))
        return source.fault(path, fault.message, fault.hint)

    return MechanismError(place(fault) for fault in error.faults)
