"""A crank-rocker by its dead centres: what is found fulfils the text's own equations, as they are printed."""

import cmath
import math

import pytest

from chosen import first
from mechsheet.description import loads
from mechsheet.kinematics.dimensions import dimension_values
from synthesis_tasks import description, task


def results(asked):
    """Exact values by name, in radians and the unit of lengths; None where the task has no solution."""
    mechanism = loads(description(asked))
    values = dimension_values(mechanism)
    found = {name: values[symbol] for name, symbol in mechanism.synthesis.results.items()}
    found["psi"] = values[mechanism.synthesis.names["psi"]]
    return found if all(map(math.isfinite, (found["a2"], found["a3"], found["a4"], found["theta_1"]))) else None


@pytest.mark.parametrize("seed", first(range(200), 20))
def test_equations_9_to_12_of_section_7_1(seed):
    """Soeylemez, Mechanisms, "The classical transmission angle problem": the two loops at the dead centres."""
    found = results(task("dead-centres", seed))
    if found is None:
        return
    a1, a2, a3, a4 = (found[name] for name in ("a1", "a2", "a3", "a4"))
    beta, psi_1, phi, psi, lam = (found[name] for name in ("theta_1", "psi_1", "phi", "psi", "lam"))
    near = 1e-12 * max(a1, a3, a4)
    crank, rocker = cmath.exp(1j * beta), cmath.exp(1j * psi_1)
    assert abs((a2 + a3) * crank - a4 * rocker - a1) < near  # (9)
    assert abs((a2 - a3) * crank * cmath.exp(1j * phi) - a4 * rocker * cmath.exp(1j * psi) - a1) < near  # (10)
    z1, z2 = a2 / a1 * crank, a4 / a1 * rocker
    near /= a1
    assert abs((1 + lam) * z1 - z2 - 1) < near  # (11)
    assert abs(cmath.exp(1j * phi) * (1 - lam) * z1 - z2 * cmath.exp(1j * psi) - 1) < near  # (12)
