"""What a study says of a design is what its workbook says, what the reference says, and what is known in closed form."""

import numpy as np
import pytest

from chosen import ALL, some
from mechsheet.description import loads
from mechsheet.description.templates import template_names
from mechsheet.diagnostics import MechanismError, MechsheetError
from mechsheet.homework.expected_values import truth_of
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs
from studying import in_workbook, study_of, template_text

GRID = "vary = { a2 = [10, 80, 5], a3 = [10, 80, 5], a4 = [10, 80, 5] }"


def kept(mechanism):
    designs = Designs(mechanism)
    return designs, kept_of(designs, 0, designs.sampling.total)


# --- against the workbook --------------------------------------------------------------------------------------------------

TEMPLATES = (
    "four-bar",
    "slider-crank",
    "inverted-slider-crank",
    "whitworth",
    "hoeken",
    "jansen",
    "cylinder-boom",
    "excavator",
    "scotch-yoke",
    "drag-link",
    "geared-five-bar",
    "four-bar-forces",
    "toggle-press",
    "six-link-dwell",
    "oldham",
    "adjustable-pump",
    "rack-slider",
)


def around(template):
    """A study of small changes of the first inputs of a template."""
    plain = study_of("", template)
    inputs = [dim for dim in plain.dimensions if isinstance(dim.value, float) and not dim.path and dim.value][:3]
    spans = []
    for dim in inputs:
        values = [repr(round(dim.unit.to_shown(dim.value) * part, 6)) for part in (0.98, 1.0, 1.01)]
        spans.append(f"{dim.symbol} = {{ values = [{', '.join(values)}] }}")
    return f"[study]\nvary = {{ {', '.join(spans)} }}"


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.parametrize("template", some(TEMPLATES, 1, 5))
def test_summaries_are_those_of_the_workbook(template):
    mechanism = study_of(around(template), template)
    if not mechanism.summaries:
        pytest.skip("no summaries")
    designs, found = kept(mechanism)
    names = [summary.symbol for summary in mechanism.summaries]
    count = 10 if template == "four-bar" else 2
    for number in np.random.default_rng(1).choice(len(found.numbers), count, replace=False):
        values = {one: float(found.columns[one][number]) for one in designs.varied}
        book = in_workbook(mechanism, values, designs.modes)
        for name in names:
            study = float(found.columns[name][number])
            assert study == pytest.approx(book[name], rel=1e-12, abs=1e-12 * designs.size, nan_ok=True), (name, values)


def test_conditions_over_outputs_of_summaries():
    """An output of summaries is in its unit what its formula makes of the summaries: radians inside, degrees shown."""
    own = 'worst = { formula = "max(abs(mu_max - pi/2), abs(mu_min - pi/2))", unit = "deg" }\n'
    own += 'arc = { formula = "a4*swing" }\n[summary]'
    text = template_text("four-bar").replace("[summary]", own, 1)
    part = f'\n[study]\n{GRID}\nkeep = ["closes", "worst < 60", "arc > 50"]\nminimize = ["worst"]'
    _, found = kept(loads(text + part))
    angles = np.abs(np.array([found.columns["mu_min"], found.columns["mu_max"]]) - 90).max(axis=0)
    assert found.columns["worst"] == pytest.approx(angles, rel=1e-12)
    assert 0 < angles.max() < 60
    arcs = found.columns["a4"] * np.radians(found.columns["swing"])
    assert arcs.min() > 50
    _, all_of_them = kept(loads(f'{text}\n[study]\n{GRID}\nkeep = ["closes"]'))
    angles = np.abs(np.array([all_of_them.columns["mu_min"], all_of_them.columns["mu_max"]]) - 90).max(axis=0)
    arcs = all_of_them.columns["a4"] * np.radians(all_of_them.columns["swing"])
    assert len(found.numbers) == np.count_nonzero((angles < 60) & (arcs > 50)) < len(all_of_them.numbers)


