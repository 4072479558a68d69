"""The written solution: the text's own numbers, every template in both languages, LaTeX that compiles."""

import re
import shutil
import subprocess
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from folders import TEMPLATE_FILES
from mechsheet.description import Overrides, load, loads
from mechsheet.diagnostics import MechsheetError
from mechsheet.exporting import Job, export
from mechsheet.exporting.mathtext import point_math, symbol_math
from mechsheet.exporting.solution import latex, markdown
from mechsheet.model import Label

BY_NAME = {path.stem: path for path in TEMPLATE_FILES}
PUBLISHED = Path(__file__).parent.parent / "data" / "published" / "worked-values.toml"


def written(mechanism, at=None):
    return markdown(Job(mechanism, "it", at))[0].decode()


@pytest.fixture(scope="module")
def calculator():
    """The text's slider-crank with the tolerances that its printed digits stand for, at 60 degrees."""
    text = BY_NAME["slider-crank"].read_text(encoding="utf-8")
    for symbol, value in (("a1", 20), ("a2", 50), ("a3", 250), ("b3", 120), ("gamma3", 30)):
        changed = re.sub(
            rf"(?m)^{symbol} = {{ value = {value},", rf"{symbol} = {{ value = {value}, tolerance = 0.1,", text
        )
        assert changed != text
        text = changed
    return written(loads(text, overrides=Overrides(language="en")), 60)


def test_the_texts_calculator_example(calculator):
    """Each number that the text prints is printed, as it prints it."""
    printed = tomllib.loads(PUBLISHED.read_text(encoding="utf-8"))["slider-crank"]
    sine = re.search(
        r"a_\{3\}\\,e\^\{i\\theta_\{13\}\}\$ \| \$250\.0\$ \| \$(.*?)\^\\circ\$ \| \$.*?\$ \| \$(.*?)\$", calculator
    )
    assert sine.groups() == (str(printed["theta13_deg"]), str(printed["sin_theta13"]))
    for symbol, key in ((r"s_{14}", "s14"), (r"x_{C}", "xC"), (r"y_{C}", "yC")):
        assert f"| ${symbol}$ | ${printed[key]:.1f}\\ \\mathrm{{mm}}$ |" in calculator
    assert f"| $\\theta_{{13}}$ | ${printed['theta13_deg']}^\\circ$ |" in calculator


@pytest.mark.parametrize(
    "line",
    [
        r"\overrightarrow{A_{0}A} + \overrightarrow{AB} &= \overrightarrow{A_{0}B} \\",
        r"a_{2}\,e^{i\theta_{12}} &= a_{3}\,e^{i\theta_{13}} + i\,a_{1} + s_{14}",
        r"a_{2}\,\cos \theta_{12} &= a_{3}\,\cos \theta_{13} + s_{14} \\",
        r"a_{2}\,\sin \theta_{12} &= a_{3}\,\sin \theta_{13} + a_{1}",
        r"&= 50.0 \cdot \cos\left(60.0^\circ\right) = 25.0\ \mathrm{mm}",
        r"&= \sqrt{(250.0 - (-23.3)) \cdot (250.0 + (-23.3))} = 248.9\ \mathrm{mm}",
        r"&= 1 \cdot 248.9 + 25.0 = 273.9\ \mathrm{mm}",
        r"&= 20.0 + 120.0 \cdot \sin\left(174.7^\circ - 30.0^\circ\right) \\",
        "Unknown in it: $\\theta_{13}$ and $s_{14}$.",
    ],
)
def test_written_as_the_text_writes(calculator, line):
    assert line in calculator.splitlines()


@pytest.mark.parametrize(
    ("symbol", "code"),
    [
        ("theta13", r"\theta_{13}"),
        ("A0.x", r"x_{A_{0}}"),
        ("A0B0", "A_{0}B_{0}"),
        ("s_x_2", "s_{x,2}"),
        ("phi_0", r"\varphi_{0}"),
        ("mode_1", r"\mathit{mode}_{1}"),
        ("çıkış", r"\text{çıkış}"),
        ("phi_held_2", r"\varphi_{\text{held},2}"),
    ],
)
def test_symbols(symbol, code):
    assert symbol_math(symbol) == code


def test_names_of_points():
    assert [point_math(name) for name in ("A", "A0", "P12", "pin_1", "Çene")] == [
        "A", "A_{0}", "P_{12}", r"\text{pin\_1}", r"\text{Çene}",
    ]  # fmt: skip


def test_radians(tmp_path):
    text = BY_NAME["four-bar"].read_text(encoding="utf-8")
    text = text.replace("[mechanism]\n", '[mechanism]\nangle_unit = "rad"\n', 1)
    text = re.sub(r"(?s)\[driver\].*?\n\n", '[driver]\nlink = "crank"\nvalues = [0.5, 1, 1.5]\n\n', text)
    document = written(loads(text, overrides=Overrides(language="en")), 1.0)
    assert r"\theta_{12} &= 1.0000\ \mathrm{rad}" in document
    assert "circ" not in document.replace("180^\\circ", "")
    assert r"\cos\left(1.0000\right)" in document


@pytest.mark.slow
def test_where_there_is_no_position(tmp_path):
    mechanism = load(BY_NAME["cylinder-boom"])
    for kind in ("latex", "markdown"):
        with pytest.raises(MechsheetError, match="no position at"):
            export(mechanism, kind, tmp_path / "it", at=1e6)
        with pytest.raises(MechsheetError, match="expected a finite number, found nan"):
            export(mechanism, kind, tmp_path / "it", at=float("nan"))
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_texts_of_the_description_stay_texts():
    hostile = Label(r"\input{x} $y$ #1 50% a_b ^~ | `c` <d> *e* & → ğ")
    given = load(BY_NAME["four-bar"])
    dims = tuple(replace(dim, label=hostile) for dim in given.dimensions)
    mechanism = replace(given, title=hostile, source=hostile, dimensions=dims)
    tex = latex(Job(mechanism, "it"))[0].decode()
    assert r"\input" not in tex
    assert r"\textbackslash{}input\{x\} \$y\$ \#1 50\% a\_b" in tex
    lines = written(mechanism).splitlines()
    assert lines[0].startswith(r"# \\input\{x\} \$y\$ \#1 50% a\_b")
    rows = [line for line in lines if line.startswith("| $a_{1}$")]
    assert len(re.split(r"(?<!\\)\|", rows[0])) == 5


@pytest.mark.slow
def test_same_bytes(tmp_path):
    for kind in ("latex", "markdown"):
        first, second = (export(load(BY_NAME["oldham"]), kind, tmp_path / "it")[0].read_bytes() for _ in range(2))
        assert first == second


@pytest.mark.latex
@pytest.mark.parametrize(
    ("name", "language"),
    [("slider-crank", "en"), ("four-bar", "tr"), ("fivelink", "tr"), ("jansen", "en"), ("adjustable-pump", "tr")],
)
def test_latex_compiles(name, language, tmp_path):
    """No error, nothing undefined, no line over the margin."""
    export(load(BY_NAME[name], Overrides(language=language)), "latex", tmp_path / "it.tex")
    command = [shutil.which("pdflatex"), "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", "it.tex"]
    ran = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, encoding="latin-1", check=False, timeout=60
    )
    assert ran.returncode == 0, ran.stdout[-1500:]
    assert not re.search(r"^!|Overfull|undefined|Missing character", ran.stdout, re.MULTILINE), ran.stdout[-1500:]
    assert (tmp_path / "it.pdf").read_bytes().startswith(b"%PDF")
