"""What links are called in words: the label of the description, or the field's own word for a common name."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, count

from mechsheet.formula.names import folded
from mechsheet.model import Link, Mechanism, Words

TERMS = {
    "arm": "kol",
    "block": "kızak",
    "coupler": "biyel",
    "crank": "krank",
    "frame": "gövde",
    "ground": "sabit uzuv",
    "input": "giriş uzvu",
    "lever": "kol",
    "output": "çıkış uzvu",
    "piston": "piston",
    "plunger": "piston",
    "ram": "koç",
    "rocker": "sarkaç",
    "rod": "biyel",
    "slider": "kızak",
}
"""English name of a link -> the Turkish one."""

BLOCK = "block of "
"""How the massless block of a pin-slot joint is called, before the joint's symbol."""


def link_words(link: Link) -> Words:
    """A link in both languages. A name that is no common one stays as it is."""
    return link.label or Words(link.name, TERMS.get(link.name, link.name))


def body_words(mechanism: Mechanism, name: str) -> Words:
    """A link, or the block of a pin-slot joint, by its name."""
    if name.startswith(BLOCK):
        symbol = name.removeprefix(BLOCK)
        return Words(name, f"{symbol} bloğu")
    return next((link_words(link) for link in mechanism.links if link.name == name), Words(name, name))


def given_names(mechanism: Mechanism) -> list[str]:
    """Every name that the description gives to a quantity."""
    return [
        *(dimension.symbol for dimension in mechanism.dimensions),
        *(output.symbol for output in mechanism.outputs),
        *(summary.symbol for summary in mechanism.summaries),
        *(link.angle_symbol for link in mechanism.links),
        *(joint.symbol for joint in mechanism.joints),
        mechanism.driver.symbol,
    ]


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
