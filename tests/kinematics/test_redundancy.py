"""Links marked as redundant: they follow the others, and what their length misses is said."""

import numpy as np
import pytest
from laid import Laid

from livesheet.formats import write
from mechsheet.checking import check, perturb
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.text.rewrite import without_origin
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.kinematics.redundancy import redundant_links
from mechsheet.library import changed
from mechsheet.library.show import overview_text

pytestmark = pytest.mark.slow

LAMP = """
format = 1
[mechanism]
name = "double-parallelogram"
[dimensions]
a1 = 60
a2 = 150
a4 = 150
[links.ground]
points = { A0 = [0, 0], B0 = ["a1", 0], C0 = ["2*a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.follower]
points = { B0 = [0, 0], B = ["a2", 0] }
[links.third]
points = { C0 = [0, 0], C = ["a4", 0], P = { r = 80, angle = 30 } }
redundant = true
[links.coupler]
points = { A = [0, 0], B = ["a1", 0], C = ["2*a1", 0] }
[driver]
link = "crank"
start = 30
stop = 150
step = 20
speed = { value = 10, unit = "rpm" }
[assembly]
B = [190, 75]
"""
TURNED = 'points = { C = ["-a4", 0], C0 = [0, 0], P = { r = 80, angle = 30 } }'
POLAR = 'points = { C0 = [0, 0], C = { r = "a4", angle = 40 }, P = { r = 80, angle = 30 } }'
WRITTEN = {
    "as a length": LAMP,
    "turned": LAMP.replace(LAMP.splitlines()[15], TURNED),
    "polar": LAMP.replace(LAMP.splitlines()[15], POLAR),
}


def misfit(sheet, link):
    return sheet.plan.text("verdict.gap.redundant", link=link, sheet=sheet.plan.at.titles["checks"])


@pytest.mark.cases(1)
@pytest.mark.parametrize("text", WRITTEN.values(), ids=WRITTEN.keys())
def test_it_follows_and_its_length_is_checked_in_every_row(text):
    sheet = Laid(text)
    assert all(sheet.exists)
    assert sheet.spot("largest_gap") < 1e-12
    lengths = [sheet.column(each.symbol) for each in sheet.mechanism.redundant]
    assert np.abs(lengths) == pytest.approx(150.0, abs=1e-12)
    rates = sheet.plan.at.spots["omega14"]
    assert {round(sheet.values.get(rates.sheet, rates.row + row, rates.col), 9) for row in range(7)} == {
        round(10 * 2 * np.pi / 60, 9)
    }
    sheet.change(a4=151)
    assert all(sheet.exists)
    assert sheet.spot("largest_gap") == pytest.approx(1.0, abs=1e-12)
    assert sheet.words("largest_gap") == misfit(sheet, "third")
    assert sheet.verdict == sheet.words("largest_gap")


@pytest.mark.cases(2)
@pytest.mark.parametrize(
    ("place", "angle"),
    [('["a4", 0]', 30), ("[150, 0]", 30), ("[-150, 0]", -150), ('["-a4", 0]', -150), ("[0, -150]", 120)],
)
def test_its_angle_is_that_of_its_own_frame(place, angle):
    """However its second joint lies in it: the crank stands at 30 degrees, and the link beside it."""
    sheet = Laid(LAMP.replace(LAMP.splitlines()[15], f"points = {{ C0 = [0, 0], C = {place} }}"))
    assert sheet.column("theta14")[0] == pytest.approx(angle, abs=1e-9)


def test_it_is_drawn_as_a_link_and_not_as_a_slot():
    sheet = Laid(LAMP)
    (symbol,) = (each.symbol for each in sheet.mechanism.redundant)
    drawing = next(own for own in sheet.workbook.sheets if own.title == sheet.plan.at.titles["drawing"])
    names = [cell.content for cell in drawing.cells if isinstance(cell.content, str)]
    assert "third" in names
    assert not [name for name in names if symbol in name]


def test_of_a_marked_link_nothing_more_is_said():
    compiled = Compiled(loads(LAMP))
    assert not [fault for fault in doubts(compiled.mechanism, compiled.equations) if fault.key.startswith("links")]
    assert all(not group.open for group in compiled.equations.groups)


UNMARKED = LAMP.replace("redundant = true\n", "")


