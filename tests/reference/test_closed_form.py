"""Single loops against their closed solutions, through limits and gaps."""

import numpy as np
import pytest
from reference_cases import mechanism

from mechsheet.reference import residuals, solve, variables, worst


def four_bar(a, mode, angle):
    """B and whether it exists: A0 at 0, B0 at (a1, 0); psi at A between AB0 and AB."""
    a1, a2, a3, a4 = a
    pin = a2 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    away = np.array([a1, 0.0]) - pin
    s = np.hypot(*away.T)
    cosine = (a3**2 + s**2 - a4**2) / (2 * a3 * s)
    exists = np.abs(cosine) <= 1
    direction = np.arctan2(away[:, 1], away[:, 0]) + mode * np.arccos(np.clip(cosine, -1, 1))
    place = pin + a3 * np.stack([np.cos(direction), np.sin(direction)], axis=1)
    return np.where(exists[:, None], place, np.nan), exists, np.sqrt(np.abs(1 - cosine**2))


@pytest.mark.slow
@pytest.mark.cases(4)
@pytest.mark.parametrize("seed", range(24))
def test_four_bar(seed):
    rng = np.random.default_rng(seed)
    a = rng.uniform(0.2, 1, 4) * 10.0 ** rng.integers(-3, 4)
    if seed % 3 == 0:  # a crank and a coupler a thousand and more times shorter than ground and rocker
        a *= [1.0, 10.0 ** rng.uniform(-5, -3), 10.0 ** rng.uniform(-5, -3), 1.0]
        a[3] = a[0] + rng.uniform(-1, 1) * (a[1] + a[2])
    mode = rng.choice([-1, 1])
    step = rng.choice([0.7, 3, 50])
    angle = np.radians(0.3 + np.arange(int(400 / step + 1e-9) + 1) * step)
    place, exists, sine = four_bar(a, mode, angle)
    first = place[np.argmax(exists)] if exists.any() else (0.0, 0.0)
    found = solve(
        mechanism(f"""
        links.ground.points = {{A0 = [0, 0], B0 = [{a[0]}, 0]}}
        links.crank.points = {{A0 = [0, 0], A = [{a[1]}, 0]}}
        links.coupler.points = {{A = [0, 0], B = [{a[2]}, 0]}}
        links.rocker.points = {{B0 = [0, 0], B = [{a[3]}, 0]}}
        assembly = {{B = [{first[0]}, {first[1]}]}}
        driver = {{link = "crank", start = 0.3, stop = 400.3, step = {step}}}
        """)
    )
    assert np.array_equal(found.exists, exists)
    assert not found.undetermined.any()
    error = np.hypot(*(found.points["B"] - place).T)[exists]
    assert (error * sine[exists] < 1e-13 * found.size).all()
    assert (error < 1e-7 * found.size).all()


@pytest.mark.parametrize("seed", range(16))
def test_slider_crank(seed):
    """Offset guide in any direction; block as a link or as a pin in a slot. s = foot + mode sqrt(a3^2 - h^2)."""
    rng = np.random.default_rng(seed)
    a2, a3 = rng.uniform(0.2, 1, 2)
    guide, direction, orientation = rng.uniform(-0.7, 0.7, 2), rng.uniform(0, 360), rng.uniform(-180, 180)
    mode = rng.choice([-1, 1])
    angle = np.radians(0.3 + np.arange(201) * 2)
    pin = a2 * np.stack([np.cos(angle), np.sin(angle)], axis=1) - guide
    along = np.array([np.cos(np.radians(direction)), np.sin(np.radians(direction))])
    height = pin @ [-along[1], along[0]]
    exists = np.abs(height) <= a3
    root = np.sqrt(np.maximum(a3**2 - height**2, 0))
    s = np.where(exists, pin @ along + mode * root, np.nan)
    block = "links.piston.points = {B = [0, 0]}" if seed % 2 else ""
    kind = f'type = "prismatic"\nlink = "piston"\norientation = {orientation}' if seed % 2 else 'type = "pin-slot"'
    found = solve(
        mechanism(f"""
        links.ground.points = {{A0 = [0, 0]}}
        links.crank.points = {{A0 = [0, 0], A = [{a2}, 0]}}
        links.rod.points = {{A = [0, 0], B = [{a3}, 0]}}
        {block}
        [[joints]]
        {kind}
        on = "ground"
        point = "B"
        through = [{guide[0]}, {guide[1]}]
        angle = {direction}
        symbol = "s"
        [assembly]
        s = {s[np.argmax(exists)] if exists.any() else 0.0}
        [driver]
        link = "crank"
        start = 0.3
        stop = 400.3
        step = 2
        """)
    )
    assert np.array_equal(found.exists, exists)
    assert np.nanmax(np.append(np.abs(found.displacements["s"] - s) * root, 0)) < 1e-13


@pytest.mark.parametrize("seed", range(16))
def test_inverted_slider_crank(seed):
    """Slot that misses the pivot by e, at any angle of the lever. D from pivot to pin: s = -u + mode sqrt(D^2 - e^2)."""
    rng = np.random.default_rng(seed)
    a1, a2 = rng.uniform(0.2, 1, 2)
    e, u = rng.choice([0, rng.uniform(-0.6, 0.6)]), rng.uniform(-0.5, 0.5)
    slot, orientation, mode = rng.uniform(0, 360), rng.uniform(-180, 180), rng.choice([-1, 1])
    angle = np.radians(0.3 + np.arange(201) * 2)
    pin = a2 * np.stack([np.cos(angle), np.sin(angle)], axis=1) - [a1, 0]
    distance = np.hypot(*pin.T)
    exists = distance >= abs(e)
    root = mode * np.sqrt(np.maximum(distance**2 - e**2, 0))
    lever = np.arctan2(pin[:, 1], pin[:, 0]) - np.arctan2(e, root) - np.radians(slot)
    along = np.array([np.cos(np.radians(slot)), np.sin(np.radians(slot))])
    through = e * np.array([-along[1], along[0]]) + u * along
    block = "links.block.points = {A = [0, 0]}" if seed % 2 else ""
    kind = f'type = "prismatic"\nlink = "block"\norientation = {orientation}' if seed % 2 else 'type = "pin-slot"'
    m = mechanism(f"""
        links.ground.points = {{A0 = [0, 0], B0 = [{a1}, 0]}}
        links.crank.points = {{A0 = [0, 0], A = [{a2}, 0]}}
        links.lever.points = {{B0 = [0, 0]}}
        {block}
        [[joints]]
        {kind}
        on = "lever"
        point = "A"
        through = [{through[0]}, {through[1]}]
        angle = {slot}
        symbol = "s"
        [assembly]
        s = {(root - u)[np.argmax(exists)]}
        [driver]
        link = "crank"
        start = 0.3
        stop = 400.3
        step = 2
        """)
    found = solve(m)
    assert np.array_equal(found.exists, exists)
    assert np.max(np.abs((found.displacements["s"] - root + u) * root)[exists]) < 1e-13
    turned = found.poses["lever"][exists, 2] - lever[exists]
    assert np.max(np.abs((turned - 2 * np.pi * np.round(turned / (2 * np.pi))) * root[exists])) < 1e-13
    assert np.nanmax(worst(residuals(m, {}, variables(found)))[0]) < 1e-13
    if seed % 2:
        kept = (found.poses["block"] - found.poses["lever"])[exists, 2]
        assert np.ptp(kept) < 1e-12
