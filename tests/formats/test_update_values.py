"""Workbooks written back with other values: those cells change, and not one other byte."""

from __future__ import annotations

import io
import sys
import zipfile
from pathlib import Path

import openpyxl
import pytest
import xlsxwriter
from ods_files import cell, content, number, row, table, text, write_ods
from openpyxl.comments import Comment
from openpyxl.worksheet.datavalidation import DataValidation
from samples import sample

from folders import TEMPLATES
from livesheet.diagnostics import OutputError, WorkbookError
from livesheet.formats import read, write
from livesheet.formula.nodes import ErrorValue
from mechsheet.checking import check
from mechsheet.description import load
from mechsheet.library.recalculation import recalc

FORMATS = ("xlsx", "ods")


def parts(path):
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return {info.filename: archive.read(info) for info in archive.infolist()}


def changed_parts(source, output):
    old, new = parts(source), parts(output)
    assert list(old) == list(new)
    return [name for name in old if old[name] != new[name]]


def raw(path):
    """Of each entry: what the directory says, and the packed bytes."""
    data, found = path.read_bytes(), {}
    with zipfile.ZipFile(path) as archive:
        for info in archive.infolist():
            start = info.header_offset + 30 + sum(data[info.header_offset + at] for at in (26, 28))
            about = (
                info.date_time,
                info.compress_type,
                info.external_attr,
                info.create_system,
                info.extra,
                info.comment,
            )
            found[info.filename] = (about, data[start : start + info.compress_size])
    return found


def updated(source, output, settings=None):
    result = recalc(source, settings)
    result.write(output)
    return read(output)


def built(name, folder):
    from mechsheet.library.building import build

    return {path.suffix[1:]: path for path in build(load(TEMPLATES / f"{name}.toml"), folder, FORMATS)}


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory):
    return built("four-bar", tmp_path_factory.mktemp("four-bar"))


@pytest.fixture(scope="module")
def yoke(tmp_path_factory):
    """The smallest of the templates."""
    return built("scotch-yoke", tmp_path_factory.mktemp("yoke"))


@pytest.mark.parametrize("suffix", FORMATS)
class TestOurOwn:
    @pytest.mark.cases(1)
    @pytest.mark.slow
    def test_without_a_change_every_part_is_the_same(self, suffix, four_bar, tmp_path):
        for path in (four_bar[suffix], tmp_path / f"sample.{suffix}"):
            if not path.exists():
                write(sample(), path)
            output = tmp_path / f"out.{suffix}"
            recalc(path).write(output)
            assert changed_parts(path, output) == []

    @pytest.mark.cases(1)
    @pytest.mark.slow
    def test_what_is_not_touched_is_copied_as_it_is_packed(self, suffix, yoke, tmp_path):
        output = tmp_path / f"out.{suffix}"
        updated(yoke[suffix], output, {"a_2": 51.5})
        old, new = raw(yoke[suffix]), raw(output)
        changed = changed_parts(yoke[suffix], output)
        assert all("sheet" in name or name == "content.xml" for name in changed)
        for name in old:
            assert old[name][0] == new[name][0], name
            assert name in changed or old[name][1] == new[name][1], name

    @pytest.mark.cases(1)
    @pytest.mark.slow
    def test_the_new_values_are_right(self, suffix, yoke, tmp_path):
        output = tmp_path / f"out.{suffix}"
        updated(yoke[suffix], output, {"a_2": 51.5})
        report = check(output)
        assert report.agrees
        assert report.comparisons[0].worst == 0
        assert report.remarks == ("a2 is 51.5, was 50",)

    @pytest.mark.cases(1)
    @pytest.mark.slow
    def test_back_again(self, suffix, four_bar, tmp_path):
        there, back = tmp_path / f"there.{suffix}", tmp_path / f"back.{suffix}"
        updated(four_bar[suffix], there, {"a_1": 200})  # nothing can be joined: #N/A in most cells
        assert ErrorValue("#N/A") in {value for *_, value in read(there).sheets[1].cached.items()}
        updated(there, back, {"a_1": 70})
        first, last = read(four_bar[suffix]), read(back)
        for mine, theirs in zip(last.sheets, first.sheets, strict=True):
            assert list(mine.cached.items()) == list(theirs.cached.items())
            assert list(mine.constants.items()) == list(theirs.constants.items())
            assert mine.blocks == theirs.blocks

    @pytest.mark.slow
    def test_in_its_own_place(self, suffix, yoke, tmp_path, monkeypatch):
        replace = Path.replace

        def as_on_windows(source, target):
            """A file that is open is not replaced."""
            ours = [held.resolve() for held in Path("/proc/self/fd").iterdir()] if sys.platform == "linux" else []
            assert Path(target).resolve() not in ours
            return replace(source, target)

        monkeypatch.setattr(Path, "replace", as_on_windows)
        path = tmp_path / f"own.{suffix}"
        path.write_bytes(yoke[suffix].read_bytes())
        updated(path, path, {"a_2": 51.5})
        assert check(path).agrees
        assert [left.name for left in tmp_path.iterdir()] == [path.name]

    @pytest.mark.slow
    def test_cells_that_had_no_element(self, suffix, yoke, tmp_path):
        settings = {"Mechanism!ZZ3": 5.0, "Mechanism!B3000": "a < b", "mechanism!A3000": 1, "Checks!G1": -1e-9}
        book = updated(yoke[suffix], tmp_path / f"out.{suffix}", settings)
        first, checks = book.sheets[0], book.sheet("Checks")
        assert first.constants.get(2, 701) == 5.0
        assert (first.constants.get(2999, 0), first.constants.get(2999, 1)) == (1.0, "a < b")
        assert checks.constants.get(0, 6) == -1e-9

    @pytest.mark.slow
    def test_another_format_is_refused(self, suffix, yoke, tmp_path):
        other = "ods" if suffix == "xlsx" else "xlsx"
        with pytest.raises(OutputError, match=f"is written as .{suffix}"):
            recalc(yoke[suffix]).write(tmp_path / f"out.{other}")


