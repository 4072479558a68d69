"""Random linkages of all five dyads: what the workbook computes is what Newton's method finds from the model alone."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from chosen import examples, part
from judging import judged
from mechsheet.description import loads
from mechsheet.kinematics.solve import solve
from random_mechanisms import KINDS, Grower

pytestmark = pytest.mark.slow

CHUNK = 20
CHUNKS = 15
"""15 x 20 = 300 mechanisms in a full run, always the same."""


def mechanism(seed: int, rows: int = 13):
    return loads(Grower(seed, 1 + seed % 6).text(rows))


@pytest.mark.ci
@pytest.mark.parametrize("chunk", part(range(CHUNKS), of=15))
def test_engine_equals_reference(chunk):
    worst = 0.0
    for seed in range(chunk * CHUNK, (chunk + 1) * CHUNK):
        comparison = judged(mechanism(seed))
        assert comparison.agrees, (seed, comparison)
        worst = max(worst, comparison.worst)
    assert worst < 1e-9


@settings(max_examples=examples(25), derandomize=True, deadline=None, database=None)
@given(st.integers(10_000, 2**31), st.sampled_from([(kind,) for kind in KINDS]))
def test_a_single_kind(seed, kinds):
    comparison = judged(loads(Grower(seed, 1 + seed % 3, kinds).text(7)))
    assert comparison.agrees, (seed, kinds, comparison)


@pytest.mark.cases(4)
@pytest.mark.parametrize("seed", part(range(400, 440), 2))
def test_dimensions_and_modes_changed_in_the_sheet(seed):
    """The workbook follows its input cells: a few dimensions changed by some percent, every second mode flipped."""
    given_mechanism = mechanism(seed, 7)
    random = np.random.default_rng(seed)
    changes = {}
    for dimension in given_mechanism.dimensions:
        if random.random() < 0.3:
            changes[dimension.symbol] = dimension.shown * (1 + 0.04 * random.uniform(-1, 1))
    for group in solve(given_mechanism).groups:
        if group.mode and group.number % 2:
            changes[group.mode] = -group.mode_value
    comparison = judged(given_mechanism, changes)
    assert comparison.agrees, (seed, changes, comparison)


@pytest.mark.ci
def test_every_kind_occurs():
    kinds = [group.kind for seed in range(60) for group in solve(mechanism(seed)).groups]
    assert set(kinds) == set(KINDS)
    assert all(kinds.count(kind) >= 10 for kind in KINDS)
