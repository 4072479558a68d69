import random

import pytest

from mechsheet.reference.system import blocks, matching


def test_triangular():
    assert blocks([[0], [0, 1], [1, 2, 0]]) == [([0], [0]), ([1], [1]), ([2], [2])]


def test_coupled_pair_after_what_it_needs():
    assert blocks([[1, 2], [1, 2, 0], [0]]) == [([2], [0]), ([0, 1], [1, 2])]


def test_no_matching():
    assert matching([[0], [0], [1, 2]]) is None
    assert blocks([[0], [0], [1, 2]]) is None


@pytest.mark.parametrize("seed", range(20))
def test_hidden_order_is_found(seed):
    """Blocks of known sizes, shuffled: the same sizes come back, and each block needs only what came before."""
    rng = random.Random(seed)
    sizes = [rng.randint(1, 5) for _ in range(8)]
    pattern, first = [], 0
    for size in sizes:
        inside = list(range(first, first + size))
        for i in range(size):
            earlier = [u for u in range(first) if rng.random() < 0.3]
            pattern.append([inside[i], inside[(i + 1) % size], *earlier])
        first += size
    names, rows = list(range(first)), list(range(first))
    rng.shuffle(names)
    rng.shuffle(rows)
    shuffled = [[names[u] for u in pattern[r]] for r in rows]
    found = blocks(shuffled)
    assert sorted(len(unknowns) for _, unknowns in found) == sorted(sizes)
    known = set()
    for equations, unknowns in found:
        known |= set(unknowns)
        assert all(set(shuffled[e]) <= known for e in equations)
