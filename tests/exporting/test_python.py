"""The numpy modules: run by a Python that cannot import anything of this package, against the reference."""

import ast
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from exported import leaping_angles, mechanisms, worst_against_reference

from folders import TEMPLATE_FILES
from mechsheet.description import load, loads
from mechsheet.exporting import export
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.solve import solve
from mechsheet.model import Label

RUNNER = """
import importlib.util, pathlib, sys, warnings
warnings.simplefilter("error")
import numpy as np
for name in ("mechsheet", "click", "openpyxl", "formulas", "xlsxwriter", "lxml"):
    sys.modules[name] = None  # an import of it fails
for path in sorted(pathlib.Path(sys.argv[1]).glob("*.py")):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    changes = eval(path.with_suffix(".changes").read_text())
    found = module.solve(**changes)
    assert set(found) == set(module.UNITS)
    assert all(column.dtype == float and column.shape == found[next(iter(found))].shape for column in found.values())
    np.savez(path.with_suffix(".npz"), **found)
"""


def run_all(folder):
    subprocess.run([sys.executable, "-I", "-c", RUNNER, str(folder)], check=True, timeout=120)


def loaded(folder, name):
    with np.load(folder / f"{name}.npz") as file:
        return dict(file)


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """Each mechanism's arrays: with its own dimensions, and once more with others."""
    folder = tmp_path_factory.mktemp("modules")
    given = mechanisms(1)
    changed = {}
    random = np.random.default_rng(8)
    for name, mechanism in given.items():
        named = [
            dim for dim in mechanism.dimensions if dim.symbol.isidentifier() and dim.symbol != "n"
        ]  # n: of rows there
        inputs = {dim.symbol: dim.value for dim in named if not dim.derived}
        changed[name] = {symbol: value * random.uniform(0.99, 1.01) for symbol, value in inputs.items()}
        for stem, changes in ((name, {}), (f"{name}_changed", changed[name])):
            export(mechanism, "python", folder / f"{stem}.py")
            (folder / f"{stem}.changes").write_text(repr({key: float(value) for key, value in changes.items()}))
    run_all(folder)
    return given, changed, folder


@pytest.mark.slow
def test_equal_to_the_reference(ran):
    given, _, folder = ran
    assert max(worst_against_reference(mechanism, loaded(folder, name)) for name, mechanism in given.items()) < 1e-9


@pytest.mark.slow
def test_angles_do_not_leap_by_a_turn(ran):
    given, _, folder = ran
    leaps = {name: leaping_angles(mechanism, loaded(folder, name)) for name, mechanism in given.items()}
    assert {name: symbols for name, symbols in leaps.items() if symbols} == {}


@pytest.mark.slow
def test_other_dimensions(ran):
    """The module follows its arguments as the reference follows its own."""
    given, changed, folder = ran
    judged = 0
    for name, mechanism in given.items():
        found = loaded(folder, f"{name}_changed")
        if all(np.isnan(column).all() for symbol, column in found.items() if symbol != mechanism.driver.symbol):
            continue  # nowhere assembled: no position to start the reference from
        judged += 1
        assert worst_against_reference(mechanism, found, dimensions_of(mechanism, changed[name])) < 1e-9, name
    assert judged > 0.6 * len(given)


def dimensions_of(mechanism, changes):
    dims = tuple(replace(dim, value=changes.get(dim.symbol, dim.value)) for dim in mechanism.dimensions)
    return dimension_values(replace(mechanism, dimensions=dims))


