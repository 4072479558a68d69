"""Every message about a description or a mechanism has its Turkish, with the same parts."""

import ast
import re
import string
from pathlib import Path

import pytest

from catalogues import texts
from livesheet.diagnostics import Fault
from livesheet.said import Said, say
from mechsheet.description import load, loads
from mechsheet.description.grammar import Either, Items, Kinds, Named, Table
from mechsheet.description.schema import DESCRIPTION, MEANT, REASONS
from mechsheet.diagnostics import MechsheetError
from mechsheet.words.catalogue import in_language

TURKISH = {english: turkish for english, turkish in texts("tr").items() if english not in texts("en")}

SOURCE = Path(__file__).parents[2] / "src" / "mechsheet"
FAULTY = sorted((Path(__file__).parents[1] / "errors").glob("*.toml"))


def said_in(path):
    """The literal patterns of a module's calls of `say` and nouns of `suggestion`."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) for alias in node.names}
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id in names & {"say", "say_count", "suggestion"}
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
    missing = [] if text.pattern in TURKISH or not text else [text.pattern]
    return missing + [each for part in text.parts.values() if isinstance(part, str) for each in unsaid(part)]


@pytest.mark.slow
def test_every_pattern_in_the_sources_has_its_turkish():
    patterns = {pattern for path in SOURCE.rglob("*.py") for pattern in said_in(path)}
    assert len(patterns) > 400
    assert sorted(patterns - TURKISH.keys()) == [""]


def test_what_messages_quote_of_the_schema_has_its_turkish():
    quoted = {*notes(DESCRIPTION), *(text for reason in REASONS.values() for text in reason), *MEANT.values()}
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


UNSAID = {"no table", "no position", "id,name"}
"""Of `homework.understanding`, which says why a workbook is none in words of its own; headings of a list."""

RAISED = re.compile(
    r"Fault|(Mechsheet|Description|Mechanism|Workbook|Formula|Output|Damaged|Unreadable|Unsupported)Error"
)
GATHERED = re.compile(r"(.*faults\.note|.*\.(fault|remark|damaged|unknown))")
"""How faults come into being: what is raised, and what gathers them."""

SENTENCE = re.compile(r"[a-z]{2,},? [a-z{(]")
"""What people read: no place, no path, no format."""


def plain_texts(node, assigned, seen=()):
    """Texts that an expression may be without having been said; `assigned`: what names of the function stand for."""
    if isinstance(node, ast.JoinedStr):
        yield "…".join(part.value if isinstance(part, ast.Constant) else "" for part in node.values)
    elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value:
        yield node.value
    elif isinstance(node, ast.IfExp | ast.BoolOp):
        for part in node.values if isinstance(node, ast.BoolOp) else (node.body, node.orelse):
            yield from plain_texts(part, assigned, seen)
    elif isinstance(node, ast.Name) and node.id not in seen:
        for value in assigned.get(node.id, ()):
            yield from plain_texts(value, assigned, (*seen, node.id))


def unsaid_faults(path):
    """What faults and notes of a module say or hint at in English only."""
    for function in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(function, ast.FunctionDef):
            continue
        assigned = {}
        for node in ast.walk(function):
            if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
                for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                    if isinstance(target, ast.Name):
                        assigned.setdefault(target.id, []).append(node.value)
        for node in ast.walk(function):
            match node:
                case ast.Call(func=ast.Name(name), args=given) if RAISED.fullmatch(name):
                    given = [*given[:1], *(each.value for each in node.keywords if each.arg in ("message", "hint"))]
                    texts = (text for each in given for text in plain_texts(each, assigned))
                    yield from texts
                case ast.Call(func=ast.Attribute() as called, args=given) if GATHERED.fullmatch(ast.unparse(called)):
                    texts = (text for each in given for text in plain_texts(each, assigned))
                    yield from filter(SENTENCE.search, texts)


@pytest.mark.slow
def test_every_fault_is_said():
    found = {(path.name, text) for path in SOURCE.rglob("*.py") for text in unsaid_faults(path)}
    assert {(name, text) for name, text in found if text not in UNSAID} == set()


TERMS = {
    "link": "uz[uv]", "joint": "mafsal", "crank": "krank", "rocker": "sarka", "slider": "kızak|kızağ",
    "gear": "dişli", "rack": "kremayer", "pinion": "pinyon", "velocit(?:y|ies)": "hız", "acceleration": "ivme",
    "cell": "hücre", "freedom": "serbestli", "workbook": "çalışma kita[bp]", "sheet": "sayfa",
    "driver": "tahrik", "assembly mode": "montaj biçim", "assembl(?:y|ies)": "montaj", "sketch": "eskiz",
    "dimension": "boyut", "mass(?:es)?": "kütle", "load": "yük", "force": "kuvvet", "torque": "moment",
    "ground": "sabit uz[uv]", "synthesis": "sentez",
    "tolerance": "tolerans", "output": "çıktı|çıkış", "template": "şablon",
}  # fmt: skip
"""English term -> its Turkish, one for each thing, as the text has it."""

NO_TERM = re.compile(
    r"^the link leads round.*|CELL\(|--\w+|`[^`]*`|\{[^}]*\}|\[[a-z.]+\]|\"[^\"]*\"|\w+ = "
    r"|angle\(.*\)|angle of (?:link|arm)|^no link$"
)
"""What is typed as it stands, a word that answers a question about one, and a link of another kind: of a disk."""


@pytest.mark.parametrize("term", TERMS)
def test_one_word_for_each_thing(term):
    said = {
        english: turkish
        for english, turkish in TURKISH.items()
        if re.search(rf"\b{term}s?\b", NO_TERM.sub(" ", english), re.IGNORECASE)
    }
    assert said
    assert {
        english: turkish for english, turkish in said.items() if not re.search(TERMS[term], turkish, re.IGNORECASE)
    } == {}
