"""The numbers of the tutorial "From task to mechanism", in both languages, are those that the templates give."""

import math
import re

import numpy as np
import pytest

from folders import ROOT
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.reference.synthesis import crank_rocker, functions

PAGES = ["task-to-mechanism.md", "task-to-mechanism.tr.md"]
BY_HAND = re.compile(r"^\| `(\w+)` \| (?![\d.]+ \|).* \| (-?[\d.]+)(?: mm)? \|$", re.MULTILINE)
"""A line of a table: a symbol, how it is found, its value."""
TWO = re.compile(r"^\| `(a\d)` \| ([\d.]+) \| ([\d.]+) \|$", re.MULTILINE)
"""A length, before and after the change of an angle."""
RATIOS = re.compile(r"^\| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+)° \|$", re.MULTILINE)
"""λ, a2, a3, a4, least transmission angle."""
DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")


def text_of(page):
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return DECIMAL_COMMA.sub(".", text) if page.endswith(".tr.md") else text


def fits(found, printed):
    """Half of the last printed digit may be missing."""
    return abs(found - float(printed)) <= 0.5000001 * 10.0 ** -len(printed.partition(".")[2])


def dimensions(name, old="", new=""):
    """Values by symbol, in their own units, of a template with something else in its task."""
    text = template_text(name)
    assert old in text
    mechanism = loads(text.replace(old, new, 1))
    values = dimension_values(mechanism)
    return {dim.symbol: dim.unit.written(values[dim.symbol]) for dim in mechanism.dimensions}


@pytest.mark.parametrize("page", PAGES)
def test_the_steps_by_hand(page):
    printed = dict(BY_HAND.findall(text_of(page)))
    assert printed.keys() == {"D", "k1", "k2", "k3", "a2", "a3", "a4", "half_swing", "centre", "lever"}
    found = dimensions("function-generator") | dimensions("quick-return-lever")
    for symbol, text in printed.items():
        assert fits(found[symbol], text), symbol


@pytest.mark.parametrize("page", PAGES)
def test_what_a_tenth_of_a_degree_does(page):
    before = dimensions("function-generator")
    after = dimensions("function-generator", "psi = [60, 80, 100]", "psi = [60, 80.1, 100]")
    lines = TWO.findall(text_of(page))
    assert [name for name, _, _ in lines] == ["a2", "a3", "a4"]
    for name, old, new in lines:
        assert fits(before[name], old), name
        assert fits(after[name], new), name


@pytest.mark.parametrize("page", PAGES)
def test_the_lecture_that_rounded_its_cosines(page):
    found = functions.function(np.radians([35.02, 67.5, 100]), np.radians([91.21, 101.79, 117.19]), 4.5)
    said = re.search(r"0\.8456 .*?(0\.\d+), (4\.\d+) (?:and|ve) (0\.\d+)", text_of(page), re.DOTALL)
    assert said
    assert all(fits(value, text) for value, text in zip((found.a2, found.a3, found.a4), said.groups(), strict=True))


@pytest.mark.parametrize("page", PAGES)
def test_the_choice_of_a_ratio(page):
    text = text_of(page)
    lines = RATIOS.findall(text)
    assert len(lines) == 5
    for lam, *printed in lines:
        found = dimensions("crank-rocker-swing", "best = true", f"lam = {lam}")
        for symbol, value in zip(("a2", "a3", "a4", "mu_min"), printed, strict=True):
            assert fits(found[symbol], value), (lam, symbol)
    best = dimensions("crank-rocker-swing")
    said = re.search(r"`best = true`.*?λ = ([\d.]+) .*?([\d.]+)°", text)
    assert said
    assert fits(best["lam"], said[1])
    assert fits(best["mu_min"], said[2])
    assert fits(best["phi"], re.search(r"φ = 360° · t/\(t \+ 1\) = ([\d.]+)°", text)[1])
    crank = re.search(r"`a2 = 60`: ([\d.]+), ([\d.]+) (?:and|ve) ([\d.]+)°", text)
    chosen = dimensions("crank-rocker-swing", "best = true", "a2 = 60")
    for symbol, value in zip(("a3", "a4", "mu_min"), crank.groups(), strict=True):
        assert fits(chosen[symbol], value), symbol


@pytest.mark.parametrize("page", PAGES)
def test_the_bound_of_the_ratio(page):
    said = re.search(r"(?:From λ = |λ = )(17\.\d)(?:'den sonra| on)", text_of(page))
    assert said
    psi, phi = math.radians(80), crank_rocker.crank_turn(10 / 9)
    assert math.isfinite(crank_rocker.by_lam(psi, phi, 120, float(said[1]) - 0.05).mu_min)
    assert math.isnan(crank_rocker.by_lam(psi, phi, 120, float(said[1]) + 0.05).mu_min)
