"""vba: the module as text, and run in LibreOffice: the text's tables come out of the functions cell by cell."""

import csv
import math
import re
import shutil
import warnings
from functools import cache
from types import ModuleType

import numpy as np
import pytest

from chosen import ITERATED, LISTED, TASKS, but, part
from folders import ROOT, TEMPLATE_FILES
from livesheet.formula.parser import parse_description
from livesheet.formula.printer import print_formula
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, load, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.exporting import Job, exported
from mechsheet.exporting.functions.all_functions import TABLE_KEY, functions_of, in_degrees, prefix_of, variable_key
from mechsheet.exporting.functions.basic import function_names, vba
from mechsheet.exporting.functions.basic_body import ascii_text
from mechsheet.exporting.functions.routines import Source
from mechsheet.exporting.functions.solvers import solvers_of
from mechsheet.kinematics import numeric
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.library.show import variables_of
from office_macros import Job as Office
from office_macros import with_macros
from random_mechanisms import Grower

PUBLISHED = ROOT / "tests" / "data" / "published"

needs_libreoffice = pytest.mark.skipif(shutil.which("soffice") is None, reason="LibreOffice is not installed")


@cache
def mechanism_of(name: str, language: str | None = None):
    return load(ROOT / "templates" / f"{name}.toml", Overrides(language=language))


def module_of(mechanism) -> bytes:
    (content,) = vba(Job(mechanism, mechanism.name.replace("-", "_")))
    return content


WRITTEN = [ROOT / "templates" / f"{name}.toml" for name in (*part(ITERATED, 4, 1), *LISTED)]


@pytest.mark.cases(8)
@pytest.mark.parametrize(
    "path", [*but(TEMPLATE_FILES, *ITERATED, *LISTED, *TASKS), *WRITTEN], ids=lambda path: path.stem
)
def test_every_template_is_ascii_with_dos_lines_and_declares_what_it_uses(path):
    content = module_of(load(path))
    text = content.decode("ascii")
    assert text.count("\n") == text.count("\r\n")
    assert max(map(len, text.splitlines())) < 1023
    assert text.startswith('Attribute VB_Name = "')
    assert "Option Explicit" in text
    functions = re.findall(r"^(?:Public|Private) (?:Function|Sub) (\w+)\(", text, re.MULTILINE)
    kept = [
        name for line in re.findall("^Global (.*)", text, re.MULTILINE) for name in re.findall(r"(\w+)[^,]* As ", line)
    ]
    assert len(functions) + len(kept) == len({name.casefold() for name in (*functions, *kept)})
    for name, body in re.findall(r"^Public Function (\w+)\(.*?\n(.*?)^End Function", text, re.MULTILINE | re.DOTALL):
        assert f" {name} = " in body
    statements = text.replace(" _\r\n", "\0").split("\r\n")
    assert max(statement.count("\0") for statement in statements) < 24


@pytest.mark.slow
def test_more_arguments_than_vba_takes():
    with pytest.raises(MechanismError, match="61 arguments"):
        module_of(loads(Grower(7, 7).text(rows=5)))


def test_names_follow_the_language():
    turkish = module_of(mechanism_of("adjustable-pump", "tr")).decode()
    english = module_of(mechanism_of("adjustable-pump", "en")).decode()
    for name in ("Boy", "Aci", "AciCos", "KolKizak", "DortCubuk", "KrankBiyel", "AyarliPompa", "AyarliPompa_s15"):
        assert f"Public Function {name}(" in turkish
    for name in ("Mag", "Ang", "AngCos", "SlottedLever", "FourBar", "SliderCrank", "AdjustablePump"):
        assert f"Public Function {name}(" in english
    assert "Public Function DortCubuk(ByVal Krank As Double, ByVal Biyel As Double, ByVal Cikis As Double," in turkish


@pytest.mark.parametrize(
    ("text", "basic"),
    [
        ("-a^2", "-(a ^ 2)"),  # LibreOffice reads -a ^ 2 as (-a) ^ 2, Excel does not
        ("(-a)^3", "((-a) ^ (3))"),
        ("a^-1", "a ^ (-1)"),
        ("2^3^a", "2 ^ (3 ^ a)"),
        ("a - -b", "a - (-b)"),
        ("a/(b*c)", "a / (b * c)"),
        ("radians(a + b)", "((a + b) * PiValue() / 180)"),
        ("max(a, b, c, d)", "MaxOf(MaxOf(a, b), MaxOf(c, d))"),
        ("ln(a) + sqrt(b) + atan(c) + sign(d)", "Log(a) + Sqr(b) + Atn(c) + Sgn(d)"),
        ("acos(a) + pi", "ArcCos(a) + PiValue()"),
    ],
)
def test_expressions(text, basic):
    assert print_formula(parse_description(text), "basic", lambda part: part.name) == basic


