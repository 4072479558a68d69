"""What quantities, links and groups are called, in both languages."""

from __future__ import annotations

from collections.abc import Iterable

from mechsheet.model import Link, Mechanism, Words

from .catalogue import catalogue, words

NOTHING = Words("", "")

BLOCK = "block of "
"""How the massless block of a pin-slot joint is called, before the joint's symbol."""


def phrase(key: str, **parts: str | Words) -> Words:
    """The phrase with its parts in place, each in its own language where it has words of its own."""
    spelt = {name: part if isinstance(part, Words) else same(part) for name, part in parts.items()}
    return Words(
        words("en", f"equation.{key}").format(**{name: part.en for name, part in spelt.items()}),
        words("tr", f"equation.{key}").format(**{name: part.tr for name, part in spelt.items()}),
    )


def same(text: str) -> Words:
    """A text that is the same in both languages: a symbol, a name."""
    return Words(text, text)


def listed(names: Iterable[Words]) -> Words:
    """Names beside each other."""
    found = tuple(names)
    return Words(" + ".join(each.en for each in found), " + ".join(each.tr for each in found))


def several(names: Iterable[Words]) -> Words:
    """Names one after another."""
    found = tuple(names)
    return Words(", ".join(each.en for each in found), ", ".join(each.tr for each in found))


def link_words(link: Link) -> Words:
    """A link: the label of the description, or the field's own word for a common name; another name stays as it is."""
    return link.label or Words(link.name, catalogue("tr").pgettext("link", link.name))


def body_words(mechanism: Mechanism, name: str) -> Words:
    """A link, or the block of a pin-slot joint, by its name."""
    if name.startswith(BLOCK):
        return phrase("block", symbol=name.removeprefix(BLOCK))
    return next((link_words(link) for link in mechanism.links if link.name == name), same(name))
