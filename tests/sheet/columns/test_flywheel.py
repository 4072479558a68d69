"""A flywheel against a torque with a closed form, and what is said where there is no whole turn at constant speed."""

import math

import numpy as np
import pytest
from laid import Laid

from in_line import IN_LINE
from mechsheet import loads, reference
from mechsheet.diagnostics import DescriptionError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.library.show import overview_text
from mechsheet.reference.outputs import further

WHEEL = '[[loads]]\nlink = "crank"\ntorque = "-(3 + 2*sin(theta12))"\n[flywheel]\nfluctuation = 0.05\n'
TEXT = IN_LINE.replace("step = 15", "step = 15\nspeed = 10") + WHEEL


@pytest.mark.slow
def test_mean_energy_and_moment_of_inertia():
    """T12 = 3 + 2 sin theta: the energy beyond the mean is 2 (1 - cos theta), trapezia take it a little smaller."""
    laid = Laid(TEXT)
    half = math.radians(15) / 2
    change = 4 * half / math.tan(half)
    assert laid.spot("mean_torque") == pytest.approx(3)
    energy = np.array(laid.column("E_f"))
    assert energy == pytest.approx(change / 2 * (1 - np.cos(np.radians(15 * np.arange(25)))))
    assert laid.spot("energy_change") == pytest.approx(change)
    assert laid.spot("flywheel") == pytest.approx(change / (0.05 * 10**2))
    assert laid.words("energy_change") == "slowest at 180°, fastest at 0°"
    said = "flywheel: mean torque 3 N m, change of energy 3.97713 J, moment of inertia 0.795426 kg m²"
    assert said in overview_text(loads(TEXT))
    assert [chart.title for chart in laid.workbook.sheets[0].charts].count("E_f against θ₁₂") == 1
    laid.change(fluctuation=0.1)
    assert laid.spot("flywheel") == pytest.approx(change / (0.1 * 10**2))


@pytest.mark.parametrize("changed", [{"alpha12": 3.0}, {"omega12": 0.0}])
def test_the_reference_knows_no_energy_either(changed):
    mechanism = loads(TEXT)
    even, uneven = (reference.solve(mechanism, dimension_values(mechanism) | typed) for typed in ({}, changed))
    assert np.isfinite(further(even)["E_f"]).all()
    assert np.isnan(further(uneven)["E_f"]).all()


@pytest.mark.slow
@pytest.mark.parametrize("change", [{"omega12": 0.0}, {"alpha12": 3.0}, {"_step": 10.0}])
def test_without_a_whole_turn_at_constant_speed_the_sheet_names_what_it_needs(change):
    laid = Laid(TEXT, "tr").change(**change)
    assert not isinstance(laid.spot("flywheel"), float)
    assert laid.words("flywheel") == "sabit hızda tam bir tur gerekir"


@pytest.mark.parametrize(
    ("was", "now", "said"),
    [
        ("stop = 360", "stop = 345", "these rows cover 345°"),
        ("start = 0\nstop = 360\nstep = 15", "values = [0, 180, 360]", "the driver has `values`"),
        ("speed = 10", "speed = 0", "at rest it stores no energy"),
        ("speed = 10", "speed = 10\nacceleration = 1", "this one varies"),
        ("speed = 10", 'speed = "10 + sin(theta12)"', "this one varies"),
        ('link = "crank"\nstart', 'joint = "s14"\nstart', "by its angle"),
        ("[flywheel]", '[workbook]\nlayout = "page"\n[flywheel]', "which the layout page does not have"),
    ],
)
def test_refused(was, now, said):
    with pytest.raises(DescriptionError, match=said):
        loads(TEXT.replace(was, now, 1))
