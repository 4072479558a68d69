"""The pages of docs: what follows from the code is up to date, examples are right, links lead somewhere."""

import dataclasses
import json
import math
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import openpyxl
import pytest

import mechsheet
from folders import ROOT
from livesheet.engine import evaluate
from livesheet.formats import read
from livesheet.formula.functions import FUNCTIONS
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_name
from mechsheet import reference as independent
from mechsheet.cli import main as commands
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, load, loads
from mechsheet.description.grammar import Either, Items, Kinds, Named, Shape, Table
from mechsheet.description.schema import DESCRIPTION
from mechsheet.description.templates import template_names, template_text
from mechsheet.kinematics.solve import solve
from mechsheet.model import Sketch
from mechsheet.sheet.transmission import POOR

DOCS = ROOT / "docs"
sys.path.append(str(ROOT / "tools"))
import reference  # noqa: E402

BLOCK = re.compile(r"```toml\n(.*?)```", re.DOTALL)
EXAMPLES = [
    (path.name, number, text)
    for path in sorted(DOCS.glob("*.md"))
    for number, text in enumerate(BLOCK.findall(path.read_text(encoding="utf-8")), 1)
]


@pytest.mark.parametrize("name", sorted(reference.PAGES))
def test_pages_made_from_the_code_are_up_to_date(name):
    assert (DOCS / name).read_text(encoding="utf-8") == reference.PAGES[name](), "run `make reference`"


@pytest.mark.parametrize(("page", "number", "text"), EXAMPLES, ids=lambda part: str(part)[:20])
def test_examples_are_toml_and_whole_ones_solve(page, number, text):
    found = tomllib.loads(text)
    if "format" in found:
        assert solve(loads(text)).columns  # gears, or an arm alone, have no groups


