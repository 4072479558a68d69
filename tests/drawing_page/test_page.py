"""The page in a browser: what a person does with the mouse, the keyboard and the text, and what comes of it."""

import re

import pytest

import mechsheet

pytestmark = pytest.mark.chromium


def test_a_template_opens_moves_and_is_written_back_unchanged(opening, four_bar):
    before = four_bar.read_bytes()
    opened = opening(four_bar)
    opened.said("degrees of freedom: 1")
    assert opened.page.locator("#title").text_content() == "Four-bar linkage"
    start = opened.place("B")
    opened.page.locator("#position").focus()
    opened.page.keyboard.press("PageUp")
    opened.until("document.querySelector('#position').value > 0")
    assert opened.place("B") != start
    opened.page.keyboard.press("Control+s")
    opened.said("Saved:")
    assert four_bar.read_bytes() == before


def test_dragging_a_point_changes_its_dimensions_and_nothing_else(opening, four_bar):
    text = four_bar.read_text(encoding="utf-8")
    opened = opening(four_bar)
    there = opened.place("A")
    opened.drag("B", (40, -30))
    opened.until("document.querySelector('[data-name=a3]').value !== '62.3'")
    lines = [(old, new) for old, new in zip(text.splitlines(), opened.text().splitlines(), strict=True) if old != new]
    changed = {re.match(r"\w+", old)[0] for old, _ in lines}
    assert changed == {"a3", "a4", "B", "c3"}
    assert opened.place("A") == pytest.approx(there, abs=0.6)
    opened.page.click("#save")
    opened.said("Saved:")
    linkage = mechsheet.load(four_bar)
    place = [linkage.solve()[f"B.{axis}"][0] for axis in "xy"]
    shown = opened.page.evaluate("async () => (await import('./geometry.js')).place('B')")
    assert shown == pytest.approx(place, abs=1e-4)


def test_a_number_that_is_typed_moves_the_drawing(opening, four_bar):
    opened = opening(four_bar)
    x, _ = opened.place("A")
    field = opened.page.locator("[data-name=a2]")
    field.fill("50")
    field.press("Enter")
    opened.until("document.querySelector('#text').value.includes('a2 = { value = 50,')")
    opened.said("It can be joined only from")
    assert opened.place("A")[0] > x + 20
    field.fill("nonsense")
    field.press("Enter")
    opened.until("document.querySelector('[data-name=a2]').classList.contains('bad')")
    assert "value = 50" in opened.text()
