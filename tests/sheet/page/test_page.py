"""The layout of one sheet: the values of several sheets, formulas as on the blackboard, nothing that it needs elsewhere."""

import math
from dataclasses import replace
from itertools import accumulate, pairwise

import numpy as np
import pytest
from placed import places_of

import mechsheet
from chosen import ITERATED, LOADED, STEPWISE, but, part
from folders import ROOT, TEMPLATE_NAMES
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from livesheet.formats import read
from livesheet.formula.nodes import CellRef, NameRef, RangeRef, shifted, walk
from livesheet.formula.printer import print_formula
from livesheet.workbook import Fill
from mechsheet.checking import check
from mechsheet.checking.cells import compare_cells
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.equations import RATES
from mechsheet.sheet.page.paper import ACROSS, DOWN, NARROW, SEVERAL, cut_down, on_paper, pixels
from mechsheet.sheet.page.plan import ROW_HEIGHT
from mechsheet.sheet.plan import VALUE
from office_macros import Job, with_macros
from published.printed_numbers import dimensions, table
from random_mechanisms import Grower

TEMPLATES = but(TEMPLATE_NAMES, *ITERATED, *STEPWISE)
DISTANT = 1e-9
"""Of the size, or rad: what the rounding of cosines leaves where no triangle is within 0.03 degrees of a dead centre."""

KITE = (
    'format = 1\n[mechanism]\nname = "kite"\n[dimensions]\na1 = 60\na2 = 60\na3 = 70\na4 = 70\n'
    '[links.ground]\npoints = { A0 = [0, 0], B0 = ["a1", 0] }\n[links.crank]\npoints = { A0 = [0, 0], A = ["a2", 0] }\n'
    '[links.coupler]\npoints = { A = [0, 0], B = ["a3", 0] }\n[links.rocker]\npoints = { B0 = [0, 0], B = ["a4", 0] }\n'
    '[driver]\nlink = "crank"\nstart = -360\nstop = 360\nstep = 15\n'
)


class Page:
    """A description in this layout, and the values of its cells."""

    def __init__(self, text, language=None, names=False, **overrides):
        mechanism = loads(
            text, overrides=Overrides({key: str(value) for key, value in overrides.items()}, language=language)
        )
        self.mechanism = replace(mechanism, layout="page", references="names" if names else "anchors")
        self.compiled = Compiled(self.mechanism)
        self.workbook, self.plan = self.compiled.layout, self.compiled.plan
        self.sheet = self.workbook.sheets[0]
        self.values = evaluate(book_of(self.workbook))

    def column(self, symbol):
        """The cells of a column as numbers in internal units, NaN where there is none."""
        spot = self.plan.at.spots[symbol]
        cells = self.values.column(spot.sheet, spot.col, self.plan.at.first, self.plan.at.last)
        found = np.array([cell if isinstance(cell, float) else math.nan for cell in cells])
        return np.radians(found) if spot.degrees else found

    def cell(self, key):
        spot = places_of(self.plan)[key]
        return self.values.get(spot.sheet, spot.row, spot.col)

    def change(self, **symbols):
        """Type numbers (as shown) into input cells, None empties one."""
        places = places_of(self.plan)
        spots = {places[symbol]: value for symbol, value in symbols.items()}
        changes = {
            (spot.sheet, spot.row, spot.col): None if value is None else float(value) for spot, value in spots.items()
        }
        self.values = evaluate(book_of(self.workbook), changes)
        return self

    def said(self):
        return [
            self.values.get(self.plan.main, row, self.plan.status_column)
            for row in range(self.plan.at.first, self.plan.at.last + 1)
        ]

    def formulas(self):
        return [fill.formula for fill in self.sheet.fills]


def worst(page):
    """The largest difference of any column from the equations' own values; rows that do not exist must be the same ones."""
    found = 0.0
    nominal = page.plan.nominal
    for column in page.plan.columns:
        if column.kind == "equation" and column.symbol in nominal:
            ours, theirs = page.column(column.symbol), nominal[column.symbol]
            assert (np.isnan(ours) == np.isnan(theirs)).all(), column.symbol
            scale = page.plan.size if column.equation.unit.kind == "length" else 1.0
            if column.equation.role in RATES:  # of any size, and less certain beside a dead centre
                scale = max(1.0, float(np.nanmax(np.abs(theirs), initial=0.0)))
            found = max(found, float(np.nanmax(np.abs(ours - theirs), initial=0.0)) / scale)
    return found


