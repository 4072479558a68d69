"""Files of all kinds for many mechanisms: well formed, to scale, the same bytes each time, nothing from outside."""

import io
import json
import re
import sys
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import mechsheet
from chosen import some
from command_line import run
from folders import TEMPLATES
from livesheet.diagnostics import OutputError
from loaded_mechanisms import SUSPENSION
from mechsheet import plotting
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechsheetError, MissingProgramError
from mechsheet.plotting import pictures, sampling
from mechsheet.plotting.sampling import sample
from mechsheet.plotting.scenes import Stage, journey

pytestmark = pytest.mark.slow

NAMES = ["four-bar", "fivelink", "adjustable-pump", "six-link-dwell", "jansen", "elliptic-trammel", "scissor-lift"]


def template(name, **changes):
    return mechsheet.load(TEMPLATES / f"{name}.toml", changes)


@pytest.fixture
def few(monkeypatch):
    """Fewer positions than a person wants to see: quicker."""
    monkeypatch.setattr(plotting, "GIF_FRAMES", 8)
    monkeypatch.setattr(sampling, "LEAST", 25)


class Elements(HTMLParser):
    """Attributes of all elements, by tag; ids; the text of scripts."""

    def __init__(self, text):
        super().__init__()
        self.found, self.ids, self.script, self.scripts = [], {}, False, []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.found.append((tag, attributes))
        if "id" in attributes:
            assert attributes["id"] not in self.ids
            self.ids[attributes["id"]] = (tag, attributes)
        self.script = tag == "script"

    def handle_endtag(self, tag):
        self.script = False

    def handle_data(self, data):
        if self.script:
            self.scripts.append(data)


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", some(NAMES, 0, every=13))
@pytest.mark.usefixtures("few")
def test_every_kind(name, tmp_path):
    mechanism = template(name)
    paths = {kind: mechsheet.plot(mechanism, tmp_path / f"m.{kind}") for kind in plotting.KINDS}
    root = ET.parse(paths["svg"]).getroot()
    assert root.get("viewBox") == "0 0 360 360"
    assert mechanism.title.of(mechanism.language) in paths["svg"].read_text(encoding="utf-8")
    with Image.open(paths["png"]) as image:
        assert image.size == (960, 960)
        assert image.getpixel((0, 959)) == (255, 255, 255, 255)
    with Image.open(paths["gif"]) as image:
        assert image.size == (400, 400)
        assert 4 <= image.n_frames <= 8
        assert image.info["loop"] == 0
        frames = []
        for frame in range(image.n_frames):
            image.seek(frame)
            frames.append(np.array(image.convert("RGB")))
        assert all((a != b).any() for a, b in pairwise(frames))
        assert frames[-1][399, 0].tolist() == [255, 255, 255]
    judge_page(paths["html"].read_text(encoding="utf-8"))
    assert paths["pdf"].read_bytes().startswith(b"%PDF-")


def judge_page(text):
    """Nothing from outside; every position complete; every element that moves is there."""
    page = Elements(text)
    for tag, attributes in page.found:
        assert not {"src", "href", "srcset", "action", "data", "background"} & attributes.keys(), tag
        assert tag not in {"link", "img", "iframe", "object", "embed", "base"}
    policy = next(attributes["content"] for tag, attributes in page.found if "http-equiv" in attributes)
    assert policy.startswith("default-src 'none'")
    assert not re.search(r"https?://|url\(|@import|fetch\(|XMLHttp", "".join(page.scripts) + text.split("</style>")[0])
    data = json.loads(page.scripts[0])
    positions = len(data["captions"])
    assert len(data["driver"]) == positions == int(page.ids["slider"][1]["max"]) + 1
    tags = {"path": "path", "dots": "g", "label": "text"}
    for key, kind, frames in data["moves"]:
        assert len(frames) == positions
        assert page.ids[key][0] in {tags.get(kind), "text" if kind == "words" else None, "span"}
        if kind != "words":
            assert len({len(frame) for frame in frames}) == 1
    assert {"slider", "play", "shown"} <= page.ids.keys()
    assert page.ids["play"][0] == "button"


