"""Workbooks made by hand in many ways: what is right is never blamed, a fault is found where it is, and mended."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest

import mechsheet
from chosen import first
from command_line import printed
from homework.handmade import FOUR_BAR, STEPS, Table, four_bar
from homework.plain_export import plain_book
from homework.shaper import SHAPER, shaped
from mechsheet import description
from mechsheet.homework.audit import FaultFound, audit, audited, fault_line
from mechsheet.homework.expected_values import asked_of
from mechsheet.homework.formula_strips import upright

ASKED = ("theta13", "theta14", "mu")


@pytest.fixture(scope="module")
def mechanism():
    return mechsheet.template("four-bar")


def judged(tmp_path, mechanism, table):
    return audit(table.save(tmp_path / "book.xlsx"), mechanism)


def verdicts(found):
    return {symbol: one.verdict for symbol, one in found.asked.items()}


RIGHT = dict.fromkeys(ASKED, "right")

HALF_ANGLE = {
    "b": "2*{a3}*({a1}-{xA})", "g": "-2*{a3}*{yA}",
    "t13": "2*ATAN2({b}+({a3}^2+{s}^2-{a4}^2)/1,{g}+SQRT({b}^2+{g}^2-({a3}^2+{s}^2-{a4}^2)^2))",
}  # fmt: skip

DESCRIBED = (("", "a1", 70.0), ("", "a2", 35.0), ("", "a3", 62.3), ("", "a4", 56.0))
"""The description's own numbers: without a word beside them only these can be recognised."""

STYLES = {
    "down": Table(FOUR_BAR, four_bar()),
    "to the right": Table(FOUR_BAR, four_bar(), across=True),
    "two sheets": Table(FOUR_BAR, four_bar(), two_sheets=True),
    "names": Table(FOUR_BAR, four_bar(), names=True),
    "no headings": Table(FOUR_BAR, four_bar(), headings=False),
    "no words at all": Table(DESCRIBED, four_bar(), headings=False, labels=False),
    "short pi": Table(FOUR_BAR, four_bar(fi="{deg}*3.1415926/180")),
    "half the angle": Table(FOUR_BAR, four_bar(**HALF_ANGLE)),
    "clockwise by choice": Table(FOUR_BAR, four_bar(mu="{t13}-{t14}")),
    "degrees": Table(FOUR_BAR, four_bar(t14="DEGREES(ATAN2({xB}-{a1},{yB}))", mu="{t14}-DEGREES({t13})")),
    "centimetres": Table([(a, b, c / 10) for a, b, c in FOUR_BAR], four_bar()),
}


@pytest.mark.parametrize("style", first(list(STYLES), 4))
def test_what_is_right_is_never_blamed(tmp_path, mechanism, style):
    found = judged(tmp_path, mechanism, STYLES[style])
    assert verdicts(found) == RIGHT
    assert found.faults == ()
    assert (found.plain, found.follow_through) == (3, 3)


def newton(mechanism, count=3):
    """Both angles by Newton's method on the closure f, g = 0 from typed starting values, iteration after iteration."""
    own = mechsheet.template("four-bar", {"a1": 100, "a2": 35, "a3": 70, "a4": 80}).solve()
    start = {name: [round(math.radians(value), 1) for value in own[name]] for name in ("theta13", "theta14")}
    columns = [("aci", "deg", STEPS), ("rad", "fi", "RADIANS({deg})")]
    columns += [("ilk 3", "p0", start["theta13"]), ("ilk 4", "q0", start["theta14"])]
    for k in range(count):
        p, q = f"{{p{k}}}", f"{{q{k}}}"
        columns += [
            (f"f{k}", f"f{k}", f"{{a2}}*COS({{fi}})+{{a3}}*COS({p})-{{a1}}-{{a4}}*COS({q})"),
            (f"g{k}", f"g{k}", f"{{a2}}*SIN({{fi}})+{{a3}}*SIN({p})-{{a4}}*SIN({q})"),
            (f"p{k + 1}", f"p{k + 1}", f"{p}+(COS({q})*{{f{k}}}+SIN({q})*{{g{k}}})/({{a3}}*SIN({p}-{q}))"),
            (f"q{k + 1}", f"q{k + 1}", f"{q}+(COS({p})*{{f{k}}}+SIN({p})*{{g{k}}})/({{a4}}*SIN({p}-{q}))"),
        ]
    last = f"{{p{count}}}", f"{{q{count}}}"
    return [*columns, ("theta13", "t13", last[0]), ("theta14", "t14", last[1]), ("mu", "mu", f"{last[1]}-{last[0]}")]


