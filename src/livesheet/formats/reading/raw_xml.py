"""XML whose bytes stay as they are but for a few places: what was parsed, position by position, and what replaces it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

TAG = re.compile(rb"<[^<>\"']*(?:(?:\"[^\"]*\"|'[^']*')[^<>\"']*)*>")
"""A start tag, or an end tag."""
_NAME = re.compile(rb"</?([^\s/>]+)")


class Span(NamedTuple):
    """An element as the parser reports it: where its start tag begins, and where its end tag does.

    What is reported as the end of an element without an end tag (`<c/>`) means nothing: see `RawXml.end`.
    """

    start: int
    last: int


class Edit(NamedTuple):
    """Bytes start..stop-1 are replaced by `new`."""

    start: int
    stop: int
    new: bytes


class RawXml:
    """The bytes of a part from some position on, as they come, and the edits that wait for them to pass on."""

    def __init__(self) -> None:
        self._bytes = bytearray()
        self._base = 0
        self._edits: list[Edit] = []

    def feed(self, piece: bytes) -> None:
        """Further bytes."""
        self._bytes += piece

    def cut(self, start: int, stop: int) -> bytes:
        """Bytes start..stop-1 of the part."""
        return bytes(self._bytes[start - self._base : stop - self._base])

    def end_of_tag(self, start: int) -> int:
        """Where the tag that begins at `start` has ended."""
        match = TAG.match(self._bytes, start - self._base)
        if match is None:
            raise ValueError(f"no tag at {start}")
        return match.end() + self._base

    def is_empty(self, span: Span) -> bool:
        """Whether an element has no end tag."""
        stop = self.end_of_tag(span.start)
        return self.cut(stop - 2, stop) == b"/>"

    def end(self, span: Span) -> int:
        """Where an element has ended."""
        return self.end_of_tag(span.start if self.is_empty(span) else span.last)

    def replace(self, edit: Edit) -> None:
        """Note an edit; edits come in the order of their places and do not touch."""
        self._edits.append(edit)

    def added(self, span: Span, new: bytes) -> Edit:
        """The edit that gives an element further content at its end."""
        if not self.is_empty(span):
            return Edit(span.last, span.last, new)
        stop = self.end_of_tag(span.start)
        tag = self.cut(span.start, stop)
        return Edit(span.start, stop, opened(tag) + new + end_tag(tag))

    def passed(self, position: int | None = None) -> bytes:
        """All bytes before `position` (None: all there are) with their edits; they are forgotten here."""
        if position is None:
            position = self._base + len(self._bytes)
        taken = edited(bytes(self._bytes[: position - self._base]), self._edits, self._base)
        self._edits.clear()
        del self._bytes[: position - self._base]
        self._base = position
        return taken


def edited(data: bytes, edits: Iterable[Edit], base: int = 0) -> bytes:
    """`data`, which begins at position `base`, with the edits."""
    pieces: list[bytes] = []
    done = 0
    for start, stop, new in edits:
        pieces += (data[done : start - base], new)
        done = stop - base
    pieces.append(data[done:])
    return b"".join(pieces)


def opened(tag: bytes) -> bytes:
    """The start tag of an element that has content."""
    return tag[:-2].rstrip() + b">" if tag.endswith(b"/>") else tag


def end_tag(tag: bytes) -> bytes:
    """The end tag that belongs to a start tag."""
    match = _NAME.match(tag)
    return b"</" + (match[1] if match else b"") + b">"


def attributes_named(*names: str) -> re.Pattern[bytes]:
    """The pattern of attributes of these names, each with the space before it."""
    wanted = b"|".join(re.escape(name.encode()) for name in names)
    return re.compile(rb"\s+(?:" + wanted + rb")\s*=\s*(?:\"[^\"]*\"|'[^']*')")


def with_attributes(tag: bytes, old: re.Pattern[bytes], text: str) -> bytes:
    """A start tag with attributes, given as ` a="1" b="2"`, in the place of those of the pattern `old`."""
    tag = old.sub(b"", tag)
    end = len(tag) - (2 if tag.endswith(b"/>") else 1)
    return tag[:end].rstrip() + text.encode() + tag[end:]
