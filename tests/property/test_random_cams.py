"""Random cams: equations and reference agree in every column, and the finished profile envelops what it was made for."""

import re

import numpy as np
import pytest

from chosen import part
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.sweep import rough_poses, sweep
from mechsheet.reference.expressions import number
from random_cams import KINDS, SMOOTH, cam, loaded

CASES = part(range(300), 12)
SHARP = 10.0
"""A radius of curvature, where sizes are about 50."""

WINDOW = 4
"""Rows on either side through which a polynomial is laid."""


def solved(text):
    mechanism = loads(text)
    equations, dimensions = solve(mechanism), dimension_values(mechanism)
    return mechanism, equations, dimensions, sweep(mechanism, equations, given_values(mechanism, dimensions))


@pytest.mark.cases(15)
@pytest.mark.parametrize("seed", CASES)
def test_every_column_is_the_references(seed):
    mechanism, equations, dimensions, found = solved(cam(seed))
    known = reference.further(reference.solve(mechanism, dimensions, start=rough_poses(mechanism, equations)))
    follower = next(driver.symbol for driver in mechanism.drivers if driver.segments)
    for name in (*mechanism.cam.symbols, *(f"{follower}.{ending}" for ending in ("d", "dd", "ddd"))):
        ours, theirs = found[name], known[name]
        # a radius of curvature is as exact as the curvature, a derivative as its largest
        scale = (np.abs(theirs) + 100) ** 2 / 50 if name == "rho" else 1 + np.nanmax(np.abs(theirs))
        assert np.array_equal(np.isnan(ours), np.isnan(theirs)), name
        assert np.nanmax(np.abs(ours - theirs) / scale, initial=0.0) < 1e-10, name


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "coupler"])
@pytest.mark.parametrize("seed", part(range(40), 4))
def test_forces_are_the_references(seed, kind):
    """The cam's force on its follower, the joints, the cam's torque both ways, the spring that would hold."""
    mechanism, equations, dimensions, found = solved(loaded(cam(seed, kind)))
    known = reference.further(reference.solve(mechanism, dimensions, start=rough_poses(mechanism, equations)))
    names = (*equations.shown_forces, *equations.efforts)
    assert {"N", "K.hold"} < {*names}
    for name in names:
        ours, theirs = found[name], known[name.removesuffix(".work")]
        assert np.nanmax(np.abs(ours - theirs) / (1 + np.abs(theirs) + np.nanmedian(np.abs(theirs)))) < 1e-10, name


def within(mechanism, dimensions, phi):
    """Rows whose window lies within a segment: elsewhere a derivative leaps."""
    motion = next(driver.segments for driver in mechanism.drivers if driver.segments)
    edges = [number(part.begins, dimensions) for part in motion.parts]
    marks = np.array([*edges, 2 * np.pi])
    for law, begins, over in ((p.law, p.begins, p.over) for p in motion.parts):
        if law.startswith("modified"):
            start, wide = number(begins, dimensions), number(over, dimensions)
            marks = np.append(marks, start + wide * np.array([1, 3, 4, 5, 7]) / 8)
    reach = (WINDOW + 1) * (phi[1] - phi[0])
    return np.flatnonzero(np.abs(phi[:, None] - marks).min(axis=1) > reach)


def lowest(curve):
    """Where a polynomial that is lowest (or highest) near 0 is so, by a step of Newton's."""
    return -curve.deriv(1)(0.0) / curve.deriv(2)(0.0)