@pytest.mark.ci
def test_newtons_method_in_columns_is_right(tmp_path, mechanism):
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, newton(mechanism)))
    assert verdicts(found) == RIGHT
    assert found.faults == ()


SLIPS = {
    "term twice": ({"fi": "RADIANS({deg})-{a2}/100"}, "B9:B33", "RADIANS(A9)"),
    "degrees": ({"fi": "{deg}"}, "B9:B33", "RADIANS(A9)"),
    "pi": ({"fi": "{deg}*3.14/180"}, "B9:B33", "A9*PI()/180"),
    "sine": ({"xB": "{xA}+{a3}*SIN({t13})"}, "I9:I33", "C9+$B$4*COS(H9)"),
    "bracket": ({"g": "ACOS(({a3}^2+{s}^2-{a4}^2)/2*{a3}*{s})"}, "G9:G33", "ACOS(($B$4^2+E9^2-$B$5^2)/(2*$B$4*E9))"),
    "exchanged": ({"g": "ACOS(({a4}^2+{s}^2-{a3}^2)/(2*{a3}*{s}))"}, "G9:G33", "ACOS(($B$4^2+E9^2-$B$5^2)/(2*$B$4*E9))"),
    "ATAN2 turned": ({"b": "ATAN2(-{yA},{a1}-{xA})"}, "F9:F33", "ATAN2($B$2-C9,-D9)"),
    "square lost": ({"s": "SQRT(({a1}-{xA})^2+{yA})"}, "E9:E33", "SQRT(($B$2-C9)^2+D9^2)"),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("slip", first(list(SLIPS), 1))
def test_a_slip_is_found_and_mended(tmp_path, mechanism, slip):
    changes, cells, mend = SLIPS[slip]
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, four_bar(**changes)))
    (fault,) = found.faults
    assert fault.cells == f"Sayfa1!{cells}"
    assert fault.mend == mend
    assert found.follow_through == 3
    assert found.plain < 3


@pytest.mark.ci
def test_mends_are_written_with_names_and_to_the_right(tmp_path, mechanism):
    slip = four_bar(xB="{xA}+{a3}*SIN({t13})")
    assert judged(tmp_path, mechanism, Table(FOUR_BAR, slip, names=True)).faults[0].mend == "C9+a3_*COS(H9)"
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, slip, across=True)).faults[0]
    assert (found.cells, found.mend) == ("Sayfa1!I29:AG29", "I23+$B$4*COS(I28)")


@pytest.mark.ci
def test_one_cell_typed_over_is_its_own_fault(tmp_path, mechanism):
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, four_bar(), cells={"E14": "=SQRT((B2-C14)^2+D13^2)"}))
    assert [(fault.cells, fault.kind) for fault in found.faults] == [("Sayfa1!E14", "breaks its column")]
    assert verdicts(found) == dict.fromkeys(ASKED, "follows")


@pytest.mark.slow
def test_the_other_assembly_is_said_before_any_mend(tmp_path, mechanism):
    path = Table(FOUR_BAR, four_bar(t13="{b}-{g}")).save(tmp_path / "book.xlsx")
    found = audit(path, mechanism)
    assert verdicts(found) == {"theta13": "other assembly", "theta14": "other assembly", "mu": "right"}
    assert found.faults == ()
    assert audit(path, mechanism, assembly="any").follow_through == 3


@pytest.mark.slow
def test_numbers_in_place_of_dimensions_are_not_live(tmp_path, mechanism):
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, four_bar(xA="35*COS({fi})", yA="35*SIN({fi})")))
    assert verdicts(found) == dict.fromkeys(ASKED, "not live")
    assert found.follow_through == 1.5
    partly = judged(tmp_path, mechanism, Table(FOUR_BAR, four_bar(xA="35*COS({fi})")))
    assert set(verdicts(partly).values()) == {"not live"}


