"""Every bad description in tests/errors/ gives exactly the messages that stand beside it."""

from pathlib import Path

import pytest

from mechsheet.description import load, loads
from mechsheet.diagnostics import DescriptionError

FOLDER = Path(__file__).parents[1] / "errors"
CASES = sorted(path.stem for path in FOLDER.glob("*.toml"))


def test_folder_is_not_empty() -> None:
    assert len(CASES) >= 60
    assert sorted(path.stem for path in FOLDER.glob("*.txt")) == CASES


@pytest.mark.parametrize("case", CASES)
def test_messages(case: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(FOLDER)
    with pytest.raises(DescriptionError) as caught:
        load(f"{case}.toml")
    assert f"{caught.value}\n" == Path(f"{case}.txt").read_text(encoding="utf-8")


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(DescriptionError, match=r"no-such\.toml: there is no such file"):
        load(tmp_path / "no-such.toml")


def test_a_name_to_which_notepad_has_added_an_ending(tmp_path: Path) -> None:
    (tmp_path / "mine.toml.txt").write_text("format = 1", encoding="utf-8")
    with pytest.raises(DescriptionError, match=r"there is \S*mine\.toml\.txt: Notepad has added \.txt; rename it"):
        load(tmp_path / "mine.toml")


def test_directory(tmp_path: Path) -> None:
    with pytest.raises(DescriptionError, match="this is a directory"):
        load(tmp_path)


def test_path_with_null_character() -> None:
    with pytest.raises(DescriptionError, match="cannot be read"):
        load("a\0b.toml")


def test_huge_file(tmp_path: Path) -> None:
    path = tmp_path / "huge.toml"
    path.write_bytes(b"# " + b"x" * 1_000_000)
    with pytest.raises(DescriptionError, match="larger than 1,000,000 bytes"):
        load(path)
    with pytest.raises(DescriptionError, match="larger than 1,000,000 characters"):
        loads(" " * 1_000_001)


def test_lone_surrogate_in_a_text() -> None:
    with pytest.raises(DescriptionError, match="<text>:2: not Unicode text"):
        loads("format = 1\nx = '\ud800'\n")


def test_fault_fields() -> None:
    with pytest.raises(DescriptionError) as caught:
        load(FOLDER / "driver-link-unknown.toml")
    (fault,) = caught.value.faults
    assert (fault.line, fault.key, fault.source) == (18, "driver.link", 'link = "crnak"')
    assert fault.hint.startswith('did you mean "crank"?')