def test_texts_in_ascii():
    assert ascii_text("açı θ₁₂ → ğ’") == "aci theta12 -> g'"
    assert ascii_text("plain (text), 30°") == "plain (text), 30deg"


def test_a_long_title_gives_way_to_the_name():
    assert prefix_of(mechanism_of("adjustable-pump"), "tr") == "AyarlıPompa"
    assert prefix_of(mechanism_of("fivelink"), "tr") == "Fivelink"


def rows_of(name: str) -> list[dict[str, str]]:
    with (PUBLISHED / name).open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


@needs_libreoffice
@pytest.mark.libreoffice
def test_the_tables_of_the_text_come_out_of_the_functions():
    """The pump by its function, in degrees; the five-link as the text computes it, by KolKızak and DörtÇubuk."""
    pump = rows_of("adjustable-pump.csv")
    settings = [key for key in pump[0] if key.startswith("s1=")]
    pump_formulas = [
        f"=AyarliPompa(55;240;165;185;70;{key[3:]};{row['theta12_deg']})" for row in pump for key in settings
    ]
    five = rows_of("fivelink.csv")
    alpha1, ground = "Aci(1250;200)", "Boy(1250;200)"
    tilt, second = "Aci(1700;600)", "Boy(1700;600)"
    five_formulas = []
    for row in five:
        angle = f"(RADIANS({row['theta12_deg']})-{alpha1})"
        # the text subtracts alpha1 twice: docs/errata.md
        lever = f"(KolKizak(510;{ground};{angle}-{alpha1})+{alpha1}-PI()/2)"
        five_formulas.append(f"={lever}")
        five_formulas.append(f"=DortCubuk(1160;1995;820;{second};1;{lever}+{tilt})-{tilt}")
    answers = with_macros(
        [
            Office(module=module_of(mechanism_of("adjustable-pump", "tr")), formulas=pump_formulas),
            Office(module=module_of(mechanism_of("fivelink", "tr")), formulas=five_formulas),
        ]
    )
    wanted = [float(row[key]) for row in pump for key in settings]
    found = [answers[0].get("Sheet1", row, 0) for row in range(len(wanted))]
    assert len(wanted) == 114
    assert np.abs(np.array(found) - wanted).max() < 6e-5  # printed with 4 digits, computed with pi = 3.1415926
    columns = [[answers[1].get("Sheet1", 2 * row + column, 0) for row in range(len(five))] for column in (0, 1)]
    for column, key in zip(columns, ("theta13_rad", "theta15_rad"), strict=True):
        gap = np.array(column) - [float(row[key]) for row in five]
        gap -= 2 * math.pi * np.round(gap / (2 * math.pi))
        assert np.abs(gap).max() < 3e-7


VALUED = (
    "adjustable-pump", "cylinder-boom", "fivelink", "four-bar", "inverted-slider-crank", "scotch-yoke", "six-link-dwell",
    "slider-crank",
)  # fmt: skip
"""Templates with every kind of dyad, whose values are compared."""


def formulas_of(mechanism, rows, changed=None) -> tuple[list[str], list[tuple[str, int]]]:
    """Calls of every function of a mechanism at rows of its sweep; (variable, row) of each.

    changed  dimensions and modes that are others than described, by symbol
    """
    source = Source(Compiled(mechanism))
    functions = [function for function in functions_of(source, mechanism.language) if not function.basic]
    names = function_names(functions_of(source, mechanism.language))
    dimensions = dimension_values(mechanism)
    driven = given_values(mechanism, dimensions)
    formulas, places = [], []
    for row in rows:
        given = dimensions | {symbol: float(column[row]) for symbol, column in driven.items()} | (changed or {})
        for function in functions:
            if function.key != TABLE_KEY:
                arguments = [given[part.symbol] for part in function.routine.parameters if part.symbol in given]
                formulas.append(f"={names[function.key]}({';'.join(map(repr, arguments))})")
                places.append((function.key.removeprefix(variable_key("")), row))
    return formulas, places