@pytest.mark.slow
def test_a_dimensions_cell_that_nobody_reads_is_not_live(tmp_path, mechanism):
    """a2 = 36.5 in its cell, another length than the description's, and the formulas have the number instead."""
    given = [(label, name, 36.5 if name == "a2" else value) for label, name, value in FOUR_BAR]
    found = judged(tmp_path, mechanism, Table(given, four_bar(xA="36.5*COS({fi})", yA="36.5*SIN({fi})")))
    assert verdicts(found) == dict.fromkeys(ASKED, "not live")
    assert any("does not follow a2" in remark for remark in found.remarks)


@pytest.mark.ci
def test_a_long_table_is_mended_in_all_its_rows(tmp_path, mechanism):
    """The fault is looked for in a part of 3,601 rows; a cell of its own among them is found, too."""
    steps = [n / 10 for n in range(3601)]
    columns = [("aci", "deg", steps), *four_bar(xB="{xA}+{a3}*SIN({t13})")[1:]]
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, columns))
    assert [(fault.cells, fault.mend) for fault in found.faults] == [("Sayfa1!I9:I3609", "C9+$B$4*COS(H9)")]
    assert verdicts(found) == {"theta13": "right", "theta14": "follows", "mu": "follows"}
    columns = [("aci", "deg", steps), *four_bar()[1:]]
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, columns, cells={"E1234": "=SQRT((B2-C1234)^2+D1233^2)"}))
    assert [(fault.cells, fault.kind) for fault in found.faults] == [("Sayfa1!E1234", "breaks its column")]


@pytest.mark.slow
def test_what_is_not_there_is_missing(tmp_path, mechanism):
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, [c for c in four_bar() if c[1] != "mu"]))
    assert verdicts(found)["mu"] == "missing"
    assert (found.of, found.follow_through) == (3, 2)


@pytest.mark.ci
def test_the_texts_fivelink_subtracts_alpha1_twice(tmp_path):
    """Section 3.8: theta12 - alpha1 in column B, and alpha1 once more inside the slotted lever."""
    mechanism = mechsheet.template("fivelink")
    given = [
        (s, s, float(v)) for s, v in (("a2", 510), ("a1", 1250), ("b1", 200), ("b2", 1160), ("b3", 1995), ("b4", 820))
    ]
    given += [("c1", "c1", 1700.0), ("d1", "d1", 600.0), ("Alfa1", "al", "ATAN({b1}/{a1})")]
    given += [("A0B0", "r", "SQRT({a1}^2+{b1}^2)"), ("B0C0", "c", "SQRT({c1}^2+{d1}^2)"), ("e", "e", "ATAN({d1}/{c1})")]
    columns = [
        ("Teta12", "deg", [20.0 * n for n in range(19)]),
        ("B", "w", "RADIANS({deg})-{al}"),
        ("u", "u", "{a2}*COS({w}-{al})-{r}"),
        ("v", "v", "{a2}*SIN({w}-{al})"),
        ("Teta13 (rad)", "t13", "ATAN2({u},{v})+{al}-PI()/2"),
        ("xB", "xB", "{b2}*COS({t13})-{c1}"),
        ("yB", "yB", "{b2}*SIN({t13})+{d1}"),
        ("s", "s", "SQRT({xB}^2+{yB}^2)"),
        ("Teta15 (rad)", "t15", "ATAN2({xB},{yB})-ACOS(({b4}^2+{s}^2-{b3}^2)/(2*{b4}*{s}))"),
    ]  # fmt: skip
    found = judged(tmp_path, mechanism, Table(given, columns))
    assert [(f.cells, f.formula, f.mend, f.kind) for f in found.faults] == [
        ("Sayfa1!B17:B35", "RADIANS(A17)-$B$10", "RADIANS(A17)", "term too many")
    ]
    assert found.faults[0].rights == ("theta13", "theta15")
    told = "theta13, Sayfa1!E17 hücresinde: bulunan -4.35283, olması gereken -4.44843"
    assert told in found.remarks  # a turn less than 110.60 and 105.12 degrees
    assert [math.degrees(number + math.tau) for number in (-4.35283, -4.44843)] == pytest.approx(
        [110.6, 105.12], abs=0.01
    )
    assert "$B$10 Sayfa1!C17 hücresinde de var" in found.remarks