@pytest.mark.cases(12)
@pytest.mark.parametrize("name", TEMPLATES)
def test_values_are_those_of_the_equations(name):
    page = Page(template_text(name))
    assert worst(page) < (1e-6 if name in LOADED else DISTANT)  # near dead centres forces magnify what ACOS loses
    assert page.said() == [
        "" if closed else word for closed, word in zip(page.compiled.closed, page.said(), strict=True)
    ]
    assert page.cell("rows_closed") == np.count_nonzero(page.compiled.closed)


@pytest.mark.slow
@pytest.mark.cases(8)
@pytest.mark.parametrize("seed", part(range(30), of=3))
def test_values_of_random_mechanisms(seed):
    page = Page(Grower(seed, 1 + seed % 4).text())
    assert worst(page) < DISTANT
    assert [word == "" for word in page.said()] == page.compiled.closed.tolist()


@pytest.mark.parametrize(("column", "s1"), [(1, 20), (3, 100), (6, 250)])
def test_pump_prints_the_texts_table(column, s1):
    published = table("adjustable-pump")
    assert np.max(np.abs(Page(template_text("adjustable-pump"), s1=s1).column("s15") - published[:, column])) < 6e-5


def test_fivelink_prints_the_texts_table():
    published = table("fivelink")
    page = Page(template_text("fivelink"))
    page.change(**{"start": -math.degrees(dimensions("fivelink")["alpha1"])})
    for symbol, column in (("theta13", 2), ("theta15", 4)):
        assert np.max(np.abs(np.remainder(page.column(symbol), math.tau) - published[:, column])) < 3e-7


def test_four_bar_is_the_texts_table():
    """Its own formulas, column by column: s cos(phi), s sin(phi), s, phi, psi, mu, theta14, theta13."""
    page = Page(template_text("four-bar"))
    a1, a2, a3, a4 = 70.0, 35.0, 62.3, 56.0
    theta = np.radians(np.arange(25) * 15.0)
    x, y = a2 * np.cos(theta) - a1, a2 * np.sin(theta)
    s, phi = np.hypot(x, y), np.unwrap(np.arctan2(y, x))
    psi = np.arccos((a4**2 + s**2 - a3**2) / (2 * a4 * s))
    mu = np.arccos((a3**2 + a4**2 - s**2) / (2 * a3 * a4))
    expected = {
        "s_x": x,
        "s_y": y,
        "s": s,
        "phi": phi,
        "psi": psi,
        "mu_1": mu,
        "theta14": phi - psi,
        "theta13": phi - psi - mu,
    }
    assert [column.symbol for column in page.plan.columns][1:9] == list(expected)
    for symbol, column in expected.items():
        assert np.max(np.abs(page.column(symbol) - column)) < 1e-11, symbol


def test_formulas_are_those_of_the_blackboard():
    page = Page(template_text("four-bar"))
    first = page.plan.at.first
    found = {fill.col: print_formula(fill.formula) for fill in page.sheet.fills if fill.row == first}
    row = first + 1
    assert found[1] == f"$B$5*COS(RADIANS(A{row}))-$B$4"
    assert found[5] == f"IFERROR(DEGREES(ACOS(ROUND(($B$7^2+D{row}^2-$B$6^2)/(2*$B$7*D{row}),12))),NA())"
    assert found[7] == f"E{row}-$B$12*F{row}"


@pytest.mark.cases(6)
@pytest.mark.parametrize("name", TEMPLATES)
def test_formulas_of_the_table_are_short(name):
    """Loads are as long as the description has them."""
    page = Page(template_text(name))
    longest = 400 if name in LOADED else 160
    table = [fill for fill in page.sheet.fills if fill.row >= page.plan.at.first and fill.col < len(page.plan.columns)]
    assert max(len(print_formula(fill.formula)) for fill in table) <= longest