@pytest.mark.cases(12)
@pytest.mark.slow
@pytest.mark.parametrize("template", template_names())
def test_every_packaged_mechanism_is_studied_or_refused_by_name(template):
    """Closing, links that turn, drivers of every kind: each design is kept or counted once, or a message says why not."""
    plain = study_of("", template)
    links = [link.name for link in plain.links if link.name != plain.ground.name][:2]
    conditions = ", ".join(f'"crank({link})"' for link in links)
    try:
        designs, found = kept(study_of(f'{around(template)}\nkeep = ["closes", {conditions}]', template))
    except MechsheetError as error:
        assert any(word in str(error) for word in ("at least 1 dimension", "found all at once", "the driver's values"))
    else:
        assert found.failed.sum() + len(found.numbers) == designs.sampling.total


# --- against the reference -------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_positions_of_many_designs_are_those_of_the_reference():
    count = 200 if ALL else 40
    vary = "vary = { a2 = [15, 60], a3 = [50, 110], a4 = [30, 90], b3 = [60, 140] }"
    part = f'[study]\nsample = "sobol"\ncount = {count}\n{vary}'
    mechanism = study_of(part, rows=37)
    designs = Designs(mechanism)
    shown = designs.sampling.values(np.arange(count))
    inside = {symbol: shown[:, at][:, None] for at, symbol in enumerate(designs.varied)}
    with np.errstate(all="ignore"):
        out = designs.in_rows.run.both(
            designs.in_rows.of_rows, designs.in_rows.run.designs(inside), given=inside | designs.row_given
        )
    worst, rows = 0.0, 0
    for design in range(count):
        own = dict(zip(designs.varied, map(float, shown[design]), strict=True))
        truth = truth_of(mechanism, own, designs.given["theta12"])
        there = out["there"][design]
        if truth is None:
            assert not there.any()
            continue
        assert np.array_equal(there, truth.exists)
        difference = out["theta14"][design][there] - truth.columns["theta14"][there]
        worst = max(worst, float(np.abs(np.remainder(difference + np.pi, 2 * np.pi) - np.pi).max(initial=0.0)))
        rows += int(there.sum())
    assert rows > 20 * count
    assert worst < 1e-8, worst


# --- in closed form --------------------------------------------------------------------------------------------------------


def lengths_of(mechanism):
    designs = Designs(mechanism)
    values = designs.sampling.values(np.arange(designs.sampling.total))
    return np.concatenate([np.full((len(values), 1), 70.0), values], axis=1)


def test_crank_rockers_of_a_grid_are_as_many_as_grashof_says():
    part = f'[study]\n{GRID}\nkeep = ["grashof(A0ABB0)", "crank(crank)", "not crank(rocker)"]'
    mechanism = study_of(part)
    sides = lengths_of(mechanism).astype(int)  # whole numbers: exact
    ordered = np.sort(sides, axis=1)
    turns = ordered[:, 0] + ordered[:, 3] < ordered[:, 1] + ordered[:, 2]
    crank_is_shortest = (sides[:, 1] == ordered[:, 0]) & (ordered[:, 0] < ordered[:, 1])
    _, found = kept(mechanism)
    assert len(found.numbers) == np.count_nonzero(turns & crank_is_shortest)
    assert found.failed.sum() + len(found.numbers) == len(sides)
    assert found.failed[0] == np.count_nonzero(~turns)


def test_cranks_that_turn_are_those_of_the_triangle_inequality():
    """The crank turns fully where the coupler and the rocker reach across both extreme diagonals, |a1 - a2| and a1 + a2."""
    mechanism = study_of(f'[study]\n{GRID}\nkeep = ["crank(crank)"]')
    a1, a2, a3, a4 = lengths_of(mechanism).T
    reaches = (np.abs(a3 - a4) <= np.abs(a1 - a2)) & (a1 + a2 <= a3 + a4)
    moves = np.abs(a1 - a2) > 0  # the pins A and B0 meet where these are equal: the rocker is free there
    _, found = kept(mechanism)
    assert np.array_equal(found.numbers, np.flatnonzero(reaches & moves))


