"""Both twins of every template, and of random mechanisms, in the programs that people open them with.

Programs are started once for many files: starting takes longer than computing. `generated/` is what `build` makes of the
templates (test_generated.py sees to that).
"""

from __future__ import annotations

import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest
from lxml import etree

from chosen import first, some
from livesheet.engine import evaluate
from livesheet.formats import read, write
from livesheet.formula.nodes import Number, shifted, transform
from mechsheet.checking import check
from mechsheet.checking.books_compared import compare_twins
from mechsheet.checking.cells import compare_program
from mechsheet.checking.inputs import description_in, plan_inside
from mechsheet.checking.programs import convert_with_libreoffice, stored_values
from mechsheet.description import loads
from mechsheet.library.building import FORMATS, compile_workbook
from odf import document_parts, schema_file
from random_mechanisms import KINDS, Grower

pytestmark = pytest.mark.slow

GENERATED = Path(__file__).parent.parent.parent / "generated"
SOME = ("adjustable-pump", "fivelink", "four-bar", "scotch-yoke")
"""A two-way table, Turkish, the plain one, and one that slides."""


def twins(turn):
    """(.xlsx, .ods) of every template in a full run; else of some of them, because other programs take their time."""
    found = sorted(GENERATED.glob("*.ods"))
    assert len(found) >= 21
    return [(path.with_suffix(".xlsx"), path) for path in some(found, turn, every=29)]


def random_ods(folder):
    """Workbooks of random mechanisms of all five dyads."""
    folder.mkdir()
    paths = []
    for seed in first(range(1300, 1306), 1):
        mechanism = loads(Grower(seed, 1 + seed % 4, KINDS).text(5))
        paths.append(folder / f"random-{seed}.ods")
        write(compile_workbook(mechanism)[0], paths[-1])
    return paths


def agrees(judge, source, answer):
    """Whether the program that wrote `answer` computed from `source` what the engine computes."""
    book = read(source)
    plan = plan_inside(description_in(book), source.name)
    found = compare_program(judge, book, evaluate(book), stored_values(answer).get, plan, source.name)
    assert found.agrees, (source.name, found)


def test_twins_are_one_workbook():
    for xlsx, ods in twins(0):
        assert compare_twins(read(xlsx), read(ods), "twin").agrees, ods.name


def test_the_ods_agrees_with_the_reference():
    for name in first(SOME[::-1], 2):
        report = check(GENERATED / f"{name}.ods")
        assert report.agrees, report


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.libreoffice
@pytest.mark.parametrize("suffix", FORMATS)
def test_libreoffice_computes_both_twins(suffix, tmp_path):
    sources = [pair[FORMATS.index(suffix)] for pair in twins(1 + FORMATS.index(suffix))]
    if suffix == "ods":
        sources += random_ods(tmp_path / "random")
    for source, answer in zip(sources, convert_with_libreoffice(sources, "xlsx", tmp_path), strict=True):
        agrees("libreoffice", source, answer)


@pytest.mark.gnumeric
@pytest.mark.ci
def test_gnumeric_computes_the_ods(tmp_path):
    for source in [ods for _, ods in twins(3)] + random_ods(tmp_path / "random"):
        answer = tmp_path / f"{source.stem}.xlsx"
        subprocess.run([shutil.which("ssconvert"), "--recalc", source, answer], check=True, capture_output=True)
        agrees("gnumeric", source, answer)


@pytest.mark.ci
@pytest.mark.libreoffice
def test_conversions_by_libreoffice_lose_nothing(tmp_path):
    for old, new in (FORMATS, FORMATS[::-1]):
        sources = [GENERATED / f"{name}.{old}" for name in first(SOME[::-1], 1)]
        for source, result in zip(sources, convert_with_libreoffice(sources, new, tmp_path), strict=True):
            ours, theirs = read(source), read(result)
            assert [sheet.title for sheet in theirs.sheets] == [sheet.title for sheet in ours.sheets]
            assert sorted(map(str, theirs.names)) == sorted(map(str, ours.names))
            for mine, converted in zip(ours.sheets, theirs.sheets, strict=True):
                assert formulas(converted) == formulas(mine), (source.name, mine.title)
            # Charts and validations: as many as our own twin in that format has.
            assert counted(result) == counted(source.with_suffix(f".{new}")), source.name


def formulas(sheet):
    """Every cell's formula: runs may be cut otherwise where neighbours are alike. LibreOffice writes 15 digits."""

    def rounded(node):
        return Number(float(f"{node.value:.12g}")) if isinstance(node, Number) else node

    return {
        (block.row + down, block.col + right): shifted(formula, down, right)
        for block in sheet.blocks
        for formula in [transform(block.formula, rounded)]
        for down in range(block.rows)
        for right in range(block.cols)
    }


def counted(path):
    """How many charts and rules for typing a file holds."""
    with zipfile.ZipFile(path) as archive:
        data = {name: archive.read(name) for name in archive.namelist()}
    if path.suffix == ".ods":
        return data["content.xml"].count(b"<draw:object "), data["content.xml"].count(b"<table:content-validation ")
    charts = sum(name.startswith("xl/charts/chart") for name in data)
    return charts, sum(part.count(b"<dataValidation ") for name, part in data.items() if "worksheets/sheet" in name)


@pytest.mark.jing
def test_every_ods_is_valid(tmp_path):
    parts: dict[str, list[Path]] = {}
    files = [ods for _, ods in twins(4)] + random_ods(tmp_path / "random")
    for ods in files:
        for schema, name, tree in document_parts(ods):
            path = tmp_path / f"{ods.stem}-{name.replace('/', '-')}"
            path.write_bytes(etree.tostring(tree))
            parts.setdefault(schema, []).append(path)
    assert sum(map(len, parts.values())) >= 6 * len(files)
    for schema, paths in parts.items():
        done = subprocess.run(["jing", "-i", schema_file(schema), *paths], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout[:2000]