@pytest.mark.cases(1)
@pytest.mark.parametrize("kind", plotting.KINDS)
@pytest.mark.usefixtures("few")
def test_same_bytes(kind, tmp_path):
    first, second = (mechsheet.plot(template("four-bar"), tmp_path / f"{n}.{kind}", at=40).read_bytes() for n in (1, 2))
    assert first == second
    assert b"20" + b"26-" not in first  # no date


def test_settings_of_the_user_do_not_matter(tmp_path):
    import matplotlib as mpl

    before = mechsheet.plot(template("four-bar"), tmp_path / "a.svg").read_bytes()
    with mpl.rc_context({"lines.linewidth": 9, "font.size": 30, "savefig.bbox": "tight", "figure.facecolor": "red"}):
        assert mechsheet.plot(template("four-bar"), tmp_path / "b.svg").read_bytes() == before


def strokes(svg):
    """Corners of every line of an SVG made by matplotlib, by colour, a list for each unbroken part."""
    found = {}
    for path in ET.parse(svg).getroot().iter("{http://www.w3.org/2000/svg}path"):
        color = re.search(r"stroke: (#\w+)", path.get("style") or "")
        if color:
            parts = path.get("d").split("M")[1:]
            places = [np.array(re.findall(r"-?[\d.]+", part), float).reshape(-1, 2) for part in parts]
            found.setdefault(color[1], []).append(places)
    return found


def test_what_belongs_to_a_shape_is_in_a_group_of_its_kind(tmp_path):
    for ending in ("svg", "html"):
        text = mechsheet.plot(mechsheet.loads(SUSPENSION), tmp_path / f"s.{ending}").read_text(encoding="utf-8")
        found = {kind for value in re.findall(r'class="([^"]*)"', text) for kind in value.split()}
        assert {"link", "ground", "spring", "damper", "load", "torque", "weight", "mass", "path", "name"} <= found


def test_a_circle_is_round(tmp_path):
    """The disc of the Oldham coupling runs on a circle over the hubs' distance."""
    path = strokes(mechsheet.plot(template("oldham"), tmp_path / "o.svg"))["#8fafcb"][0][0]
    width, height = np.ptp(path, axis=0)
    assert width > 100
    assert width == pytest.approx(height, rel=1e-3)


def test_gaps(tmp_path):
    """The path of C in two parts, in the picture as on the page."""
    mechanism = template("four-bar", a2="90")
    parts = strokes(mechsheet.plot(mechanism, tmp_path / "g.svg"))["#8fafcb"][0]
    assert len(parts) == 2
    page = Elements(mechsheet.plot(mechanism, tmp_path / "g.html").read_text(encoding="utf-8"))
    data = json.loads(page.scripts[0])
    lines = [attributes["d"] for tag, attributes in page.found if tag == "path" and "d" in attributes]
    assert [line.count("M") for line in lines if line.count("L") > 50 and line.count("M") > 1]
    assert sum("does not close" in caption for caption in data["captions"]) > 50
    assert data["round"] is False
    theta13 = next(frames for key, kind, frames in data["moves"] if key.endswith("value"))
    assert "–" in theta13
    assert "nan" not in "".join(page.scripts).lower().split('"use strict"')[0]


