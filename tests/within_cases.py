"""A cylinder between crank and coupler of a four-bar: inside a loop that moves."""

LOADER = """
format = 1
[mechanism]
name = "loader"
[dimensions]
a1 = {a1}
a2 = {a2}
a3 = {a3}
a4 = {a4}
closed = {closed}
[links.ground]
points = {{ A0 = [0, 0], B0 = ["a1", 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0], P = [{p}, -8] }}
[links.coupler]
points = {{ A = [0, 0], B = ["a3", 0], Q = [{q}, 5] }}
[links.rocker]
points = {{ B0 = [0, 0], B = ["a4", 0] }}
[links.barrel]
points = {{ P = [0, 0] }}
[links.rod]
points = {{ Q = [0, 0] }}
[[joints]]
type = "prismatic"
name = "cylinder"
link = "rod"
on = "barrel"
point = "Q"
through = ["closed", {aside}]
symbol = "s"
[driver]
joint = "cylinder"
start = 0
stop = 30
step = 5
speed = 1
[assembly]
A = [10, 30]
P = [14, 8]
Q = [45, 48]
B = [60, 50]
"""


def loader(rng):
    """The text of a random one: the sketch says how crank and coupler stand, the lengths need not fit it."""
    sizes = {"a1": 70, "a2": 35, "a3": 60, "a4": 56, "closed": 32, "p": 16, "q": 38, "aside": 0}
    text = {name: round(value * rng.uniform(0.85, 1.15), 3) for name, value in sizes.items()}
    text["aside"] = rng.choice([0, 0, 3])
    return LOADER.format(**text)
