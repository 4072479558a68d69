"""What cannot be written of a mechanism whose dimensions are found from a task."""

from __future__ import annotations

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.model import Mechanism


def refuse_synthesis(mechanism: Mechanism, what: str) -> None:
    """Raise MechanismError where dimensions are found from a task: functions take lengths, not tasks."""
    if mechanism.synthesis is not None:
        message = say("{what} take dimensions, and those of this mechanism are found by a synthesis", what=what)
        hint = say("give the dimensions as numbers (`show --dimensions` prints them); other exports have the synthesis")
        raise MechanismError(Fault(message, key="synthesis", hint=hint))