@pytest.mark.cases(7)
@pytest.mark.parametrize("seed", CASES)
def test_the_finished_profile_envelops_roller_and_face(seed):
    """In the cam's axes: the roller's centre keeps its distance to the curve, and the curve stays under the face."""
    mechanism, _, dimensions, found = solved(cam(seed, laws=SMOOTH, step=0.5))
    shape, phi = mechanism.cam, found[mechanism.driver.symbol]
    sense = -1 if shape.clockwise else 1
    outline = found["cam.x"] + 1j * found["cam.y"]
    center = found[f"{shape.center}.x"] + 1j * found[f"{shape.center}.y"]
    place = (found[f"{shape.point}.x"] + 1j * found[f"{shape.point}.y"] - center) * np.exp(-1j * sense * phi)
    steps = np.arange(-WINDOW, WINDOW + 1)
    rows = within(mechanism, dimensions, phi)
    assert len(rows) > 100
    for row in rows[::7]:
        sharp = abs(found["rho"][row]) < SHARP  # beside a point of the profile differences are no judge
        x = np.polynomial.Polynomial.fit(steps, outline.real[row + steps], 2 * WINDOW)
        y = np.polynomial.Polynomial.fit(steps, outline.imag[row + steps], 2 * WINDOW)
        if shape.radius is not None:
            away = x - place.real[row], y - place.imag[row]
            square = away[0] ** 2 + away[1] ** 2
            radius = number(shape.radius, dimensions)
            assert abs(np.sqrt(max(0.0, square(0.0))) - radius) < 1e-9 * 100
            # and nowhere beside it is the profile nearer
            assert sharp or radius == 0 or abs(np.sqrt(square(lowest(square))) - radius) < 1e-9 * 100
        if not sharp and abs(found["rho"][row]) < 1e4:
            first, second = (x.deriv(1)(0.0), y.deriv(1)(0.0)), (x.deriv(2)(0.0), y.deriv(2)(0.0))
            speed = np.hypot(*first)
            if speed > 1e-3:
                curvature = abs(first[0] * second[1] - first[1] * second[0]) / speed**3
                assert curvature == pytest.approx(1 / abs(found["rho"][row]), rel=1e-4, abs=1e-6)
        if shape.radius is None:
            angle = found["theta12"][row] + number(shape.face, dimensions) - sense * phi[row]
            normal = np.array([-np.sin(angle), np.cos(angle)])
            height = normal[0] * (x - place.real[row]) + normal[1] * (y - place.imag[row])
            assert abs(height(0.0)) < 1e-9 * 100
            assert sharp or abs(height(lowest(height))) < 1e-9 * 100


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_has_its_columns(kind):
    mechanism, _, _, found = solved(cam(1, kind))
    assert all(np.isfinite(found[name]).any() for name in mechanism.cam.symbols)


@pytest.mark.parametrize("seed", part(range(50), 12))
def test_undercut_is_where_the_base_circle_is_too_small_by_a_millionth(seed):
    """A flat face on a slide: the radius of curvature grows as the base circle does."""
    text = cam(seed, "flat slide")
    base = float(re.search(r"base_radius = (\S+)", text)[1])
    least = float(np.min(solved(text)[3]["rho"]))
    if least >= base - 1e-5:  # no base circle is too small
        return
    for more in (-1e-6, 1e-6):
        changed = text.replace(f"base_radius = {base}", f"base_radius = {base - least + more}")
        assert (np.min(solved(changed)[3]["rho"]) > 0) == (more > 0)


@pytest.mark.parametrize("seed", part(range(50), 12))
def test_undercut_is_where_the_roller_is_too_large_by_a_millionth(seed):
    """Of one pitch curve: the roller may be as large as its sharpest place is round, and no larger."""
    text = cam(seed, "slide")
    base, wheel = (float(re.search(rf"{key} = ([0-9.]+)", text)[1]) for key in ("base_radius", ", radius"))
    sharpest = 1 / float(np.max(solved(text)[3]["kappa"]))
    for more in (-1e-6, 1e-6):
        radius = sharpest + more
        if radius >= base + wheel:  # as round as the base circle: any roller fits
            return
        changed = text.replace(f"base_radius = {base}", f"base_radius = {base + wheel - radius}")
        changed = changed.replace(
            f", radius = {wheel:g} " if wheel == 0 else f", radius = {wheel} ", f", radius = {radius} "
        )
        found = solved(changed)[3]
        assert (np.min(found["rho"][found["kappa"] > 0]) <= 0) == (more > 0)
