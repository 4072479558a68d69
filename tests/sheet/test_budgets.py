"""What a person reads stays small: columns, and formulas short enough to be read.

Cells and bytes in all are printed by `benchmarks/bench_budgets.py`, and held by nothing: as a gate they bred special cases.
"""

from dataclasses import replace

import pytest
from budgets import (
    A_PASS,
    ANYWHERE,
    FOUR_BAR_COLUMNS,
    IN_TABLE,
    LAW_OF_A_LOAD,
    PAGES,
    TABLES,
    compiled,
    length,
    longest_of_tables,
    size_of,
)

from chosen import ITERATED, STEPWISE, part, some
from folders import TEMPLATE_NAMES
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.newton.system import FIRST_PASSES
from mechsheet.sheet.table.positions import heading
from random_mechanisms import Grower


@pytest.mark.parametrize("layout", FOUR_BAR_COLUMNS)
def test_columns_of_a_four_bar(layout):
    assert size_of(compiled("four-bar", layout)).columns <= FOUR_BAR_COLUMNS[layout]


@pytest.mark.cases(5)
@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_other_sheets_have_few_columns_for_each_of_the_table(name):
    size = size_of(compiled(name))
    # what follows from the unknowns of Newton's method stands in its passes
    passes = [group.system.passes for group in compiled(name).equations.groups if group.system]
    assert size.rates <= 1.6 * (size.table + size.iterations / (max(passes, default=0) + 1))
    assert size.forces <= 2.5 * size.table
    bands = compiled(name).plan.mechanism.bands
    assert size.tolerance <= size.table * (len(bands.quantities) if bands else 0)


@pytest.mark.slow
def test_velocities_and_forces_of_a_four_bar_with_three_masses():
    """Nineteen columns for velocities with a point, thirty-seven for forces: 1,400 formulas where there are 25 rows."""
    found = compiled("four-bar-forces")
    size, rows = size_of(found), found.plan.rows
    assert len(found.mechanism.dynamics.masses) == 3
    assert (size.rates, size.forces) == (19 * rows, 37 * rows)


@pytest.mark.cases(9)
@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_iterations(name):
    """Passes, unknowns and rows decide how large the sheet of Newton's method is; its start what leads to the group, too."""
    found = compiled(name)
    systems = [group.system for group in found.equations.groups if group.system]
    start = FIRST_PASSES + 1
    most = sum(A_PASS * len(each.unknowns) * ((each.passes + 1) * found.plan.rows + start) for each in systems)
    most += sum(start * (len(each.described) + len(each.way) + 2) for each in systems)
    assert size_of(found).iterations <= most


@pytest.mark.cases(5)
@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_no_heading_stands_over_two_columns(name):
    plan = compiled(name).plan
    heads = [str(getattr(head, "plain", head)) for head in (heading(plan, column) for column in plan.columns)]
    assert len(set(heads)) == len(heads)


@pytest.mark.slow
@pytest.mark.cases(12)
@pytest.mark.parametrize(
    ("name", "layout"), [*((name, "sheets") for name in TEMPLATE_NAMES), *((name, "page") for name in PAGES)]
)
def test_formulas_of_tables_can_be_read(name, layout):
    """Every table that a person reads row by row, and every two-way table with its helpers."""
    longest = longest_of_tables(compiled(name, layout))
    assert longest <= TABLES


WRITTEN = [("en", "sheets", "names"), ("en", "page", "anchors")]
WRITTEN += [
    ("tr", layout, references)
    for layout, references in (("sheets", "names"), ("sheets", "anchors"), ("page", "anchors"))
]
"""Turkish words and titles of sheets are the longer ones."""


@pytest.mark.slow
@pytest.mark.cases(8)
@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_no_formula_is_too_long_to_be_read(name):
    """One that is longer says the same part twice, or asks all inputs in one: nobody can follow it in the line above the
    sheet."""
    for language, layout, references in WRITTEN:
        if (layout == "page" and name in (*ITERATED, *STEPWISE)) or (references == "anchors" and name in LAW_OF_A_LOAD):
            continue
        described = loads(template_text(name), overrides=Overrides(language=language))
        found = Compiled(replace(described, layout=layout, references=references)).layout
        longest = max(
            (length(fill), sheet.title, fill.row + 1, fill.col) for sheet in found.sheets for fill in sheet.fills
        )
        assert longest[0] <= ANYWHERE, (language, layout, references, longest)


@pytest.mark.parametrize("seed", part(range(6), of=3))
def test_the_first_sheet_of_any_mechanism_can_be_read(seed):
    """However many inputs, loops and angles of transmission there are, no formula grows with them."""
    described = loads(Grower(seed, dyads=4).text(), overrides=Overrides(language="tr"))
    found = Compiled(replace(described, references="anchors"))
    assert max(map(length, found.layout.sheets[0].fills)) <= ANYWHERE


FORMS = [(name, "names") for name in TEMPLATE_NAMES] + [(name, "anchors") for name in some(TEMPLATE_NAMES, 2)]
"""Pages: see page/test_page.py."""


@pytest.mark.cases(10)
@pytest.mark.parametrize(("name", "references"), FORMS)
def test_formulas_are_short(name, references):
    size = size_of(compiled(name, "sheets", references))
    assert size.longest <= IN_TABLE["sheets", references]
    assert size.ifs <= 1