def keys_of(shape: Shape, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Every key of the format as a path, `*` for names that the description gives."""
    match shape:
        case Table(keys):
            for name, key in keys.items():
                yield (*path, name)
                yield from keys_of(key.shape, (*path, name))
        case Named(item):
            yield from keys_of(item, (*path, "*"))
        case Items(item):
            yield from keys_of(item, path)
        case Kinds(_, tables):
            for table in tables.values():
                yield from keys_of(table, path)
        case Either(shapes):
            for part in shapes:
                yield from keys_of(part, path)


def used(value: object, path: tuple[str, ...], known: set[tuple[str, ...]]) -> Iterator[tuple[str, ...]]:
    """The paths of the keys that an example uses, written as `keys_of` writes them."""
    if isinstance(value, list):
        for item in value:
            yield from used(item, path, known)
    if not isinstance(value, dict):
        return
    for name, below in value.items():
        place = (*path, name) if (*path, name) in known else (*path, "*")
        yield place
        yield from used(below, place, known)


def test_every_key_has_an_example():
    known = set(keys_of(DESCRIPTION))
    shown = {
        key for page, _, text in EXAMPLES if page == "description.md" for key in used(tomllib.loads(text), (), known)
    }
    assert known - shown == set()


AT_THE_OTHER_CRANK = {("synthesis", "A", "turns"), ("synthesis", "B", "moving")}
"""Keys of `guidance` that a pattern shows at the other one of its two cranks, which are given in the same ways."""


def test_every_key_stands_in_a_template_or_a_pattern():
    """Who looks for how a feature is used finds it in a whole mechanism that works."""
    known = set(keys_of(DESCRIPTION))
    patterns = [text for page, _, text in EXAMPLES if page == "patterns.md"]
    whole = [*patterns, *(template_text(name) for name in template_names())]
    shown = {key for text in whole for key in used(tomllib.loads(text), (), known)}
    assert known - shown == AT_THE_OTHER_CRANK


@pytest.mark.slow
def test_the_site_is_built_and_its_links_lead_somewhere(tmp_path):
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(tmp_path / "site")]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "site" / "index.html").exists()


@pytest.mark.parametrize("path", [".pre-commit-hooks.yaml", "docs/examples/check-workbooks.yml"])
def test_ready_files_run_commands_that_exist(path):
    """The hook and the workflow are YAML, and their `mechsheet` lines have options that the command knows."""
    yaml = pytest.importorskip("yaml")
    text = (ROOT / path).read_text(encoding="utf-8")
    assert yaml.safe_load(text)
    lines = re.findall(r"(?:entry|run): mechsheet (.*)", text)
    assert lines
    for line in lines:
        name, *options = line.split()
        known = {option for parameter in commands.commands[name].params for option in parameter.opts}
        assert {option for option in options if option.startswith("-")} <= known


EXPERIMENT = {
    DOCS.parent / "README.md": r"Type (?P<crank>\d+) into.*?crank `a2`.*?(?P<lost>\d+) of the (?P<rows>\d+) rows "
    r"\((?P<first>\d+)° to (?P<last>\d+)°\)",
    DOCS / "lecturer.md": r"`a2` from (?P<old>\d+) to (?P<crank>\d+).*?(?P<lost>\d+) of the (?P<rows>\d+) rows "
    r"\((?P<first>\d+)° to (?P<last>\d+)°\).*?up to (?P<most>[\d.]+) the crank turns fully",
    DOCS / "lecturer.tr.md": r"`a2` (?P<old>\d+) yerine (?P<crank>\d+) olsun.*?(?P<rows>\d+) satırın (?P<lost>\d+)'üne "
    r"\((?P<first>\d+)° ile (?P<last>\d+)° arası\).*?krank (?P<most>[\d,]+)'e kadar tam döner",
    DOCS
    / "workbook.md": r"crank `a2` (?P<crank>\d+) mm instead of (?P<old>\d+):.*?(?P<lost>\d+) of (?P<rows>\d+) rows.*?"
    r"\((?P<first>\d+)° to (?P<last>\d+)°\)",
}
"""The first experiment as each page tells it."""


@pytest.mark.parametrize("page", EXPERIMENT, ids=lambda page: page.name)
def test_the_first_experiment_goes_as_the_page_says(page):
    found = re.search(EXPERIMENT[page], page.read_text(encoding="utf-8"), re.DOTALL)
    assert found, "the page tells the experiment in other words: change the pattern with it"
    said = {name: float(text.replace(",", ".")) for name, text in found.groupdict().items()}
    linkage = mechsheet.template("four-bar")
    motion = mechsheet.template("four-bar", {"a2": said["crank"]}).solve()
    lost = motion["theta12"][~motion.exists]
    assert (len(motion.exists), len(lost), lost[0], lost[-1]) == tuple(
        said[name] for name in ("rows", "lost", "first", "last")
    )
    assert np.allclose(np.diff(lost), 15), "one stretch, as the page says"
    values = {dimension.symbol: dimension.value for dimension in linkage.dimensions}
    assert said.get("old", 35.0) == values["a2"]
    if "most" in said:  # Grashof with equality: crank + longest = the other two
        lengths = sorted(values[name] for name in ("a1", "a3", "a4"))
        assert math.isclose(said["most"], lengths[0] + lengths[1] - lengths[2])


LESSON = {
    "lecturer.md": (
        r"each crank angle from row (\d+) on\. Row (\d+) shows.*?(F\d+) is\n\n```text\n(=.*?)\n```.*?"
        r"ends at (\d+)°\. Select A(\d+) to M(\d+), .*?to row (\d+): 360°.*?all (\d+) positions.*?above row (\d+) "
        r"instead, and fill all of row (\d+) .*?is ([\d.]+)° in rows.*?finds ([\d.]+)°.*?\(rows (\d+) to (\d+)\).*?"
        r"in row (\d+), and"
    ),
    "lecturer.tr.md": (
        r"B11'de, (\d+)\. satırdan.*? (\d+)\. satırda her sütunun.*?(F\d+) hücresi de\n\n```text\n(=.*?)\n```.*?"
        r"şimdi (\d+)°'de.*?A(\d+)'den M(\d+)'y?e kadar.*?köşesinden (\d+)\. satıra.*?\*(\d+) konumun hepsinde.*?(\d+)\. "
        r"satırın üstüne satır ekleyin ve (\d+)\. satırı .*?satırlarda ([\d,]+)°'dir.*?bakar ve ([\d,]+)° bulur.*?"
        r"\((\d+)–(\d+)\. satırlar\).*?formüllerini (\d+)\. satıra"
    ),
}
"""The lesson on one sheet as each page tells it: rows, a formula, what is said of the swing."""

TURKISH = {"EĞERHATA": "IFERROR", "DERECE": "DEGREES", "YUVARLA": "ROUND", "YOKSAY": "NA", ";": ","}


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("name", LESSON)
def test_the_lesson_on_one_sheet_goes_as_the_page_says(name):
    page = openpyxl.load_workbook(ROOT / "generated" / "four-bar-page.xlsx").worksheets[0]
    last = max(row for row in range(1, page.max_row + 1) if page.cell(row, 1).value is not None)
    first = 1 + max(row for row in range(1, last) if not str(page.cell(row, 2).value).startswith("="))
    found = re.search(LESSON[name], (DOCS / name).read_text(encoding="utf-8"), re.DOTALL)
    assert found, "the page tells the lesson in other words: change the pattern with it"
    begin, heading, cell, formula, ends, a, m, filled, rows, above, copied, rough, swing, *others = found.groups()
    for turkish, english in TURKISH.items():
        formula = formula.replace(turkish, english)
    assert formula == page[cell].value
    assert [int(begin), int(heading), cell, int(a), int(m)] == [first, first - 1, f"F{first}", last, last]
    assert [int(ends), int(filled), int(rows)] == [10 * (last - first), first + 36, 37]
    assert [int(above), int(copied), *map(int, others)] == [last, last - 1, first, last, first]
    motion = mechsheet.template("four-bar").solve()
    assert fits(float(np.ptp(motion["theta14"])), rough.replace(",", "."))
    exact = mechsheet.open_book(ROOT / "generated" / "four-bar.xlsx")
    assert fits(exact["swing"], swing.replace(",", "."))


@pytest.mark.slow
def test_what_the_class_finds():
    """Grashof's number before and after, both limits, and lengths with a better transmission angle."""
    book = mechsheet.open_book(ROOT / "generated" / "four-bar.xlsx")
    found = [f"{book['grashof_1']:+.2f}"]
    book["a_2"] = 50
    found += [f"{book['grashof_1']:+.2f}", f"{book['limit_1']:.2f}", f"{book['limit_2']:.2f}"]
    book["a_1"], book["a_2"], book["a_3"] = 85, 35, 75
    found.append(f"{book['transmission_1']:.1f}")
    for name in LESSON:
        text = (DOCS / name).read_text(encoding="utf-8").replace(",", ".").replace("−", "-")
        grashof, limits = r"(-[\d.]+) mm.*?(\+[\d.]+) mm", r"(\d{3}\.\d+)°[^°]*? (\d{3}\.\d+)°"
        (least,) = re.search(r"`a1` = 85\D*`a3` = 75\D*([\d.]+)°", text).groups()
        assert [*re.search(grashof, text).groups(), *re.search(limits, text).groups(), least] == found


def number_in(page: Path, pattern: str) -> list[str]:
    found = re.search(pattern, page.read_text(encoding="utf-8"))
    assert found, f"{page.name} says it in other words: change the pattern with it"
    return list(found.groups())


def test_the_verdict_that_the_readme_shows():
    (rows,) = number_in(ROOT / "README.md", r"closes in all (\d+) positions")
    exists = mechsheet.template("four-bar").solve().exists
    assert int(rows) == exists.sum() == len(exists)


def test_pictures_that_pages_show_are_there_and_shown():
    """No picture of a template is missing, none lies about unused."""
    shown = {
        name
        for page in (ROOT / "README.md", *DOCS.glob("*.md"))
        for name in re.findall(r"\]\((?:docs/)?pictures/([^)]+)\)", page.read_text(encoding="utf-8"))
    }
    assert shown == {path.name for path in (DOCS / "pictures").iterdir()}
    assert {f"{name}.png" for name in template_names()} <= shown


def test_counts_that_pages_promise():
    assert number_in(ROOT / "README.md", r"All (\d+) mechanisms") == [str(len(template_names()))]
    assert number_in(DOCS / "lecturer.md", r"(\d+) mechanisms") == [str(len(template_names()))]
    assert number_in(DOCS / "workbook.md", r"All (\d+)\s+templates") == [str(len(template_names()))]
    assert number_in(ROOT / "CHANGELOG.md", r"(\d+) functions") == [str(len(FUNCTIONS))]
    assert number_in(DOCS / "functions.md", r"The (\d+) functions") == [str(len(FUNCTIONS))]
    assert float(number_in(DOCS / "workbook.md", r"warning below (\d+)°")[0]) == POOR


def test_figures_of_the_readme_are_those_of_the_proof():
    formulas, share = number_in(ROOT / "README.md", r"of (\d+) formulas damaged.* noticed ([\d.]+) %")
    damaged, checked, _, noticed = number_in(
        DOCS / "proof.md", r"\*\*all\*\* \| (\d+) \| ([\d.]+)% \| ([\d.]+)% \| ([\d.]+)%"
    )
    assert (formulas, share) == (damaged, noticed)
    assert checked == "100.0", "the README says that check notices all"


def test_the_notebook_uses_public_names_only():
    notebook = json.loads((DOCS / "examples" / "four-bar.ipynb").read_text(encoding="utf-8"))
    code = "\n".join("".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code")
    assert re.findall(r"^\s*(?:from|import) (mechsheet\S*).*$", code, re.MULTILINE) == ["mechsheet"]
    assert set(re.findall(r"\bmechsheet\.(\w+)", code)) <= set(mechsheet.__all__)


CHANGE = r"^\| `(\w+)` ([\d.,]+) \| ([\d.,]+) \| ([\d.,]+) \|$"
"""A line of a table: a changed cell and its value, the mean torque, the flywheel."""

BY_HAND = re.compile(r"^\| `(\S+)` \| .* \| (-?[\d.,]+)(?: \S.*)? \|$", re.MULTILINE)
"""A line of a table: a symbol, how it is found, its value with a unit."""


def rows_of(page: str) -> dict[str, str]:
    return {name: text.replace(",", ".") for name, text in BY_HAND.findall((DOCS / page).read_text(encoding="utf-8"))}


def fits(found: float, printed: str) -> bool:
    """Half of the last printed digit may be missing."""
    return abs(found - float(printed)) <= 0.5000001 * 10.0 ** -len(printed.partition(".")[2])


def loaded(name: str, step: float | None = None) -> Compiled:
    return Compiled(mechsheet.template(name, step=step))


@pytest.mark.parametrize("page", ["positions-to-forces.md", "positions-to-forces.tr.md"])
def test_the_row_by_hand(page):
    printed, values = rows_of(page), loaded("engine").values
    assert len(printed) == 18
    row = 9
    assert math.degrees(values["theta12"][row]) == pytest.approx(90)
    for symbol, text in printed.items():
        assert fits(float(values[symbol][row]), text), symbol
    largest = float(np.max(loaded("engine", step=0.5).values["s14.v"])) / 1000
    assert fits(largest, number_in(DOCS / page, r"([\d.,]+) m/s,?\s(?:some|der)")[0].replace(",", "."))
    theirs = loaded("four-bar-forces").values
    assert fits(float(theirs["T12"][6]), number_in(DOCS / page, r"T₁₂ = (\d+[.,]\d+) lbf")[0].replace(",", "."))


@pytest.mark.slow
@pytest.mark.parametrize("page", [DOCS / "motor-sizing.md", DOCS / "motor-sizing.tr.md"], ids=lambda page: page.name)
def test_the_press_that_gets_a_motor_and_a_flywheel(page):
    printed, press = rows_of(page.name), loaded("toggle-press")
    wheel, torque = press.flywheel, press.values["T12"]
    assert fits(wheel.mean, printed["mean_torque"])
    assert fits(wheel.change, printed["energy_change"])
    assert fits(wheel.inertia, printed["flywheel"])
    assert fits(float(torque.max()), printed["largest_effort"])
    assert np.degrees(press.values["theta12"][torque.argmax()]) == pytest.approx(295)
    assert fits(max(press.values[name].max() for name in ("F34", "F14", "F56", "F35")), printed["largest_force"])
    fine = loaded("toggle-press", step=1).values
    assert fits(float(loaded("toggle-press", step=0.1).values["s16.v"].max()), printed["approach"])
    assert fits(float(fine["T12"].max()), number_in(page, r"(?:largest torque of|momenti)\s+(\d+) N m")[0])
    changes = re.findall(CHANGE, page.read_text("utf-8"), re.MULTILINE)
    assert len(changes) == 4
    text = template_text("toggle-press")
    for name, *said in changes:
        value, mean, inertia = (number.replace(",", ".") for number in said)
        other = text.replace("fluctuation = 0.1", f"fluctuation = {value}") if name == "fluctuation" else text
        other = other.replace("value = 60,", f"value = {value},") if name == "speed" else other
        found = Compiled(loads(other, overrides=Overrides({name: value} if name in ("F", "die") else {}))).flywheel
        assert fits(found.mean, mean), name
        assert fits(found.inertia, inertia), name


@pytest.mark.parametrize("page", ["chains.md", "chains.tr.md"])
def test_links_solved_all_at_once_as_the_page_says(page):
    text = re.sub(r"(?<=\d),(?=\d)", "." if page.endswith("tr.md") else ",", (DOCS / page).read_text(encoding="utf-8"))
    platform = loads(template_text("planar-3rpr"))
    (group,) = solve(platform).groups
    angles = re.findall(r"^\| \d \| (-?[\d.]+)° \|$", text, re.MULTILINE)
    found = sorted(math.degrees(start[group.system.variables.index("theta16")]) for start in group.system.starts)
    assert len(angles) == len(found) == 4
    assert all(fits(*pair) for pair in zip(found, angles, strict=True))
    far = dataclasses.replace(platform, driver=dataclasses.replace(platform.driver, values=(7.0,), speed=None))
    far = dataclasses.replace(far, sketch=Sketch(), dynamics=None)
    assert f"{len(solve(far).groups[0].assemblies)}" == re.search(r"7 m(?: there would be |'de\n)(\d)", text)[1]
    cardan = mechsheet.template("cardan-gear").solve()
    assert fits(float(np.ptp(cardan["P.x"])), re.search(r"(\d+) mm(?:, four times|'lik bir doğru)", text)[1])
    assert np.abs(cardan["P.y"]).max() < 1e-12
    turn = np.radians(cardan["theta12"])
    assert cardan["P.x"] == pytest.approx(100 * np.cos(turn), abs=1e-11)  # de la Hire's theorem
    assert cardan["R.y"] == pytest.approx(50 * np.sin(turn) + 20 * np.cos(turn), abs=1e-11)
    height = mechsheet.template("geared-five-bar").solve()["P.y"]
    low, high = re.search(r"(0\.\d+) m\s(?:and|ile) (0\.\d+) m", text).groups()
    assert fits(float(height.min()), low) and fits(float(height.max()), high)
    (off,) = re.findall(r"(0\.\d+) mm", text)
    assert 0.0005 < 1e3 * np.abs(mechsheet.template("five-bar-robot").solve()["off"]).max() < float(off)


def test_the_example_of_the_spreadsheet_library(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (example,) = re.findall(r"```python\n(.*?)```", (DOCS / "livesheet.md").read_text(encoding="utf-8"), re.DOTALL)
    exec(compile(example, "livesheet.md", "exec"), {})
    assert openpyxl.load_workbook("plan.xlsx", data_only=True)["Plan"]["C11"].value == pytest.approx(1000 * 1.05**10)


@pytest.mark.slow
def test_one_number_on_its_way():
    """What the page says of A.x at each stage is there."""
    page = (DOCS / "architecture.md").read_text(encoding="utf-8")
    mechanism = load(ROOT / "templates" / "four-bar.toml")
    compiled = Compiled(mechanism)
    plan = compiled.plan
    said = print_formula(compiled.equations.of("A.x").expression, "text")
    spot, length, angle = (plan.at.spots[name] for name in ("A.x", "a2", "theta12"))
    (fill,) = (fill for fill in compiled.workbook.sheets[1].fills if (fill.row, fill.col) == (spot.row, spot.col))
    book = read(ROOT / "generated" / "four-bar.xlsx")
    (block,) = (block for block in book.sheets[1].blocks if block.col == spot.col)
    row = spot.row + 4
    assert plan.given["theta12"][4] == pytest.approx(math.radians(60))
    assert f"`A.x = {said}`" in page
    assert f"`{print_formula(fill.formula)}`" in page
    assert (fill.rows, block.rows) == (25, 25)
    assert f"17.5 for {cell_name(row, spot.col)}:" in page
    assert [cell_name(each.row, each.col) for each in (spot, length)] == ["D4", "B12"]
    assert angle.degrees and angle.col == 1
    assert evaluate(book).get("Positions", row, spot.col) == pytest.approx(17.5)
    place = independent.solve(mechanism).points["A"][4]
    assert place == pytest.approx((17.5, 30.31), abs=5e-3)
