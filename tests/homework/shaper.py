"""A shaper, and the table of a student who counts its lever clockwise from the vertical."""

from __future__ import annotations

import mechsheet
from homework.handmade import STEPS, Table

SHAPER = """
format = 1
mechanism.name = "shaper"
dimensions = { d = 300, r = 90, L = 550, c = 120, h = 520 }
links.frame.points = { O2 = [0, "d"], O4 = [0, 0] }
links.crank.points = { O2 = [0, 0], A = ["r", 0] }
links.lever.points = { O4 = [0, 0], B = ["L", 0] }
links.rod.points = { B = [0, 0], C = ["c", 0] }
links.ram.points = { C = [0, 0] }
joints = [
    { type = "pin-slot", point = "A", on = "lever", through = "O4", symbol = "s4" },
    { type = "prismatic", link = "ram", on = "frame", point = "C", through = [0, "h"], symbol = "s" },
]
driver = { link = "crank", start = 0, stop = 360, step = 15 }
assembly.C = [60, 520]
outputs.reach = "hypot(C.x, C.y)"
exercise.asked = { theta13 = 2, s = 2, reach = 1 }
"""

GIVEN = (("d", 300.0), ("r", 90.0), ("L", 550.0), ("c", 120.0), ("h", 520.0))


def shaped(tmp_path, text=SHAPER, **slips):
    """The table audited against a description; `slips` are formulas in place of some columns'."""
    columns = {
        "deg": STEPS,
        "xA": "{r}*COS(RADIANS({deg}))",
        "yA": "{d}+{r}*SIN(RADIANS({deg}))",
        "lean": "ATAN({xA}/{yA})",
        "xB": "{L}*SIN({lean})",
        "yB": "{L}*COS({lean})",
        "s": "{xB}-SQRT({c}^2-({h}-{yB})^2)",
        "reach": "SQRT({s}^2+{h}^2)",
    }
    given = tuple((name, name, value) for name, value in GIVEN)
    table = Table(given, [(name, name, slips.get(name, formula)) for name, formula in columns.items()])
    return mechsheet.audit(table.save(tmp_path / "shaper.xlsx"), mechsheet.loads(text))
