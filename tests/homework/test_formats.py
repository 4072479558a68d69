"""The same tables in the formats that come back from a class: .xlsx, and .ods and .xls as LibreOffice writes them."""

from __future__ import annotations

import pytest

import mechsheet
from homework.handmade import FOUR_BAR, Table, four_bar
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.homework.audit import audit

pytestmark = pytest.mark.slow

TURKISH = [(f"{label} [mm]", name, value) for label, name, value in FOUR_BAR]
SLIP = {"xB": "{xA}+{a3}*SIN({t13})"}
STYLES = {
    "down": lambda columns: Table(FOUR_BAR, columns),
    "right": lambda columns: Table(FOUR_BAR, columns, across=True),
    "two-sheets": lambda columns: Table(FOUR_BAR, columns, two_sheets=True),
    "names": lambda columns: Table(FOUR_BAR, columns, names=True),
    "no-headings": lambda columns: Table(FOUR_BAR, columns, headings=False),
    "turkish": lambda columns: Table(TURKISH, [(f"{heading} değeri", *rest) for heading, *rest in columns]),
}


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Every style, right and with a slip, in three formats; LibreOffice is started twice."""
    folder = tmp_path_factory.mktemp("formats")
    made = []
    for style, table in STYLES.items():
        for name, columns in (("right", four_bar()), ("wrong", four_bar(**SLIP))):
            made.append(table(columns).save(folder / f"{style}_{name}.xlsx"))
    for suffix in ("ods", "xls"):
        convert_with_libreoffice(made, suffix, folder)
    return folder


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.libreoffice
@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("suffix", ["xlsx", "ods", "xls"])
def test_every_style_in_every_format(files, style, suffix):
    mechanism = mechsheet.template("four-bar")
    found = audit(files / f"{style}_right.{suffix}", mechanism)
    assert {one.verdict for one in found.asked.values()} == {"right"}
    assert found.faults == ()
    found = audit(files / f"{style}_wrong.{suffix}", mechanism)
    assert {symbol: one.verdict for symbol, one in found.asked.items()} == {
        "theta13": "right", "theta14": "follows", "mu": "follows",
    }  # fmt: skip
    (fault,) = found.faults
    assert fault.mend.replace("COS", "SIN") == fault.formula
    assert found.follow_through == 3
