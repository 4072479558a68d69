"""What is read from an .ods: of our own writing, of other programs' habits, and of no use at all."""

from __future__ import annotations

import time
import tracemalloc
import zipfile

import pytest
from ods_files import NAMESPACES, cell, content, number, row, table, text, write_ods
from samples import sample

from livesheet.diagnostics import WorkbookError
from livesheet.engine import evaluate
from livesheet.formats import read, write
from livesheet.formula.book import Block
from livesheet.formula.nodes import MAX_COLUMNS, Binary, CellRef, ErrorValue, NameRef, Number, RangeRef, Text, Unary
from livesheet.formula.printer import print_formula
from livesheet.workbook import Fill, Sheet, Workbook


def book_of(tmp_path, rows, outside="", **options):
    return read(write_ods(tmp_path / "a.ods", content(table(rows) + outside, **options)))


def constants(book, title="S"):
    return {(row, col): value for row, col, value in book.sheet(title).constants.items()}


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    folder = tmp_path_factory.mktemp("twins")
    for suffix in ("xlsx", "ods"):
        write(sample(), folder / f"a.{suffix}")
    return read(folder / "a.xlsx"), read(folder / "a.ods")


class TestOurOwn:
    def test_both_twins_are_one_book(self, twins):
        xlsx, ods = twins
        assert [sheet.title for sheet in ods.sheets] == [sheet.title for sheet in xlsx.sheets]
        for mine, theirs in zip(ods.sheets, xlsx.sheets, strict=True):
            assert mine.blocks == theirs.blocks
            assert list(mine.cached.items()) == list(theirs.cached.items())

    def test_names(self, twins):
        xlsx, ods = twins
        assert sorted(ods.names, key=str) == sorted(xlsx.names, key=str)

    def test_constants(self, twins):
        xlsx, ods = twins
        for mine, theirs in zip(ods.sheets, xlsx.sheets, strict=True):
            # A character that XML cannot hold is spelt in OOXML, and left out in OpenDocument.
            expected = [
                (*place, value.replace("\x01", "") if isinstance(value, str) else value)
                for *place, value in theirs.constants.items()
            ]
            assert list(mine.constants.items()) == expected


