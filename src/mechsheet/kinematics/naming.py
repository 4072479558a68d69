"""Names of quantities and of bodies: those that the description gives, and new ones beside them."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, count

from livesheet.formula.names import folded
from mechsheet.model import Mechanism


def given_names(mechanism: Mechanism) -> list[str]:
    """Every name that the description gives to a quantity."""
    return [
        *(dimension.symbol for dimension in mechanism.dimensions),
        *(output.symbol for output in mechanism.outputs),
        *(each.symbol for each in mechanism.motion_numbers),
        *(link.angle_symbol for link in mechanism.links),
        *(joint.symbol for joint in mechanism.joints),
        *mechanism.driven_symbols,
        *(name for name in mechanism.given_by_row if name not in mechanism.driven_symbols),
        *_rates(mechanism),
        *(mechanism.cam.symbols if mechanism.cam else ()),
    ]


def _rates(mechanism: Mechanism) -> tuple[str, ...]:
    """The names of angular velocities and accelerations, where there are any."""
    if mechanism.driver.speed is None:
        return ()
    return tuple(name for link in mechanism.links for name in link.rate_symbols)


def without_group(symbol: str, group: int) -> str:
    """The symbol without the number of its group: what `FreshNames.reserve` made it from."""
    return symbol.removesuffix(f"_{group}") if group > 1 else symbol


class FreshNames:
    """Names for quantities that no description gave one."""

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = {folded(name) for name in taken}

    def reserve(self, base: str, group: int) -> str:
        """A name like `base` that nothing else has: `phi`, in the second group `phi_2`."""
        group = max(group, 1)
        first = [base, f"{base}_1"] if group == 1 else [f"{base}_{group}"]
        further = (f"{base}_{group}_{number}" for number in count(2))
        name = next(name for name in chain(first, further) if folded(name) not in self._taken)
        self._taken.add(folded(name))
        return name
