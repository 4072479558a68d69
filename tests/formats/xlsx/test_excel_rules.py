"""Excel opens what is written without repairing it: its known rules over finished workbooks, and that each rule can fail."""

import re
from pathlib import Path

import pytest
from excel_rules import RULES, Parts

from chosen import ALL

GENERATED = Path(__file__).parents[3] / "generated"
FEW = ("four-bar", "four-bar-page", "fivelink", "adjustable-pump", "crank-rocker-swing")
"""Anchors, one sheet, names and Turkish, a two-way table and a summary, a task."""

NAMES = sorted(path.stem for path in GENERATED.glob("*.xlsx")) if ALL else FEW


@pytest.mark.parametrize("name", NAMES)
def test_finished_workbooks(name):
    parts = Parts(GENERATED / f"{name}.xlsx")
    assert {rule: found for rule, check in RULES.items() if (found := list(check(parts)))} == {}


SHEET, BOOK, CHARTS, STYLES = "xl/worksheets/sheet1.xml", "xl/workbook.xml", "xl/charts/chart1.xml", "xl/styles.xml"
POSITIONS = "xl/worksheets/sheet2.xml"
LONG = "1+" * 5000
DAMAGE = [
    ("order", SHEET, r"(<sheetData>.*</sheetData>)(.*)(</worksheet>)", r"\2\1\3"),
    ("cells", SHEET, r'<row r="2"', '<row r="1"'),
    ("cells", SHEET, r'<c r="A2"', '<c r="XFE2"'),
    ("cells", SHEET, r' s="\d+"', ' s="999"'),
    ("cells", SHEET, r't="s"><v>\d+', 't="s"><v>9999'),
    ("cells", POSITIONS, r"<v>35</v>", "<v>1e-310</v>"),
    ("cells", POSITIONS, r"<v>35</v>", "<v>1e400</v>"),
    ("lengths", POSITIONS, r"<f>", f"<f>{LONG}"),
    ("lengths", POSITIONS, r"<f>", "<f>" + "(" * 65 + "1" + ")" * 65 + "+"),
    ("lengths", POSITIONS, r"<f>", "<f>SUM(" + "1," * 255 + "1)+"),
    ("lengths", POSITIONS, r"<f>", '<f>"' + "x" * 256 + '"+'),
    ("prefixes", "xl/worksheets/sheet5.xml", r"_xlfn\.ISFORMULA", "ISFORMULA"),
    ("prefixes", POSITIONS, r"ATAN2", "_xlfn.ATAN2"),
    ("sharing", POSITIONS, r'ref="A4:A28"', 'ref="A4:A27"'),
    ("sharing", POSITIONS, r'(t="shared" ref="[^"]*" si=)"1"', r'\1"0"'),
    ("titles", BOOK, r'name="Mechanism"', 'name="Positions"'),
    ("titles", BOOK, r'name="Notes"', f'name="{"n" * 32}"'),
    ("titles", BOOK, r"Mechanism!", "Mechanisms!"),
    ("names", BOOK, r'name="a_2"', 'name="A_1"'),
    ("views", BOOK, r"<workbookView", '<workbookView activeTab="6"'),
    ("views", POSITIONS, r'topLeftCell="D4"', 'topLeftCell="D3"'),
    ("validations", SHEET, r'<dataValidations count="\d+"', '<dataValidations count="1"'),
    ("validations", SHEET, r'prompt="', 'prompt="' + "x" * 256),
    ("validations", SHEET, r'promptTitle="', 'promptTitle="' + "x" * 32),
    ("validations", SHEET, r"<formula1>\"", '<formula1>"' + "1," * 128),
    ("conditions", SHEET, r'priority="2"', 'priority="1"'),
    ("conditions", SHEET, r'dxfId="\d+"', 'dxfId="99"'),
    ("charts", CHARTS, r'<c:ptCount val="\d+"', '<c:ptCount val="99"'),
    ("charts", CHARTS, r'<c:pt idx="1"', '<c:pt idx="0"'),
    ("charts", CHARTS, r'<c:order val="1"', '<c:order val="0"'),
    ("charts", CHARTS, r'<c:crossAx val="', '<c:crossAx val="9'),
    ("merges", SHEET, r'(<mergeCell ref="A)(\d+)(:[^"]*"/>)', r"\1\2\3\1\2\3"),
    ("merges", SHEET, r'<mergeCell ref="[^"]*"/>', '<mergeCell ref="A1:E12"/>'),
    ("sizes", SHEET, r'<col min="2"', '<col min="1"'),
    ("sizes", SHEET, r' ht="[^"]*"', ' ht="410"'),
    ("sizes", SHEET, r"<oddFooter>", "<oddFooter>" + "x" * 256),
    ("sizes", SHEET, r'paperSize="9" scale="\d+"', 'paperSize="9" scale="9"'),
    ("styles", STYLES, r'<fonts count="\d+"', '<fonts count="1"'),
    ("styles", STYLES, r'(<cellXfs.*?)fontId="\d+"', r'\1fontId="99"'),
    ("styles", STYLES, r'numFmtId="164" formatCode', 'numFmtId="14" formatCode'),
    ("relations", "[Content_Types].xml", r"/xl/charts/chart1.xml", "/xl/calcChain.xml"),
    ("relations", "xl/worksheets/_rels/sheet1.xml.rels", r'Id="rId1"', 'Id="rId2"'),
    ("relations", "xl/drawings/_rels/drawing1.xml.rels", r"chart1\.xml", "chart9.xml"),
    ("notes", "xl/comments1.xml", r'(<comment ref=")[^"]*(".*?<comment ref=")[^"]*"', r'\1B2\2B2"'),
    ("notes", "xl/comments1.xml", r'authorId="0"', 'authorId="3"'),
]


@pytest.fixture(scope="module")
def plain():
    return Parts(GENERATED / "four-bar.xlsx")


@pytest.mark.parametrize(("rule", "part", "old", "new"), DAMAGE, ids=lambda item: item[:24] if "<" not in item else "")
def test_each_rule_can_fail(plain, rule, part, old, new):
    damaged = Parts.__new__(Parts)
    text = plain.data[part].decode()
    assert re.search(old, text, re.DOTALL)
    damaged.data = plain.data | {part: re.sub(old, new, text, count=1, flags=re.DOTALL).encode()}
    damaged.trees = {name: tree for name, tree in plain.trees.items() if name != part}
    assert list(RULES[rule](plain)) == []
    assert list(RULES[rule](damaged)) != []


def test_every_rule_is_tried():
    assert {rule for rule, *_ in DAMAGE} == set(RULES)
