"""Notes: equations as mathematics, one line for every symbol, and Turkish workbooks in Turkish throughout."""

import re
import tomllib

import pytest
from laid import Laid

from catalogues import pairs
from chosen import some
from folders import ROOT, TEMPLATE_NAMES
from livesheet.formula.nodes import Binary, Call, CellRef, Number, Previous, RangeRef, Symbol, Text, walk
from livesheet.formula.parser import parse_description
from livesheet.workbook import Rich
from mechsheet.description.templates import template_text
from mechsheet.sheet.mathematics import written
from mechsheet.sheet.notes import EQUATION, FORMULA, MEANING, PLACE, SYMBOL, WIDTHS

OTHERS = ("homework.", "study.", "draw.", "equation.", "step.", "solution.", "picture.")
"""How the keys begin of what is not the workbook's."""

WORDS = {key: both for key, both in pairs().items() if not key.startswith(OTHERS)}

CASES = tomllib.loads((ROOT / "tests/cases/mathematics.toml").read_text(encoding="utf-8"))["case"]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["expression"])
def test_mathematics(case):
    node = parse_description(case["expression"])
    assert written(node, "en").plain == case["en"]
    assert written(node, "tr").plain == case.get("tr", case["en"])


def test_cases_and_rows_above():
    """What a description cannot say: conditions, positions that do not exist, the row above."""
    test = Call("OR", (Binary("<", Symbol("s"), Symbol("tol")), Call("ISNUMBER", (Symbol("a"),))))
    node = Call("IF", (test, Call("NA"), Previous("phi")))
    assert written(node, "en").plain == "φ (row above); #N/A if s < tol or a is a number"
    assert written(node, "tr").plain == "φ (üst satır); s < tol veya a bir sayı ise #YOK"
    node = Call("IF", (Symbol("a"), Number(1), Number(0)))
    assert written(node, "en").plain == "1 if a; otherwise 0"


def test_subscripts_and_powers():
    parts = written(parse_description("theta13^2"), "en").parts
    assert parts == (("θ", "italic"), ("13", "sub"), ("2", "super"))


def lines(laid):
    sheet = laid.workbook.sheet(laid.plan.at.titles["notes"])
    found = {}
    for cell in sheet.cells:
        content = cell.content.plain if isinstance(cell.content, Rich) else cell.content
        found.setdefault(cell.row, {})[cell.col] = content
    return sheet, found


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "jansen", "cylinder-boom", "adjustable-pump"])
def test_one_line_for_every_symbol(name):
    laid = Laid(template_text(name))
    _, found = lines(laid)
    places = {line.get(PLACE) for line in found.values()}
    assert len([line for line in found.values() if line.get(EQUATION)]) > len(laid.plan.equations.all)
    for equation in laid.plan.equations.columns:
        place = laid.plan.at.spots[equation.symbol]
        assert any(text and text.startswith(place.sheet + " ") for text in places)
        label = equation.label.of(laid.plan.language)
        assert any(line.get(MEANING) == label and str(line[EQUATION]).startswith("=") for line in found.values()), label


@pytest.mark.slow
@pytest.mark.parametrize("name", ["adjustable-pump", "jansen"])
def test_rows_are_high_enough(name):
    """At 1.05 characters to a unit of width, every text has the lines that it needs."""
    laid = Laid(template_text(name))
    sheet, found = lines(laid)
    heights = dict(sheet.row_heights)
    high = 0
    for row, line in found.items():
        needed = max(
            (
                len(str(text)) / (WIDTHS[col] * 1.05)
                for col, text in line.items()
                if col not in (SYMBOL, FORMULA) and text
            ),
            default=0,
        )
        if needed > 1 and EQUATION in line:
            high += 1
            assert heights[row] >= 13 * needed
    assert high


@pytest.mark.slow
@pytest.mark.parametrize(("name", "said"), [("four-bar", True), ("slider-crank", False)])
def test_what_the_number_of_grashof_is(name, said):
    """A student who wants to turn a crank further learns which number must change its sign."""
    _, found = lines(Laid(template_text(name)))
    texts = [str(line.get(SYMBOL)) for line in found.values()]
    assert any("Below 0 the shortest can turn fully" in text for text in texts) == said


