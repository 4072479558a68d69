"""A catalogue as translators write it (.po) as the one that `gettext` reads (.mo), in the formats of GNU gettext.

A wheel has compiled catalogues (`hatch_build.py`); those of a source tree are compiled when they are first read. It
imports nothing of the package, so that building needs nothing of it.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator

_LINE = re.compile(
    r'^(msgctxt|msgid_plural|msgid|msgstr)(?:\[\d\])? ("(?:[^"\\]|\\.)*"(?:\n"(?:[^"\\]|\\.)*")*)', re.MULTILINE
)
_SEAM = re.compile(r'"\n"')
_ESCAPE = re.compile(r"\\(.)")
_ESCAPED = {"n": "\n", "t": "\t"}

_MAGIC, _HEAD = 0x950412DE, 7 * 4
"""The first number of a compiled catalogue, and how many bytes its seven first numbers take."""


def entries(text: str) -> Iterator[tuple[str, str]]:
    """What is looked up and what it is in the language, plural forms behind each other with a zero character between.

    A context stands before what is looked up, with the character 4 between, as `gettext` asks for it. What a tool has
    guessed (`fuzzy`) and what has no text yet is left out.
    """
    for block in text.split("\n\n"):
        fields: dict[str, list[str]] = {}
        for kind, quoted in _LINE.findall(block):
            plain = _SEAM.sub("", quoted[1:-1]) if "\n" in quoted else quoted[1:-1]
            if "\\" in plain:
                plain = _ESCAPE.sub(lambda found: _ESCAPED.get(found[1], found[1]), plain)
            fields.setdefault(kind, []).append(plain)
        if "msgstr" not in fields or not all(fields["msgstr"]) or "\n#, fuzzy" in "\n" + block:
            continue
        key = "\0".join(fields["msgid"] + fields.get("msgid_plural", []))
        context = fields.get("msgctxt")
        yield f"{context[0]}\4{key}" if context else key, "\0".join(fields["msgstr"])


def compiled(text: str) -> bytes:
    """The bytes of a catalogue's .mo file."""
    pairs = sorted((key.encode(), said.encode()) for key, said in entries(text))
    sizes: list[list[int]] = []
    at = _HEAD + 16 * len(pairs)
    for column in zip(*pairs, strict=True):
        row = []
        for each in column:
            row += [len(each), at]
            at += len(each) + 1
        sizes.append(row)
    head = (_MAGIC, 0, len(pairs), _HEAD, _HEAD + 8 * len(pairs), 0, _HEAD + 16 * len(pairs))
    numbers = struct.pack(f"<{7 + 4 * len(pairs)}I", *head, *sizes[0], *sizes[1])
    return numbers + b"".join(each + b"\0" for column in zip(*pairs, strict=True) for each in column)
