"""Designs by their numbers: whoever asks for some of them gets what is there when all are listed."""

import itertools

import numpy as np
import pytest

from mechsheet.model import Range
from mechsheet.studies.sampling import Grid, Sobol

BOX = (Range("a", 20, 60), Range("b", -1, 1), Range("c", 0.5, 0.75))


def test_a_grid_is_all_combinations_the_last_dimension_first():
    grid = Grid((Range("a", 1, 2, 0.5), Range("b", values=(7.0, 3.0)), Range("c", 0, 10, 5)))
    wanted = list(itertools.product([1, 1.5, 2], [7, 3], [0, 5, 10]))
    assert grid.total == len(wanted)
    assert grid.values(np.arange(grid.total)).tolist() == [list(each) for each in wanted]


@pytest.mark.parametrize(("low", "step"), [(20, 0.1), (0.05, 0.01), (-3, 0.7), (1e-3, 1e-5)])
def test_values_are_those_that_somebody_would_type(low, step):
    values = Grid((Range("a", low, low + 50 * step, step),)).values(np.arange(51))[:, 0]
    assert all(len(repr(value)) <= 8 for value in values.tolist())
    assert np.allclose(values, low + step * np.arange(51), rtol=1e-12)


def test_a_grid_of_a_million_million_is_not_held():
    grid = Grid(tuple(Range(name, 0, 9_999, 1) for name in "abc"))
    assert grid.total == 10**12
    assert grid.values(np.array([0, 123_456_789_012, 10**12 - 1])).tolist() == [
        [0, 0, 0],
        [1234, 5678, 9012],
        [9999, 9999, 9999],
    ]


@pytest.mark.parametrize("seed", [0, 7])
def test_sobol_points_are_scipys(seed):
    from scipy.stats import qmc  # a second to load: only where it is needed

    engine = qmc.Sobol(3, scramble=True, bits=30, seed=np.random.default_rng(seed))
    wanted = [20, -1, 0.5] + engine.random(2**14) * [40, 2, 0.25]
    assert np.array_equal(Sobol(BOX, 20_000, seed).values(np.arange(2**14)), wanted)


def test_a_part_of_a_sample_is_that_part_of_all():
    sample = Sobol(BOX, 100_000, 1)
    every = sample.values(np.arange(100_000))
    numbers = np.random.default_rng(0).integers(0, 100_000, 500)
    assert np.array_equal(sample.values(numbers), every[numbers])
    assert (every >= [20, -1, 0.5]).all()
    assert (every < [60, 1, 0.75]).all()


def test_a_longer_sample_begins_with_the_shorter():
    assert np.array_equal(Sobol(BOX, 1000, 5).values(np.arange(1000)), Sobol(BOX, 9000, 5).values(np.arange(1000)))
