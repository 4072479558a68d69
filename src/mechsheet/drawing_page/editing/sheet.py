"""The sheet that is drawn on: its text, where everything is shown, and what every kind of drawing writes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from mechsheet.description.parts import Parts, parts_of
from mechsheet.description.text.rewrite import number_text, with_last_key
from mechsheet.description.text.source import Source
from mechsheet.drawing_page.editing.naming import free_point
from mechsheet.drawing_page.editing.shaping import Drawn, digits_for, size_of, with_sketched
from mechsheet.drawing_page.positions import Point, Pose
from mechsheet.drawing_page.questions import Impossible, Refusal, point_in, text_in
from mechsheet.model import Link
from mechsheet.words.catalogue import Language, words


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

    @property
    def digits(self) -> int:
        """Decimals of a length that is drawn."""
        spans = [size_of(self.drawn.places), *(abs(part) for place in self.drawn.places.values() for part in place)]
        return min(digits_for(max(spans)), 9)


def rounded(value: float, digits: int) -> str:
    """A number as the description writes it."""
    return number_text(round(value, digits) + 0.0)


def end_of(sheet: Sheet, end: Any) -> tuple[str, Point, bool]:
    """(name, place, whether it is new) of what was clicked: a point that is there, or a place."""
    if not isinstance(end, dict):
        raise Refusal("an end is a table")
    if "point" in end:
        name = text_in(end, "point")
        if name not in sheet.drawn.places:
            raise Refusal(f'there is no point "{name}"')
        return name, sheet.drawn.places[name], False
    place = point_in(end, "at")
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
