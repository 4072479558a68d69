"""Several tables in one workbook: each is understood by itself, with its own dimensions and its own rows."""

from __future__ import annotations

import openpyxl
import pytest

import mechsheet
from homework.conventions import TASKS
from homework.handmade import FOUR_BAR, Table, four_bar
from mechsheet.homework.audit import audit

OTHER = tuple((label, name, 1.1 * value) for label, name, value in FOUR_BAR)
ROCKER = "ATAN2({xA}-{a1},{yA})-ACOS(({a4}^2+{s}^2-{a3}^2)/(2*{a4}*{s}))"


@pytest.fixture(scope="module")
def mechanism():
    return mechsheet.template("four-bar")


def rocker_only(step):
    """The rocker's angle and no other link's, every `step` degrees."""
    columns = {name: column for column in four_bar(t14=ROCKER) for name in [column[1]]}
    chosen = [columns[name] for name in ("deg", "fi", "xA", "yA", "s", "t14")]
    chosen[0] = ("Krank açısı (derece)", "deg", [step * n for n in range(round(360 / step) + 1)])
    return chosen


def coupler_only(**slips):
    return [column for column in four_bar(**slips) if column[1] not in ("xB", "yB", "t14", "mu")]


def both(tmp_path, first, second):
    """One workbook with two sheets, a table on each."""
    book = openpyxl.load_workbook(first.save(tmp_path / "first.xlsx"))
    other = openpyxl.load_workbook(second.save(tmp_path / "second.xlsx")).active
    sheet = book.create_sheet("İkinci")
    for row in other.iter_rows():
        for cell in row:
            if cell.value is not None:
                sheet[cell.coordinate] = cell.value
    book.save(tmp_path / "both.xlsx")
    return tmp_path / "both.xlsx"


def verdicts(found):
    return {symbol: (one.verdict, one.cells.split("!")[0]) for symbol, one in found.asked.items()}


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("given", [FOUR_BAR, OTHER], ids=["the same lengths", "lengths of its own"])
def test_asked_quantities_may_lie_in_different_tables(tmp_path, mechanism, given):
    """The angles of the smaller table were missing, or not live: its own cells were taken for nothing."""
    path = both(tmp_path, Table(FOUR_BAR, coupler_only()), Table(given, rocker_only(24.0)))
    found = audit(path, mechanism)
    assert verdicts(found) == {"theta13": ("right", "Sayfa1"), "theta14": ("right", "İkinci"), "mu": ("missing", "")}
    assert found.faults == ()


@pytest.mark.slow
def test_a_fault_is_found_in_the_table_that_has_it(tmp_path, mechanism):
    slip = "SQRT(({a1}-{xA})^2-{yA}^2)"
    path = both(tmp_path, Table(FOUR_BAR, coupler_only(s=slip)), Table(FOUR_BAR, rocker_only(24.0)))
    found = audit(path, mechanism)
    assert verdicts(found)["theta13"] == ("follows", "Sayfa1")
    assert verdicts(found)["theta14"] == ("right", "İkinci")
    assert [(fault.cells, fault.mend) for fault in found.faults] == [("Sayfa1!E9:E33", "SQRT(($B$2-C9)^2+D9^2)")]


@pytest.mark.ci
def test_a_second_attempt_that_is_right_counts(tmp_path, mechanism):
    """A first try left on its sheet is no fault of the second."""
    first = Table(FOUR_BAR, four_bar(b="ATAN2(-{yA},{a1}-{xA})"))
    found = audit(both(tmp_path, first, Table(FOUR_BAR, four_bar())), mechanism)
    assert {verdict for verdict, _ in verdicts(found).values()} == {"right"}
    assert found.faults == ()


MIRRORED = {
    "with the place": ({"t13": "{q}"}, {"theta13": "other assembly", "x_C": "other assembly"}),
    "the angle alone": ({"t13": "{q}", "xC": "{deg}+0*{t13}"}, {"theta13": "right", "x_C": "wrong"}),
    "the sharp angle, the right place": (
        {"t13": "{q}", "xC": "{a2}*COS({fi})-{a3}*COS({t13})"}, {"theta13": "right", "x_C": "right"}
    ),
}  # fmt: skip


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("how", MIRRORED)
def test_an_angle_whose_place_is_mirrored_is_of_the_other_assembly(tmp_path, how):
    """The rod at 5.35 degrees for 174.65 was right, counted clockwise, beside a pin on the wrong side of the crank."""
    changes, wanted = MIRRORED[how]
    found = audit(TASKS["slider"].save(tmp_path / "book.xlsx", changes), TASKS["slider"].mechanism)
    assert {symbol: found.asked[symbol].verdict for symbol in wanted} == wanted
    clockwise = "theta13 is counted clockwise" in found.remarks
    assert clockwise is (wanted["theta13"] == "right")
