"""What the benchmarks compare gives the same values on all sides."""

import sys
from pathlib import Path

import numpy as np
import pytest

import mechsheet
from livesheet.engine import evaluate

sys.path.insert(0, str(Path(__file__).parent.parent / "benchmarks"))

import bench_engine
import bench_forces
import bench_rows
import bench_study
import bench_sweep
import tables

ROWS = 73


@pytest.mark.parametrize("shared", [False, True])
def test_the_table_that_engines_are_compared_on(tmp_path, shared):
    path = tmp_path / "table.xlsx"
    tables.write_table(path, ROWS, shared)
    book = mechsheet.open_book(path)
    for a_2 in (tables.INPUTS["a_2"], 34.5):
        book["a_2"] = a_2
        found = book[f"Positions!B{tables.FIRST}:M{tables.FIRST + ROWS - 1}"]
        assert np.allclose(found, np.transpose(tables.by_hand(ROWS, a_2)), rtol=1e-12, atol=1e-12)


def test_the_four_bar_and_the_two_way_table():
    four_bar = evaluate(bench_engine.four_bar(ROWS))
    for col, column in enumerate(bench_engine.by_hand(ROWS), 1):
        found = four_bar.arrays("Positions", col, bench_engine.FIRST, bench_engine.FIRST + ROWS - 1)[0]
        assert np.allclose(found, column, rtol=1e-12, atol=1e-12)
    pump = evaluate(bench_engine.pump(ROWS))
    expected = bench_engine.pump_by_hand(ROWS)
    for col in range(len(bench_engine.ACROSS)):
        assert np.allclose(pump.arrays("Table", col + 1, 7, ROWS + 6)[0], expected[:, col], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("name", sorted(bench_rows.CASES))
def test_columns_that_read_each_other_row_by_row(name):
    build, by_hand, _, _ = bench_rows.CASES[name]
    assert bench_rows.worst(build(ROWS), by_hand(ROWS)) < 1e-12


def test_the_sweep_of_the_four_bar():
    theta12 = bench_sweep.driver(ROWS)
    found, expected = bench_sweep.ours(theta12), bench_sweep.by_hand(theta12)
    for name, column in expected.items():
        assert np.allclose(found[name], column, rtol=1e-12, atol=1e-12), name


@pytest.mark.slow
def test_the_four_bar_with_forces():
    book, plan = bench_forces.tables_of(ROWS)
    assert bench_forces.worst_of(ROWS, evaluate(book), plan) < 1e-12


def test_four_bars_by_the_thousand():
    """Which designs are kept, their least angles and the heights of their coupler points."""
    pytest.importorskip("pyarrow")
    found = bench_study.agree(bench_study.designs_of(1_024, ROWS), 1_024)
    assert len(found.numbers) > 50
