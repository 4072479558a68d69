"""What quantities, links and groups are called."""

from __future__ import annotations

from collections.abc import Iterable

from livesheet.said import Words
from mechsheet.model import Label, Link, Mechanism

from .catalogue import Listed, Phrase, Term

NOTHING = Label("")

BLOCK = "block of "
"""How the massless block of a pin-slot joint is called, before the joint's symbol."""


def phrase(key: str, **parts: str | Words) -> Words:
    """What a quantity is called, with its parts in place."""
    return Phrase(f"equation.{key}", tuple(parts.items()))


def listed(names: Iterable[Words]) -> Words:
    """Names beside each other."""
    return Listed(tuple(names), " + ")


def several(names: Iterable[Words]) -> Words:
    """Names one after another."""
    return Listed(tuple(names), ", ")


def link_words(link: Link) -> Words:
    """A link: the label of the description, or the field's own word for a common name; another name stays as it is."""
    return link.label or Term("link", link.name)


def body_words(mechanism: Mechanism, name: str) -> Words:
    """A link, or the block of a pin-slot joint, by its name."""
    if name.startswith(BLOCK):
        return phrase("block", symbol=name.removeprefix(BLOCK))
    return next((link_words(link) for link in mechanism.links if link.name == name), Label(name))
