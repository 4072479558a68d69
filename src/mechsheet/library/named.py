"""Things by name, as the library gives them: a wrong name is told with the one that may be meant."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from livesheet.diagnostics import Fault
from livesheet.said import Said, say
from mechsheet.description.report import suggestion
from mechsheet.diagnostics import MechsheetError, quoted

Thing = TypeVar("Thing")


class UnknownNameError(MechsheetError, KeyError):
    """Nothing has this name."""

    def __str__(self) -> str:
        return "\n".join(str(fault) for fault in self.faults)


def unknown(name: object, known: Iterable[str], what: Said) -> UnknownNameError:
    """The error for a name; `what` heads the list of those that there are."""
    message = say("nothing is called {name}", name=quoted(str(name)))
    return UnknownNameError(Fault(message, hint=suggestion(str(name), known, what)))


class Named(dict[str, Thing]):
    """Things by name; printed one a line."""

    def __missing__(self, name: object) -> Thing:
        raise unknown(name, self, say("names"))

    def __str__(self) -> str:
        return "\n".join(
            f"{name} = {thing:.10g}" if isinstance(thing, float) else f"{name}{thing}" for name, thing in self.items()
        )
