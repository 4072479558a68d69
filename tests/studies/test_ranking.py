"""The front and the best, against every pair compared."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from livesheet.formula.nodes import Symbol
from mechsheet.model import Objective
from mechsheet.studies.ranking import front_of, ranked

pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")

POINTS = st.integers(1, 3).flatmap(
    lambda width: st.lists(st.tuples(*[st.integers(0, 6)] * width), min_size=1, max_size=60)
)


def dominates(one, other):
    return all(a <= b for a, b in zip(one, other, strict=True)) and one != other


@given(POINTS)
def test_nobody_is_better_than_a_design_of_the_front(points):
    front = front_of(np.array(points, float))
    found = [points[place] for place in front.tolist()]
    assert set(found) == {one for one in points if not any(dominates(other, one) for other in points)}
    assert len(found) == len(set(found))
    assert all(
        points.index(one) == place for one, place in zip(found, front.tolist(), strict=True)
    )  # of equals the first


def test_many_points_of_three_objectives():
    points = np.random.default_rng(2).integers(0, 50, (3000, 3)).astype(float)
    front = points[front_of(points)]
    for point in points[:300]:
        assert np.any((front <= point).all(axis=1))


def files_of(tmp_path, *tables):
    paths = []
    for number, table in enumerate(tables):
        paths.append(tmp_path / f"{number}.parquet")
        count = len(table["design"])
        pq.write_table(pa.table({"set_apart": [False] * count, **table}), paths[-1])
    return paths


def test_the_best_of_one_objective_are_its_best_values(tmp_path):
    paths = files_of(tmp_path, {"design": [1, 2, 3], "x": [5.0, None, 7.0]}, {"design": [4, 5], "x": [9.0, 5.0]})
    assert ranked(paths, [Objective("x", Symbol("x"))], 3).best.tolist() == [1, 5, 3]
    assert ranked(paths, [Objective("x", Symbol("x"), True)], 2).best.tolist() == [4, 3]


def test_the_best_of_two_objectives_are_nearest_to_the_best_of_both(tmp_path):
    paths = files_of(tmp_path, {"design": [1, 2, 3], "x": [0.0, 1.0, 10.0], "y": [10.0, 1.0, 0.0]})
    found = ranked(paths, [Objective("x", Symbol("x")), Objective("y", Symbol("y"))], 2)
    assert found.front.tolist() == [1, 2, 3]
    assert found.best.tolist() == [2, 1]


def test_designs_set_apart_are_neither_ranked_nor_on_the_front(tmp_path):
    table = {"design": [1, 2, 3, 4], "x": [1.0, 2.0, 3.0, 0.5], "y": [4.0, 3.0, 2.0, 0.5]}
    paths = files_of(tmp_path, table | {"set_apart": [False, False, False, True]})
    found = ranked(paths, [Objective("x", Symbol("x")), Objective("y", Symbol("y"))], 4)
    assert 4 not in found.front.tolist() + found.best.tolist()
    assert found.apart.tolist() == [4]
    assert ranked(paths, [Objective("x", Symbol("x"))], 1).best.tolist() == [1]
    assert ranked(paths, [], 4).best.tolist() == [1, 2, 3]


def test_parts_do_not_change_the_front(tmp_path):
    random = np.random.default_rng(4)
    x, y = random.random((2, 900))
    whole = files_of(tmp_path, {"design": np.arange(1, 901), "x": x, "y": y})
    (tmp_path / "parts").mkdir()
    cuts = [slice(at, at + 100) for at in range(0, 900, 100)]
    parts = files_of(
        tmp_path / "parts", *({"design": np.arange(1, 901)[cut], "x": x[cut], "y": y[cut]} for cut in cuts)
    )
    objectives = [Objective("x", Symbol("x")), Objective("y", Symbol("y"), True)]
    one, other = (ranked(paths, objectives, 20) for paths in (whole, parts))
    assert one.front.tolist() == other.front.tolist()
    assert one.best.tolist() == other.best.tolist()
