"""Where a closed form is needed and a group has none: the same words everywhere."""

from __future__ import annotations

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.equations import Equations


def need_closed_form(equations: Equations, what: str, key: str = "", hint: str = "") -> None:
    """Raise MechanismError where a group is solved by Newton's method; `what` is not written then."""
    group = next((group for group in equations.groups if group.system is not None), None)
    if group is not None:
        message = say("{what}: {group} have no closed form, each row needs the row above", what=what, group=group.label)
        raise MechanismError(Fault(message, key=key, hint=hint))


def need_one_position(equations: Equations, what: str, key: str = "", hint: str = "") -> None:
    """As `need_closed_form`; the driver's value alone must also say where everything else that is driven stands."""
    need_closed_form(equations, what, key, hint)
    for listed in equations.listed:
        message = say(
            "{what}: the values of {symbol} are listed row by row, they do not follow from the driver",
            what=what,
            symbol=listed.symbol,
        )
        raise MechanismError(Fault(message, key=key, hint=hint))
