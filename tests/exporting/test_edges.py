"""Descriptions that a printer could trip over: names that are words of a language, radians, expressions, a single row."""

import io
import zipfile

import numpy as np
import pytest
from exported import worst_against_reference
from test_octave import RUNNER, arrays, octave
from test_python import loaded, run_all

from mechsheet.description import loads
from mechsheet.diagnostics import MechsheetError
from mechsheet.exporting import KINDS, Job, export

TEXT = """format = 1
[mechanism]
name = "four-bar"
title = "four-bar"
{units}
[dimensions]
{a1} = 70
{a2} = {crank}
{a3} = 62.3
{a4} = 56
"{b3}" = 126.6
"{g3}" = {{ value = 35.5, unit = "deg" }}
[links.ground]
points = {{ A0 = [0, 0], B0 = ["{a1}", 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["{a2}", 0] }}
[links.coupler]
points = {{ A = [0, 0], B = ["{a3}", 0], C = {{ r = "{b3}", angle = "{g3}" }} }}
[links.rocker]
points = {{ B0 = [0, 0], B = ["{a4}", 0] }}
[driver]
link = "crank"
{sweep}
[assembly]
B = [50, 55]
[outputs]
{outputs}
"""
"""The text's four-bar with holes."""

NAMES = ("a1", "a2", "a3", "a4", "b3", "g3")
SWEEP = "start = 0\nstop = 360\nstep = 15"
POWERS = """
root = { formula = "(C.x - 20)^0.5 + ln(C.y - 100)", unit = "1" }
cut = { formula = "acos(C.x/40) + asin(B.x/60)", unit = "deg" }
turn = { formula = "max(abs(theta13), hypot(B.x/90, 1), 0.1) - atan2(B.y, B.x)", unit = "rad" }
over = { formula = "1/(3 + sign(B.y - 55)) + 2^3^0.5 + -(C.x/100)^2 + exp(atan(theta13)) + tan(theta14/9)", unit = "mm^2" }
"""


def text(names=NAMES, sweep=SWEEP, outputs="", units="", crank=35):
    return TEXT.format(**dict(zip(NAMES, names, strict=True)), sweep=sweep, outputs=outputs, units=units, crank=crank)


FOUR_BAR = text()
CASES = {
    # a program's own names, keywords, Greek and Turkish letters, names that differ only in a letter that ASCII lacks
    "names": text(("rows", "end", "lambda", "exists", "ölçü", "olcu")),
    "more_names": text(("np", "varargin", "start", "result", "θ", "solve")),
    "single_row": text(sweep="start = 30\nstop = 30\nstep = 15"),
    "values": text(sweep='values = [0, 15, "acos(a4/a1)", 200, 100, -700]'),
    "backwards": text(sweep='start = "asin(a2/a1)"\nstop = -720\nstep = -7'),
    "radians": text(units='angle_unit = "rad"', sweep="start = 0\nstop = 7\nstep = 0.1"),
    "limits": text(crank=69, sweep="start = 60\nstop = 700\nstep = 7"),
    "many_rows": text(sweep="start = 0\nstop = 720\nstep = 0.2"),
    "furlongs": text(units='length_unit = "furlong"'),
    "powers": text(outputs=POWERS),
}


@pytest.fixture(scope="module")
def mechanisms():
    return {name: loads(case) for name, case in CASES.items()}


@pytest.mark.slow
def test_python(mechanisms, tmp_path):
    for name, mechanism in mechanisms.items():
        export(mechanism, "python", tmp_path / f"{name}.py")
        (tmp_path / f"{name}.changes").write_text("{}")
    run_all(tmp_path)
    for name, mechanism in mechanisms.items():
        assert worst_against_reference(mechanism, loaded(tmp_path, name)) < 1e-9, name


@pytest.mark.octave
def test_octave(mechanisms, tmp_path):
    for name, mechanism in mechanisms.items():
        export(mechanism, "octave", tmp_path / f"{name}.m")
    octave(tmp_path, RUNNER + "disp('done')")
    for name, mechanism in mechanisms.items():
        assert worst_against_reference(mechanism, arrays(mechanism, tmp_path / f"{name}.txt")) < 1e-9, name


@pytest.mark.cases(5)
@pytest.mark.parametrize("kind", sorted(KINDS))
def test_every_kind_writes_them(kind, mechanisms):
    all_names = kind in ("geogebra", "latex", "octave", "python", "vba")
    for name in ("names", "powers") if all_names else ("single_row",):
        (content,) = KINDS[kind].write(Job(mechanisms[name], "it"))
        if kind == "geogebra":  # an archive with one text
            content = zipfile.ZipFile(io.BytesIO(content)).read("geogebra.xml")
        content.decode()
        assert len(content) > 100


@pytest.mark.slow
def test_the_cases_are_what_they_say(mechanisms, tmp_path):
    assert "olcu" in {dim.symbol for dim in mechanisms["names"].dimensions}
    export(mechanisms["powers"], "python", tmp_path / "powers.py")
    (tmp_path / "powers.changes").write_text("{}")
    run_all(tmp_path)
    found = loaded(tmp_path, "powers")
    exists = np.isfinite(found["C.x"])
    for symbol in ("root", "cut"):
        assert 0 < np.isnan(found[symbol][exists]).sum() < exists.sum(), "missing in some rows, there in others"


def test_a_file_name_that_is_no_name(tmp_path):
    for kind in ("octave", "python"):
        with pytest.raises(MechsheetError, match=r"(?s)letters, digits and _.*for example four_bar"):
            export(loads(FOUR_BAR), kind, tmp_path / f"four-bar{KINDS[kind].suffix}")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("kind", "name"),
    [("octave", "plot"), ("octave", "end"), ("python", "csv"), ("python", "numpy"), ("python", "lambda")],
)
def test_a_name_that_stands_in_the_way(kind, name, tmp_path):
    with pytest.raises(MechsheetError, match=f"for example {name}_mechanism"):
        export(loads(FOUR_BAR), kind, tmp_path / f"{name}{KINDS[kind].suffix}")
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_default_names(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = [export(loads(FOUR_BAR), kind)[0].name for kind in ("octave", "python", "csv", "markdown")]
    assert names == ["four_bar.m", "four_bar.py", "four-bar.csv", "four-bar.md"]
    files = export(loads(FOUR_BAR), "svg", frames=2)
    assert [path.as_posix() for path in files] == ["four-bar/four-bar-1.svg", "four-bar/four-bar-2.svg"]