class TestCells:
    def test_types(self, tmp_path):
        values = {
            'office:value-type="float" office:value="1.5e-3"': 0.0015,
            'office:value-type="percentage" office:value="0.25"': 0.25,
            'office:value-type="currency" office:currency="EUR" office:value="9.5"': 9.5,
            'office:value-type="boolean" office:boolean-value="true"': True,
            'office:value-type="boolean" office:boolean-value="false"': False,
            'office:value-type="date" office:date-value="2024-02-29"': 45351.0,
            'office:value-type="date" office:date-value="2024-02-29T18:00:00"': 45351.75,
            'office:value-type="time" office:time-value="PT36H30M00S"': 36.5 / 24,
            'office:value-type="string" office:string-value="given"': "given",
        }
        book = book_of(tmp_path, row(*(cell(attributes) for attributes in values)))
        assert [constants(book)[0, col] for col in range(len(values))] == list(values.values())

    def test_texts(self, tmp_path):
        texts = {
            "one": "one",
            "a  b": "a b",
            ' <text:s text:c="2"/>a<text:s/>b<text:tab/>c ': "  a b\tc",
            "one<text:line-break/>two": "one\ntwo",
            'x<text:span text:style-name="sub">1</text:span> = <text:a>link</text:a>': "x1 = link",
            "a<office:annotation><text:p>hidden</text:p></office:annotation>b": "ab",
            "&lt;&amp;ı İ ğ θ₁₂": "<&ı İ ğ θ₁₂",
        }
        book = book_of(tmp_path, row(*map(text, texts)))
        assert [constants(book)[0, col] for col in range(len(texts))] == list(texts.values())

    def test_paragraphs_are_lines_and_notes_and_shapes_are_no_text(self, tmp_path):
        note = "<office:annotation><text:p>a note</text:p></office:annotation>"
        shape = "<draw:frame><draw:text-box><text:p>a box</text:p></draw:text-box></draw:frame>"
        inside = f"{note}<text:p>one</text:p><text:p/><text:p>three</text:p>{shape}"
        book = book_of(tmp_path, row(cell('office:value-type="string"', inside), cell("", note + shape)))
        assert constants(book) == {(0, 0): "one\n\nthree"}

    @pytest.mark.parametrize(
        ("attributes", "shown", "expected"),
        [
            ('office:value-type="string" office:string-value="" calcext:value-type="error"', "#DIV/0!", "#DIV/0!"),
            ('office:value-type="string" office:string-value="" calcext:value-type="error"', "Err:503", "#NUM!"),
            ('office:value-type="string" office:string-value="" calcext:value-type="error"', "Err:502", "#VALUE!"),
            ('office:value-type="string" office:string-value="" calcext:value-type="error"', None, "#VALUE!"),
            ('office:value-type="string" office:string-value="" calcext:value-type="error"', "#YOK", "#VALUE!"),
            ('office:value-type="string" office:string-value="#N/A"', "#N/A", "#N/A"),  # gnumeric
        ],
    )
    def test_errors(self, tmp_path, attributes, shown, expected):
        inside = "" if shown is None else f"<text:p>{shown}</text:p>"
        rows = row(cell(f'table:formula="of:=NA()" {attributes}', inside))
        assert book_of(tmp_path, rows).sheet("S").cached.get(0, 0) == ErrorValue(expected)

    def test_a_text_that_looks_like_an_error(self, tmp_path):
        known = 'office:value-type="string" office:string-value="#N/A" calcext:value-type="string"'
        rows = row(cell(known, "<text:p>#N/A</text:p>"), text("#N/A"))
        assert constants(book_of(tmp_path, rows)) == {(0, 0): "#N/A", (0, 1): "#N/A"}

    def test_a_result_of_ours_that_looks_like_an_error(self, tmp_path):
        fills = (Fill(0, 0, Text("#N/A"), values=("#N/A",)), Fill(1, 0, Text(""), values=("",)))
        write(Workbook((Sheet("S", fills=fills),)), tmp_path / "a.ods")
        cached = read(tmp_path / "a.ods").sheets[0].cached
        assert (cached.get(0, 0), cached.get(1, 0)) == ("#N/A", "")

    def test_repeated_cells_and_rows(self, tmp_path):
        rows = row(cell(repeated=3), number(7, repeated=2), cell(repeated=16379)) + row(cell(), repeated=98)
        rows += row(number(1), text("a"), repeated=3)
        book = book_of(tmp_path, rows)
        assert constants(book) == {
            (0, 3): 7.0, (0, 4): 7.0,
            (99, 0): 1.0, (100, 0): 1.0, (101, 0): 1.0,
            (99, 1): "a", (100, 1): "a", (101, 1): "a",
        }  # fmt: skip

    def test_a_repeated_formula_has_the_same_text_everywhere(self, tmp_path):
        sheet = book_of(tmp_path, row(number(1), number(2, "[.A1]+1", repeated=2))).sheet("S")
        plus = Binary("+", CellRef(0, 0), Number(1.0))
        assert [(block.col, block.formula) for block in sheet.blocks] == [(1, plus), (2, plus)]

    def test_covered_cells_count(self, tmp_path):
        spanned = cell('table:number-columns-spanned="2" office:value-type="float" office:value="1"')
        rows = row(spanned, cell("", covered=True), number(3))
        assert constants(book_of(tmp_path, rows)) == {(0, 0): 1.0, (0, 2): 3.0}

    def test_groups_and_headings_are_rows_too(self, tmp_path):
        rows = f"<table:table-header-rows>{row(number(1))}</table:table-header-rows>"
        rows += f"<table:table-row-group>{row(number(2))}</table:table-row-group>" + row(number(3))
        assert constants(book_of(tmp_path, rows)) == {(n, 0): n + 1.0 for n in range(3)}


