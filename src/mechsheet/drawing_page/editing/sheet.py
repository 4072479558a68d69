"""The sheet that is drawn on: its text, where everything is shown, and what every kind of drawing writes.

Points are called A and B, those of the ground A0 and B0, links by numbers, dimensions by links. A line of TOML has a remark
behind it, which says what the value is in the language of the page.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import count
from typing import Any

from livesheet.formula.names import folded
from mechsheet.description.parts import Parts, parts_of
from mechsheet.description.scope import symbol_fault
from mechsheet.description.text.index import key_text
from mechsheet.description.text.rewrite import number_text, with_last_key, with_table
from mechsheet.description.text.source import Source
from mechsheet.drawing_page.editing.shaping import Drawn, digits_for, size_of, with_sketched
from mechsheet.drawing_page.positions import Point, Pose
from mechsheet.drawing_page.questions import Impossible, Refusal, end, point_in, text_in
from mechsheet.model import Link
from mechsheet.words.catalogue import Language, words

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


@dataclass(frozen=True, slots=True)
class Sheet:
    """What is drawn on: the text, what is readable of it, where everything is shown.

    language  of what is written;  mobility  degrees of freedom of what is drawn
    """

    source: Source
    parts: Parts
    drawn: Drawn
    language: Language = "en"
    mobility: int | None = None

    def again(self, source: Source, places: Mapping[str, Point]) -> Sheet:
        """The same after a change of the text."""
        return replace(self.with_places(places), source=source, parts=parts_of(source))

    def with_places(self, places: Mapping[str, Point]) -> Sheet:
        """The same with new points."""
        return replace(self, drawn=replace(self.drawn, places={**self.drawn.places, **places}))

    @property
    def link_stem(self) -> str:
        """New links are called by it, with a number."""
        return words(self.language, "name.link")

    @property
    def ground(self) -> Link:
        """The fixed link. Raises Refusal where there is none."""
        if not self.parts.links:
            raise Impossible("no_ground")
        return self.parts.links[0]

    def moving(self, name: str, impossible: str) -> Link:
        """The link of that name, which is not the ground. Raises Impossible, in the words of that key, where it is."""
        found = self.parts.link(name)
        if found is None or found is self.ground:
            raise Impossible(impossible)
        return found

    def with_entry(self, key: str, lines: list[str]) -> Sheet:
        """The same with one more table in a list of tables, [[loads]] for one."""
        listed = self.source.data.get(key)
        number = len(listed) if isinstance(listed, list) else 0
        return self.again(with_table(self.source, (key, number), lines), {})

    @property
    def digits(self) -> int:
        """Decimals of a length that is drawn."""
        spans = [size_of(self.drawn.places), *(abs(part) for place in self.drawn.places.values() for part in place)]
        return min(digits_for(max(spans)), 9)


def rounded(value: float, digits: int) -> str:
    """A number as the description writes it."""
    return number_text(round(value, digits) + 0.0)


def end_of(sheet: Sheet, clicked: Any) -> tuple[str, Point, bool]:
    """(name, place, whether it is new) of what was clicked: a point that is there, or a place."""
    given = end(clicked)
    if "point" in given:
        name = text_in(given, "point")
        if name not in sheet.drawn.places:
            raise Refusal(f'there is no point "{name}"')
        return name, sheet.drawn.places[name], False
    place = point_in(given, "at")
    return free_point(sheet.parts, sheet.drawn.places, fixed=False), place, True


def with_length(source: Source, symbol: str, length: str, label: str, unit: str = "") -> Source:
    """The text with a new dimension; `unit` is what stands behind its value."""
    return with_last_key(source, ("dimensions",), symbol, f'{{ value = {length}{unit}, label = "{label}" }}')


def sketched(sheet: Sheet, new: Mapping[str, Point]) -> Sheet:
    """New points stand in the sketch: it says where they were drawn, and how they are joined."""
    source = sheet.source
    for point, place in new.items():
        source = with_sketched(source, point, place, sheet.digits)
    return sheet.again(source, new)


def in_frame(place: Point, pose: Pose) -> Point:
    """A place of the plane in a link's frame."""
    dx, dy = place[0] - pose.x, place[1] - pose.y
    c, s = math.cos(pose.turn), math.sin(pose.turn)
    return dx * c + dy * s, dy * c - dx * s


WIDE = 26
"""Characters before a remark, so that those of one table stand below one another."""


def said(sheet: Sheet, key: str, **parts: str) -> str:
    """Words of the page in its language."""
    return words(sheet.language, f"draw.{key}", **parts)


def noted(sheet: Sheet, value: str, key: str, **parts: str) -> str:
    """A value with a remark behind it; `key`: what it is the value of, if that is written elsewhere."""
    note = said(sheet, f"insert.note.{key}", **parts)
    return f"{value:<{WIDE - len(key) - 3}}  # {note}"


def line(sheet: Sheet, key: str, value: str, **parts: str) -> str:
    """A line of TOML, `key = value`, with a remark behind it."""
    return f"{key} = {noted(sheet, value, key, **parts)}"


def quoted_key(name: str) -> str:
    """A name as a text of TOML."""
    text = key_text(name)
    return text if text.startswith(('"', "'")) else f'"{text}"'
