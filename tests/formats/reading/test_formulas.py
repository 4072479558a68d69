"""Formulas read cell by cell, gathered into blocks."""

from hypothesis import given, settings
from hypothesis import strategies as st

from livesheet.formats.reading.formulas import FormulaRuns
from livesheet.formula.nodes import shifted
from livesheet.formula.parser import parse_formula


@settings(max_examples=50, deadline=None)
@given(
    st.lists(
        st.sampled_from(["B{r}+C{p}", "SUM(B$1:B{r})", "B{r}*{r}", "$B{r}", "B$3", "LOG10(B{r})", '"B{r}"', "B{r}:B{n}"]),
        min_size=1, max_size=25,
    ).map(lambda names: [name.format(r=r, p=r + 1, n=r + 9) for r, name in enumerate(names, 1)])
)  # fmt: skip
def test_runs_say_what_each_cell_says(texts):
    """However the formulas fall into runs, each cell keeps its own."""
    runs = FormulaRuns(lambda text, area: parse_formula(text))
    for row, text in enumerate(texts):
        runs.text(row, 0, text)
    found = {b.row + down: shifted(b.formula, down) for b in runs.blocks() for down in range(b.rows)}
    assert found == {row: parse_formula(text) for row, text in enumerate(texts)}
