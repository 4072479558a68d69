"""The library as notebooks and scripts use it."""

import ast
import builtins
import json
import pickle
import time
from dataclasses import replace

import numpy as np
import pytest

import mechsheet
from folders import ROOT
from mechsheet.description.templates import template_text

FOUR_BAR = ROOT / "templates" / "four-bar.toml"


def test_columns_by_name():
    motion = mechsheet.load(FOUR_BAR).solve()
    assert next(iter(motion)) == "theta12"
    assert motion.units["theta14"] == "°" and motion.units["C.x"] == "mm"
    assert motion["theta12"].tolist() == [15.0 * row for row in range(25)]
    assert motion.exists.all()
    # AB is a3 in every row
    x, y = motion["B.x"] - motion["A.x"], motion["B.y"] - motion["A.y"]
    assert np.hypot(x, y) == pytest.approx(62.3, abs=1e-12)


def test_a_dimension_changed():
    linkage = mechsheet.load(FOUR_BAR, {"a3": 70})
    motion = linkage.solve()
    assert np.hypot(motion["B.x"] - motion["A.x"], motion["B.y"] - motion["A.y"]) == pytest.approx(70, abs=1e-12)


def test_rows_that_do_not_exist():
    motion = mechsheet.load(FOUR_BAR, {"a2": 60}).solve()
    assert 0 < motion.exists.sum() < len(motion.exists)
    assert np.isnan(motion["theta14"][~motion.exists]).all()


@pytest.mark.slow
def test_a_frame_has_the_driver_as_index():
    motion = mechsheet.load(FOUR_BAR).solve()
    frame = motion.frame()
    assert frame.index.name == "theta12"
    assert frame["mu"].to_numpy() == pytest.approx(motion["mu"])


def test_without_pandas(monkeypatch):
    real = builtins.__import__

    def without(name, *args, **kwargs):
        if name == "pandas":
            raise ImportError(name)
        return real(name, *args, **kwargs)

    motion = mechsheet.load(FOUR_BAR).solve()
    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(mechsheet.MechsheetError, match=r"mechsheet\[notebook\]"):
        motion.frame()


@pytest.mark.slow
def test_a_drawing_shows_itself():
    shown = mechsheet.load(FOUR_BAR).drawing(at=60)._repr_mimebundle_()
    assert shown["image/svg+xml"].lstrip().startswith("<?xml")
    assert shown["text/plain"] == "<Drawing of four-bar at 60>"


@pytest.mark.slow
def test_methods_do_what_functions_do(tmp_path):
    linkage = mechsheet.loads(template_text("four-bar"))
    [path] = linkage.build(tmp_path)
    assert mechsheet.check(path).agrees
    assert linkage.plot(tmp_path / "a.svg").exists()
    assert repr(linkage) == "<Linkage four-bar: 4 links, driven by theta12>"


@pytest.mark.slow
def test_the_notebook_runs(monkeypatch, tmp_path):
    """Every code cell in order; the last expression of a cell can be shown."""
    monkeypatch.chdir(tmp_path)
    notebook = json.loads((ROOT / "docs" / "examples" / "four-bar.ipynb").read_text(encoding="utf-8"))
    space: dict = {}
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    for source in cells:
        exec(compile(source, "four-bar.ipynb", "exec"), space)
        last = ast.parse(source).body[-1]
        if isinstance(last, ast.Expr):
            assert repr(eval(ast.unparse(last), space))
    assert len(cells) >= 6
    assert space["agrees"] is True
    assert space["least"][25] > space["least"][40]


def test_a_linkage_is_solved_once_and_its_answers_are_the_callers_own():
    linkage = mechsheet.template("four-bar")
    first = linkage.solve()
    wanted = first["theta14"].copy()
    first["theta14"][:] = 0.0

    def seconds():
        start = time.perf_counter()
        assert np.array_equal(linkage.solve()["theta14"], wanted)
        return time.perf_counter() - start

    assert min(seconds() for _ in range(5)) < 0.010
    other = replace(linkage, driver=replace(linkage.driver, values=(0.5, 1.0)))
    assert len(other.solve()["theta14"]) == 2
    assert len(pickle.loads(pickle.dumps(linkage)).solve()["theta14"]) == 25
