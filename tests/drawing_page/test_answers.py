"""The file on the disk, and what the page gets of a description."""

import zipfile
from io import BytesIO

import pytest

import mechsheet
from mechsheet.diagnostics import MechsheetError
from mechsheet.drawing_page.answers import Studio
from mechsheet.drawing_page.questions import Refusal
from mechsheet.words.catalogue import is_key

TEXT = mechsheet.template("four-bar").text


@pytest.mark.slow
def test_a_file_that_changed_on_the_disk_is_not_replaced_unasked(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(TEXT, encoding="utf-8")
    studio = Studio(path)
    mark = studio.answer("begin", {})["mark"]
    path.write_text("# by another program\n" + TEXT, encoding="utf-8")
    answer = studio.answer("save", {"text": "mine", "mark": mark})
    assert (answer["saved"], answer["changed"]) == (False, True)
    assert path.read_text(encoding="utf-8").startswith("# by another")
    answer = studio.answer("save", {"text": "mine", "mark": mark, "replace": True})
    assert answer["saved"]
    assert path.read_text(encoding="utf-8") == "mine"
    assert studio.answer("save", {"text": "mine 2", "mark": answer["mark"]})["saved"]


def test_a_file_that_is_there_is_not_overwritten_by_a_new_drawing(tmp_path):
    (tmp_path / "mine.toml").write_text("somebody's", encoding="utf-8")
    studio = Studio(None, tmp_path)
    assert not studio.answer("save", {"text": "new", "mark": "", "name": "mine"})["saved"]
    assert (tmp_path / "mine.toml").read_text(encoding="utf-8") == "somebody's"
    assert studio.answer("save", {"text": "new", "mark": "", "name": "other"})["file"].endswith("other.toml")


@pytest.mark.parametrize(
    "name",
    ["../mine", "a/b.toml", "/tmp/x.toml", "..", ".hidden", "a\\b", "C:mine", "con", "LPT1.toml", "what?", "mine."],
)
def test_a_name_is_never_a_path_nor_one_that_windows_keeps(tmp_path, name):
    folder = tmp_path / "inside"
    folder.mkdir()
    with pytest.raises(MechsheetError, match="is not the name of a file in this folder"):
        Studio(None, folder).answer("save", {"text": "x", "mark": "", "name": name})
    assert list(folder.iterdir()) == []
    assert list(tmp_path.iterdir()) == [folder]


@pytest.mark.slow
@pytest.mark.parametrize(
    "before", [b"\xef\xbb\xbfformat = 1\r\na = 1\r\n", b"format = 1\na = 1\n", b"format = 1\r\na = 1"]
)
def test_line_ends_and_a_byte_order_mark_come_back(tmp_path, before):
    path = tmp_path / "mine.toml"
    path.write_bytes(before)
    studio = Studio(path)
    begun = studio.answer("begin", {})
    assert "\r" not in begun["text"]
    studio.answer("save", {"text": begun["text"], "mark": begun["mark"]})
    assert path.read_bytes() == before


@pytest.mark.slow
def test_a_description_that_is_not_there_yet_begins_empty(tmp_path):
    begun = Studio(tmp_path / "press line.toml").answer("begin", {})
    assert begun["text"] == ""
    assert 'name = "pressline"' in begun["empty"]


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "begin"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("toml", b"#:schema")])
def test_pictures_and_the_text_are_given_away(kind, begin):
    assert Studio(None).answer("file", {"text": TEXT, "kind": kind, "at": 40}).startswith(begin)


@pytest.mark.slow
def test_a_workbook_is_that_of_build(tmp_path):
    """Byte for byte what the command line writes, in the language and the layout that were asked for."""
    path = tmp_path / "mine.toml"
    path.write_text(TEXT, encoding="utf-8")
    content = Studio(path).answer("file", {"text": TEXT, "kind": "xlsx", "layout": "page", "language": "tr"})
    (built,) = mechsheet.build(mechsheet.load(path, language="tr"), tmp_path / "mine.xlsx", layout="page")
    assert content == built.read_bytes()
    assert "Açılar" in zipfile.ZipFile(BytesIO(content)).read("xl/sharedStrings.xml").decode()


@pytest.mark.slow
def test_the_check_says_whether_the_workbook_is_right_and_by_whom():
    answer = Studio(None).answer("check", {"text": TEXT})
    assert answer["agrees"]
    assert answer["verdict"].startswith("closes in all 25 positions")
    assert {each["judge"]: each["agrees"] for each in answer["judges"]} == {
        "stored values": True,
        "reference": True,
        "search": True,
    }
    assert all(is_key(f"draw.check.by.{each['judge']}") for each in answer["judges"])


@pytest.mark.parametrize(
    ("question", "said"),
    [
        ({"kind": "exe"}, 'no kind of file is called "exe"'),
        ({"kind": "xlsx", "layout": "book"}, "no such language or layout"),
        ({"kind": "xlsx", "language": "de"}, "no such language or layout"),
    ],
)
def test_files_that_are_unknown_are_refused(question, said):
    with pytest.raises(Refusal, match=said):
        Studio(None).answer("file", {"text": TEXT, **question})


def test_a_file_of_what_cannot_be_solved_is_refused_with_its_line():
    with pytest.raises(MechsheetError) as told:
        Studio(None).answer("file", {"text": TEXT.replace("value = 62.3,", "value = 1,"), "kind": "xlsx"})
    assert told.value.faults[0].line


def test_faults_are_told_in_the_language_of_the_page():
    broken = TEXT.replace('link = "crank"', 'link = "crnk"', 1)
    studio = Studio()
    (english,), (turkish,) = (
        studio.answer("look", {"text": broken, "spoken": language})["faults"] for language in ("en", "tr")
    )
    assert english["message"] == 'no link is called "crnk"'
    assert turkish["message"] == '"crnk" adlı uzuv yok'
    assert turkish["hint"].startswith('"crank" mi demek istediniz? uzuvlar: ground, crank')
    assert turkish["line"] == english["line"]


def test_what_cannot_be_joined_is_told_in_turkish_with_the_links_in_turkish():
    apart = TEXT.replace("a1 = { value = 70,", "a1 = { value = 700,", 1)
    faults = Studio().answer("look", {"text": apart, "spoken": "tr"})["faults"]
    assert faults[0]["message"].startswith("uzuvlar tahrikin hiçbir değerinde birleşemiyor: ")
    assert "links" not in faults[0]["message"]
    assert faults[0]["links"] == ["coupler", "rocker"]


@pytest.mark.slow
def test_the_check_is_told_in_the_language_of_the_workbook(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(TEXT, encoding="utf-8")
    answer = Studio(path).answer("check", {"text": TEXT, "language": "tr", "spoken": "tr"})
    assert answer["verdict"].startswith("25 konumun hepsinde")


def test_a_length_may_have_its_unit():
    assert Studio(None).answer("length", {"text": TEXT, "value": "2 cm"}) == {"length": 20}
    with pytest.raises(MechsheetError, match="kg"):
        Studio(None).answer("length", {"text": TEXT, "value": "2 kg"})