# --- conditions ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("mu_min > 40", lambda c: c["mu_min"] > 40),
        ("40 < mu_min", lambda c: c["mu_min"] > 40),
        ("30 < mu_min <= 50", lambda c: (c["mu_min"] > 30) & (c["mu_min"] <= 50)),
        ("not mu_min > 40", lambda c: np.isfinite(c["mu_min"]) & ~(c["mu_min"] > 40)),
        ("swing < 70", lambda c: c["swing"] < 70),
        ("mu_max - mu_min < 2*a2", lambda c: c["mu_max"] - c["mu_min"] < 2 * c["a2"]),
        ("min(C.y) > 0", lambda c: c["min(C.y)"] > 0),
        ("a3 >= 2*a2", lambda c: c["a3"] >= 2 * c["a2"]),
    ],
)
def test_conditions_keep_what_the_columns_say(condition, holds):
    vary = '[study]\nvary = { a2 = [20, 60, 5], a3 = [46, 118, 8], a4 = [40, 80, 10] }\nminimize = ["min(C.y)"]\n'
    _, every = kept(study_of(vary))
    designs, found = kept(study_of(f'{vary}keep = ["{condition}"]'))
    with np.errstate(invalid="ignore"):
        wanted = holds(every.columns)
    assert 0 < np.count_nonzero(wanted) < len(wanted)
    assert np.array_equal(found.numbers, every.numbers[wanted])
    for name in designs.names:
        assert np.array_equal(found.columns[name], every.columns[name][wanted], equal_nan=True)


def test_designs_are_the_same_whatever_block_they_are_in():
    """A chunk of designs gives what its halves give: the bytes of a part do not hang on what was computed beside it."""
    mechanism = study_of('[study]\nvary = { a2 = [20, 60, 1], a3 = [46, 118, 4] }\nkeep = ["mu_min > 10"]')
    designs = Designs(mechanism)
    whole = kept_of(designs, 0, 700)
    halves = [kept_of(designs, 0, 333), kept_of(designs, 333, 367)]
    for name in designs.names:
        assert np.allclose(
            whole.columns[name], np.concatenate([half.columns[name] for half in halves]), rtol=1e-14, equal_nan=True
        )


# --- what a study refuses --------------------------------------------------------------------------------------------------


def test_links_that_are_solved_all_at_once_are_refused_by_name():
    with pytest.raises(MechanismError, match="a study does not solve links that must be found all at once"):
        Designs(study_of(around("stephenson-ii-class-iv"), "stephenson-ii-class-iv"))


def test_rows_that_would_differ_from_design_to_design_are_refused():
    text = study_of().text.replace("stop = 360", 'stop = "radians(10*a2)"')
    from mechsheet.library.changed import loads

    with pytest.raises(MechanismError, match="the driver's values follow a2"):
        Designs(loads(text))


def test_a_loop_that_there_is_not_is_told_with_those_that_there_are():
    with pytest.raises(MechanismError, match="A0ABB0"):
        Designs(study_of(f'[study]\n{GRID}\nkeep = ["grashof(A0BBA0)"]'))


@pytest.mark.ci
@pytest.mark.slow
def test_links_that_turn_far_between_limits_swing_as_in_the_workbook():
    """An angle where a stretch ends is near what it is in the row beside the end; near the best row it was a turn off."""
    text = template_text("four-bar").replace("[summary]\n", '[summary]\nturn = { of = "theta13", take = "range" }\n')
    own = "a2 = { values = [88.6, 95.0, 74.6] }, a3 = { values = [102.1, 72.2] }, a4 = { values = [82.3, 100.1] }"
    mechanism = loads(f"{text}\n[study]\nvary = {{ {own} }}\n")
    designs, found = kept(mechanism)
    swings = []
    for number in range(len(found.numbers)):
        values = {one: float(found.columns[one][number]) for one in designs.varied}
        book = in_workbook(mechanism, values, designs.modes)
        for name in ("turn", "swing"):
            swings.append(float(found.columns[name][number]))
            assert swings[-1] == pytest.approx(book[name], rel=1e-6, nan_ok=True), (name, values)
    assert 180 < swings[0] < 350
