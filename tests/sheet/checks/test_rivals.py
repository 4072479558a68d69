"""An extreme that may be beside another row than the best one, or in a spike between two rows, is said to be so."""

import re
from dataclasses import replace

import numpy as np
import pytest
from placed import places_of
from swept import four_bar, swept

from chosen import some
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from mechsheet.checking.against_search import against_search
from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides
from mechsheet.description.templates import template_names, template_text
from mechsheet.library.changed import loads
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.checks.search_rules import BEYOND
from mechsheet.sheet.plan import MEANING
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs

pytestmark = pytest.mark.slow

FORCES = template_text("four-bar-forces").partition("[summary]")[0]
SAID = " (or beyond)"


def asked(*quantities):
    """Both extremes of each."""
    return "[summary]\n" + "".join(
        f'{take}_{place} = {{ of = "{quantity}", take = "{take}" }}\n'
        for place, quantity in enumerate(quantities) for take in ("min", "max")
    )  # fmt: skip


def law(stop, rows):
    """The loaded four-bar with a cycloidal motion."""
    motion = f'start = -30\nstop = {stop}\nmotion = {{ law = "cycloidal", duration = 0.4, rows = {rows} }}\n'
    text = re.sub(r"(?m)^(start|stop|step|speed|acceleration) = .*\n", "", FORCES)
    return text.replace('[driver]\nlink = "crank"\n', f'[driver]\nlink = "crank"\n{motion}') + asked("T12")


def changed(text, **values):
    return loads(text, overrides=Overrides({name: repr(value) for name, value in values.items()}))


def shown(mechanism, name):
    """The value of a summary, and its words."""
    compiled = compiled_of(mechanism)
    spot = places_of(compiled.plan)[f"summary {name}"]
    return compiled.value(spot), str(compiled.value(replace(spot, col=MEANING)))


def test_a_torque_that_is_largest_beside_another_row():
    found, words = shown(loads(law(330, 25)), "min_0")
    truth = float(np.min(compiled_of(loads(law(330, 2401))).values["T12"]))
    assert found > truth + 50
    assert words.endswith(SAID)
    assert not shown(loads(law(330, 49)), "min_0")[1].endswith(SAID)


def test_a_quantity_of_several_waves():
    text = swept(four_bar("C.x*cos(3*theta12)"), (360, 24))
    lengths = {"a2": 22.0, "a3": 81.8, "a4": 56.9}
    found, words = shown(changed(text, **lengths), "high")
    truth = float(np.max(compiled_of(changed(swept(text, (360, 0.24)), **lengths)).values["asked"]))
    assert found < truth - 1
    assert words.endswith(SAID)
    compiled = compiled_of(changed(text, **lengths))
    book = book_of(compiled.layout)
    searched = against_search(book, evaluate(book), compiled.plan, "case")
    assert searched.agrees, "what is said to be beyond is not held against the number"


def test_an_acceleration_with_a_spike_between_two_rows():
    """Beside a change point; in no row is the transmission as bad as between two of them."""
    text = re.sub(r"(?m)^start = .*$", "start = 7", FORCES)
    text = re.sub(r"(?m)^stop = .*$", "stop = 367", re.sub(r"(?m)^step = .*$", "step = 20", text))
    mechanism = changed(text + asked("alpha14", "theta14"), a=5.0, b=15.0, c=10.0, d=19.999)
    assert shown(mechanism, "min_0")[1].endswith(SAID)
    assert not shown(mechanism, "min_1")[1].endswith(SAID)


@pytest.mark.cases(6)
@pytest.mark.parametrize("formula", ["B.x", "cos(2*theta12)*a2", "C.x", "sin(theta12)*a2"])
@pytest.mark.parametrize("rows", [(360, 15), (345, 15), (360, 20), (300, 15)])
def test_one_peak_or_several_alike_are_none_to_doubt(formula, rows):
    text = swept(four_bar(formula), rows)
    for name in ("low", "high"):
        assert not shown(loads(text), name)[1].endswith(SAID)


