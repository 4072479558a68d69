"""A language that nobody speaks, each text in brackets: what stands outside them comes from no catalogue."""

import re
import shutil
import subprocess
import sys
from dataclasses import replace

import openpyxl
import pytest

from catalogues import FOLDER, messages, texts
from folders import ROOT
from livesheet.formula.nodes import Text, walk
from livesheet.workbook import Rich
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechsheetError
from mechsheet.exporting import export
from mechsheet.words import catalogue
from mechsheet.words.catalogue import in_language

FORMS = 3
"""Plural forms of the language: for one thing, for few and for many, as Polish has them."""

HEAD = (
    'msgid ""\nmsgstr ""\n"Language: xx\\n"\n"Content-Type: text/plain; charset=utf-8\\n"\n'
    f'"Plural-Forms: nplurals={FORMS}; plural=n==1 ? 0 : n<5 ? 1 : 2;\\n"\n'
)
IN_BRACKETS, BEGUN, ENDED = re.compile("⟦[^⟦⟧]*⟧"), re.compile("⟦.*", re.DOTALL), re.compile(".*⟧", re.DOTALL)
WORD = re.compile(r"[^\W\d_]{3,}")
MARK = "mechsheet description, format 1"
FORMAL = ("number.", "letter.", "name.")
"""Keys of signs, and of names of cells, which are no texts."""

FUNCTIONS = "sin cos tan arcsin arccos arctan min max mod sign trunc rad mode rrr rrp rpr prp rpp "
"""What mathematics has, the symbol of an assembly, the kinds of dyads."""


