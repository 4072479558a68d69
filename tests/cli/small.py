"""A description that is built in no time."""

CRANK = """format = 1
[mechanism]
name = "yoke"
title = { en = "Yoke at θ", tr = "Çatal ışığı" }
[dimensions]
a2 = 30
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.block]
points = { A = [0, 0] }
[links.yoke]
points = { P = [0, 0] }
[[joints]]
type = "prismatic"
link = "block"
on = "yoke"
point = "A"
through = "P"
angle = 90
[[joints]]
type = "prismatic"
link = "yoke"
on = "ground"
point = "P"
through = "A0"
[driver]
link = "crank"
start = 0
stop = 360
step = 90
[assembly]
P = [30, 0]
"""