def test_printed_table_is_that_of_csv(tmp_path):
    mechanism = load(next(path for path in TEMPLATE_FILES if path.stem == "fivelink"))
    (module,) = export(mechanism, "python", tmp_path / "fivelink.py")
    (table,) = export(mechanism, "csv", tmp_path / "fivelink.csv")
    ran = subprocess.run(
        [sys.executable, "-I", str(module)], check=True, capture_output=True, text=True, encoding="utf-8"
    )
    ours, theirs = (text.splitlines() for text in (ran.stdout, table.read_text(encoding="utf-8")))
    assert ours[0] == theirs[0]
    assert len(ours) == len(theirs) == 20
    for line, other in zip(ours[1:], theirs[1:], strict=True):
        np.testing.assert_allclose(
            [float(x) for x in line.split(",")], [float(x) for x in other.split(",")], rtol=1e-12
        )


def test_texts_of_the_description_stay_texts(tmp_path):
    given = load(next(path for path in TEMPLATE_FILES if path.stem == "four-bar"))
    hostile = Label('x """ \\ " end\nimport os\n#\u2028import os')
    dims = tuple(replace(dim, label=hostile) for dim in given.dimensions)
    (module,) = export(
        replace(given, title=hostile, source=hostile, dimensions=dims, length_unit='"""\nimport os'), "python",
        tmp_path / "hostile.py",
    )  # fmt: skip
    imported = [name for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))) for name in names_of(node)]
    assert set(imported) == {"annotations", "csv", "sys", "numpy", "ArrayLike", "NDArray"}


def names_of(node):
    return [alias.name for alias in node.names] if isinstance(node, ast.Import | ast.ImportFrom) else []


def test_same_bytes(tmp_path):
    mechanism = load(TEMPLATE_FILES[0])
    written = [export(mechanism, "python", tmp_path / name)[0].read_bytes() for name in ("a.py", "a.py")]
    assert written[0] == written[1]


@pytest.mark.slow
def test_modes_are_arguments(tmp_path):
    """The other assembly of a four-bar is the mirror image of the first about the line of its outer pins."""
    mechanism = load(next(path for path in TEMPLATE_FILES if path.stem == "four-bar"))
    mode = solve(mechanism).groups[0].mode_value
    export(mechanism, "python", tmp_path / "mirror.py")
    (tmp_path / "mirror.changes").write_text(repr({"mode_1": -mode}))
    run_all(tmp_path)
    found = loaded(tmp_path, "mirror")
    assert worst_against_reference(mechanism, found, modes={"mode_1": -mode}) < 1e-9


IMPOSSIBLE = [{"a2": -35.0}, {"a3": 0.0}, {"mode_1": 3.0}, {"mode_1": 0.0}]


def test_what_a_workbook_refuses_has_no_positions(tmp_path):
    """A length between joints that is not above 0, a mode that is neither 1 nor -1: the crank alone has an angle."""
    mechanism = load(next(path for path in TEMPLATE_FILES if path.stem == "four-bar"))
    for number, changes in enumerate([{}, *IMPOSSIBLE]):
        export(mechanism, "python", tmp_path / f"four_bar_{number}.py")
        (tmp_path / f"four_bar_{number}.changes").write_text(repr(changes))
    run_all(tmp_path)
    for number in range(len(IMPOSSIBLE) + 1):
        found = loaded(tmp_path, f"four_bar_{number}")
        assert np.isfinite(found["theta14"]).any() == (number == 0)
        assert np.isfinite(found["theta12"]).all()


def test_a_mechanism_without_dimensions_or_modes(tmp_path):
    """Nothing can be changed but the driver's values: then there is no keyword to ask for."""
    head = 'format = 1\n[mechanism]\nname = "arm"\n[links.base]\npoints = { O = [0, 0] }\n'
    links = "[links.arm]\npoints = { O = [0, 0], T = [30, 0] }\n"
    mechanism = loads(f'{head}{links}[driver]\nlink = "arm"\nvalues = [0, 90]\n')
    (module,) = export(mechanism, "python", tmp_path / "arm.py")
    body = ast.parse(module.read_text(encoding="utf-8")).body
    (solver,) = (each for each in body if getattr(each, "name", "") == "solve")
    assert [each.arg for each in solver.args.args] == ["theta12"]