def quoted(text):
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Catalogues of which one is made up."""
    made = tmp_path_factory.mktemp("catalogues")
    for path in FOLDER.glob("*.po"):
        shutil.copy(path, made)
    english = texts("en")
    entries = [HEAD]
    for one in messages("tr"):
        if one.pluralizable:
            first, many = one.id
            text = f"⟦{english.get(first, many)}⟧"
            form = "".join(f"msgstr[{number}] {quoted(text)}\n" for number in range(FORMS))
            entries.append(f"msgid {quoted(first)}\nmsgid_plural {quoted(many)}\n{form}")
            continue
        text = english.get(one.id, one.id)
        text = text if one.id.startswith(FORMAL) else f"⟦{text}⟧"
        context = f"msgctxt {quoted(one.context)}\n" if one.context else ""
        entries.append(f"{context}msgid {quoted(one.id)}\nmsgstr {quoted(text)}\n")
    (made / "xx.po").write_text("\n".join(entries), encoding="utf-8")
    return made


@pytest.fixture(autouse=True)
def made_up(folder, monkeypatch):
    monkeypatch.setattr(catalogue, "FOLDER", folder)
    catalogue.catalogue.cache_clear()
    yield
    catalogue.catalogue.cache_clear()


def outside(text):
    """What stands in no brackets; a text that code cuts in two has one of them in each part."""
    while (shorter := IN_BRACKETS.sub(" ", text)) != text:
        text = shorter
    return BEGUN.sub(" ", ENDED.sub(" ", text))


def vocabulary(mechanism):
    """The English words of the catalogues, without those that the description has itself."""
    known = {word for text in texts("en").values() for word in WORD.findall(text.lower())}
    own = repr(mechanism) + template_text(mechanism.name) + FUNCTIONS
    own += " ".join(text for key, text in texts("en").items() if key.startswith(FORMAL))
    return known - set(WORD.findall(own.lower()))


def spoken(name, layout="sheets"):
    return replace(loads(template_text(name)), language="xx", layout=layout)


def texts_of(workbook):
    """Every text of a workbook that a person may see."""
    for sheet in workbook.sheets:
        if any(cell.content == MARK for cell in sheet.cells):
            continue  # the description itself, for the program
        yield sheet.title
        for cell in sheet.cells:
            content = cell.content.plain if isinstance(cell.content, Rich) else cell.content
            if isinstance(content, str) and not content.startswith("="):
                yield content
        for fill in sheet.fills:
            yield from (part.value for part in walk(fill.formula) if isinstance(part, Text))
        yield from (comment.text for comment in sheet.comments)
        for rule in sheet.validations:
            yield from (rule.input_title, rule.input_message, rule.error_title, rule.error_message)
        for chart in sheet.charts:
            yield from (chart.title, chart.x_axis.title, chart.y_axis.title)


def texts_in(path):
    """The texts of an .xlsx that are no values of formulas, and the titles of its sheets."""
    found = []
    for sheet in openpyxl.load_workbook(path):
        values = [cell.value for row in sheet.iter_rows() for cell in row]
        if MARK not in values:
            found += [sheet.title, *(each for each in values if isinstance(each, str) and not each.startswith("="))]
    return found


@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("name", ["four-bar", "cam-valve", "shaper"])
def test_a_workbook_has_no_text_of_its_own(name, layout):
    mechanism = spoken(name, layout)
    english = vocabulary(mechanism)
    workbook = Compiled(mechanism).layout
    said = [text for text in texts_of(workbook) if text]
    assert sum("⟦" in text for text in said) > 50
    found = {text: left for text in said if (left := english.intersection(WORD.findall(outside(text).lower())))}
    assert found == {}, found


FAULTY = sorted((ROOT / "tests" / "errors").glob("*.toml"))[::10]


@pytest.mark.parametrize("path", FAULTY, ids=lambda path: path.stem)
def test_a_message_has_no_text_of_its_own(path):
    with pytest.raises(MechsheetError) as caught:
        load(path)
    for fault in caught.value.faults:
        told = in_language(fault, "xx")
        assert re.fullmatch("⟦.*⟧", told.message, re.DOTALL)
        assert re.fullmatch("(⟦.*⟧)?", told.hint, re.DOTALL)


@pytest.mark.parametrize("name", ["four-bar", "slider-crank"])
def test_a_written_solution_has_no_text_of_its_own(name, tmp_path):
    mechanism = spoken(name)
    (path, *_) = export(mechanism, "markdown", tmp_path / "made.md")
    lines = re.sub(r"\\\w+", " ", path.read_text(encoding="utf-8")).splitlines()
    assert sum("⟦" in line for line in lines) > 20
    english = vocabulary(mechanism)
    assert {line: left for line in lines if (left := english.intersection(WORD.findall(outside(line).lower())))} == {}


def test_the_drawing_page_has_its_words_in_every_language():
    page = catalogue.texts("xx", "draw.")
    assert len(page) > 100
    assert all(re.fullmatch("⟦.*⟧", text, re.DOTALL) for text in page.values())


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:Cannot parse header or footer")
def test_another_language_is_one_file(folder, tmp_path):
    """The program takes what it has a catalogue of, and speaks it."""
    shutil.copytree(ROOT / "src", tmp_path / "src", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(ROOT / "templates", tmp_path / "templates")
    shutil.copy(folder / "xx.po", tmp_path / "src" / "mechsheet" / "words" / "catalogues")
    code = "import sys; sys.path.insert(0, sys.argv.pop(1)); from mechsheet.cli import main; main()"
    shutil.copy(ROOT / "templates" / "shaper.toml", tmp_path)
    (tmp_path / "class.csv").write_text("id,name\n7,Ada\n", encoding="utf-8")
    for command in (["build", "shaper.toml"], ["exercise", "shaper.toml", "class.csv", "-o", "made"]):
        line = [sys.executable, "-c", code, str(tmp_path / "src"), *command, "--language", "xx"]
        done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, encoding="utf-8", check=False)
        assert done.returncode == 0, done.stderr
        assert command[0] == "exercise" or "⟦" in done.stderr
    english = vocabulary(spoken("shaper"))
    for path in (tmp_path / "shaper.xlsx", tmp_path / "made" / "student" / "7.xlsx"):
        said = texts_in(path)
        assert sum("⟦" in text for text in said) > 10
        found = {text: left for text in said if (left := english.intersection(WORD.findall(outside(text).lower())))}
        assert found == {}, found