@pytest.mark.cases(11)
@pytest.mark.parametrize("name", TEMPLATES)
def test_no_formula_reads_another_sheet_or_a_name(name):
    """So the sheet can be copied into any workbook and leaves no link behind. Names are for those who read it."""
    page = Page(template_text(name))
    named = {(name.row, name.col) for name in page.workbook.names}
    assert {(row, VALUE) for row in page.plan.blocks["dimensions"].rows.values()} <= named
    tables = [False for request in page.plan.mechanism.tables if not request.of_summary]
    assert [sheet.hidden for sheet in page.workbook.sheets] == [False, *tables, True]
    trees = [*page.formulas(), *(rule.condition for rule in page.sheet.conditionals)]
    for part_ in (part_ for tree in trees for part_ in walk(tree)):
        assert not isinstance(part_, NameRef)
        if isinstance(part_, CellRef):
            assert part_.sheet is None
        if isinstance(part_, RangeRef):
            assert part_.start.sheet is None


def test_names_on_request():
    page = Page(template_text("four-bar"), names=True)
    assert {"a_1", "a_2", "mode_1", "start", "step"} <= {name.name for name in page.workbook.names}
    assert worst(page) < DISTANT
    assert any(isinstance(part_, NameRef) for tree in page.formulas() for part_ in walk(tree))


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["four-bar", "slider-crank", "inverted-slider-crank", "adjustable-pump", "klann", "drag-link"]
)
def test_a_row_filled_down_by_hand_computes(name):
    """The last row copied down: angles go on, and what is said of the rows counts it."""
    text = template_text(name)
    page, longer = Page(text), Page(text)
    last, more = page.plan.at.last, 3
    copies = [
        Fill(last + 1, fill.col, shifted(fill.formula, last + 1 - fill.row), rows=more)
        for fill in page.sheet.fills
        if fill.row + fill.rows - 1 == last and fill.col < len(page.plan.columns)
    ]
    sheet = replace(page.sheet, fills=(*page.sheet.fills, *copies))
    page.values = evaluate(book_of(replace(page.workbook, sheets=(sheet, *page.workbook.sheets[1:]))))
    driver = longer.mechanism.driver
    step = longer.plan.driver[1] - longer.plan.driver[0]
    values = (*longer.plan.driver, *(longer.plan.driver[-1] + (n + 1) * step for n in range(more)))
    expected = Compiled(replace(longer.mechanism, driver=replace(driver, values=tuple(values)))).values
    for column in page.plan.columns:
        if column.kind == "equation" and column.symbol in expected:
            spot = page.plan.at.spots[column.symbol]
            cells = np.array(page.values.column(spot.sheet, spot.col, last + 1, last + more), float)
            found = np.radians(cells) if spot.degrees else cells
            apart = found - expected[column.symbol][-more:]
            if spot.degrees:  # how many turns stand in an angle is chosen over all rows: it goes on from the row above
                assert np.max(np.abs(np.diff(np.append(page.column(column.symbol)[-1:], found)))) < 1, column.symbol
                apart = np.remainder(apart + math.pi, math.tau) - math.pi
            assert np.max(np.abs(apart)) < 1e-8 * page.plan.size, column.symbol
    assert page.cell("rows_closed") == page.plan.rows + more


def test_continuous_angles_do_not_jump():
    page = Page(template_text("drag-link"))
    for symbol in ("theta13", "theta14"):
        assert np.max(np.abs(np.diff(page.column(symbol)))) < math.radians(60)


def test_pins_that_coincide_leave_no_position():
    """A kite folded onto itself: at -360, 0 and 360 degrees a link can turn about both pins."""
    page = Page(KITE)
    theta = page.plan.nominal["theta14"]
    apart = (
        np.remainder(page.column("theta14") - theta + math.pi, math.tau) - math.pi
    )  # it begins anew after such a row
    assert np.nanmax(np.abs(apart)) < DISTANT
    assert np.flatnonzero([word != "" for word in page.said()]).tolist() == [0, 24, 48]
    assert page.said()[24] == "undetermined: coupler, rocker"


