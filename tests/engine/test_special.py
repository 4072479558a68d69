"""Special functions and distributions against values of 60 digits."""

from asking import ours
from engine_cases import FOLDER, load

CASES = load(FOLDER / "special" / "mpmath.toml")["cases"]

EXPECTED_DIGITS = 2e-12
"""Far out in the tails of distributions with large parameters; elsewhere it is nearer to 1e-14."""


def test_special_functions():
    found = ours([formula for formula, _ in CASES], [])
    wrong = [
        (formula, value, mine)
        for (formula, value), mine in zip(CASES, found, strict=True)
        if not (isinstance(mine, float) and abs(mine - value) <= EXPECTED_DIGITS * abs(value))
    ]
    assert wrong == []


def test_most_have_fourteen_digits():
    found = ours([formula for formula, _ in CASES], [])
    good = sum(abs(mine - value) <= 2e-14 * abs(value) for (_, value), mine in zip(CASES, found, strict=True))
    assert good >= 0.85 * len(CASES)
