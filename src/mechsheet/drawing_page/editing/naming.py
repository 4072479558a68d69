"""Names for what is drawn: points A, B and A0, B0 for those of the ground, links by numbers, dimensions by links."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import count

from livesheet.formula.names import folded
from mechsheet.description.parts import Parts
from mechsheet.description.scope import symbol_fault

LETTERS = "ABCDEFGHKLMNPQRSTUVW"


def free_point(parts: Parts, taken: Iterable[str], fixed: bool) -> str:
    """A name that no point has: A0 for a point of the ground, else A."""
    used = {folded(point) for link in parts.links for point in link.points} | {folded(name) for name in taken}
    return next(name for name in _points(fixed) if folded(name) not in used and not symbol_fault(name))


def _points(fixed: bool) -> Iterator[str]:
    yield from (f"{letter}0" if fixed else letter for letter in LETTERS)
    for number in count(1):
        yield from (f"{letter}{number}{0 if fixed else ''}" for letter in LETTERS)


def free_link(parts: Parts, stem: str) -> tuple[str, int]:
    """A name that no link has, `link4`, and the number that the next link gets."""
    number = max((link.number for link in parts.links), default=0) + 1
    used = {folded(link.name) for link in parts.links}
    return next(name for n in count(number) if folded(name := f"{stem}{n}") not in used), number


def free_symbol(parts: Parts, wanted: str) -> str:
    """A symbol that no dimension, angle, displacement or point has: the one that is wanted, or with a number behind it."""
    used = {folded(dim.symbol) for dim in parts.dimensions}
    used |= {folded(link.angle_symbol) for link in parts.links} | {folded(joint.symbol) for joint in parts.joints}
    names = (wanted if n == 1 else f"{wanted}_{n}" for n in count(1))
    return next(name for name in names if folded(name) not in used and not symbol_fault(name))
