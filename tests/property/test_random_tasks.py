"""Random tasks of synthesis: the workbook finds what the reference finds, and nothing where it finds nothing.

Each kind has one workbook for each form of its task; the tasks are typed into the yellow cells, as a person does.
"""

import contextlib
import functools
import math

import pytest
from placed import places_of

from chosen import first
from livesheet.evaluation import book_of
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.references import cell_address
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_values as of_equations
from mechsheet.library.session import Session
from mechsheet.reference import dimension_values as of_reference
from mechsheet.synthesis.kinds import KINDS
from synthesis_tasks import description, task

SEEDS = first(range(200), 7)  # 21 of each kind in CI
EXACT = 1e-12
FLAT = 1e-10
"""Where a best ratio is asked for: the reference finds it among computed values, by their differences."""


ROUND = str(("round",))
"""How a form says that lengths are rounded, which no random task asks for."""


def form_of(asked):
    """What tasks have in common whose numbers stand in the same cells of the same workbook."""
    task_of = loads(description(asked)).synthesis
    return asked["kind"], tuple(sorted(map(str, task_of.task))), tuple(sorted(task_of.chosen.items()))


@functools.cache
def workbook(form):
    """The session of the first task of this form that has a solution, and where its cells are."""
    for seed in range(10_000):
        asked = task(form[0], seed)
        if ROUND in form[1]:
            asked["round"] = 1.0
        if form_of(asked) == form:
            with contextlib.suppress(MechanismError):
                compiled = Compiled(loads(description(asked)))
                return Session(book_of(compiled.layout)), places_of(compiled.plan)
    raise AssertionError(f"no task of this form has a solution: {form}")


def typed(asked, mechanism):
    """The session of the task's workbook with the task typed into its cells, and where its cells are."""
    session, spots = workbook(form_of(asked))
    shown = {dim.symbol: dim.shown for dim in mechanism.dimensions}
    session.reset()
    session.update({address(spots[symbol]): shown[symbol] for symbol in mechanism.synthesis.inputs})
    return session, spots


def address(spot):
    """Of a cell of the session."""
    return cell_address(spot.sheet, spot.row, spot.col)


def compare(found, expected, names, tolerance):
    """Both have no number, or both have the same but for rounding of the largest of them."""
    lengths = [abs(expected[name]) for name in names if math.isfinite(expected[name])]
    for name in names:
        assert math.isfinite(found[name]) == math.isfinite(expected[name]), name
        if math.isfinite(expected[name]):
            assert abs(found[name] - expected[name]) <= tolerance * max(lengths), name


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", KINDS)
def test_the_equations_find_what_the_reference_finds(kind, seed):
    asked = task(kind, seed)
    mechanism = loads(description(asked))
    tolerance = FLAT if "best" in asked else EXACT
    compare(of_equations(mechanism), of_reference(mechanism), mechanism.synthesis.results.values(), tolerance)


@pytest.mark.cases(6)
@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", KINDS)
def test_tasks_typed_into_the_workbook_give_the_same(kind, seed):
    asked = task(kind, seed)
    mechanism = loads(description(asked))
    session, spots = typed(asked, mechanism)
    dimensions = {dim.symbol: dim for dim in mechanism.dimensions}
    expected, found = of_reference(mechanism), {}
    results, taken = mechanism.synthesis.results.values(), mechanism.synthesis.taken
    if not all(math.isfinite(expected[symbol]) for symbol in mechanism.synthesis.ends):
        expected |= dict.fromkeys(taken, math.nan)  # no dimension follows then, also none that the task gives itself
    for symbol in dict.fromkeys((*results, *taken)):
        value = session.get(address(spots[symbol]))
        assert isinstance(value, float | ErrorValue), symbol
        found[symbol] = dimensions[symbol].unit.to_internal(value) if isinstance(value, float) else math.nan
    compare(found, expected, found, FLAT if "best" in asked else EXACT)