def test_dead_centre_is_a_position():
    """Links in a line: the cosine is 1 + 1e-16 and no error."""
    text = template_text("chebyshev")
    page = Page(text)
    assert page.compiled.closed[[0, -1]].all()
    assert page.said()[0] == page.said()[-1] == ""


def test_a_row_that_does_not_exist_says_so_and_nothing_else_does():
    page = Page(template_text("four-bar"), a2=75)
    closed = page.compiled.closed
    assert 0 < np.count_nonzero(closed) < len(closed)
    assert worst(page) < DISTANT
    assert np.isfinite(page.column("s")).all()
    assert page.cell("verdict").startswith(f"closes in {np.count_nonzero(closed)} / 25 positions; ")


@pytest.mark.parametrize(
    ("typed", "named"), [({"a3": 0}, "a₃"), ({"a4": -5}, "a₄"), ({"a2": None}, "a₂"), ({"mode_1": 0.5}, "mode₁")]
)
def test_an_input_that_is_none_shows_no_position(typed, named):
    page = Page(template_text("four-bar")).change(**typed)
    assert np.isnan(page.column("theta14")).all()
    assert page.cell("verdict").startswith(f"look at {named}: ")
    assert page.cell("rows_closed") == 0


def test_verdict_says_rows_only():
    page = Page(template_text("four-bar"))
    (note,) = [comment for comment in page.sheet.comments if comment.text.startswith("Grashof: shortest + longest")]
    assert next(cell for cell in page.sheet.cells if (cell.row, cell.col) == (note.row, note.col)).content == "Grashof"
    said = page.cell("verdict")
    assert said.startswith("closes in all 25 positions; A0ABB0: crank-rocker, crank can turn fully; ")
    assert said.endswith("; transmission angle: worst 33.9° at 0° (below 40°: poor) (rows only)")
    assert (
        Page(template_text("four-bar"), "tr")
        .cell("verdict")
        .startswith("25 konumun hepsinde kapanıyor; A0ABB0: krank-sarkaç")
    )


def test_many_rows_do_not_add_up_rounding():
    page = Page(template_text("four-bar").replace("step = 15", "step = 0.1"))
    assert page.plan.rows == 3601
    driver = [page.values.get(page.plan.main, row, 0) for row in range(page.plan.at.first, page.plan.at.last + 1)]
    assert driver == [0.1 * row for row in range(3601)]
    assert worst(page) < DISTANT


def test_without_the_drawing():
    page = Page(template_text("four-bar").replace("[workbook]", "[workbook]\ndrawing = false"))
    assert "drawing" not in [chart.name for chart in page.sheet.charts]
    assert max(fill.col for fill in page.sheet.fills if fill.col != page.plan.marks) < len(page.plan.columns)
    assert not any(column.hidden for column in page.sheet.columns)
    assert worst(page) < DISTANT


