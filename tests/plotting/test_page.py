"""The page in a browser: a fragment, the slider and the button change the drawing to the reference's points."""

import re
import shutil
import subprocess
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

import mechsheet
from chosen import part
from drawn_points import drawn_points, expected, fitted
from folders import TEMPLATES
from mechsheet import reference
from mechsheet.plotting.sampling import sample

HALF_A_STEP = 0.006
"""Pixels: places stand in the page in hundredths."""

pytestmark = pytest.mark.chromium


def browser():
    return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))


def dom(page, fragment="", milliseconds=300):
    """The document as it stands after its scripts have run so long by its own clock, and its complaints."""
    command = [browser(), "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0"]
    profile = page.with_suffix(".profile")
    command += [f"--user-data-dir={profile}", f"--virtual-time-budget={milliseconds}", "--dump-dom"]
    result = subprocess.run([*command, page.as_uri() + fragment], capture_output=True, timeout=120, check=True)
    complaints = [line for line in result.stderr.decode(errors="replace").splitlines() if "CONSOLE" in line]
    return result.stdout.decode(), complaints


class Drawing(HTMLParser):
    """Places of the drawing's circles by group, attributes by id, text by id."""

    def __init__(self, text):
        super().__init__()
        self.groups, self.group, self.attributes, self.texts, self.open = {}, "", {}, {}, ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if "id" in attributes:
            self.attributes[attributes["id"]] = attributes
            self.open = attributes["id"]
        if tag == "g":
            self.group = attributes.get("id", "")
        if tag == "circle" and self.group.startswith("m-"):
            self.groups.setdefault(self.group, []).append((float(attributes["cx"]), -float(attributes["cy"])))

    def handle_data(self, data):
        self.texts.setdefault(self.open, data)
        self.open = ""

    def marked(self, mechanism):
        """Rings, then dots, as `expected` has them."""
        count = sum(map(len, drawn_points(mechanism)))
        return np.concatenate([group for group in self.groups.values() if group])[:count]


@cache
def sampled(name):
    taken = sample(mechsheet.load(TEMPLATES / f"{name}.toml"), None, None)
    return taken, reference.solve(taken.plan.mechanism)


def judge(name, text, row):
    """The drawing shows the row of the sweep."""
    taken, truth = sampled(name)
    mechanism = taken.plan.mechanism
    page = Drawing(text)
    true = expected(mechanism, truth, row)
    scale, worst = fitted(page.marked(mechanism), true)
    assert scale > 0
    assert worst < HALF_A_STEP * 2
    caption = page.texts["shown"]
    value = taken.plan.driver[row]
    shown = mechanism.driver.unit.to_shown(value)
    assert float(re.search(r"= (-?[\d.]+)", caption)[1]) == pytest.approx(shown, abs=1e-3)
    assert page.attributes["slider"]["aria-valuetext"] == caption
    return page


@cache
def text_of_page(name):
    with TemporaryDirectory() as folder:
        path = mechsheet.plot(mechsheet.load(TEMPLATES / f"{name}.toml"), Path(folder) / f"{name}.html")
        return path.read_text(encoding="utf-8")


def page_of(name, folder, script=""):
    """The page, with a script of the test at its end."""
    path = folder / f"{name}.html"
    text = text_of_page(name)
    path.write_text(text.replace("</body>", f"<script>{script}</script></body>") if script else text, encoding="utf-8")
    return path


MOVE = """
slider.value = ROW;
slider.dispatchEvent(new Event("input", { bubbles: true }));
slider.dispatchEvent(new Event("change", { bubbles: true }));
"""


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("name", "fragment", "row"),
    part(
        [
            ("four-bar", "#at=61.6", 21),
            ("four-bar", "#at=60", 20),
            ("scissor-lift", "#at=50", None),
            ("fivelink", "#at=200", None),
        ],
        2,
    ),
)
def test_fragment(name, fragment, row, tmp_path):
    text, complaints = dom(page_of(name, tmp_path), fragment)
    assert complaints == []
    if row is None:
        taken, _ = sampled(name)
        driver = np.array(taken.plan.driver)
        shown = taken.plan.mechanism.driver.unit.to_shown(driver)
        row = int(np.argmin(np.abs(shown - float(fragment.removeprefix("#at=")))))
    judge(name, text, row)


@pytest.mark.cases(1)
@pytest.mark.parametrize(("name", "row"), [("four-bar", 87), ("jansen", 50)])
def test_slider(name, row, tmp_path):
    text, complaints = dom(page_of(name, tmp_path, MOVE.replace("ROW", str(row))))
    assert complaints == []
    page = judge(name, text, row)
    _, truth = sampled(name)
    if name == "four-bar":  # the value beside the curve, and the marker on it
        theta13 = np.degrees(reference.variables(truth)["theta13"][row])
        assert float(page.texts["c1-3-value"].replace("−", "-")) == pytest.approx(theta13, abs=0.006)


def test_button(tmp_path):
    """Play moves on, step by step, and can be stopped."""
    text, complaints = dom(page_of("four-bar", tmp_path, "button.click();"), milliseconds=900)
    assert complaints == []
    page = Drawing(text)
    assert page.texts["play"] == "Pause"
    assert not page.texts["shown"].endswith("= 0°")
    value = float(re.search(r"= ([\d.]+)", page.texts["shown"])[1])
    judge("four-bar", text, round(value / 3))
    text, _ = dom(page_of("four-bar", tmp_path, "button.click(); button.click();"), milliseconds=900)
    assert Drawing(text).texts["play"] == "Play"
    judge("four-bar", text, 0)


def test_to_and_fro(tmp_path):
    """A sweep that does not come round turns at its end."""
    script = "show(last); button.click();"
    text, complaints = dom(page_of("scissor-lift", tmp_path, script), milliseconds=200)
    assert complaints == []
    taken, _ = sampled("scissor-lift")
    value = float(re.search(r"= ([\d.]+)", Drawing(text).texts["shown"])[1])
    assert taken.plan.driver[-8] < value <= taken.plan.driver[-1]


@pytest.mark.cases(1)
@pytest.mark.parametrize("fragment", ["#at=x", "#at=1e999"])
def test_nonsense_in_the_fragment(fragment, tmp_path):
    text, complaints = dom(page_of("four-bar", tmp_path), fragment)
    assert complaints == []
    judge("four-bar", text, 0)
