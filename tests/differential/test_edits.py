"""What a person does to a workbook keeps it true, or is told: cases of `edits.txt`, done by LibreOffice."""

import subprocess
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import pytest

from chosen import part
from folders import ROOT
from livesheet.formats import read
from livesheet.formula.references import column_letters
from mechsheet.checking import check
from mechsheet.checking.edited.edits import WITH_ROWS
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, load
from mechsheet.library.building import build
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.plan import MAY_GO
from office_macros import Job, edited

ROWS = [
    [part.strip() for part in line.split("|")]
    for line in (Path(__file__).parent / "edits.txt").read_text(encoding="utf-8").splitlines()
    if line and not line.startswith("#")
]
TEMPLATES = ("four-bar", "fivelink", "adjustable-pump", "six-link-dwell", "slider-crank", "engine")
BUILT = [
    (layout, form, name)
    for layout, form, name in product(("sheets", "page"), ("xlsx", "ods"), TEMPLATES)
    if (layout, name) != ("page", "engine")  # its flywheel needs sheets of its own
]
NAMES_OF_CELLS = {"fivelink": ("Alfa1", "Alfa2"), "six-link-dwell": ("beta1",)}
"""Names that gnumeric, whose sheets of an .ods have more columns, takes for cells: it writes NAMEAlfa1."""

WIDE = "BZ"
"""A column behind all that a sheet has."""

BESIDE = ("notes", "drawing", "description", *MAY_GO)


@dataclass(frozen=True)
class Case:
    """A workbook, what is done to it, and what is said then."""

    name: str
    compiled: Compiled
    file: Path
    edits: tuple[tuple[str, ...], ...]
    line: str
    check: str


