"""Random formulas over random cells: the values that other programs confirmed, and the same in blocks as alone."""

import random

import pytest

from asking import agree, ours
from engine_cases import COLUMN, FIRST_ROW, FOLDER, anchored, load, same, scalar
from livesheet.engine import compile_book
from livesheet.formula.book import BookBuilder
from livesheet.formula.parser import parse_formula
from random_formulas import Formulas, random_cells


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("path", sorted((FOLDER / "random").glob("*.toml")), ids=lambda path: path.stem)
def test_values_that_other_programs_confirmed(path):
    table = load(path)
    grid = [(row, col, scalar(value)) for row, col, value in table["cells"]]
    found = ours([formula for formula, _ in table["cases"]], grid)
    wrong = [
        (formula, value, mine)
        for (formula, value), mine in zip(table["cases"], found, strict=True)
        if not agree(scalar(value), mine)
    ]
    assert wrong == []


def drawn(seed, count):
    chance = random.Random(seed)
    grid, formulas = list(random_cells(chance)), Formulas(chance)
    return grid, [formulas.formula() for _ in range(count)]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [11, 12])
def test_formulas_filled_down_are_the_formula_alone(seed):
    """A block of cells gives in each of them what the formula gives by itself."""
    grid, texts = drawn(seed, 400)
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row, col, value in grid:
        sheet.constant(row, col, value)
    for index, text in enumerate(texts):
        sheet.block(FIRST_ROW + 3 * index, COLUMN, 2, 2, anchored(parse_formula(text)))
    plan = compile_book(builder.build())
    alone = ours(texts, grid)
    for _ in range(2):
        values = plan.evaluate()
        for index, text in enumerate(texts):
            for row in range(2):
                for col in range(2):
                    found = values.get("S", FIRST_ROW + 3 * index + row, COLUMN + col)
                    assert same(found, alone[index], 1e-12), (text, found, alone[index])