class TestXlsx:
    @pytest.mark.slow
    @pytest.mark.filterwarnings("ignore:Cannot parse header or footer")
    def test_what_openpyxl_reads(self, yoke, tmp_path):
        output = tmp_path / "out.xlsx"
        result = recalc(yoke["xlsx"], {"a_2": 51.5})
        result.write(output)
        book, before = openpyxl.load_workbook(output, data_only=True), openpyxl.load_workbook(yoke["xlsx"])
        assert book["Mechanism"]["B6"].value is not None
        for title in ("Mechanism", "Positions", "Checks"):
            for cells in book[title].iter_rows():
                for found in cells:
                    mine = result.get(title, found.row - 1, found.column - 1)
                    if isinstance(mine, float):
                        assert found.value == pytest.approx(mine, rel=1e-14), (title, found.coordinate)
                    elif isinstance(mine, ErrorValue):
                        assert found.value == str(mine)
        formulas = openpyxl.load_workbook(output)
        for sheet in before:
            assert len(formulas[sheet.title]._charts) == len(sheet._charts)
            assert [[c.value for c in cells] for cells in sheet.iter_rows() if cells[0].row > 60] == [
                [c.value for c in cells] for cells in formulas[sheet.title].iter_rows() if cells[0].row > 60
            ]

    def test_a_file_of_openpyxl(self, tmp_path):
        """Formula cells without values, inline texts, comments, and parts that nobody knows."""
        book = openpyxl.Workbook()
        sheet = book.active
        sheet.append([3, "=A1*2", '=IF(A1>2,"big  "," small <&>")', "=A1>2", "=1/(A1-3)", "=C1&D1"])
        sheet["A1"].comment = Comment("typed", "somebody")
        sheet.add_data_validation(DataValidation(type="whole", sqref="A1", formula1="1", formula2="9"))
        plain = tmp_path / "plain.xlsx"
        book.save(plain)
        source = tmp_path / "source.xlsx"
        with zipfile.ZipFile(plain) as old, zipfile.ZipFile(Pipe(source), "w", zipfile.ZIP_DEFLATED) as new:
            for name in old.namelist():
                new.writestr(name, old.read(name))  # into a pipe: sizes come behind the data
            new.writestr("custom/ünbekannt.bin", bytes(range(256)) * 9, compress_type=zipfile.ZIP_STORED)
            new.comment = b"made by hand"
        output = tmp_path / "out.xlsx"
        updated(source, output)
        assert changed_parts(source, output) == ["xl/worksheets/sheet1.xml"]
        with zipfile.ZipFile(output) as archive:
            assert archive.comment == b"made by hand"
        found = openpyxl.load_workbook(output, data_only=True).active
        assert [c.value for c in found[1]] == [3, 6, "big  ", True, "#DIV/0!", "big  TRUE"]
        assert found["A1"].comment.text == "typed"

        updated(output, source, {"Sheet!A1": 1})
        found = openpyxl.load_workbook(source, data_only=True).active
        assert [c.value for c in found[1]] == [1, 2, " small <&>", False, -0.5, " small <&>FALSE"]

    def test_a_text_typed_into_a_number_s_cell(self, tmp_path):
        book = openpyxl.Workbook()
        book.active.append([3, "=ISNUMBER(A1)"])
        book.active["A2"] = "a shared text"
        book.save(tmp_path / "a.xlsx")
        updated(tmp_path / "a.xlsx", tmp_path / "b.xlsx", {"Sheet!A1": "'x_0041_", "Sheet!A2": 4})
        found = openpyxl.load_workbook(tmp_path / "b.xlsx", data_only=True).active
        assert read(tmp_path / "b.xlsx").sheets[0].constants.get(0, 0) == "x_0041_"
        assert (found["B1"].value, found["A2"].value) == (False, 4)

    @pytest.mark.slow
    def test_another_encoding_is_refused(self, yoke, tmp_path):
        source = tmp_path / "a.xlsx"
        with zipfile.ZipFile(yoke["xlsx"]) as old, zipfile.ZipFile(source, "w") as new:
            for name in old.namelist():
                data = old.read(name)
                if name.endswith("sheet1.xml"):
                    data = data.decode().replace('encoding="UTF-8"', 'encoding="UTF-16"').encode("utf-16")
                new.writestr(name, data)
        with pytest.raises(WorkbookError, match="UTF-16"):
            recalc(source).write(tmp_path / "b.xlsx")
        assert not (tmp_path / "b.xlsx").exists()


