"""Every message about a description or a mechanism has its Turkish, with the same parts."""

import ast
import string
from pathlib import Path

import pytest

from mechsheet.description import load, loads
from mechsheet.description.grammar import Either, Items, Kinds, Named, Table
from mechsheet.description.schema import DESCRIPTION, REASONS
from mechsheet.diagnostics import Fault, MechsheetError
from mechsheet.said import Said, say
from mechsheet.words.messages import TURKISH, in_language

SOURCE = Path(__file__).parents[3] / "src" / "mechsheet"
FAULTY = sorted((Path(__file__).parents[2] / "errors").glob("*.toml"))


def said_in(path):
    """The literal patterns of a module's calls of `say` and nouns of `suggestion`."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) for alias in node.names}
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id in names & {"say", "suggestion"}
        ):
            given = node.args[2] if node.func.id == "suggestion" else node.args[0]
            chosen = [given.body, given.orelse] if isinstance(given, ast.IfExp) else [given]
            yield from (each.value for each in chosen if isinstance(each, ast.Constant))


def notes(shape):
    """What messages quote of the schema: the notes of keys that must be there and of lists, and what names stand for."""
    match shape:
        case Table(keys):
            for key in keys.values():
                yield from [key.note] if key.required else []
                yield from notes(key.shape)
        case Kinds(_, tables):
            for table in tables.values():
                yield from notes(table)
        case Named(item, what, least, _, keys):
            yield from [what] if least else []
            yield from notes(item)
            for key in keys.values():
                yield from notes(key.shape)
        case Items(item, _, _, note):
            yield from [note] if note else []
            yield from notes(item)
        case Either(shapes):
            for one in shapes:
                yield from notes(one)


def fields(pattern):
    """The parts of a pattern and how they are written."""
    return {(name, spec) for _, name, spec, _ in string.Formatter().parse(pattern) if name}


def unsaid(text):
    """What of a text has no Turkish: parts, too."""
    if not isinstance(text, Said):
        return []
    missing = [] if text.pattern in TURKISH else [text.pattern]
    return missing + [each for part in text.parts.values() if isinstance(part, str) for each in unsaid(part)]


def test_every_pattern_in_the_sources_has_its_turkish():
    patterns = {pattern for path in SOURCE.rglob("*.py") for pattern in said_in(path)}
    assert len(patterns) > 400
    assert sorted(patterns - TURKISH.keys()) == []


def test_what_messages_quote_of_the_schema_has_its_turkish():
    quoted = {*notes(DESCRIPTION), *(text for reason in REASONS.values() for text in reason)}
    assert "rigid links; the first is the ground" in quoted
    assert sorted(quoted - TURKISH.keys()) == []


@pytest.mark.parametrize("english", [pattern for pattern in TURKISH if "{" in pattern and "{ en" not in pattern])
def test_the_turkish_has_parts_of_the_english_only(english):
    if any(f"{{{sign}" in english for sign in (" ", "…")):
        return  # braces of TOML: a pattern without parts
    assert fields(TURKISH[english]) <= fields(english)


@pytest.mark.parametrize("path", FAULTY, ids=lambda path: path.stem)
def test_faults_of_a_description_are_told_in_turkish(path, monkeypatch):
    monkeypatch.chdir(path.parent)
    with pytest.raises(MechsheetError) as caught:
        load(path.name)
    for fault in caught.value.faults:
        assert isinstance(fault.message, Said)
        assert not fault.hint or isinstance(fault.hint, Said)
        assert unsaid(fault.message) == unsaid(fault.hint) == []
        told = in_language(fault, "tr")
        assert (told.line, told.key) == (fault.line, fault.key)
        assert in_language(fault, "en") == fault


def test_parts_are_told_in_turkish_too():
    with pytest.raises(MechsheetError) as caught:
        loads("format = 1\n[mechanism]\nname = 5\n")
    told = [str(in_language(fault, "tr")) for fault in caught.value.faults]
    assert any("tırnak içinde bir metin beklenir, bulunan: 5" in text for text in told)


def test_a_text_that_was_not_said_stays():
    fault = Fault("of another program", hint=say("take it away"))
    assert in_language(fault, "tr") == Fault("of another program", hint="kaldırın")