@pytest.mark.parametrize("name", ["chebyshev", "whitworth"])
@pytest.mark.parametrize("headings", [True, False])
def test_templates_written_out_plainly_are_right(name, headings):
    mechanism = mechsheet.template(name)
    found = audited(upright(plain_book(mechanism, headings)), mechanism, asked_of(mechanism), name)
    assert set(verdicts(found).values()) == {"right"}
    assert found.faults == ()


@pytest.mark.slow
def test_own_workbooks_are_right(tmp_path):
    mechanism = mechsheet.template("fivelink")
    mechsheet.build(mechanism, tmp_path / "own.ods", layout="page")
    assert audit(tmp_path / "own.ods", mechanism).right


@pytest.mark.slow
def test_a_driver_that_follows_from_the_time_is_found(tmp_path):
    """Its column is computed from times, and its sines are those of degrees: `COS(RADIANS(B4))`."""
    links = '[links.base]\npoints = { O = [0, 0] }\n[links.arm]\npoints = { O = [0, 0], A = ["a2", 0] }\n'
    law = 'start = 10\nstop = 60\nmotion = { law = "harmonic", duration = 2, rows = 9 }\n'
    asked = '[outputs]\nx = { formula = "A.x" }\n'
    head = 'format = 1\n[mechanism]\nname = "timed"\n[dimensions]\na2 = 30\n'
    timed = mechsheet.loads(f'{head}{links}[driver]\nlink = "arm"\n{law}{asked}')
    mechsheet.build(timed, tmp_path / "own.xlsx")
    assert audit(tmp_path / "own.xlsx", timed).right


def test_faults_in_words():
    fault = FaultFound("Sayfa1!B9:B33", "A9", "RADIANS(A9)", ("theta13", "mu"), "radians and degrees")
    assert fault_line(fault, "en") == "Sayfa1!B9:B33  A9: radians and degrees; RADIANS(A9) makes theta13, mu right"
    assert fault_line(fault, "tr") == "Sayfa1!B9:B33  A9: radyan ve derece; RADIANS(A9) ile theta13, mu doğru olur"


@pytest.mark.slow
def test_the_command_prints_json(tmp_path):
    (tmp_path / "m.toml").write_text(mechsheet.template("four-bar").text, encoding="utf-8")
    path = Table(FOUR_BAR, four_bar(fi="RADIANS({deg})-{a2}/100")).save(tmp_path / "book.xlsx")
    command = ["audit", path, "--against", tmp_path / "m.toml", "--json", "--language", "tr"]
    data = json.loads(printed(*command, code=1))
    assert data["asked"]["theta13"] == {"cells": "Sayfa1!H9:H33", "verdict": "follows"}
    assert data["marks"] == {"of": 3, "plain": 0, "follow_through": 3}
    assert set(data) == {"asked", "faults", "marks", "remarks"}


def test_what_is_no_table_is_refused_in_words(tmp_path, mechanism):
    import openpyxl

    book = openpyxl.Workbook()
    book.active["A1"] = "nothing"
    book.save(tmp_path / "empty.xlsx")
    with pytest.raises(mechsheet.MechsheetError, match="no table was found"):
        audit(tmp_path / "empty.xlsx", mechanism)
    (tmp_path / "broken.xlsx").write_bytes(b"PK\x03\x04 no workbook")
    with pytest.raises(mechsheet.MechsheetError, match="damaged"):
        audit(tmp_path / "broken.xlsx", mechanism)


def test_circles_links_and_volatile_functions_are_remarks(tmp_path, mechanism):
    cells = {"Q1": "=Q2", "Q2": "=Q1", "Q3": "=[1]Sheet1!A1", "Q4": "=NOW()", "Q5": "3,5", "Q6": "=NOSUCH(1)"}
    found = judged(tmp_path, mechanism, Table(FOUR_BAR, four_bar(), cells=cells))
    assert verdicts(found) == RIGHT
    assert math.isclose(found.plain, 3)
    assert "1 number was typed as a text with a decimal comma; it is read as a number" in found.remarks


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("read", [False, True])
def test_a_page_of_text_has_no_numbers_typed_as_texts(tmp_path, mechanism, read):
    """The legend of our own Turkish workbooks shows colours on `12,5`; but what a formula reads is a number."""
    import openpyxl

    path = tmp_path / "book.xlsx"
    mechsheet.build(mechsheet.template("four-bar", language="tr"), path)
    book = openpyxl.load_workbook(path)
    legend, *_ = [cell.coordinate for cell in book["Notlar"]["A"] if cell.value == "12,5"]
    if read:
        book.worksheets[0]["Z90"] = f"=2*Notlar!{legend}"
    book.save(path)
    found = audit(path, mechanism)
    assert any("decimal comma" in remark for remark in found.remarks) is read