class Pipe(io.RawIOBase):
    """A file that cannot be gone back in."""

    def __init__(self, path):
        self.path, self.data = path, b""

    def writable(self):
        return True

    def write(self, data):
        self.data += bytes(data)
        return len(data)

    def flush(self):
        self.path.write_bytes(self.data)


class TestOds:
    """Of files as other programs write them."""

    def updated(self, tmp_path, rows, settings=None, after=""):
        source = write_ods(tmp_path / "a.ods", content(table(rows + after)))
        book = updated(source, tmp_path / "b.ods", settings)
        return book, parts(tmp_path / "b.ods")["content.xml"].decode()

    def test_a_number_keeps_what_kind_of_number_it_is(self, tmp_path):
        def result(kind, value, shown, formula):
            name = {"date": "date-value", "time": "time-value"}.get(kind, "value")
            attributes = f'table:formula="of:={formula}" office:value-type="{kind}" office:{name}="{value}"'
            return cell(f'{attributes} calcext:value-type="{kind}"', f"<text:p>{shown}</text:p>")

        rows = row(
            number(2),
            result("percentage", 0.5, "50.00%", "[.A1]/8"),
            result("currency", 1, "1,5", "[.A1]*3"),
            result("date", "2024-01-01", "1.1.24", "45351+[.A1]/4"),
            result("time", "PT1H", "1:00", "[.A1]/24"),
            result("float", 1, "irgendwas", "[.A1]/3"),
            result("float", 1, "-3.25", "[.A1]/-3"),
        )
        book, xml = self.updated(tmp_path, rows)
        assert [book.sheets[0].cached.get(0, col) for col in range(1, 7)] == [0.25, 6.0, 45351.5, 2 / 24, 2 / 3, -2 / 3]
        assert 'office:value-type="percentage" office:value="0.25"><text:p>25.00%</text:p>' in xml
        assert 'office:value-type="currency" office:value="6"><text:p>6,0</text:p>' in xml
        assert 'office:date-value="2024-02-29T12:00:00"' in xml
        assert 'office:time-value="PT02H00M00S"' in xml
        assert "<text:p>0.666666666666667</text:p>" in xml
        assert "<text:p>-0.67</text:p>" in xml

    def test_notes_shapes_and_styles_stay(self, tmp_path):
        note = "<office:annotation><text:p>a note &gt; 1</text:p></office:annotation>"
        shape = "<draw:frame><draw:text-box><text:p>a box</text:p></draw:text-box></draw:frame>"
        attributes = (
            "table:style-name='a>b' table:formula='of:=[.A1]&amp;\"!\"' office:value-type=\"float\" office:value='1'"
        )
        rows = row(number(2), cell(attributes, f"{note}<text:p>1</text:p><text:p>2</text:p>{shape}"))
        rows += row(cell('table:formula="of:=[.B1]" office:value-type="float" office:value="1"', note + shape))
        book, xml = self.updated(tmp_path, rows)
        assert (book.sheets[0].cached.get(0, 1), book.sheets[0].cached.get(1, 0)) == ("2!", "2!")
        assert f"{note}<text:p>2!</text:p>{shape}</table:table-cell></table:table-row>" in xml
        assert "table:style-name='a>b' table:formula=" in xml
        assert xml.count(f"{note}<text:p>2!</text:p>{shape}") == 2

    def test_errors_in_a_file_without_the_extension(self, tmp_path):
        xml = content(table(row(number(0), number(1, "1/[.A1]"))))
        xml = xml.replace(' xmlns:calcext="urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0"', "")
        source = write_ods(tmp_path / "a.ods", xml)
        book = updated(source, tmp_path / "b.ods")
        assert book.sheets[0].cached.get(0, 1) == ErrorValue("#DIV/0!")
        assert "xmlns:calcext" in parts(tmp_path / "b.ods")["content.xml"].decode()

    def test_repeated_cells_come_apart(self, tmp_path):
        rows = row(number(5, repeated=4), number(1, "SUM([.A1:.D1])"), cell(repeated=100))
        book, xml = self.updated(tmp_path, rows, {"S!B1": 7, "S!AA1": "x"})
        sheet = book.sheets[0]
        assert [sheet.constants.get(0, col) for col in range(4)] == [5.0, 7.0, 5.0, 5.0]
        assert (sheet.cached.get(0, 4), sheet.constants.get(0, 26)) == (22.0, "x")
        assert xml.count("table:number-columns-repeated") == 3  # D and C; before and behind AA

    def test_repeated_rows_come_apart(self, tmp_path):
        rows = row(number(5), number(0, "ROW()"), repeated=4) + row(cell(repeated=3), repeated=1000)
        book, xml = self.updated(tmp_path, rows, {"S!A3": 7, "S!C500": True})
        sheet = book.sheets[0]
        assert [sheet.constants.get(n, 0) for n in range(5)] == [5.0, 5.0, 7.0, 5.0, None]
        assert [sheet.cached.get(n, 1) for n in range(4)] == [1.0, 2.0, 3.0, 4.0]
        assert sheet.constants.get(499, 2) == 1.0
        assert xml.count("<table:table-row") == 4 + 3

    def test_formulas_that_stay_equal_stay_together(self, tmp_path):
        rows = row(number(5), number(0, "PI()", repeated=3), repeated=4)
        book, xml = self.updated(tmp_path, rows)
        assert len([1 for *_, value in book.sheets[0].cached.items() if value == pytest.approx(3.14159265)]) == 12
        assert xml.count("<table:table-row") == 1
        assert 'table:number-columns-repeated="3"' in xml

    def test_new_rows_stand_before_what_follows_the_rows(self, tmp_path):
        names = '<table:named-expressions><table:named-range table:name="N" table:cell-range-address="$S.$A$1"/>'
        names += "</table:named-expressions>"
        book, xml = self.updated(tmp_path, row(number(5)), {"S!B3": 1.5, "S!A3": "a", "S!C9": 2}, names)
        sheet = book.sheets[0]
        assert [sheet.constants.get(*place) for place in ((2, 0), (2, 1), (8, 2))] == ["a", 1.5, 2.0]
        assert xml.index("table:named-expressions") > xml.rindex("table:table-row")

    def test_sheets_that_are_copies_of_other_files_stay(self, tmp_path):
        cache = table(row(number(5), number(1, "[.A1]")), "&apos;file:///tmp/other.ods&apos;#$Sheet1")
        source = write_ods(tmp_path / "a.ods", content(cache + table(row(number(2), number(1, "[.A1]"), text("a")))))
        updated(source, tmp_path / "b.ods")
        assert cache in parts(tmp_path / "b.ods")["content.xml"].decode()

    def test_unusual_prefixes_are_refused(self, tmp_path):
        xml = content(table(row(number(2), number(1, "[.A1]"))))
        xml = xml.replace("xmlns:text=", "xmlns:words=")
        with pytest.raises(WorkbookError, match="can be read, but not written"):
            updated(write_ods(tmp_path / "a.ods", xml), tmp_path / "b.ods")
        assert not (tmp_path / "b.ods").exists()