class TestFormulas:
    def test_a_fill_down_run_is_one_block(self, tmp_path):
        rows = "".join(
            row(number(n), number(2 * n, f"-[.A{n + 1}]*[.$B$1]+[$'it''s A1'.A${n + 2}]+[$'it''s A1'.B{n + 1}]"))
            for n in range(12)
        )
        book = book_of(tmp_path, rows, outside=table(row(cell()), "it's A1"))
        blocks = book.sheet("S").blocks
        assert [(block.row, block.rows) for block in blocks] == [(n, 1) for n in range(12)]

        rows = "".join(row(number(n), number(2 * n, f"2*[.A{n + 1}]+[.$A$1]")) for n in range(12))
        (block,) = book_of(tmp_path, rows).sheet("S").blocks
        formula = Binary("+", Binary("*", Number(2.0), CellRef(0, 0)), CellRef(0, 0, True, True))
        assert block == Block(0, 1, 12, 1, formula)

    def test_quoted_sheet_names_hold_no_rows(self, tmp_path):
        rows = "".join(row(number(n, f"[$'Table .A1 ''x'''.B{n + 1}:.C{n + 1}]")) for n in range(3))
        (block,) = book_of(tmp_path, rows, table(row(cell()), "Table .A1 &apos;x&apos;")).sheet("S").blocks
        title = "Table .A1 'x'"
        assert block.formula == RangeRef(CellRef(0, 1, sheet=title), CellRef(0, 2, sheet=title))
        assert block.rows == 3

    def test_prefixes_are_the_file_s_own(self, tmp_path):
        xml = content(table(row(number(1), number(-1, "-[.A1]"))))
        for old, new in (("table", "t"), ("office", "o"), ("of", "formel")):
            xml = xml.replace(f"<{old}:", f"<{new}:").replace(f"</{old}:", f"</{new}:").replace(f" {old}:", f" {new}:")
            xml = xml.replace(f'"{old}:=', f'"{new}:=').replace(f"xmlns:{old}=", f"xmlns:{new}=")
        book = read(write_ods(tmp_path / "a.ods", xml))
        assert constants(book) == {(0, 0): 1.0}
        assert book.sheet("S").blocks[0].formula == Unary("-", CellRef(0, 0))

    def test_names(self, tmp_path):
        def names(*entries):
            return f"<table:named-expressions>{''.join(entries)}</table:named-expressions>"

        def named(name, address, base="$S.$A$1"):
            return (
                f'<table:named-range table:name="{name}" table:base-cell-address="{base}"'
                f' table:cell-range-address="{address}"/>'
            )

        expression = (
            '<table:named-expression table:name="Twice" table:base-cell-address="$S.$B$2"'
            ' table:expression="of:=2*[.A2]"/>'
        )
        inner = row(number(1), number(1, "[.A1]")) + names(named("Yerel", "$S.$A$1"))
        everything = names(
            named("Açı1", "$S.$A$1"), named("Range", "$S.$A$1:.$B$1"), named("Gone", "$S.#REF!"), expression
        )
        book = book_of(tmp_path, inner, outside=everything)
        found = {(name.name, name.sheet): name.formula for name in book.names}
        first = CellRef(0, 0, True, True, "S")
        assert found[("Açı1", None)] == first
        assert found[("Yerel", "S")] == first
        assert found[("Range", None)] == RangeRef(first, CellRef(0, 1, True, True, "S"))
        assert found[("Gone", None)] == ErrorValue("#REF!")
        assert found[("Twice", None)] == Binary("*", Number(2.0), CellRef(0, MAX_COLUMNS - 1))  # one column left of A

    def test_relative_names_mean_what_is_beside_the_formula(self, tmp_path):
        left = (
            '<table:named-expressions><table:named-expression table:name="Left" table:base-cell-address="$S.$C$3"'
            ' table:expression="of:=[.B3]"/></table:named-expressions>'
        )
        rows = "".join(row(number(n), number(n, "10*Left")) for n in range(3))
        book = book_of(tmp_path, rows, left)
        assert evaluate(book).column("S", 1, 0, 2) == [0.0, 10.0, 20.0]

    def test_names_are_used(self, tmp_path):
        rows = row(number(1), number(1, "ÇıkışUzvu"))
        assert book_of(tmp_path, rows).sheet("S").blocks[0].formula == NameRef("ÇıkışUzvu")

    def test_copies_of_other_files_are_no_sheets(self, tmp_path):
        cache = table(row(number(5)), "&apos;file:///tmp/other.ods&apos;#$Sheet1")
        assert [sheet.title for sheet in book_of(tmp_path, row(number(1)), cache).sheets] == ["S"]

    def test_1904(self, tmp_path):
        days = (
            '<table:calculation-settings><table:null-date table:date-value="1904-01-01"/></table:calculation-settings>'
        )
        date = cell('office:value-type="date" office:date-value="1904-01-03"')
        book = read(write_ods(tmp_path / "a.ods", content(days + table(row(date)))))
        assert book.date1904
        assert constants(book) == {(0, 0): 2.0}


