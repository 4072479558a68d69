"""Groups that Newton's method solves, with other dimensions: programs begin as the workbook does, and doubt as it does."""

import math
import warnings
from functools import lru_cache
from types import ModuleType

import numpy as np
import pytest
from laid import Laid
from test_octave import octave

from mechsheet.compiled import compiled_of
from mechsheet.description.templates import template_text
from mechsheet.exporting import exported
from mechsheet.exporting.program import program_of
from mechsheet.exporting.python import RESERVED

pytestmark = pytest.mark.slow

CHANGES = [
    ("planar-3rpr", "p1", 8.0),  # more by 60 %: the assembly ends, none is found
    ("planar-3rpr", "y2", 2.4),  # it goes on, where the sketch would mean another
    ("planar-3rpr", "gamma", 13.0),
    ("planar-3rpr", "_start", 6.1),
    pytest.param("stephenson-ii-class-iv", "delta", -16.0, marks=pytest.mark.slow),  # it ends, another is found
    pytest.param("stephenson-ii-class-iv", "e", 5.76, marks=pytest.mark.slow),  # rows behind a gap
    pytest.param("stephenson-ii-class-iv", "delta", 50.0, marks=pytest.mark.slow),
]


VALUES = [getattr(case, "values", case) for case in CHANGES]

PRINTED = """
names = fieldnames(r);
for n = 1:numel(names)
  printf('%s', names{n});
  printf(' %.17g', r.(names{n}));
  disp('');
end
"""


@lru_cache
def of_sheet(name, symbol, shown):
    """What the workbook has after a number was typed: its columns in internal units, and whether it doubts the assembly."""
    sheet = Laid(template_text(name)).change(**{symbol: shown})

    def column(name):
        degrees = sheet.plan.at.spots[name].degrees
        rows = zip(sheet.column(name), sheet.exists, strict=True)
        found = [value if isinstance(value, float) and there else math.nan for value, there in rows]
        return np.radians(found) if degrees else np.array(found)

    columns = sheet.plan.equations.equations.columns
    found = {each.symbol: column(each.symbol) for each in columns if each.role in ("variable", "point")}
    doubts = [sheet.plan.text(f"verdict.same_assembly.{word}") for word in ("begun", "lost")]
    doubted = sheet.words("same_assembly") in doubts or sheet.verdict == sheet.plan.text("verdict.line.ended")
    driver = [float(value) for value in sheet.column(sheet.mechanism.driver.symbol)]
    return found, doubted, driver


def asked(name, symbol, shown):
    """The same as arguments of the exported function."""
    mechanism = Laid(template_text(name)).mechanism
    names = program_of(compiled_of(mechanism), RESERVED).names
    if symbol == "_start":
        return {names[mechanism.driver.symbol]: of_sheet(name, symbol, shown)[2]}
    unit = next(dim for dim in mechanism.dimensions if dim.symbol == symbol).unit
    return {names[symbol]: float(unit.to_internal(shown))}


@lru_cache
def module(name):
    found = ModuleType(name)
    exec(exported(Laid(template_text(name)).mechanism, "python"), found.__dict__)
    return found


def same(ours, theirs):
    """The same rows exist, and everything in them is the same."""
    for symbol, column in theirs.items():
        assert np.array_equal(np.isnan(ours[symbol]), np.isnan(column)), symbol
        assert np.nan_to_num(ours[symbol]) == pytest.approx(np.nan_to_num(column), abs=1e-9), symbol


@pytest.mark.cases(1)
@pytest.mark.parametrize(("name", "symbol", "shown"), CHANGES)
def test_python_as_the_workbook(name, symbol, shown):
    theirs, doubted, _ = of_sheet(name, symbol, shown)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        ours = module(name).solve(**asked(name, symbol, shown))
    same(ours, theirs)
    assert bool(told) == doubted
    assert all("assembly" in str(each.message) for each in told)


@pytest.mark.ci
@pytest.mark.octave
def test_octave_as_the_workbook(tmp_path):
    code = ""
    for number, (name, symbol, shown) in enumerate(VALUES):
        function = name.replace("-", "_")
        (tmp_path / f"{function}.m").write_bytes(exported(Laid(template_text(name)).mechanism, "octave"))
        given = ", ".join(f"'{key}', {value!r}" for key, value in asked(name, symbol, shown).items())
        code += f"lastwarn(''); r = {function}({given});\nprintf('@{number} %d\\n', ~isempty(lastwarn()));\n" + PRINTED
    blocks = octave(tmp_path, code + "disp('done')").stdout.split("@")[1:]
    for (name, symbol, shown), block in zip(VALUES, blocks, strict=True):
        theirs, doubted, _ = of_sheet(name, symbol, shown)
        first, *lines = block.replace("done", "").splitlines()
        columns = {line.split()[0]: np.array(line.split()[1:], float) for line in lines if line}
        names = program_of(compiled_of(Laid(template_text(name)).mechanism), ()).names
        same({symbol: columns[names[symbol]] for symbol in theirs}, theirs)
        assert first.split()[1] == str(int(doubted))