class TestArrays:
    """Cells that show a part of an array have no formula of their own."""

    @staticmethod
    def book(path, formula, area, value, dynamic):
        with xlsxwriter.Workbook(path) as workbook:
            sheet = workbook.add_worksheet("S")
            sheet.write_column("A1", [3, 1, 2])
            sheet.write_number("B1", 2)
            write = sheet.write_dynamic_array_formula if dynamic else sheet.write_array_formula
            write(area, formula, None, value)
            sheet.write_string("E9", "stays")
        return path

    def test_an_array_formula(self, tmp_path):
        source = self.book(tmp_path / "a.xlsx", "{=A1:A3*B1}", "C1:C3", 0, False)
        book = updated(source, tmp_path / "b.xlsx", {"S!B1": 10})
        assert [book.sheets[0].cached.get(row, 2) for row in range(3)] == [30.0, 10.0, 20.0]
        again = updated(tmp_path / "b.xlsx", tmp_path / "c.xlsx", {"S!B1": 2})
        assert [again.sheets[0].cached.get(row, 2) for row in range(3)] == [6.0, 2.0, 4.0]
        sheet = openpyxl.load_workbook(tmp_path / "c.xlsx", data_only=True)["S"]
        assert [[cell.value for cell in row] for row in sheet["A1:C3"]] == [[3, 2, 6], [1, None, 2], [2, None, 4]]

    def test_a_dynamic_array_grows_and_shrinks(self, tmp_path):
        source = self.book(tmp_path / "a.xlsx", "=SEQUENCE(B1,2)", "C2:D3", 0, True)
        grown = updated(source, tmp_path / "b.xlsx", {"S!B1": 4})
        (block,) = grown.sheets[0].blocks
        assert (block.rows, block.cols, block.kind) == (4, 2, "spill")
        assert [grown.sheets[0].cached.get(row, 3) for row in range(1, 6)] == [2.0, 4.0, 6.0, 8.0, None]
        shrunk = updated(tmp_path / "b.xlsx", tmp_path / "c.xlsx", {"S!B1": 1})
        (block,) = shrunk.sheets[0].blocks
        assert (block.rows, block.cols) == (1, 2)
        sheet = openpyxl.load_workbook(tmp_path / "c.xlsx", data_only=True)["S"]
        shown = [[cell.value for cell in row] for row in sheet["C1:D5"]]
        assert shown == [[None, None], [1, 2], [None, None], [None, None], [None, None]]
        assert sheet["E9"].value == "stays"

    def test_an_array_of_an_ods(self, tmp_path):
        spanned = 'table:number-matrix-columns-spanned="2" table:number-matrix-rows-spanned="1"'
        array = cell(f'table:formula="of:=[.A1]*{{1;2}}" {spanned} office:value-type="float" office:value="3"')
        source = write_ods(tmp_path / "a.ods", content(table(row(number(3), array, number(6)))))
        book = updated(source, tmp_path / "b.ods", {"S!A1": 5})
        assert [book.sheets[0].cached.get(0, col) for col in (1, 2)] == [5.0, 10.0]
        assert list(book.sheets[0].constants.items()) == [(0, 0, 5.0)]


def test_cells_out_of_order_are_read_but_not_set(tmp_path):
    xml = '<worksheet><sheetData><row r="2"><c r="A2"><f>A1*2</f><v>0</v></c></row><row r="1"><c r="A1"><v>4</v></c></row>'
    source = tmp_path / "a.xlsx"
    with xlsxwriter.Workbook(tmp_path / "plain.xlsx") as workbook:
        workbook.add_worksheet("S")
    with zipfile.ZipFile(tmp_path / "plain.xlsx") as old, zipfile.ZipFile(source, "w") as new:
        for name in old.namelist():
            new.writestr(name, f"{xml}</sheetData></worksheet>" if name.endswith("sheet1.xml") else old.read(name))
    assert updated(source, tmp_path / "b.xlsx").sheets[0].cached.get(1, 0) == 8.0
    with pytest.raises(WorkbookError, match="out of order"):
        updated(source, tmp_path / "c.xlsx", {"S!A1": 5})
    assert not (tmp_path / "c.xlsx").exists()