@pytest.mark.parametrize("name", ["four-bar", "fivelink", "scissor-lift", "elliptic-trammel"])
def test_drawing_stays_in_its_window(name):
    """At every row that exists, all of it; and the corners are where the points are."""
    page = Page(template_text(name))
    drawing = next(chart for chart in page.sheet.charts if chart.name == "drawing")
    for position in (0, page.plan.rows // 3, page.plan.rows - 1):
        page.change(**{"position": position})
        for series in drawing.series:
            for place in (series.x, series.y):
                area = place.area
                cells = page.values.column(place.sheet, area.first_col, area.first_row, area.last_row)
                assert all(isinstance(cell, float) and abs(cell) <= 1.001 for cell in cells), (series.name, cells)


@pytest.mark.parametrize("name", ["quick-return-slider", "slider-crank", "four-bar", "fivelink", "jansen"])
def test_it_can_be_read_on_paper(name):
    """Letters of 10 points are at least 6.5 high, on one sheet of A4 or on several; no chart lies across two of them."""
    page = Page(template_text(name))
    sheet, setup = page.sheet, page.sheet.print_setup
    widths = {col: pixels(column.width) for column in sheet.columns for col in range(column.first, column.last + 1)}
    across = [0, *accumulate(widths[col] for col in range(setup.area.last_col + 1))]
    heights = dict(sheet.row_heights)
    down = [0.0, *accumulate(heights.get(row, ROW_HEIGHT) for row in range(setup.area.last_row + 1))]
    if not setup.scale:
        assert (setup.fit_width, setup.fit_height, setup.page_at, setup.row_at) == (1, 1, (), ())
        assert min(ACROSS / across[-1], DOWN / down[-1]) >= 0.65
    else:
        assert (setup.fit_width, setup.fit_height) == (0, 0)
        assert setup.scale >= 65
    columns = [across[col] for col in (0, *setup.page_at, -1)]
    rows = [down[row] for row in (0, *setup.row_at, -1)]
    if setup.scale:
        assert max(after - before for before, after in pairwise(columns)) * setup.scale / 100 <= ACROSS + 1
        assert max(after - before for before, after in pairwise(rows[1:])) * setup.scale / 100 <= DOWN + 1
    table = [after - before for before, after in pairwise([row for row in setup.row_at if row >= page.plan.at.first])]
    assert all(count >= 5 for count in table)
    for chart in sheet.charts:
        left, top = across[chart.anchor.col] + chart.anchor.dx, down[chart.anchor.row] + chart.anchor.dy
        assert any(begin <= left and left + chart.anchor.width <= end for begin, end in pairwise(columns)), chart.title
        assert any(begin <= top and top + chart.anchor.height <= end for begin, end in pairwise(rows)), chart.title


def test_a_chart_that_would_be_cut_begins_on_the_next_sheet_of_paper():
    tall = cut_down({0: 60.0, 1: 400.0}, 1, 2, 80, 17)
    found = on_paper([10.0] * 40, tall, 60, 300, 1, 6)
    edges = [sum(pixels(10.0 if col < 40 else NARROW) for col in range(begin)) for begin in found.begins]
    assert edges
    assert not any(box.x < edge < box.right for box in found.charts for edge in edges)
    low = cut_down({0: 60.0, 1: 400.0}, 1, 2, 20, 17)
    assert on_paper([10.0] * 12, low, 60, 300, 1, 1).scale == 0


@pytest.mark.parametrize("rows", [25, 30, 73, 100, 361])
@pytest.mark.parametrize("above", [300.0, 700.0, 1300.0])
def test_no_sheet_of_paper_has_two_rows(above, rows):
    down = cut_down({0: 50.0, 1: above, 2: 60.0}, 2, 3, rows, 17)
    edges = [3, *(row for row in down.rows if row > 3), 3 + rows]
    counts = [after - before for before, after in pairwise(edges)]
    assert sum(counts) == rows
    assert min(counts) >= 5 or not down.rows
    assert max(counts) * 17 * SEVERAL <= DOWN


def test_helpers_are_folded_away():
    page = Page(template_text("four-bar"))
    hidden = [column for column in page.sheet.columns if column.hidden]
    assert len(hidden) == 1
    assert hidden[0].level == 1
    assert hidden[0].first > page.plan.status_column


# --- files and other programs --------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_check_agrees_with_a_file_of_one_sheet(tmp_path):
    paths = mechsheet.build(mechsheet.load(ROOT / "templates/four-bar.toml"), tmp_path, ("xlsx", "ods"), layout="page")
    for path in paths:
        assert check(path).agrees


@pytest.mark.libreoffice
def test_libreoffice_computes_and_copies_the_sheet(tmp_path):
    """Recalculated as it is; copied into another document; with a hundred rows and more, which it takes in groups."""
    four_bar = mechsheet.load(ROOT / "templates/four-bar.toml")
    rows = loads(template_text("four-bar").replace("step = 15", "step = 1"))
    paths = [
        *mechsheet.build(four_bar, tmp_path / "small.xlsx", layout="page"),
        *mechsheet.build(rows, tmp_path / "rows.ods", layout="page"),
    ]
    jobs = [Job(paths[0]), Job(paths[1]), Job(paths[0], copied=True)]
    for job, answer in zip(jobs, with_macros(jobs), strict=True):
        book = read(job.document)
        own = replace(book, sheets=book.sheets[:1]) if job.copied else book
        compared = compare_cells("libreoffice", own, evaluate(own), answer.get)
        assert compared.agrees, (job, compared)
        assert compared.cells > 400


@pytest.mark.gnumeric
@pytest.mark.parametrize("name", ["four-bar", "slider-crank"])
def test_gnumeric_agrees(name, tmp_path):
    (path,) = mechsheet.build(mechsheet.load(ROOT / f"templates/{name}.toml"), tmp_path / "page.xlsx", layout="page")
    assert check(path, ["gnumeric"]).agrees


def test_velocities_follow_the_positions():
    text = template_text("slider-crank").replace(
        "[driver]", '[driver]\nspeed = { value = 90, unit = "rpm" }\nacceleration = 2'
    )
    page = Page(text)
    symbols = [column.symbol for column in page.plan.columns]
    assert symbols.index("theta13") < symbols.index("D") < symbols.index("omega13") < symbols.index("mu")
    motion = mechsheet.loads(text).solve()
    for symbol in ("omega13", "alpha13", "s14.v", "s14.a", "C.v", "C.a"):
        assert page.column(symbol) == pytest.approx(motion[symbol], rel=1e-9, abs=1e-9), symbol
    at = page.plan.at
    for column in page.plan.columns:
        if column.equation is not None and column.equation.role in ("coefficient", "rate"):
            fill = next(fill for fill in page.sheet.fills if (fill.row, fill.col) == (at.first, column.col))
            assert len(print_formula(fill.formula, "excel")) <= 130
    folded = KITE.replace("a1 = 60\na2 = 60\na3 = 70\na4 = 70", "a1 = 70\na2 = 35\na3 = 70\na4 = 35")
    folded = folded.replace("start = -360", "speed = 1\nstart = 150").replace("stop = 360", "stop = 195")
    assert np.isnan(Page(folded).column("omega13")).tolist() == [False, False, True, False]


def test_forces_follow_the_velocities():
    """Masses and loads are inputs on top; the columns are those of the sheets, and can be read."""
    text = template_text("four-bar").replace("[driver]", "[driver]\nspeed = 20")
    text = text.replace("[links.coupler]", "[links.coupler]\nmass = 2\ncenter = [30, 10]\ninertia = 1e-3")
    text += '[[loads]]\nname = "P"\nlink = "rocker"\ntorque = 3\n'
    page = Page(text)
    symbols = [column.symbol for column in page.plan.columns]
    assert symbols.index("omega14") < symbols.index("G3.x") < symbols.index("F34") < symbols.index("T12")
    motion = mechsheet.loads(text).solve()
    for symbol in ("F34", "F34.x", "F14", "F12.y", "T12", "T12.work"):
        assert page.column(symbol) == pytest.approx(motion[symbol], rel=1e-9, abs=1e-9), symbol
    for column in page.plan.columns:
        if column.equation is not None and column.equation.role in ("dynamic", "force") and column.symbol != "T12.work":
            fill = next(fill for fill in page.sheet.fills if (fill.row, fill.col) == (page.plan.at.first, column.col))
            assert len(print_formula(fill.formula, "excel")) <= 130
    assert {"m_3", "J_3", "P"} <= page.plan.at.spots.keys()


def test_the_hodograph_is_drawn_true_to_scale():
    """A description that asks for one has it on a page, too: both axes alike, the vector of the row that is drawn."""
    text = (
        template_text("slider-crank").replace("[driver]", "[driver]\nspeed = 5") + '\n[[charts]]\nhodographs = ["C"]\n'
    )
    page = Page(text)
    chart = next(chart for chart in page.sheet.charts if chart.title == "Hodograph of C")
    assert chart.anchor.width == chart.anchor.height
    assert chart.inner[2] == chart.inner[3]

    def numbers(series):
        cells = []
        for ref in (series.x, series.y):
            rows = range(ref.area.first_row, ref.area.last_row + 1)
            cells.append([page.values.get(ref.sheet, row, ref.area.first_col) for row in rows])
        return np.array(cells, float).T

    curve, vector = (numbers(next(each for each in chart.series if len(numbers(each)) == n)) for n in (25, 2))
    motion = mechsheet.loads(text).solve()
    velocity = np.column_stack([motion["C.vx"], motion["C.vy"]])
    scale = np.ptp(curve[:, 0]) / np.ptp(velocity[:, 0])
    assert curve - vector[0] == pytest.approx(velocity * scale, abs=1e-9)
    assert vector[1] == pytest.approx(curve[0])
    assert np.max(np.abs(np.vstack([curve, vector]))) <= 1


TWO_GROUPS = KITE.replace("start = -360\nstop = 360\nstep = 15", "start = 40\nstop = 100\nstep = 10") + (
    '[links.rod]\npoints = { B = [0, 0], C = [60, 0] }\n[links.ram]\npoints = { C = [0, 0] }\n'
    '[[joints]]\ntype = "prismatic"\nlink = "ram"\non = "ground"\npoint = "C"\nthrough = [0, 0]\nsymbol = "s"\n'
    '[assembly]\nB = [80, 66]\nC = [110, 0]\n[outputs]\ntwice = { formula = "2*theta14", unit = "deg" }\n[summary]\n'
    + "".join(f'{take}_ = {{ of = "{of}", take = "{take}" }}\n' for take, of in {
        "max": "theta14", "range": "theta14", "min": "twice", "mean": "theta14", "last": "theta14", "first": "A.x",
    }.items())
)  # fmt: skip


def test_numbers_of_all_rows_leave_out_those_that_another_group_ends():
    """The four-bar goes on where the rod no longer reaches the slide's line: these are no positions of the mechanism."""
    page = Page(TWO_GROUPS)
    there = [said == "" for said in page.said()]
    assert any(there) and not all(there)
    angle, crank = page.column("theta14"), page.column("A.x")
    assert np.isfinite(angle).all()
    angle, crank = np.degrees(angle[there]), crank[there]
    wanted = {
        "max": angle.max(),
        "range": np.ptp(angle),
        "min": 2 * angle.min(),
        "mean": np.mean((angle[1:] + angle[:-1]) / 2),
        "last": angle[-1],
    }
    wanted["first"] = crank[0]
    rows = page.plan.blocks["summary"].rows
    found = {take: page.values.get(page.plan.main, rows[f"{take}_"], 1) for take in wanted}
    assert found == pytest.approx(wanted, rel=1e-12)
    mu = np.degrees(page.column("theta14") - page.column("theta13"))[there]
    assert page.cell("transmission_1") == pytest.approx(np.minimum(mu % 180, 180 - mu % 180).min(), rel=1e-9)


@pytest.mark.parametrize(
    ("template", "unit", "places"), [("five-bar-robot", "deg", "0.00"), ("four-bar", "rad", "0.0000")]
)
def test_what_is_given_row_by_row_looks_alike_in_both_layouts(template, unit, places):
    """Over it stands what it is, and it has the decimals of its unit: 0.2618 rad, not 0.3."""
    text = (
        (ROOT / "templates" / f"{template}.toml")
        .read_text("utf-8")
        .replace("[dimensions]", f'angle_unit = "{unit}"\n\n[dimensions]', 1)
    )
    found = {}
    for layout in ("sheets", "page"):
        made = Compiled(loads(text, overrides=Overrides(layout=layout)))
        plan, driver = made.plan, made.mechanism.driver
        for symbol in (driver.symbol, *made.mechanism.given_by_row):
            spot = plan.at.spots[symbol]
            sheet = next(sheet for sheet in made.layout.sheets if sheet.title == spot.sheet)
            over = {cell.content or "" for cell in sheet.cells if (cell.row, cell.col) == (plan.at.first - 1, spot.col)}
            styled = {getattr(part.style, "number_format", "") for part in (*sheet.cells, *sheet.fills)
                      if (part.row, part.col) == (plan.at.first, spot.col) }  # fmt: skip
            found.setdefault(symbol, []).append((over, styled))
    assert found
    for symbol, (sheets, page) in found.items():
        assert sheets == page, symbol
        assert sheets[1] <= {places, "General"}