def test_the_angle_of_a_slider_is_not_asked():
    """It cannot turn: a student would be asked for a column of zeros, which no audit counts."""
    mechanism = description.load(Path(__file__).parents[2] / "templates" / "slider-crank.toml")
    assert list(asked_of(mechanism).marks) == ["theta13", "s14", "mu"]


@pytest.mark.ci
@pytest.mark.parametrize("headings", [True, False])
def test_lengths_that_a_task_gives_may_be_typed_or_computed(headings):
    """The description finds them; the sheet holds the numbers, and which assembly is meant says the task."""
    mechanism = mechsheet.template("function-generator")
    found = audited(upright(plain_book(mechanism, headings)), mechanism, asked_of(mechanism), "book")
    assert set(verdicts(found).values()) == {"right"}
    assert found.faults == ()


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.parametrize("damaged", ["DEGREES({deg})", "{deg}"])
def test_a_fault_does_not_hide_the_rows_at_a_limit(damaged):
    """Chebyshev's linkage ends at limits, where rounding decides whether a formula has a value: the mend is found."""
    mechanism = mechsheet.template("chebyshev")
    book = plain_book(mechanism)
    (sheet,) = book.sheets
    place = next(n for n, block in enumerate(sheet.blocks) if block.rows > 3)
    turned = sheet.blocks[place].formula
    wrong = turned.args[0] if damaged == "{deg}" else replace(turned, name="DEGREES")
    sheet.blocks[place] = replace(sheet.blocks[place], formula=wrong)
    found = audited(upright(book), mechanism, asked_of(mechanism), "book")
    assert [fault.mend for fault in found.faults] == ["RADIANS($A14)"]
    assert set(verdicts(found).values()) == {"follows"}


@pytest.mark.ci
def test_rates_are_asked_and_mended(tmp_path):
    """The lever's angular velocity in rad/s, with the speed in its cell; a sine in place of a cosine is found."""
    text = mechsheet.template("four-bar").text.replace(
        "step = 15\n", 'step = 15\nspeed = { value = 60, unit = "rpm" }\n', 1
    )
    mechanism = description.loads(text + "\n[exercise]\nasked = { omega13 = 1, omega14 = 1 }\n", "rates")
    rates = {
        "w13": "{w}*{a2}*SIN({t14}-{fi})/({a3}*SIN({t13}-{t14}))",
        "w14": "{w}*{a2}*SIN({t13}-{fi})/({a4}*SIN({t13}-{t14}))",
    }
    given = [*FOUR_BAR, ("n [rpm]", "n", 60.0), ("omega12", "w", "{n}*PI()/30")]

    def table(**changes):
        columns = [(name, name, changes.get(name, formula)) for name, formula in rates.items()]
        return Table(given, [*four_bar(), *columns])

    right = audit(table().save(tmp_path / "right.xlsx"), mechanism)
    assert verdicts(right) == {"omega13": "right", "omega14": "right"}
    assert right.faults == ()
    wrong = audit(
        table(w14=rates["w14"].replace("SIN({t13}-{fi})", "COS({t13}-{fi})")).save(tmp_path / "b.xlsx"), mechanism
    )
    assert verdicts(wrong) == {"omega13": "right", "omega14": "wrong"}
    assert wrong.faults[0].mend.count("SIN") == 2


FORCES = {
    "along": "-1000*{M}/({a4}*SIN({t13}-{t14}))",
    "T12": "-{M}*{a2}*SIN({t13}-{fi})/({a4}*SIN({t13}-{t14}))-{K}",
    "F34": "ABS({along})",
    "F34.x": "{along}*COS({t13})",
}
"""Torques M on the rocker, K on the crank, no masses: the coupler carries one force along itself [N]; T by virtual work."""