def places(compiled):
    """What the table of cases calls by name."""
    plan = compiled.plan
    first, last = plan.at.first + 1, plan.at.last + 1
    middle = (first + last) // 2
    columns = [column.col for column in plan.columns]
    driver = plan.at.spots[plan.mechanism.driver.symbol].col
    everywhere = []
    for key in ("positions", *WITH_ROWS):
        sheet = compiled.layout.sheet(plan.at.titles[key]) if key in plan.at.titles else None
        if sheet is not None and key not in [title for title, _ in everywhere]:
            everywhere.append((sheet.title, min(fill.row for fill in sheet.fills if fill.rows == plan.rows) + 1))
    inserted = [
        f"insert rows, {title}, {row + 3}, 2; fill down, {title}, A{row}:{WIDE}{row + plan.rows + 1}"
        for title, row in dict(everywhere).items()
    ]
    shortened, torn = (
        "; ".join(f"delete rows, {title}, {row + at}, 2" for title, row in dict(everywhere).items())
        for at in (plan.rows - 2, plan.rows // 2)
    )

    def cell(spot):
        return f"{column_letters(spot.col)}{spot.row + 1}"

    length = next(dim for dim in plan.mechanism.dimensions if dim.symbol in plan.equations.positive and not dim.derived)
    return {
        "everywhere": "; ".join(inserted), "shortened": shortened, "torn": torn,
        "before_last": last - 1, "shorter": last - 2,
        "length": cell(plan.at.spots[length.symbol]), "longer": 1.5 * length.unit.to_shown(length.value),
        "mode": cell(plan.at.spots[plan.equations.groups[0].mode]), "position": cell(plan.places.position),
        "start": cell(plan.places.start), "step": cell(plan.places.step),
        "main": plan.main, "table": plan.table, "first": first, "second": first + 1, "fourth": first + 3, "last": last,
        "further": last + 5, "behind": last + 2, "middle": middle, "before": middle - 1, "beyond": middle + 2,
        "driver": column_letters(driver), "end": column_letters(max(columns)),
    }  # fmt: skip


def cases(folder, name, layout, form):
    """Those of the table that fit a layout, and each sheet deleted."""
    mechanism = load(ROOT / f"templates/{name}.toml", overrides=Overrides(layout=layout))
    compiled = Compiled(mechanism)
    (file,) = build(mechanism, folder / "built", (form,))
    known = places(compiled)
    for title, layouts, edits, line, said in ROWS:
        if layouts in (layout, "both"):
            done = [
                tuple(part.strip() for part in edit.split(","))
                for edit in edits.format(**known).split(";")
                if edit.strip()
            ]
            yield Case(title, compiled, file, tuple(done), line, said)
    for key in BESIDE if layout == "sheets" else ():
        if key in compiled.plan.at.titles:
            sheet = compiled.plan.at.titles[key]
            line = f"gone {sheet}" if key in MAY_GO else "same"
            yield Case(f"delete {sheet}", compiled, file, (("delete sheet", sheet),), line, "agrees")


def said_by(case, path):
    """The line under the title as LibreOffice saved it, and the report of `check`."""
    plan = case.compiled.plan
    book = read(path)
    cell = next(each.formula for each in book.names if each.name == "verdict")
    return book.sheet(cell.sheet).cached.get(cell.row, cell.col), check(path), plan


def wrong_in(case, path):
    """What is not as the table says."""
    line, report, plan = said_by(case, path)
    found, check = [], case.check
    if check == "fewer":
        check = "nothing" if tables_of(plan) else "agrees"
    built = case.compiled.value(plan.places.verdict)
    match case.line.split(" ", 1):
        case ["same"] if line != built:
            found.append(f"says {line!r}")
        case ["gone", sheet] if plan.text("verdict.sheets.deleted", sheet=sheet) not in line:
            found.append(f"says {line!r}")
        case ["red"] if not report.red_line:
            found.append(f"is not red: {line!r}")
        case ["torn"] if plan.text("verdict.sheets.torn") not in line:
            found.append(f"says {line!r}")
        case [more] if more[0] in "+-" and str(plan.rows + int(more)) not in line:
            found.append(f"says {line!r}")
    if check not in ("any", "differs", "nothing") and (check in ("agrees", "values")) is bool(report.edits):
        found.append(f"edits: {[edit.where for edit in report.edits][:4]}")
    agrees = report.values_agree if check in ("values", "differs") else report.agrees
    if (check in ("agrees", "values") and not agrees) or (check == "any" and not (agrees or report.edits)):
        found.append(f"does not agree: {[c for c in report.comparisons if not c.agrees]}")
    if check == "differs" and agrees:
        found.append("agrees")
    if [part for part in report.comparisons if part.judge == "reference" and not part.cells]:
        found.append("is not compared with the reference")
    if report.stored.unstored:
        found.append(f"{report.stored.unstored} have no stored value")
    return found


def wrong_of(listed, folder):
    """By name what is wrong of the cases of one workbook, all done in one start of LibreOffice."""
    nothing = [("none", "")]
    files = edited([Job(case.file, edits=case.edits or nothing) for case in listed], folder)
    found = {case.name: wrong_in(case, path) for case, path in zip(listed, files, strict=True)}
    return {name: wrong for name, wrong in found.items() if wrong}


@pytest.mark.libreoffice
@pytest.mark.slow
def test_a_few_edits_are_true_or_told(tmp_path):
    few = ("insert rows inside and fill", "fill down from the first row", "sort the table", "insert a column")
    listed = [case for case in cases(tmp_path, "four-bar", "page", "ods") if case.name in few]
    assert len(listed) == len(few)
    assert wrong_of(listed, tmp_path) == {}


@pytest.mark.libreoffice
@pytest.mark.ci
@pytest.mark.cases(2)
@pytest.mark.parametrize(("layout", "form", "name"), BUILT)
def test_what_a_person_does_is_true_or_told(layout, form, name, tmp_path):
    """A third of the cases, of one workbook these and of the next those."""
    turn = BUILT.index((layout, form, name))
    assert wrong_of(part(cases(tmp_path, name, layout, form), of=3, turn=turn), tmp_path) == {}


@pytest.mark.gnumeric
@pytest.mark.slow
@pytest.mark.cases(4)
@pytest.mark.parametrize(("layout", "form", "name"), BUILT)
def test_what_gnumeric_saves_is_the_same_workbook(layout, form, name, tmp_path):
    mechanism = load(ROOT / f"templates/{name}.toml", overrides=Overrides(layout=layout))
    (file,) = build(mechanism, tmp_path, (form,))
    saved = tmp_path / f"saved.{form}"
    subprocess.run(["ssconvert", "--recalc", file, saved], check=True, capture_output=True, timeout=120)
    report = check(saved)
    renamed = NAMES_OF_CELLS.get(name, ()) if form == "ods" else ()
    assert [edit.where for edit in report.edits if edit.kind == "name"] == [*renamed]
    assert all(edit.now == "missing" or "NAME" in str(edit.now) for edit in report.edits)
    assert all(part.agrees for part in report.comparisons)
    assert report.agrees or renamed
    assert not report.unjudged
