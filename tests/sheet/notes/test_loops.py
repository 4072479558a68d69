"""Loop equations differentiated by time, as a textbook writes them: brackets where a product needs them, and only there."""

import pytest
from planned import moving, planned

from mechsheet.sheet.mathematics import LoopRates

EQUATIONS = [
    (
        "four-bar",
        "i·a2·ω12·e^iθ₁₂ + i·a3·ω13·e^iθ₁₃ = i·a4·ω14·e^iθ₁₄",
        "(−a2·ω12^2 + i·a2·α12)·e^iθ₁₂ + (−a3·ω13^2 + i·a3·α13)·e^iθ₁₃ = (−a4·ω14^2 + i·a4·α14)·e^iθ₁₄",
    ),
    (
        "inverted-slider-crank",
        "i·a·ω12·e^iθ₁₂ = i·c·ω14·e^iθ₁₄ + (vb + i·b·ω14)·e^i(θ14 + π − δ)",
        "(−a·ω12^2 + i·a·α12)·e^iθ₁₂"
        " = (−c·ω14^2 + i·c·α14)·e^iθ₁₄ + (ab − b·ω14^2 + i·(b·α14 + 2·vb·ω14))·e^i(θ14 + π − δ)",
    ),
]


def text(rich):
    return "".join("^" * (kind == "super") + word for word, kind in rich.parts)


@pytest.mark.parametrize(("name", "velocities", "accelerations"), EQUATIONS)
def test_equations_of_a_loop(name, velocities, accelerations):
    """(r'' − ω²r + i(αr + 2ωr'))·e^(iθ) for each side (Söylemez, Mechanisms, 4.2 and 4.3)."""
    plan = planned(moving(name))
    (group,), rates = plan.equations.groups, LoopRates(plan)
    assert text(rates.velocities(group.closure)) == velocities
    assert text(rates.accelerations(group.closure)) == accelerations
