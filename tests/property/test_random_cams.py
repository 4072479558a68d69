"""Random cams: equations and reference agree in every column, and the finished profile envelops what it was made for."""

import re

import numpy as np
import pytest
from both_layouts import Book

from chosen import part
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.sweep import rough_poses, sweep
from mechsheet.reference.expressions import number
from random_cams import ALL_LAWS, KINDS, cam, loaded

CASES = part(range(300), 12)
ROWS = 5
"""Degrees between the rows of a table."""

PART = 1e-9
"""Of its size a profile may lie off its envelope."""

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


@pytest.mark.cases(13)
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


def meetings(mechanism, dimensions):
    """Angles at which segments meet, and pieces of their laws."""
    motion = next(driver.segments for driver in mechanism.drivers if driver.segments)
    marks = [0.0, 2 * np.pi]
    for law, begins, over in ((p.law, p.begins, p.over) for p in motion.parts):
        parts = (
            np.array([0, 1, 3, 4, 5, 7] if law.startswith("modified") else [0, 4] if law == "parabolic" else [0]) / 8
        )
        marks += [*(number(begins, dimensions) + number(over, dimensions) * parts)]
    return np.array(marks)


def within(mechanism, dimensions, phi):
    """Rows whose window lies within a piece: elsewhere a derivative leaps."""
    reach = (WINDOW + 1) * (phi[1] - phi[0])
    return np.flatnonzero(np.abs(phi[:, None] - meetings(mechanism, dimensions)).min(axis=1) > reach)


def sharpest(text, step):
    """The least radius that a face makes, or the largest curvature under a roller: in rows of 5 degrees, or, where another
    step is said, in such rows and on both sides of where pieces of the motion meet."""
    mechanism = loads(text)
    equations, dimensions = solve(mechanism), dimension_values(mechanism)
    marks = meetings(mechanism, dimensions)
    rows = np.radians(np.arange(0, 360 + step / 2, step))
    both = np.clip(np.concatenate((marks - 1e-7, marks + 1e-7)), 0, 2 * np.pi)
    found = sweep(mechanism, equations, rows if step == ROWS else np.sort(np.concatenate((rows, both))))
    return float(np.min(found["rho"]) if mechanism.cam.radius is None else np.max(found["kappa"]))


def lowest(curve):
    """Where a polynomial that is lowest (or highest) near 0 is so, by a step of Newton's."""
    return -curve.deriv(1)(0.0) / curve.deriv(2)(0.0)


@pytest.mark.cases(7)
@pytest.mark.parametrize("seed", CASES)
def test_the_finished_profile_envelops_roller_and_face(seed):
    """In the cam's axes: the roller's centre keeps its distance to the curve, and the curve stays under the face."""
    mechanism, _, dimensions, found = solved(cam(seed, laws=ALL_LAWS, step=0.5))
    shape, phi = mechanism.cam, found[mechanism.driver.symbol]
    sense = -1 if shape.clockwise else 1
    outline = found["cam.x"] + 1j * found["cam.y"]
    center = found[f"{shape.center}.x"] + 1j * found[f"{shape.center}.y"]
    place = (found[f"{shape.point}.x"] + 1j * found[f"{shape.point}.y"] - center) * np.exp(-1j * sense * phi)
    steps = np.arange(-WINDOW, WINDOW + 1)
    allowed = PART * max(np.ptp(outline.real), np.ptp(outline.imag))
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
            assert abs(np.sqrt(max(0.0, square(0.0))) - radius) < allowed
            # and nowhere beside it is the profile nearer
            assert sharp or radius == 0 or abs(np.sqrt(square(lowest(square))) - radius) < allowed
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
            assert abs(height(0.0)) < allowed
            assert sharp or abs(height(lowest(height))) < allowed


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_has_its_columns(kind):
    mechanism, _, _, found = solved(cam(1, kind))
    assert all(np.isfinite(found[name]).any() for name in mechanism.cam.symbols)


def undercut_by(text, more, step):
    """The same cam with a profile whose least radius is so much below 0, as `sharpest` finds it.

    On a smaller base circle under a face, under a larger roller on the same pitch curve. None where no base circle is too
    small, or any roller fits.
    """
    base = float(re.search(r"base_radius = (\S+)", text)[1])
    if "face" in text:
        least = sharpest(text, step)
        return (
            None
            if least >= base - 1e-5
            else text.replace(f"base_radius = {base}", f"base_radius = {base - least - more}")
        )
    wheel = float(re.search(r", radius = (\S+)", text)[1])
    radius = 1 / sharpest(text, step) + more
    if radius >= base + wheel - 1:
        return None
    text = re.sub(r", radius = \S+", f", radius = {radius}", text)
    return text.replace(f"base_radius = {base}", f"base_radius = {base + wheel - radius}")


def undercut_pair(seed, kind, more, laws=ALL_LAWS, step=ROWS):
    """A cam that is undercut by so much, and the same that is not by as much: of the first seed that can be."""
    texts = (cam(seed + 1000 * tries, kind, laws) for tries in range(100))
    return next(pair for text in texts if None not in (pair := [undercut_by(text, by, step) for by in (more, -more)]))


@pytest.mark.parametrize("kind", ["flat slide", "slide"])
@pytest.mark.parametrize("seed", part(range(50), 12))
def test_undercut_is_where_a_millionth_is_missing(seed, kind):
    for text, undercut in zip(undercut_pair(seed, kind, 1e-6), (True, False), strict=True):
        mechanism, _, _, found = solved(text)
        convex = found["rho"] if mechanism.cam.radius is None else found["rho"][found["kappa"] > 0]
        assert (np.min(convex) <= 0) == undercut


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("seed", part(range(50), 3))
def test_the_first_sheet_says_undercut_of_those_that_are(seed):
    """Half of them under a face. Rows are 5 degrees apart: between them a corner where pieces of a law meet is seen, too."""
    kind = ("flat slide", "slide")[seed % 2]
    for text, undercut in zip(undercut_pair(seed, kind, 0.01, step=0.02), (True, False), strict=True):
        book = Book(text, "sheets")
        assert book.words("least_rho").startswith("undercut") == undercut, book.words("least_rho")
        assert book.line_colour in (("red",) if undercut else ("green", "amber"))


@pytest.mark.cases(3)
@pytest.mark.slow
@pytest.mark.parametrize("seed", part(range(50), 3))
def test_a_page_says_undercut_of_its_rows(seed):
    kind = ("flat slide", "slide")[seed % 2]
    for text, undercut in zip(undercut_pair(seed, kind, 1e-6), (True, False), strict=True):
        book = Book(text, "page")
        assert book.words("least_rho").startswith("undercut") == undercut, book.words("least_rho")
        assert book.line_colour in (("red",) if undercut else ("green", "amber"))
