"""Mechanisms with everything that can be drawn, and what is drawn of them."""

from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.shapes.positions import Positions

SUSPENSION = """
format = 1
[mechanism]
name = "suspension"
title = "Rear suspension with shock absorber"
length_unit = "mm"
[links.frame]
points = { A0 = [0, 0], B0 = [60, 190], S = [250, 260] }
[links.swing-arm]
points = { A0 = [0, 0], W = [420, 0], C = [150, 60] }
mass = 25
center = [200, 20]
[links.rocker]
points = { B0 = [0, 0], D = [90, 0], E = [40, 70] }
mass = 0.4
center = [40, 20]
[links.push-rod]
points = { C = [0, 0], D = [110, 0] }
[driver]
link = "swing-arm"
start = -12
stop = 12
step = 2
speed = 1
[dynamics]
gravity = 9.81
[[loads]]
name = "wheel"
link = "swing-arm"
point = "W"
force = [0, "800 + 1500*theta12"]
[[loads]]
name = "brake"
link = "swing-arm"
torque = "150*theta12"
[[loads]]
name = "K"
between = ["E", "S"]
stiffness = 60
free_length = 190
damping = 3
[assembly]
D = [150, 170]
E = [100, 250]
"""

LAMP = """
format = 1
[mechanism]
name = "lamp"
title = "Desk lamp"
length_unit = "mm"
[links.base]
points = { A0 = [0, 0], S = [60, 20], T = [-30, 60] }
[links.arm]
points = { A0 = [0, 0], A = [400, 0], P = [120, 0] }
mass = 0.5
center = [200, 0]
[links.rod]
points = { T = [0, 0], Q = [400, 0], R = [150, 0] }
[links.head]
points = { A = [0, 0], Q = [-30, 60], L = [260, -60] }
mass = 0.9
center = [220, -40]
[driver]
link = "arm"
start = 50
stop = 85
step = 5
[dynamics]
gravity = 9.81
[[loads]]
name = "K1"
between = ["S", "P"]
stiffness = 0.2
free_length = 60
[[loads]]
name = "K2"
between = ["A0", "R"]
stiffness = 0.15
[assembly]
Q = [227, 366]
"""


def positions(text, **options):
    return Positions(Compiled(loads(text)), **options)


def of_kind(scene, *kinds):
    return [item for item in scene.items if item.kind in kinds]