def calls_of(mechanism) -> tuple[list[str], list[float | None], list[str]]:
    """Calls of every function at two positions, the workbook's values, their units."""
    table = variables_of(mechanism)
    count = len(table[mechanism.driver.symbol])
    formulas, places = formulas_of(mechanism, (count // 3, count // 2))
    source = Source(Compiled(mechanism))
    units = ["deg" if in_degrees(source, symbol) else "" for symbol, _ in places]
    values = [table[symbol][row] for symbol, row in places]
    radians = [
        math.radians(value) if unit == "deg" and value is not None else value
        for value, unit in zip(values, units, strict=True)
    ]
    return formulas, radians, units


@pytest.mark.ci
@needs_libreoffice
@pytest.mark.libreoffice
def test_functions_in_libreoffice_give_what_the_workbook_has():
    """1e-10 of the size; of the other templates, the module compiles and its first and last functions give numbers."""
    mechanisms = [load(ROOT / "templates" / f"{name}.toml") for name in VALUED]
    mechanisms.append(load(ROOT / "templates" / "four-bar.toml", Overrides({"a1": "100"})))  # some rows do not exist
    calls = [calls_of(mechanism) for mechanism in mechanisms]
    jobs = [
        Office(module=module_of(mechanism), formulas=formulas)
        for mechanism, (formulas, _, _) in zip(mechanisms, calls, strict=True)
    ]
    others = [load(path) for path in part(but(TEMPLATE_FILES, *ITERATED, *LISTED, *TASKS, *VALUED), 6)]
    for mechanism in others:
        formulas, _ = formulas_of(mechanism, (1,))
        jobs.append(Office(module=module_of(mechanism), formulas=[formulas[0], formulas[-1]]))
    answers = with_macros(jobs)
    for mechanism, answer in zip(others, answers[len(calls) :], strict=True):
        assert all(isinstance(answer.get("Sheet1", row, 0), float) for row in (0, 1)), mechanism.name
    numbers = missing = 0
    for mechanism, (formulas, wanted, units), answer in zip(mechanisms, calls, answers, strict=False):
        size = max([1.0, *(abs(value) for value in wanted if value is not None)])
        for row, (formula, value, unit) in enumerate(zip(formulas, wanted, units, strict=True)):
            found = answer.get("Sheet1", row, 0)
            if value is None:
                missing += 1
                assert found == "Error 2042", (mechanism.name, formula, found)
                continue
            numbers += 1
            assert isinstance(found, float), (mechanism.name, formula, found)
            gap = found - value
            if unit == "deg":
                gap -= 2 * math.pi * round(gap / (2 * math.pi))
            assert abs(gap) < 1e-10 * size, (mechanism.name, formula, found, value)
    assert numbers > 150
    assert missing


OUTPUTS = """[outputs]
q1 = { formula = "acos(theta13*4)", unit = "deg" }
q2 = { formula = "ln(-theta12^2) + 1", unit = "1" }
q3 = { formula = "sqrt(-theta13 - 4) + 1/(theta12 - 0.5)", unit = "1" }
q4 = { formula = "asin(a2/a1) + acos(0.5)*2 - max(a1, a2, a3, 3)^0.5", unit = "1" }
q5 = { formula = "-a1^2 + 2^3^2 + sign(-3)*min(1, 2, 3) + exp(1) + hypot(3, 4) + degrees(1)", unit = "1" }
"""


@needs_libreoffice
@pytest.mark.libreoffice
def test_what_has_no_value_ends_a_function_and_shows_no_message():
    text = template_text("four-bar").replace("[outputs]\n", OUTPUTS)
    formulas = [f"=FourBarLinkage_q{number}(70;35;62.3;56;126.6;84.1;0.5)" for number in range(1, 6)]
    (answer,) = with_macros([Office(module=module_of(loads(text)), formulas=formulas)])
    found = [answer.get("Sheet1", row, 0) for row in range(5)]
    assert found[:3] == ["Error 2042"] * 3
    wanted = [
        math.asin(0.5) + 2 * math.acos(0.5) - 70**0.5,
        -(70**2) + 512 - 1 + math.e + 5 + math.degrees(1),
    ]
    assert found[3:] == pytest.approx(wanted, rel=1e-13)


# --- groups that Newton's method solves ----------------------------------------------------------------------------


def run(block, given):
    """The results of steps, in Python."""
    known = dict(zip(block.given, given, strict=True))
    for step in block.steps:
        known[step.symbol] = numeric.value(step.expression, known)
    return [float(numeric.value(node, known)) for node in block.results]


@pytest.mark.parametrize("name", ["planar-3rpr", "stephenson-ii-class-iv"])
def test_steps_of_a_solver_are_those_of_the_table(name):
    """From the arguments to what a pass reads in a row; in the row's position the pass stays, with the table's det J."""
    compiled = Compiled(mechanism_of(name))
    source = Source(compiled)
    (solver,) = solvers_of(source, compiled)
    (group,) = compiled.equations.groups
    at = {symbol: float(column[3]) for symbol, column in compiled.values.items()} | compiled.modes
    still = run(solver.still, [at[symbol] for symbol in solver.asked])
    assert still == pytest.approx([at[symbol] for symbol in solver.reading.given[: len(still)]], rel=1e-12)
    read = run(solver.reading, [*still, *(at[drive.symbol] for drive in solver.drives)])
    assert read == pytest.approx([at[symbol] for symbol in group.system.given], rel=1e-12, abs=1e-12)
    *correction, residual, det = run(solver.passing, [*(at[symbol] for symbol in group.system.variables), *read])
    assert [*correction, residual] == pytest.approx([0.0] * 3, abs=1e-11)
    assert det == pytest.approx(at["det"], rel=1e-9)


def test_drivers_that_are_listed_are_arguments():
    text = module_of(mechanism_of("five-bar-robot")).decode()
    (head,) = re.findall(r"Public Function \w+_P_x\(([^)]*)\)", text)
    assert re.search(r"ByVal theta12 As Double,\s.*ByVal theta15 As Double,", head)


def table_of(mechanism, changed):
    """The rows that the workbook has when dimensions are typed into it, by the program in Python (test_loops.py)."""
    program = ModuleType("program")
    exec(exported(mechanism, "python"), program.__dict__)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return program.solve(**changed)


FORCED = "[solution]\nforce = true\n"

ASKED = [
    ("planar-3rpr", "", [({}, (0, 3, 10)), ({"mode_1": 3}, (3,)), ({"y2": 2.4}, (3,)), ({"p1": 1.0}, (3, 10, 3))]),
    ("sun-and-planet", "", [({}, (48,))]),  # two turns on
    ("stephenson-ii-class-iv", "", [({}, (30, 12, 30))]),  # and back again, whichever cell comes first
    ("six-link-dwell", FORCED, [({}, (9,))]),  # one group after the other
    ("five-bar-robot", FORCED, [({}, (20,))]),  # both drivers along a straight line
]
"""Templates, what is written behind them, and dimensions and modes that are changed, with rows of each."""

NOWHERE = [
    "=Planar3rpr_A_x(8;3;3;PI()/4;5;6;0;0;0;5)",
    "=Planar3rpr_A_x(5;7;3;PI()/4;5;6;0;0;0;5)",  # the table has rows of another assembly, with a warning
    "=Planar3rpr_A_x(5;3;3;PI()/4;5;6;0;0;0;1E+9)",
    "=Planar3rpr_A_x(-5;3;3;PI()/4;5;6;0;0;0;5)",
    "=Planar3rpr_A_x(5;3;3;PI()/4;5;6;0;0;0;5;5)",
]
"""The assembly ends on the way; the driver is too far off; no length; no such assembly."""


@needs_libreoffice
@pytest.mark.ci
@pytest.mark.libreoffice
def test_newtons_method_in_libreoffice_gives_what_the_workbook_has():
    """With its turns, whatever was asked before; #N/A beyond a limit, and where the assembly would be another."""
    jobs, values = [], []
    for name, besides, changes in ASKED:
        mechanism = loads(template_text(name) + besides)
        formulas, wanted = [], []
        for changed, rows in changes:
            calls, places = formulas_of(mechanism, rows, changed)
            table = table_of(mechanism, changed)
            formulas += calls
            wanted += [float(table[symbol][row]) for symbol, row in places]
        if not jobs:
            formulas += NOWHERE
            wanted += [math.nan] * len(NOWHERE)
            assert sum(map(math.isnan, wanted)) > len(NOWHERE)
        jobs.append(Office(module=module_of(mechanism), formulas=formulas))
        values.append(wanted)
    for answer, job, wanted in zip(with_macros(jobs), jobs, values, strict=True):
        for row, (formula, value) in enumerate(zip(job.formulas, wanted, strict=True)):
            found = answer.get("Sheet1", row, 0)
            found = math.nan if found == "Error 2042" else found
            assert found == pytest.approx(value, rel=1e-11, abs=1e-10, nan_ok=True), formula
