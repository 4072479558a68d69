"""The catalogues: complete, in order, and read as Babel reads them."""

import ast
import errno
import gettext
import os
import re
import runpy
import string
from functools import cache
from io import BytesIO

import pytest
from babel.messages.pofile import read_po

from catalogues import FOLDER, added, forms, texts
from folders import ROOT
from mechsheet.words.catalogue import words
from mechsheet.words.compiling import compiled

PATHS = sorted(FOLDER.glob("*.po"))
ordered = runpy.run_path(str(ROOT / "tools" / "catalogues.py"))["ordered"]
OTHERS = [path for path in PATHS if path.stem != "en"]


def holes(text):
    """The parts of a text and how they are written."""
    return {name for _, name, _, _ in string.Formatter().parse(text) if name}


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_gettext_reads_what_babel_reads(path):
    ours = gettext.GNUTranslations(BytesIO(compiled(path.read_text(encoding="utf-8"))))
    with path.open("rb") as file:
        theirs = read_po(file, locale=path.stem)
    assert len(theirs) > 1000
    for one in filter(lambda each: each.id and not each.pluralizable, theirs):
        found = ours.pgettext(one.context, one.id) if one.context else ours.gettext(one.id)
        assert found == one.string, one.id
    counting = [one for one in theirs if one.id and one.pluralizable]
    assert counting
    for one in counting:
        assert {ours.ngettext(*one.id, number) for number in (0, 1, 2, 25)} == set(one.string), one.id
    assert ours.info()["language"] == path.stem


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_entries_stand_in_order_each_text_in_one_line(path):
    head, *entries = path.read_text(encoding="utf-8").removesuffix("\n").split("\n\n")
    assert "Plural-Forms" in head
    for entry in entries:
        text = r'(msgctxt ".+"\n)?msgid ".+"\nmsgstr ".+"'
        assert re.fullmatch(text + r'|msgid ".+"\nmsgid_plural ".+"(\nmsgstr\[\d\] ".+")+', entry), entry
    assert ordered("\n\n".join([head, *entries])) == path.read_text(encoding="utf-8")
    ids = [re.split("\nmsg(?:str|id_plural)", entry)[0] for entry in entries]
    assert len(ids) == len(set(ids))


@pytest.mark.parametrize("path", OTHERS, ids=lambda path: path.stem)
def test_every_key_is_in_every_catalogue(path):
    assert sorted(texts("en").keys() - texts(path.stem).keys()) == []


@pytest.mark.parametrize("path", OTHERS, ids=lambda path: path.stem)
def test_a_text_has_the_parts_of_the_english_one(path):
    for key, english in texts("en").items():
        if key.startswith(("homework.", "study.", "draw.", "equation.", "step.")) or "{" in english:
            assert {frozenset(holes(form)) for form in forms(path.stem)[key]} == {frozenset(holes(english))}, key


OWNERS = (
    "homework.",
    "study.",
    "draw.",
    "equation.",
    "step.",
    "solution.",
    "notes.",
    "synthesis.",
    "draw.impossible.",
    "notes.assumptions.",
    "notes.use.",
)
"""What code puts before a key that it names."""

MADE = re.compile(r'"rad/s.*|a number of degrees|free length|expected .*s, found .*')
"""Messages that code puts together."""

SYSTEM = {os.strerror(number) for number in errno.errorcode}
"""What the system says of files."""


@cache
def code():
    """Every text in the sources; what texts with holes may become, keys and whole sentences."""
    plain, keys, sentences = set(), set(), set()
    for path in (ROOT / "src").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                plain.add(node.value)
            elif isinstance(node, ast.JoinedStr):
                parts = [part.value if isinstance(part, ast.Constant) else None for part in node.values]
                fixed = "".join(part or "" for part in parts)
                made = "".join(".+" if part is None else re.escape(part) for part in parts)
                if re.fullmatch(r"[\w.-]*[a-z]{2}[\w.-]*", fixed) and fixed not in OWNERS:
                    keys.add(made)
                elif len(fixed) > 12:
                    sentences.add(made)
    for path in (ROOT / "src" / "mechsheet" / "drawing_page" / "page").iterdir():
        text = path.read_text(encoding="utf-8")
        plain |= set(re.findall(r'"([^"\n]+)"', text))
        keys |= {re.sub(r"\\\$\\\{.*?\\\}", ".+", re.escape(one)) for one in re.findall(r"`([a-z_.]+\$[^`\n]+)`", text)}
    return plain, re.compile("|".join(sorted(keys))), re.compile("|".join(sorted(sentences)))


def used(key):
    plain, keys, sentences = code()
    if key not in texts("en"):
        return key in plain | SYSTEM or sentences.fullmatch(key) or MADE.fullmatch(key)
    names = [key, *(key.removeprefix(owner) for owner in OWNERS if key.startswith(owner))]
    return any(name in plain or keys.fullmatch(name) for name in names)


@pytest.mark.slow
def test_no_text_lies_about():
    """What no code asks for; keys that are put together are taken for used."""
    assert [key for key in texts("tr") if not used(key)] == []
    assert not used("a sentence that nobody says")


def test_a_key_without_a_text_is_an_error():
    with pytest.raises(KeyError):
        words("en", "verdict.of_nobody")


def test_another_language_without_a_text_says_it_in_english(tmp_path):
    """A catalogue that is not finished yet."""
    with added(tmp_path, "en", {"verdict.of_somebody": "{count} rows"}):
        assert words("tr", "verdict.of_somebody", count=3) == "3 rows"