class TestFaults:
    """One sentence each, and nothing that takes long."""

    def refused(self, path, *words):
        start = time.perf_counter()
        with pytest.raises(WorkbookError) as caught:
            read(path)
        assert time.perf_counter() - start < 5
        for word in words:
            assert word in str(caught.value)
        assert path.name in str(caught.value)
        return caught.value

    def test_all_cells_that_cannot_be_understood(self, tmp_path):
        rows = row(
            number("1,5"),
            cell('office:value-type="wonder"'),
            cell('office:value-type="date" office:date-value="2023-02-29"'),
        )
        path = write_ods(tmp_path / "a.ods", content(table(rows)))
        error = self.refused(path, "S!A1", "S!B1", "S!C1", '"1,5"')
        assert len(error.faults) == 3

    def test_names_of_lists_and_names_marked_as_the_documents(self, tmp_path):
        lists = (
            '<table:database-ranges><table:database-range table:name="Marks" table:target-range-address="S.A1:S.A2"/>'
            '<table:database-range table:name="list" table:target-range-address="S.B1:S.B1"/></table:database-ranges>'
        )
        names = (
            '<table:named-expressions><table:named-range table:name="LIST" table:cell-range-address="$S.$A$2"/>'
            "</table:named-expressions>"
        )
        rows = row(number(3), number(0, "SUM(marks)")) + row(number(4), number(0, "$$LIST*2"))
        book = read(write_ods(tmp_path / "a.ods", content(table(rows) + names + lists)))
        values = evaluate(book)
        assert (values.get("S", 0, 1), values.get("S", 1, 1)) == (7.0, 8.0)

    def test_as_excel_writes_ods(self, tmp_path):
        """Errors as the number 0 that shows one, types without a value, the day that its calendar has too many."""

        def computed(formula, value, shown):
            about = f'office:value-type="float" office:value="{value}" table:formula="of:={formula}"'
            return cell(about, f"<text:p>{shown}</text:p>")

        day = cell('office:value-type="date" office:date-value="1900-02-29T12:00:00"')
        first = row(
            cell('office:value-type="float"'),
            computed("NA()", 0, "#N/A"),
            day,
            computed("A1", 0, "#WERT!"),
            computed("A2", 0, "#YOK"),
        )
        divided = [
            (f"1/([.D{n}]-30)", 0, "#DIV/0!") if n == 30 else (f"1/([.D{n}]-30)", 1 / (n - 30), "0")
            for n in range(2, 60)
        ]
        rows = "".join(row(computed(*one), cell(repeated=2), number(n)) for n, one in enumerate(divided, 2))
        sheet = book_of(tmp_path, first + rows).sheets[0]
        assert (sheet.constants.get(0, 0), sheet.cached.get(0, 1), sheet.constants.get(0, 2)) == (
            None,
            ErrorValue("#N/A"),
            60.5,
        )
        assert (sheet.cached.get(0, 3), sheet.cached.get(0, 4)) == (ErrorValue("#VALUE!"), ErrorValue("#N/A"))
        assert (sheet.cached.get(28, 0), sheet.cached.get(29, 0), sheet.cached.get(30, 0)) == (
            -1.0,
            ErrorValue("#DIV/0!"),
            1.0,
        )

    def test_notations(self, tmp_path):
        def formula(notation, value):
            return cell(f'table:formula="{notation}" office:value-type="float" office:value="{value}"')

        rows = row(
            number(3),
            formula("oooc:=[.A1]*2", 1),
            formula("msoxl:=SUM($A$1:B1,A1)", 2),
            formula("=IF([.A1]&gt;1;&quot;a:=b&quot;;0)", 3),
            formula("lotus:=A1", 4),
            formula("of:=1+", 5),
            formula("msoxl:=A1:=", 6),
            formula("nothing", 7),
        )
        book = book_of(tmp_path, rows)
        assert [print_formula(block.formula) for block in book.sheets[0].blocks] == [
            "A1*2", "SUM($A$1:B1,A1)", 'IF(A1>1,"a:=b",0)'
        ]  # fmt: skip
        assert constants(book) == {(0, 0): 3.0, (0, 4): 4.0, (0, 5): 5.0, (0, 6): 6.0, (0, 7): 7.0}
        assert sorted(remark.key for remark in book.remarks) == ["S!E1", "S!F1", "S!G1", "S!H1"]

    @pytest.mark.parametrize(
        ("name", "data", "words"),
        [
            ("empty.ods", b"", "empty"),
            ("text.ods", b"a;b\n1;2\n", "no zip"),
            ("cut.ods", b"PK\x03\x04" + b"\0" * 60, "damaged"),
            ("flat.ods", content("").encode(), ".fods"),
            ("old.ods", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + b"\0" * 99, ".xls"),
        ],
    )
    def test_no_zip(self, tmp_path, name, data, words):
        path = tmp_path / name
        path.write_bytes(data)
        self.refused(path, words)

    def test_flat_file_by_its_own_suffix(self, tmp_path):
        path = tmp_path / "flat.fods"
        path.write_text(content(table(row(number(1)))), encoding="utf-8")
        self.refused(path, "save it as .ods")

    def test_cut_off(self, tmp_path):
        path = tmp_path / "a.ods"
        write(sample(), path)
        data = path.read_bytes()
        for part in (0.3, 0.9, 0.999):
            path.write_bytes(data[: int(part * len(data))])
            self.refused(path, "damaged")

    def test_damaged_inside(self, tmp_path):
        path = tmp_path / "a.ods"
        write(sample(), path)
        with zipfile.ZipFile(path) as archive:
            place = archive.getinfo("content.xml").header_offset
        data = bytearray(path.read_bytes())
        data[place + 2000 : place + 2100] = b"x" * 100
        path.write_bytes(data)
        self.refused(path)

    @pytest.mark.parametrize(
        ("xml", "words"),
        [
            (content(table(""), before='<!DOCTYPE a SYSTEM "file:///etc/passwd">'), "document type"),
            (content(table(""), before='<!DOCTYPE a [<!ENTITY b "c">]>'), "document type"),
            (content(table(row(number(1)))[:-9]), "no proper XML"),
            ("<a/>", "no OpenDocument content"),
            (content("", kind="text"), "an OpenDocument text"),
            (content(""), "no sheet"),
            (content(table("") + table("", "s")), 'two sheets are called "s"'),
            (content(table(row(number(1, repeated="-3")))), '"-3" is no number of repetitions'),
            (content(table(row(number(1, repeated="0")))), "no number of repetitions"),
            (content(table(row(number(1, repeated="1" * 5000)))), "outside the sheet"),
            (content(table(row(number(1, repeated=16384), repeated=1048576))), "repeated more than"),
            (content(table(row(cell(repeated=16384), number(1)))), "outside the sheet"),
            (content(table(row(cell(), repeated=1048576) + row(number(1)))), "outside the sheet"),
        ],
    )
    def test_content(self, tmp_path, xml, words):
        self.refused(write_ods(tmp_path / "a.ods", xml), words)

    def test_other_files_with_this_suffix(self, tmp_path):
        self.refused(write_ods(tmp_path / "a.ods", "<a/>", part="word/document.xml"), "holds no part content.xml")
        path = tmp_path / "b.ods"
        write(sample(), tmp_path / "b.xlsx")
        (tmp_path / "b.xlsx").rename(path)
        self.refused(path, "an .xlsx with another file's suffix")
        with zipfile.ZipFile(tmp_path / "c.ods", "w") as archive:
            archive.writestr("mimetype", "application/vnd.oasis.opendocument.text")
            archive.writestr("content.xml", content("", kind="text"))
        self.refused(tmp_path / "c.ods", "opendocument.text")

    def test_password(self, tmp_path):
        manifest = (
            '<manifest:manifest xmlns:manifest="urn:oasis:names:tc:opendocument:xmlns:manifest:1.0">'
            '<manifest:file-entry manifest:full-path="content.xml"><manifest:encryption-data/></manifest:file-entry>'
            "</manifest:manifest>"
        )
        path = write_ods(tmp_path / "a.ods", b"\x17\x99secret", {"META-INF/manifest.xml": manifest})
        self.refused(path, "protected by a password")
        self.refused(write_ods(tmp_path / "b.ods", b"secret", part="encrypted-package"), "protected by a password")

    def test_days_counted_from_elsewhere(self, tmp_path):
        days = (
            '<table:calculation-settings><table:null-date table:date-value="1900-01-01"/></table:calculation-settings>'
        )
        self.refused(write_ods(tmp_path / "a.ods", content(days + table(row(number(1))))), "1900-01-01")

    @pytest.mark.cases(2)
    @pytest.mark.slow
    @pytest.mark.parametrize(
        "filling",
        [
            lambda count: table(row(cell("", " " * count))),
            lambda count: table(row(cell(f'table:formula="of:={" " * count}1"'))),
            lambda count: table(row(cell('office:value-type="string"', f"<text:p>{'x' * count}</text:p>"))),
        ],
        ids=["spaces", "a formula", "a text"],
    )
    def test_what_is_packed_to_burst(self, tmp_path, filling):
        few = write_ods(tmp_path / "few.ods", content(filling(5 << 20)))
        tracemalloc.start()
        self.refused(few, "longer than")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 24 << 20
        many = write_ods(tmp_path / "many.ods", content(filling(40 << 20)))
        self.refused(many, "packed more than")

    def test_what_is_empty_costs_nothing(self, tmp_path):
        rows = row(cell(repeated=16384), repeated=1048575) + row(cell(repeated="9" * 30), repeated="9" * 30)
        start = time.perf_counter()
        book = book_of(tmp_path, row(number(1)) + rows)
        assert time.perf_counter() - start < 0.5
        assert constants(book) == {(0, 0): 1.0}

    def test_namespaces_are_needed(self, tmp_path):
        only = {"office": NAMESPACES["office"]}
        self.refused(write_ods(tmp_path / "a.ods", content("", namespaces=only)), "no sheet")
