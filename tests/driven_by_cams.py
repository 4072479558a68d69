"""Mechanisms whose driver is moved by a cam: its roller or its face is on any of their links."""

import math
import random
import re

from mechsheet.description import loads
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.driving import driver_values

PARTS = 0.06
"""The follower moves by so much of the way that the driver had."""

OWN = "start|stop|step|rows|speed|acceleration|values|law|duration|steps|period"


def driven_by_cam(text: str, seed: int, face: bool = False) -> str:
    """The description with its driver where it began, from where a cam moves it to and fro."""
    dice = random.Random(seed)
    mechanism = loads(text)
    values = driver_values(mechanism, dimension_values(mechanism))
    start, way = float(values[0]), float(values[-1] - values[0]) * PARTS
    if not mechanism.driver.joint:
        start, way = math.degrees(start), math.degrees(way)
    size = largest_length(mechanism, dimension_values(mechanism))
    x, y = (dice.uniform(-1, 1) * size for _ in "xy")
    text = text.replace(
        "points = {", f"points = {{ CAM = [{x:.3f}, {y:.3f}], ", 1
    )  # of the ground, where nothing turns
    head, own, rest = re.search(r"(?ms)\A(.*?^\[driver\]$)(.*?)((?:^\[.*)?)\Z", text).groups()
    own = re.sub(rf"(?m)^({OWN}) *=.*$", "", own)
    driven = next((link.points for link in mechanism.links if link.name == mechanism.driver.link), {})
    ground = mechanism.ground.points
    places = [
        (link.name, point) for link in mechanism.links[1:] for point in link.points
        if point not in ground and point not in driven
    ]  # fmt: skip
    link, point = dice.choice(places)
    touches = f'face = {{ link = "{link}", point = "{point}", angle = {dice.uniform(-40, 40):.3f} }}'
    if not face:
        touches = f'roller = {{ point = "{point}", radius = 3 }}'
    moves = "".join(
        f'[[driver.segments]]\nlaw = "{law}"\nover = {over}\n{way}\n'
        for law, over, way in (
            ("cycloidal", 120, f"by = {way}"), ("dwell", 60, ""), ("3-4-5", 120, "to = 0"), ("dwell", 60, ""),
        )
    )  # fmt: skip
    cam = f'[cam]\ncenter = "CAM"\nbase_radius = 20\n{touches}\n'
    return f"{head}\nstart = {start}\nstep = 15\nspeed = 3\nacceleration = 1.5\n{own}\n{moves}\n{rest}\n{cam}"