def test_every_word_in_both_languages():
    same = {"±", "Grashof", "", "No.", "12.5", "rad", "RSS", "± RSS", "μ min [°]"}
    same |= {"Config", "Theta"}  # the textbook calls parameters of its functions so
    for key, (english, turkish) in WORDS.items():
        assert english != turkish or english in same or not re.search(r"[^\W\d]{3}", re.sub(r"{\w+}", "", english)), key
        assert set(re.findall(r"{\w+}", english)) == set(re.findall(r"{\w+}", turkish)), key


def english_words():
    """Words that the English workbook uses and the Turkish one does not."""

    def tokens(index):
        texts = (re.sub(r"{\w+}", " ", pair[index]) for pair in WORDS.values())
        return {word for text in texts for word in re.findall(r"[^\W\d_]{3,}", text.lower())}

    kinematics = {
        "angle",
        "pins",
        "pin",
        "slide",
        "slides",
        "left",
        "right",
        "larger",
        "smaller",
        "distance",
        "area",
        "direction",
    }
    return (tokens(0) | kinematics | {"and", "coordinate", "fixed", "ground", "crank", "coupler", "rocker"}) - tokens(1)


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("name", some(TEMPLATE_NAMES, 3))
def test_turkish_throughout(name):
    """No English word in any cell, formula, comment, message, chart or sheet title of a Turkish workbook."""
    laid = Laid(template_text(name), language="tr")
    own = laid.mechanism
    given = {own.source.of("tr"), *(link.name for link in own.links), *(joint.name for joint in own.joints)}
    given |= {dim.symbol for dim in own.dimensions} | {output.symbol for output in own.outputs}
    given |= {
        "mode",
        "turns",
        "held",
        "size",
        "residual",
        "determinant",
        "turn",
        "motor",
        "sign",
    }  # symbols of equations and words that are the same in both
    given |= {load.name or "" for load in own.dynamics.loads} if own.dynamics else set()
    given |= {summary.symbol for summary in own.summaries} | {dim.cell or "" for dim in own.dimensions}
    english = english_words() - {word for text in given for word in re.findall(r"[^\W\d_]{3,}", text.lower())}
    for title, text in texts(laid):
        if title == laid.plan.at.titles["notes"] and text.startswith("="):
            continue  # the formula of a cell, whose functions and names are what they are
        found = english.intersection(re.findall(r"[^\W\d_]{3,}", text.lower()))
        assert not found, (title, text, found)


def texts(laid):
    """Every text of the workbook that a person may see."""
    for sheet in laid.workbook.sheets:
        if sheet.hidden:
            continue
        yield sheet.title, sheet.title
        for cell in sheet.cells:
            content = cell.content.plain if isinstance(cell.content, Rich) else cell.content
            if isinstance(content, str):
                yield sheet.title, content
        for fill in sheet.fills:
            for part in walk(fill.formula):
                if isinstance(part, Text):
                    yield sheet.title, part.value
        for comment in sheet.comments:
            yield sheet.title, comment.text
        for rule in sheet.validations:
            yield sheet.title, " ".join((rule.input_title, rule.input_message, rule.error_title, rule.error_message))
        for chart in sheet.charts:
            yield sheet.title, " ".join((chart.title, chart.x_axis.title, chart.y_axis.title))


@pytest.mark.slow
def test_what_may_be_deleted_is_read_by_nobody():
    """The notes say that they and two-way tables may go: no formula of another sheet reads them."""
    compiled = Laid(template_text("adjustable-pump"))
    titles = [sheet.title for sheet in compiled.workbook.sheets]
    free = [title for title in titles if title == compiled.plan.at.titles["notes"] or title.startswith("Tablo")]
    assert len(free) == 2
    for sheet in compiled.workbook.sheets:
        for fill in sheet.fills:
            for part in walk(fill.formula):
                spot = part.start if isinstance(part, RangeRef) else part
                assert not (isinstance(spot, CellRef) and spot.sheet in free and spot.sheet != sheet.title)