def test_one_that_is_not_marked_is_found_and_told():
    """Of follower and third crank either may be left out: the one described last is, and the other is named."""
    mechanism = changed.loads(UNMARKED)
    assert [each.link.name for each in mechanism.redundant] == ["third"]
    assert without_origin(mechanism.text) == LAMP.replace("redundant = true\n", "").replace(
        "[links.third]\n", "[links.third]\nredundant = true\n"
    )
    compiled = Compiled(mechanism)
    (said,) = [fault for fault in doubts(mechanism, compiled.equations) if fault.key.startswith("links")]
    assert said.key == "links.third"
    assert '"third" is redundant' in said.message
    assert said.hint.startswith('"follower" would do as well; write `redundant = true`')
    assert "redundant: third, left out" in overview_text(mechanism)


def test_it_is_checked_in_every_row_as_a_marked_one():
    sheet = Laid(changed.loads(UNMARKED).text)
    assert all(sheet.exists)
    sheet.change(a4=151)
    assert sheet.spot("largest_gap") == pytest.approx(1.0, abs=1e-12)


TWO = (
    UNMARKED.replace('C0 = ["2*a1", 0] }', 'C0 = ["2*a1", 0], D0 = ["3*a1", 0] }')
    .replace('C = ["2*a1", 0] }\n[driver]', 'C = ["2*a1", 0], D = ["3*a1", 0] }\n[driver]')
    .replace("a4 = 150\n", "a4 = 150\na5 = 150\n")
    .replace("[links.coupler]", '[links.fourth]\npoints = { D0 = [0, 0], D = ["a5", 0] }\n[links.coupler]')
)
"""Four cranks: two of them are redundant."""


def test_two_that_are_not_marked_are_found_and_each_is_checked():
    mechanism = changed.loads(TWO)
    assert [each.link.name for each in mechanism.redundant] == ["third", "fourth"]
    compiled = Compiled(mechanism)
    told = [fault for fault in doubts(mechanism, compiled.equations) if fault.key.startswith("links")]
    assert [fault.key for fault in told] == ["links.third", "links.fourth"]
    assert all(fault.hint.startswith('"follower" would do as well') for fault in told)
    sheet = Laid(mechanism.text)
    assert all(sheet.exists)
    for symbol, link in (("a4", "third"), ("a5", "fourth")):
        sheet.change(**{symbol: 151})
        assert all(sheet.exists)
        assert sheet.spot("largest_gap") == pytest.approx(1.0, abs=1e-12)
        assert sheet.verdict == sheet.words("largest_gap") == misfit(sheet, link)


@pytest.mark.parametrize(
    ("what", "old", "new"),
    [
        ("another length", "a4 = 150", "a4 = 150.01"),
        ("sketched in the other assembly, where it does not fit", "B = [190, 75]", "B = [126, 135]"),
        ("no sketch", "[assembly]\nB = [190, 75]", ""),
        ("begun where two assemblies meet", "start = 30", "start = 0"),
    ],
)
def test_where_it_is_not_certain_none_is_left_out(what, old, new):
    mechanism = changed.loads(UNMARKED.replace(old, new))
    assert not mechanism.redundant
    with pytest.raises(MechanismError, match="the mobility is"):
        _ = Compiled(mechanism).equations


@pytest.mark.cases(1)
@pytest.mark.parametrize("length", [150, 147])
def test_the_reference_and_the_search_agree(tmp_path, length):
    """Whether it fits or not."""
    compiled = Compiled(loads(LAMP.replace("a4 = 150", f"a4 = {length}")))
    path = tmp_path / "lamp.xlsx"
    write(compiled.workbook, path)
    report = check(path)
    assert all(found.agrees for found in report.comparisons)
    assert bool(report.red_line) == (length == 147)
    assert perturb(path, 2).agrees


@pytest.mark.parametrize(("count", "left_out"), [
    (0, ()), (1, (("plate0",),)), (2, (("plate1", "plate0"),)), (3, ()),
])  # fmt: skip
def test_links_that_may_be_left_out_are_found_and_none_where_nothing_or_too_much_is_in_the_way(count, left_out):
    """A crank, beside it so many plates bolted to the ground at two pins: each takes one freedom from the count."""
    plates = "".join(f"[links.plate{number}]\npoints = {{ B = [0, 0], C = [40, 0] }}\n" for number in range(count))
    text = (
        'format = 1\n[mechanism]\nname = "frame"\n[links.ground]\npoints = { A = [0, 0], B = [50, 0], C = [90, 0] }\n'
        f"[links.crank]\npoints = {{ A = [0, 0], P = [20, 0] }}\n{plates}"
        '[driver]\nlink = "crank"\nstart = 0\nstop = 90\nstep = 15\n'
    )
    assert redundant_links(loads(text)) == left_out