ALL_FORCES = dict.fromkeys(("T12", "F34", "F34.x"), "right")

FORCE_SLIPS = {
    "the crank's torque added": ("T12", "-{K}", "+{K}"),
    "a sum of angles": ("T12", "{t13}-{fi}", "{t13}+{fi}"),
    "a sum of angles below": ("along", "{t13}-{t14}", "{t13}+{t14}"),
}


@pytest.fixture(scope="module")
def loaded():
    loads = "".join(
        f'[[loads]]\nlink = "{link}"\ntorque = {torque}\n\n' for link, torque in (("rocker", 20), ("crank", 5))
    )
    text = mechsheet.template("four-bar").text.replace("[driver]\n", f"{loads}[driver]\n", 1)
    return description.loads(text + '\n[exercise]\nasked = { T12 = 1, F34 = 1, "F34.x" = 1 }\n', "forces")


def forces(tmp_path, loaded, **changes):
    given = [*FOUR_BAR, ("M14 [N m]", "M", 20.0), ("M12 [N m]", "K", 5.0)]
    columns = [(name, name, changes.get(name, formula)) for name, formula in FORCES.items()]
    found = audit(Table(given, [*four_bar(), *columns]).save(tmp_path / "book.xlsx"), loaded)
    return verdicts(found), found


def test_a_joint_force_and_the_driving_torque_are_right(tmp_path, loaded):
    got, found = forces(tmp_path, loaded)
    assert got == ALL_FORCES
    assert found.faults == ()
    assert not any("direction" in remark for remark in found.remarks)


@pytest.mark.slow
@pytest.mark.parametrize("slip", first(list(FORCE_SLIPS), 1))
def test_a_wrong_sign_in_a_force_is_found(tmp_path, loaded, slip):
    column, old, new = FORCE_SLIPS[slip]
    got, found = forces(tmp_path, loaded, **{column: FORCES[column].replace(old, new)})
    (fault,) = found.faults
    letter = {"along": "M", "T12": "N"}[column]
    assert fault.cells == f"Sayfa1!{letter}11:{letter}35"
    assert fault.mend == (
        "-1000*$B$6/($B$5*SIN(H11-K11))" if column == "along" else "-$B$6*$B$3*SIN(H11-B11)/($B$5*SIN(H11-K11))-$B$7"
    )
    assert got == (
        {"T12": "right", "F34": "follows", "F34.x": "follows"} if column == "along" else ALL_FORCES | {"T12": "wrong"}
    )


def test_the_force_of_the_other_link_is_right_and_said_so(tmp_path, loaded):
    """F43 in place of F34 is a choice, as an angle counted clockwise is: right, with a remark."""
    got, found = forces(tmp_path, loaded, along=FORCES["along"][1:])
    assert got == ALL_FORCES
    assert "F34.x is counted in the other direction" in found.remarks


def test_a_coordinate_is_not_a_force_of_that_size(tmp_path):
    """The sheet's cell for the height of O2 was taken for the force of 300 N, which theta13 then did not follow."""
    text = SHAPER.replace("d = 300", 'F = "300 N"').replace('O2 = [0, "d"]', "O2 = [0, 300]")
    found = shaped(tmp_path, text)
    assert {one.verdict for one in found.asked.values()} == {"right"}
    assert found.given.keys() == {"r", "L", "c", "h"}


@pytest.mark.parametrize(("formula", "verdict"), [("{d}/TAN({fi})", "right"), ("{d}/TAN({fi})+1", "wrong")])
def test_a_row_at_a_pole_is_not_asked_for(tmp_path, formula, verdict):
    """At 180 degrees 1/tan is 8e15, but for rounding: with no number there a sheet was wrong, off elsewhere right."""
    text = SHAPER.replace('"hypot(C.x, C.y)"', '"d/tan(theta12)"')
    found = shaped(
        tmp_path,
        text,
        reach=f"IF(MOD({{deg}};180)=0;NA();{formula})".replace(";", ",").replace("{fi}", "RADIANS({deg})"),
    )
    assert found.asked["reach"].verdict == verdict
