"""Velocities, accelerations and forces that others have printed: a file for each, with its source, in tests/cases/published.

A file holds a description and what is printed at its rows, in the units of the description (angles in degrees). A minus
before a symbol says that the source counts the other way. Printed digits decide: half of the last one may be missing.
"""

import math
import tomllib
from pathlib import Path

import pytest

from mechsheet import reference
from mechsheet.description import loads
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.sweep import rough_poses, sweep

CASES = sorted((Path(__file__).parent.parent / "cases" / "published").glob("*.toml"))


def half_of_the_last_digit(printed):
    """4.20 -> 0.005, 7.74e3 -> 5."""
    digits, _, power = printed.partition("e")
    return 0.5 * 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))


def by_the_reference(solution):
    """The same columns from the constraints on all links at once: rates by their Jacobian, forces as multipliers."""
    found = reference.reached(solution) | reference.by_time(solution) | reference.forces(solution)
    return found | reference.outputs(solution, found)


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_printed_values(path):
    case = tomllib.loads(path.read_text(encoding="utf-8"))
    mechanism = loads(case["description"])
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))
    assert len(driver) == len(case["at"])
    values = sweep(mechanism, equations, driver)
    theirs = by_the_reference(reference.solve(mechanism, start=rough_poses(mechanism, equations)))
    angles = {link.angle_symbol for link in mechanism.links}
    for row, printed in enumerate(case["at"]):
        at = printed.pop("driver")
        assert isinstance(at, str) or math.degrees(driver[row]) == pytest.approx(at)
        for name, text in printed.items():
            symbol, sign = name.removeprefix("-"), -1 if name.startswith("-") else 1
            for column in (values, theirs):
                found = sign * float(column[symbol][row])
                turned = math.remainder(math.degrees(found) - float(text), 360)
                off = turned if symbol in angles else found - float(text)
                assert abs(off) <= half_of_the_last_digit(text) * (1 + 1e-9), f"{name}: {found} for {text}"


def test_sources_are_named_and_many():
    """At least ten examples with rates and five with forces, each with its source."""
    with_rates, with_forces = set(), set()
    for path in CASES:
        case = tomllib.loads(path.read_text(encoding="utf-8"))
        assert len(case["source"]) > 40, path.name
        names = {name for printed in case["at"] for name in printed}
        if any(name.startswith(("omega", "alpha")) or name.endswith((".v", ".a")) for name in names):
            with_rates.add(path.stem)
        if any(name == "T12" for name in names):
            with_forces.add(path.stem)
    assert len(with_rates) >= 10
    assert len(with_forces) >= 5


def test_the_table_of_sources_counts_what_is_compared():
    page = (CASES[0].parents[3] / "docs" / "proof.md").read_text(encoding="utf-8")
    section = page.partition("## Printed velocities")[2].partition("\n## ")[0]
    told = sum(int(line.split("|")[-2]) for line in section.splitlines() if line.startswith("|") and line[-3].isdigit())
    cases = [tomllib.loads(path.read_text(encoding="utf-8"))["at"] for path in CASES]
    assert told == sum(len(printed) - 1 for rows in cases for printed in rows)
