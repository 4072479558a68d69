"""Files that a class hands in are not trusted: whatever they hold, `audit` and `mark` end with words, not in a traceback."""

from __future__ import annotations

import io
import zipfile

import pytest
import xls_files as xls
from bad_files import BAD
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import command_line
import mechsheet
from chosen import ALL, first
from homework.handmade import FOUR_BAR, Table, four_bar

ROWS = [30.0 * n for n in range(13)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A description, and small tables of it in three formats."""
    found = tmp_path_factory.mktemp("hostile")
    (found / "m.toml").write_text(mechsheet.template("four-bar").text, encoding="utf-8")
    columns = four_bar()
    columns[0] = (*columns[0][:2], ROWS)
    Table(FOUR_BAR, columns).save(found / "table.xlsx")
    mechsheet.build(mechsheet.template("four-bar"), found / "table.ods", layout="page")
    cells = b"".join(
        xls.number(row, 0, value)
        + xls.formula(row, 1, xls.cell(0, 0) + xls.cell(0, 3, rows=False, columns=False) + b"\5")
        for row, value in enumerate(ROWS)
    )
    (found / "table.xls").write_bytes(xls.stream(("S", xls.number(0, 3, 35.0) + cells)))
    return found


def run(*args):
    result = command_line.run(*args)
    assert "Traceback" not in result.output
    return result


@pytest.mark.parametrize("name", first(list(BAD), 6))
def test_a_bad_file_is_told_and_the_others_are_marked(folder, tmp_path, name):
    bad = tmp_path / f"bad{BAD[name].suffix}"
    bad.write_bytes(BAD[name].make())
    for options in (("--against", folder / "m.toml"), ()):
        result = run("audit", bad, *options)
        assert result.exit_code == 2
        assert bad.name in result.stderr
    result = run("mark", bad, folder / "table.xlsx", "--against", folder / "m.toml", "--json")
    if bad.suffix == ".csv":  # a file of another kind was meant for something else: nothing is marked
        assert result.exit_code == 2
        assert "bad.csv: is no workbook" in result.stderr
        return
    assert result.exit_code == 0
    assert '"mark": 3.0' in result.output
    assert "bad" in result.output


def rezipped(data, change):
    """An archive with one of its XML parts changed."""
    with zipfile.ZipFile(io.BytesIO(data)) as old:
        parts = {name: old.read(name) for name in old.namelist()}
    names = sorted(name for name in parts if name.endswith(".xml"))
    number, edit = change
    parts[names[number % len(names)]] = edit(parts[names[number % len(names)]])
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as new:
        for name, content in parts.items():
            new.writestr(name, content)
    return stream.getvalue()


def flipped(data, edits):
    """Bytes with some of them changed, taken out or doubled."""
    found = bytearray(data)
    for place, value, how in edits:
        at = place % max(len(found), 1)
        if how == 0:
            found[at : at + 1] = bytes([value])
        elif how == 1:
            del found[at : at + 1 + value % 7]
        else:
            found[at:at] = found[at : at + 1 + value % 40]
    return bytes(found)


EDITS = st.lists(st.tuples(st.integers(0, 1 << 20), st.integers(0, 255), st.integers(0, 2)), min_size=1, max_size=4)


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["xlsx", "ods", "xls"])
@settings(max_examples=60 if ALL else 6, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(edits=EDITS, part=st.integers(0, 20), whole=st.booleans())
def test_bytes_flipped_in_a_good_file(folder, tmp_path, suffix, edits, part, whole):
    """In the archive as a whole (then it is cut off, or a sum is wrong), or inside of one of its parts."""
    data = (folder / f"table.{suffix}").read_bytes()
    if whole or suffix == "xls":
        data = flipped(data, edits)
    else:
        data = rezipped(data, (part, lambda content: flipped(content, edits)))
    path = tmp_path / f"flipped.{suffix}"
    path.write_bytes(data)
    result = run("audit", path, "--against", folder / "m.toml")
    assert result.exit_code in (0, 1, 2)
    assert result.exit_code != 2 or "flipped" in result.stderr
    marked = run("mark", path, "--against", folder / "m.toml")
    assert marked.exit_code == 0
    assert ("cannot be" in marked.output) is (result.exit_code == 2)
