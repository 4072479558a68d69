"""Random cams: slides, rockers, flat faces, a roller on a coupler; all laws, both senses."""

import math
import random

SMOOTH = ("cycloidal", "3-4-5", "4-5-6-7", "modified trapezoid", "modified sine")
ALL_LAWS = ("parabolic", "harmonic", *SMOOTH)
ON_A_SLIDE = """
format = 1
mechanism.name = "slide"
links.ground.points = { O = [0, 0] }
links.tappet.points = { F = [0, 0] }
joints = [{ type = "prismatic", link = "tappet", on = "ground", point = "F", through = [5, 0], angle = 90, symbol = "s" }]
cam = { center = "O", base_radius = 35, roller = { point = "F", radius = 8 } }
"""
"""One that is not random, a roller on a slide beside the centre; its driver is to be added."""

KINDS = ("slide", "rocker", "flat slide", "flat rocker", "coupler")


def segments(dice: random.Random, most: float, laws=ALL_LAWS) -> str:
    """Segments that come back, with a dwell here and there."""
    count = 2 * dice.choice([1, 2, 3])
    ends = [0, *sorted(dice.sample(range(30, 330, 20), count - 1)), 360]
    text, lift = "", 0.0
    for place in range(count - 1):
        over = ends[place + 1] - ends[place]
        if place and dice.random() < 0.3:
            text += f'[[driver.segments]]\nlaw = "dwell"\nover = {over}\n'
        else:
            lift = round(dice.uniform(0.2, 1.0) * most, 3)
            text += f'[[driver.segments]]\nlaw = "{dice.choice(laws)}"\nover = {over}\nto = {lift}\n'
    return text + f'[[driver.segments]]\nlaw = "{dice.choice(laws)}"\nto = 0\n'


def cam(seed: int, kind: str = "", laws=ALL_LAWS, step: float = 5) -> str:
    """A description."""
    dice = random.Random(seed)
    kind = kind or dice.choice(KINDS)
    base, roller = dice.uniform(30, 60), dice.choice([0, dice.uniform(2, 15)])
    text = 'format = 1\n[mechanism]\nname = "cam"\n[links.ground]\n'
    if kind in ("slide", "flat slide"):
        offset, angle = dice.uniform(-15, 15), dice.uniform(-180, 180)
        x, y = 3 - offset * math.sin(math.radians(angle)), 4 + offset * math.cos(math.radians(angle))
        turned = dice.uniform(-10, 10) - (90 if kind == "flat slide" else 0)
        text += f"""points = {{ O = [3, 4], G = [{x}, {y}] }}
[links.f]
points = {{ C = [2, 1], D = [60, 0] }}
[[joints]]
type = "prismatic"
name = "guide"
link = "f"
on = "ground"
point = "D"
through = "G"
angle = {angle}
orientation = {turned}
symbol = "s"
[driver]
joint = "guide"
step = {step}
{segments(dice, dice.uniform(5, 20), laws)}"""
    elif kind in ("rocker", "flat rocker"):
        far = dice.uniform(70, 110)
        text += f"""points = {{ O = [0, 0], B = [{far}, {dice.uniform(-10, 10)}] }}
[links.f]
points = {{ B = [0, 0], C = [{dice.uniform(0.8, 1.0) * far}, {10 if kind == "flat rocker" else dice.uniform(-5, 5)}] }}
[driver]
link = "f"
{"start = 150" if kind == "flat rocker" else ""}
step = {step}
{segments(dice, dice.uniform(5, 15), laws)}"""
    else:
        text += f"""points = {{ O = [0, 0], B = [100, 0], E = [20, 60] }}
[links.f]
points = {{ B = [0, 0], C = [60, 0] }}
[links.k]
points = {{ C = [0, 0], Q = [70, 0], R = [30, -20] }}
[links.m]
points = {{ E = [0, 0], Q = [40, 0] }}
[driver]
link = "f"
start = 150
step = {step}
{segments(dice, dice.uniform(5, 15), laws)}[assembly]
Q = [-10, 50]
"""
    touches = f'roller = {{ point = "{"R" if kind == "coupler" else "C"}", radius = {roller} }}'
    if kind.startswith("flat"):
        touches = f'face = {{ link = "f", point = "C", angle = {dice.uniform(-10, 10)} }}'
    return f'{text}[cam]\ncenter = "O"\nbase_radius = {base}\nturns = {dice.choice([1, -1])}\n{touches}\n'


def loaded(text: str) -> str:
    """The same with a mass, a load, and a spring on the follower; the cam turns."""
    text = text.replace("[links.f]\n", "[links.f]\nmass = 0.3\ncenter = [10, 3]\ninertia = 2e-4\n")
    loads = """[dynamics]
gravity = 9.81
[[loads]]
link = "f"
point = "C"
force = [3, -5]
[[loads]]
name = "K"
between = ["O", "C"]
stiffness = 4
free_length = 20
damping = 0.01
[driver]
speed = 20
"""
    return text.replace("[driver]\n", loads)