RIVALS = {"cam-rocker", "cam-slide", "cam-valve", "chebyshev", "klann", "roberts", "six-bar-r-rrr-rrt"}
"""Templates in which something has several extremes that are nearly alike: straight lines, the walker's foot, a cam that
rises and returns by like laws, or one whose dwells need no base circle at all."""


@pytest.mark.ci
def test_few_templates_have_doubts():
    found, names = set(), some(template_names(), 4)
    for name in names:
        compiled = compiled_of(loads(template_text(name)))
        extremes = compiled.plan.searched.extremes.values()
        found |= {name for extreme in extremes if compiled.value(extreme.doubt) == BEYOND}
    assert found == RIVALS.intersection(names)


STUDY = "[study]\nvary = { a2 = [24, 36, 4], a3 = [50, 104, 18], a4 = [56, 92, 12] }\n"


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("rows", "more"), [((360, 40), ""), ((350, 10), ""), ((280, 40), ""), ((360, 20), "speed = 10\n")]
)
def test_a_study_says_the_same(rows, more):
    text = swept(four_bar("C.x*cos(3*theta12)"), rows)
    if more:
        text = text.replace("\n[assembly]", f"{more}\n[assembly]").partition("[outputs]")[0] + asked("alpha14", "C.v")
    mechanism = loads(text + STUDY)
    designs = Designs(mechanism)
    found = kept_of(designs, 0, designs.sampling.total)
    remarks = found.remarks
    assert any("(or beyond)" in str(each) for each in remarks)
    for number in range(0, len(found.numbers), 5):
        changes = {name: float(found.columns[name][number]) for name in designs.varied}
        compiled = compiled_of(changed(mechanism.text, **changes, **designs.modes))
        for summary in mechanism.summaries:
            words = compiled.value(replace(places_of(compiled.plan)[f"summary {summary.symbol}"], col=MEANING))
            if "rows only" in words:  # its three probes have not found a limit, which a study finds by halving
                continue
            assert (SAID in str(words)) == (f"{summary.symbol}{SAID}" in str(remarks[number])), (changes, words)


def test_a_study_begins_from_the_other_end_once():
    """The best row is the first one, the best of the others the last: from there the sheet goes on, and not back."""
    text = swept(four_bar("C.x*cos(3*theta12)"), (280, 40))
    designs = Designs(
        loads(text + "[study]\nvary = { a2 = { values = [28] }, a3 = { values = [104] }, a4 = { values = [80] } }\n")
    )
    found = kept_of(designs, 0, 1).columns["high"][0]
    assert found == pytest.approx(shown(changed(text, a2=28.0, a3=104.0, a4=80.0), "high")[0], rel=1e-12)


@pytest.mark.parametrize(("a2", "sure"), [(22.0, 0.0), (34.0, 1.0)])
def test_a_table_marks_such_a_cell(a2, sure):
    text = swept(four_bar("C.x*cos(3*theta12)"), (360, 24))
    table = f'[[tables]]\nrows = {{ a3 = [81.8, 81.8] }}\ncolumns = {{ a2 = [{a2}] }}\nvalue = "high"\n'
    compiled = compiled_of(changed(text + table, a4=56.9))
    (found,) = tables_of(compiled.plan)
    helper = found.helpers.sure
    sheet = next(each for each in compiled.workbook.sheets if each.title == found.title)
    fill = next(
        each for each in sheet.fills if each.row == helper.row and each.col <= helper.col < each.col + each.cols
    )
    assert fill.value(helper.row, helper.col) == sure


def test_the_row_of_a_turn_later_that_has_the_first_ones_value():
    """The quickest return is beside 360°, where the row has the first one's value to 15 digits: the search goes on from
    there, not from the first row, beside which there is less."""
    text = template_text("six-link-dwell").replace("stop = 360", "stop = 380")
    found, words = shown(loads(text), "back")
    truth = float(np.min(compiled_of(loads(text.replace("step = 10", "step = 0.25"))).values["omega16"]))
    assert found == pytest.approx(truth, rel=1e-5)
    assert not words.endswith(SAID)