def test_turkish(tmp_path):
    assert run("plot", TEMPLATES / "four-bar.toml", "--language", "tr", "-o", tmp_path / "t.html").exit_code == 0
    text = (tmp_path / "t.html").read_text(encoding="utf-8")
    assert '<html lang="tr">' in text
    for word in ("Dört-çubuk mekanizması", "Oynat", "Sürgüyü", "Krank açısına göre açılar", "Kaynak"):
        assert word in text
    for word in ("Play", "Drag", "Source", "Position", "linkage"):
        assert word not in text.split("<script")[0]


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    "sweep", ['values = [0, 15, "acos(4/5)", 200, 100]', "values = [30]", "start = 0\nstop = 360\nstep = 0.1"]
)
@pytest.mark.usefixtures("few")
def test_other_sweeps_and_charts(sweep, tmp_path):
    text = template_text("four-bar")
    text = text.replace("start = 0\nstop = 360\nstep = 15", sweep)
    text = text.replace('y = ["theta13", "theta14", "mu"]', 'y = ["theta12", "A.x", "theta14"]')
    page = mechsheet.plot(mechsheet.loads(text), tmp_path / "s.html").read_text(encoding="utf-8")
    judge_page(page)
    assert page.count('class="values"') == 1


def test_texts_of_the_description_are_escaped(tmp_path):
    text = template_text("four-bar")
    text = text.replace('"Four-bar linkage"', "'<script>alert(1)</script> & \"co\"'").replace(
        '"coupler"', "'</script>'"
    )
    page = mechsheet.plot(mechsheet.loads(text), tmp_path / "e.html").read_text(encoding="utf-8")
    assert page.count("<script") == page.count("</script>") == 2
    mechsheet.plot(mechsheet.loads(text), tmp_path / "e.svg")
    ET.parse(tmp_path / "e.svg")


def test_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("plot", TEMPLATES / "four-bar.toml", "--at", "60", "--set", "a1=72")
    assert (result.exit_code, result.stdout) == (0, "four-bar.svg\n")
    assert Path("four-bar.svg").exists()


@pytest.mark.cases(7)
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--at", "180", "--set", "a2=90", "-o", "x.svg"], "no position at θ₁₂ = 180°"),
        (["--at", "400", "-o", "x.gif"], "400 lies outside of the sweep"),
        (["--at", "-1", "-o", "x.html"], "-1 lies outside of the sweep"),
        (["--at", "nan", "-o", "x.svg"], "expected a finite number, found nan"),
        (["--at", "sixty", "-o", "x.svg"], "'sixty' is not a valid float"),
        (["-o", "x.tiff"], "endings: .svg, .png, .gif, .html, .pdf"),
        (["-o", "x.htm"], 'did you mean "html"?'),
        (["-o", "x"], "endings: .svg"),
        (["-o", "nowhere/x.html"], "there is no such folder"),
    ],
)
def test_mistakes(arguments, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("plot", TEMPLATES / "four-bar.toml", *arguments)
    assert result.exit_code == 2
    assert message in result.stderr
    assert not list(tmp_path.iterdir())


def test_library_says_the_same(tmp_path):
    with pytest.raises(MechsheetError, match="ending"):
        mechsheet.plot(template("four-bar"), tmp_path / "x.tiff")
    with pytest.raises(OutputError, match="there is no such folder"):
        mechsheet.plot(template("four-bar"), tmp_path / "no" / "x.html")


def test_without_matplotlib(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for kind in ("svg", "png", "gif", "pdf"):
        with pytest.raises(MissingProgramError, match=r"mechsheet\[plot\]"):
            mechsheet.plot(template("four-bar"), tmp_path / f"x.{kind}")
    mechsheet.plot(template("four-bar"), tmp_path / "x.html")
    assert [path.name for path in tmp_path.iterdir()] == ["x.html"]


@pytest.mark.ci  # sixty frames; a few of them: test_every_kind
def test_animation_is_small():
    """What the README shows: below 300 kB."""
    stage = Stage(sample(template("four-bar"), None, None))
    rows, _ = journey(stage, plotting.GIF_FRAMES)
    data = pictures.gif([stage.drawing(row) for row in rows], "four-bar")
    assert len(data) < 300_000
    with Image.open(io.BytesIO(data)) as image:
        assert image.n_frames == 60
