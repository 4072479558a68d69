"""A block in a slot of the crank, and on a guide: s = h cot(theta), without a value where slot and guide are parallel."""

COTANGENT = """
format = 1
[mechanism]
name = "cotangent"
[dimensions]
h = 50
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0] }
[links.block]
points = { P = [0, 0] }
[links.slider]
points = { P = [0, 0] }
[[joints]]
type = "prismatic"
link = "block"
on = "crank"
point = "P"
through = "A0"
symbol = "r"
[[joints]]
type = "prismatic"
link = "slider"
on = "ground"
point = "P"
through = [0, "h"]
symbol = "s"
[driver]
link = "crank"
start = 10
stop = 330
step = 20
[assembly]
P = [50, 50]
[workbook]
language = "en"
"""
