"""In which language the command line speaks, and that all it says is said."""

import ast

import pytest
import xlsxwriter

import command_line
from catalogues import texts
from folders import ROOT
from mechsheet.cli import speaking
from mechsheet.cli.speaking import language_of, machine_language

SOURCE = ROOT / "src" / "mechsheet" / "cli"
BOOK = ROOT / "generated" / "four-bar.xlsx"
SHORT = """format = 1
[mechanism]
name = "kisa"
[links.ground]
points = { A0 = [0, 0] }
[driver]
link = "krank"
[workbook]
language = "LANGUAGE"
"""


def run(*arguments, text=None, turkish=False):
    environment = {"LC_ALL": "tr_TR.UTF-8" if turkish else "C.UTF-8", "LANGUAGE": ""}
    return command_line.run(*arguments, text=text, environment=environment)


@pytest.mark.parametrize(
    ("environment", "language"),
    [
        ({"LANG": "tr_TR.UTF-8"}, "tr"),
        ({"LANG": "tr"}, "tr"),
        ({"LANG": "tr_TR.UTF-8", "LC_ALL": "en_GB.UTF-8"}, "en"),
        ({"LANG": "tr_TR.UTF-8", "LC_MESSAGES": "de_DE.UTF-8"}, "en"),
        ({"LANG": "en_GB.UTF-8", "LANGUAGE": "tr:en"}, "tr"),
        ({"LANG": "C.UTF-8", "LANGUAGE": "tr"}, "en"),  # as gettext has it
        ({"LANG": "trv_TW"}, "en"),  # Seediq
        ({"LANG": ""}, "en"),
        ({}, "en"),
    ],
)
def test_the_machine_speaks_what_other_programs_read(environment, language, monkeypatch):
    monkeypatch.setattr(speaking.sys, "platform", "linux")
    assert machine_language(environment) == language


@pytest.mark.parametrize(
    ("text", "language"),
    [
        ('[workbook]\nlanguage = "tr"', "tr"),
        ("workbook = { layout = 'page', language = 'tr' }", "tr"),
        ('[links\nlanguage = "en"', "en"),  # broken, and still plain
        ('# language = "tr"', ""),
        ("", ""),
    ],
)
def test_a_description_names_its_language_even_if_it_is_broken(text, language):
    assert language_of(text) == language


def test_faults_of_a_turkish_description_are_told_in_turkish():
    result = run("build", "-", text=SHORT.replace("LANGUAGE", "tr"))
    assert result.exit_code == 2
    assert '<stdin>:7: driver.link: "krank" adlı uzuv yok' in result.stderr


def test_the_option_comes_before_the_description():
    english = run("build", "-", "--language", "en", text=SHORT.replace("LANGUAGE", "tr")).stderr
    assert 'no link is called "krank"' in english
    assert "adlı uzuv yok" in run("build", "-", "--language", "tr", text=SHORT.replace("LANGUAGE", "en")).stderr


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (["recalc", "yok.xlsx"], "yok.xlsx: okunamıyor: böyle bir dosya ya da klasör yok"),
        (["recalc", "yok.xlsx", "--junit", "a.xml"], "--junit: yalnız --check ile"),
        (["recalc", BOOK, "--set", "a9=1"], '"a9" adlı hücre yok'),
        (["recalc", ROOT / "README.md"], "çalışma kitabı değil: bu bir zip dosyası değil"),
        (["build", "-o", "-", "four-bar.toml"], "çalışma kitabı bir dosyaya yazılır"),
        (["bild"], '"bild" adlı komut yok: "build" mi demek istediniz?'),
    ],
)
def test_a_turkish_machine_is_answered_in_turkish(line, said):
    result = run(*line, turkish=True)
    assert (result.exit_code, said in result.stderr) == (2, True), result.stderr
    assert said not in run(*line).stderr


def test_what_programs_read_is_the_same_everywhere(tmp_path):
    book = tmp_path / "note.xlsx"
    with xlsxwriter.Workbook(book) as file:
        file.add_worksheet("Plan").write_formula("A1", "=NOBODY(1)", None, 5)
    line = ["recalc", "--check", book, "--json"]
    english, turkish = run(*line), run(*line, turkish=True)
    assert "unknown function NOBODY" in english.stdout and english.stdout == turkish.stdout
    assert "not: Plan!A1: bilinmeyen fonksiyon NOBODY: kayıtlı değerler korunur" in turkish.stderr


def test_what_is_being_done_has_its_turkish():
    """`tell` takes plain texts, too: those of the library's progress."""
    for path in SOURCE.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            match node:
                case ast.Call(func=ast.Name("tell"), args=[ast.Constant(str(what))]):
                    assert what in texts("tr"), path.name
