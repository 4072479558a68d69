"""An in-line slider-crank, whose motion and forces have closed forms: crank 50, rod 200, a whole turn in 25 rows."""

IN_LINE = """
format = 1
[mechanism]
name = "in-line"
[dimensions]
r = 50
l = 200
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0], A = ["r", 0] }
[links.rod]
points = { A = [0, 0], B = ["l", 0] }
[links.piston]
points = { B = [0, 0] }
[[joints]]
type = "prismatic"
link = "piston"
on = "ground"
point = "B"
through = [0, 0]
symbol = "s14"
[driver]
link = "crank"
start = 0
stop = 360
step = 15
[assembly]
B = [250, 0]
"""
