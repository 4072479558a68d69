"""Names of cells that a spreadsheet program of some language refuses: one such name, and it does not open the file."""

import pytest

from livesheet.formula.names import name_fault, safe_name

REFUSED = [
    "r", "R", "c", "Z", "S", "L", "F", "K", "φ",  # rows and columns, in one language or another
    "RC", "r1c", "R2C3", "Z1S1", "zs", "L1C1", "F3C", "W1K1", "S1O1", "R1K1", "R1S1",
    "a1", "XFE1", "iki2",
    "TRUE", "Doğru", "YANLIŞ", "Wahr", "vrai", "FALSO", "ИСТИНА",
    "SQRT", "_xlnm.Print_Area", "1st", "two words", "",
]  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name):
    assert name_fault(name)


@pytest.mark.parametrize(
    "name", ["a_1", "r_", "_r", "phi", "theta12", "A0B0", "Krank", "ÇıkışUzvu", "φ0", "rc_", "C.x"]
)
def test_allowed(name):
    assert name_fault(name) == ""


@pytest.mark.parametrize(
    ("symbol", "name"),
    [("r", "r_1"), ("K", "K_1"), ("a1", "a_1"), ("a_1", "a_1"), ("A.x", "A_x"), ("lc", "lc_1"), ("Z1S1", "Z1S_1")],
)
def test_safe_variant(symbol, name):
    assert safe_name(symbol, set()) == name
    assert name_fault(name) == ""


def test_the_variant_may_be_taken():
    assert safe_name("r", {"r_1"}) == "r_2"


def test_a_word_comes_before_a_number():
    assert safe_name("e", set(), "offset") == "e_1"  # OFFSET is a function
    assert safe_name("e", set(), "eccentricity") == "eccentricity"
    assert safe_name("e", {"eccentricity"}, "eccentricity") == "e_1"
    assert safe_name("a1", set(), "crank") == "a_1"
