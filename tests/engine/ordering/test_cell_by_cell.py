"""Blocks that read each other cell by cell: the order of the cells is found once, and circles are found every time."""

from livesheet.engine import compile_book
from livesheet.engine.ordering.cell_by_cell import Together
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula


def to_and_fro(*formulas):
    """B2:B4 reads C one row above, C1:C3 reads B beside; what a LET names keeps them from being columns in a row's order."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [1.0, 2.0, 3.0])
    sheet.constant(0, 1, 5.0)
    sheet.block(1, 1, 3, 1, parse_formula("LET(x,C1,x+1)"))
    sheet.block(0, 2, 3, 1, parse_formula("MAX(INDEX(B1:B1,1):INDEX(B1:B1,1))+A1"))
    for row, text in enumerate(formulas):
        sheet.block(row, 5, 1, 1, parse_formula(text))
    return compile_book(builder.build())


def test_the_known_order_gives_what_a_new_plan_gives():
    for formulas in ((), ('INDIRECT("A"&A1)+C3',)):  # the second with an order of steps that depends on values
        plan = to_and_fro(*formulas)
        assert plan.settles == bool(formulas)
        (together,) = [step for step in plan.steps if isinstance(step, Together)]
        for number in range(8):
            inputs = {("S", 0, 1): float(number), ("S", 1, 0): ErrorValue("#N/A") if number == 5 else 2.0}
            found, new = plan.evaluate(inputs), to_and_fro(*formulas).evaluate(inputs)
            assert list(found.items("S")) == list(new.items("S"))
            assert together._order is not None


def test_a_circle_that_comes_and_goes():
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constant(0, 0, 1.0)
    sheet.block(0, 1, 1, 1, parse_formula("IF(A1>0,1,C1)"))
    sheet.block(0, 2, 1, 1, parse_formula("B1+1"))
    plan = compile_book(builder.build())
    for number in (1.0, 1.0, 1.0, 1.0, 1.0, 1.0, -1.0, 1.0, -1.0):
        values = plan.evaluate({("S", 0, 0): number})
        expected = [1.0, 2.0] if number > 0 else [ErrorValue("#REF!")] * 2
        assert [values.get("S", 0, col) for col in (1, 2)] == expected
        assert bool(values.remarks) == (number < 0)
