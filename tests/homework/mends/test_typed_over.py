"""A number typed over a formula is the first fault told, with its cell."""

from __future__ import annotations

import pytest

import mechsheet
from homework.handmade import FOUR_BAR, STEPS, Table, four_bar
from mechsheet.description import loads
from mechsheet.homework.audit import audit

NORTON = (
    ("krank", "deg", STEPS), ("fi", "fi", "RADIANS({deg})"),
    ("K1", "K1", "{a1}/{a2}"), ("K2", "K2", "{a1}/{a4}"), ("K4", "K4", "{a1}/{a3}"),
    ("K3", "K3", "({a2}^2-{a3}^2+{a4}^2+{a1}^2)/(2*{a2}*{a4})"),
    ("K5", "K5", "({a4}^2-{a1}^2-{a2}^2-{a3}^2)/(2*{a2}*{a3})"),
    ("A", "A", "COS({fi})-{K1}-{K2}*COS({fi})+{K3}"), ("B", "B", "-2*SIN({fi})"),
    ("C", "C", "{K1}-({K2}+1)*COS({fi})+{K3}"), ("D", "D", "COS({fi})-{K1}+{K4}*COS({fi})+{K5}"),
    ("F", "F", "{K1}+({K4}-1)*COS({fi})+{K5}"),
    ("theta14", "t14", "2*ATAN2(2*{A},-{B}-SQRT({B}^2-4*{A}*{C}))"),
    ("theta13", "t13", "2*ATAN2(2*{D},-{B}-SQRT({B}^2-4*{D}*{F}))"),
)  # fmt: skip
"""The half-angle solution of Norton's textbook."""


@pytest.fixture(scope="module")
def mechanism():
    return loads(mechsheet.template("four-bar").text + "\n[exercise]\nasked = { theta13 = 1, theta14 = 1 }\n", "two")


def test_nortons_solution_is_right(tmp_path, mechanism):
    assert audit(Table(FOUR_BAR, NORTON).save(tmp_path / "book.xlsx"), mechanism).right


@pytest.mark.parametrize(("cell", "off"), [("M15", 0.002), ("N15", 0.002), ("H15", 0.002), ("I15", 0.002), ("M9", 1.0)])
def test_a_number_in_nortons_columns_is_the_fault(tmp_path, mechanism, cell, off):
    """The row above was blamed, or a constant far from it."""
    right = mechsheet.open_book(Table(FOUR_BAR, NORTON).save(tmp_path / "right.xlsx"))[f"Sayfa1!{cell}"]
    path = Table(FOUR_BAR, NORTON, cells={cell: right + off}).save(tmp_path / "book.xlsx")
    (fault,) = audit(path, mechanism).faults
    assert (fault.cells, fault.kind) == (f"Sayfa1!{cell}", "typed over")


def test_several_numbers_are_each_told(tmp_path, mechanism):
    path = Table(FOUR_BAR, four_bar(), cells={"K9": 2.0, "K15": 2.1, "K16": 2.2, "E20": 90.0}).save(tmp_path / "b.xlsx")
    found = audit(path, mechanism)
    assert [fault.cells for fault in found.faults] == ["Sayfa1!E20", "Sayfa1!K9", "Sayfa1!K15:K16"]
    assert {symbol: one.verdict for symbol, one in found.asked.items()} == {"theta13": "follows", "theta14": "wrong"}


@pytest.mark.slow
def test_a_number_beside_another_fault_does_not_hide_it(tmp_path, mechanism):
    table = Table(FOUR_BAR, four_bar(b="ATAN2(-{yA},{a1}-{xA})"), cells={"F15": 0.7})
    found = audit(table.save(tmp_path / "b.xlsx"), mechanism)
    assert [(fault.cells, fault.kind) for fault in found.faults] == [
        ("Sayfa1!F15", "typed over"), ("Sayfa1!F9:F33", "order of arguments"),
    ]  # fmt: skip
    assert {one.verdict for one in found.asked.values()} == {"follows"}


@pytest.mark.slow
def test_a_rounded_number_and_the_start_of_an_iteration_are_no_faults(tmp_path, mechanism):
    right = mechsheet.open_book(Table(FOUR_BAR, four_bar()).save(tmp_path / "right.xlsx"))["Sayfa1!K15"]
    found = audit(Table(FOUR_BAR, four_bar(), cells={"K15": round(right, 5)}).save(tmp_path / "book.xlsx"), mechanism)
    assert ({one.verdict for one in found.asked.values()}, found.faults) == ({"right", "not live"}, ())
    columns = four_bar(xB="{xA}+{a3}*SIN({t13})")
    columns.insert(1, ("sum", "sum", "{sum-}+1"))
    found = audit(Table(FOUR_BAR, columns, cells={"B9": 7}).save(tmp_path / "book.xlsx"), mechanism)
    assert [fault.cells for fault in found.faults] == ["Sayfa1!J9:J33"]
