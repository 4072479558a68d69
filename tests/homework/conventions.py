"""Mechanisms of the tests' own and their tables by hand, in the conventions that students choose."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from homework.handmade import FOUR_BAR, STEPS, Table, four_bar
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.model import Mechanism

HEAD = 'format = 1\n[mechanism]\nname = "{name}"\n[dimensions]\n'
GROUND = "[links.ground]\npoints = {{ {points} }}\n"

STEERING = """
track = 1400
wheelbase = 2500
arm = 180
beta = { value = 18, unit = "deg" }
rod = { formula = "track - 2*arm*sin(beta)" }
[links.ground]
points = { L0 = [0, 0], R0 = ["track", 0] }
[links.left]
points = { L0 = [0, 0], L = ["arm", 0] }
[links.tierod]
points = { L = [0, 0], R = ["rod", 0] }
[links.right]
points = { R0 = [0, 0], R = ["arm", 0] }
[driver]
link = "left"
start = -102
stop = -42
step = 5
[assembly]
R = [1340, -170]
[outputs]
error = { formula = "theta14 + pi - beta - atan(track/wheelbase*cos(theta12))", unit = "deg" }
[summary]
worst = { of = "error", take = "max" }
[exercise]
asked = { theta13 = 1, theta14 = 1, error = 1, worst = 1 }
"""

SLIDER = """
a2 = 30
a3 = 150
c = 16
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.rod]
points = { A = [0, 0], C = ["a3", 0] }
[links.piston]
points = { C = [0, 0] }
[[joints]]
type = "prismatic"
link = "piston"
on = "ground"
point = "C"
through = [0, "c"]
symbol = "s14"
[driver]
link = "crank"
start = 0
stop = 360
step = 15
[assembly]
C = [-140, 16]
[outputs]
x_C = { formula = "C.x" }
lean = { formula = "2*theta13", unit = "deg" }
[summary]
stroke = { of = "s14", take = "range" }
steepest = { of = "theta13", take = "max" }
[exercise]
asked = { theta13 = 1, x_C = 1, lean = 1, stroke = 1, steepest = 1 }
"""

LEVER = """
a2 = 40
d = 90
b = 200
[links.ground]
points = { A0 = [0, 0], B0 = [0, "-d"] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.lever]
points = { B0 = [0, 0], B = ["b", 0] }
[[joints]]
type = "pin-slot"
point = "A"
on = "lever"
through = "B0"
symbol = "s3"
[driver]
link = "crank"
start = 10
stop = 350
step = 20
[assembly]
B = [20, 100]
[outputs]
arc = { formula = "b*theta13", unit = "mm" }
[summary]
left = { of = "theta13", take = "max" }
longest = { of = "s3", take = "max" }
[exercise]
asked = { theta13 = 1, s3 = 1, "B.x" = 1, arc = 1, left = 1, longest = 1 }
"""

FOUR = """
[exercise]
asked = { theta13 = 1, theta14 = 1, mu = 1, least = 1, most = 1 }
"""


@dataclass(frozen=True)
class Task:
    """A mechanism with its table by hand. `columns`: (heading, name, formula); `below`: summaries, (name, formula)."""

    text: str
    given: tuple[tuple[str, str, float | str], ...]
    columns: tuple[tuple[str, str, str | list[float]], ...]
    below: Mapping[str, str] = field(default_factory=dict)

    @property
    def mechanism(self) -> Mechanism:
        return loads(self.text, "own")

    def where(self, name: str, rows: int | None = None) -> str:
        """The cells of a column, of one of its rows, or of a summary."""
        first = len(self.given) + 5
        last = first + len(self.columns[0][2]) - 1
        if name in self.below:
            return f"Sayfa1!B{last + 3 + list(self.below).index(name)}"
        letter = chr(ord("A") + [column for _, column, _ in self.columns].index(name))
        return f"Sayfa1!{letter}{first}:{letter}{last}" if rows is None else f"Sayfa1!{letter}{first + rows}"

    def table(self, changes: Mapping[str, str] = {}, cells: Mapping[str, object] = {}) -> Table:
        """The workbook: `changes` by name of a column or summary; `cells` typed over, by name and row: `t14 5`."""
        columns = [(head, name, changes.get(name, formula)) for head, name, formula in self.columns]
        letters = {name: chr(ord("A") + number) for number, (_, name, _) in enumerate(columns)}
        first = len(self.given) + 5
        last = first + len(columns[0][2]) - 1
        found: dict[str, object] = {}
        for number, (name, formula) in enumerate(self.below.items(), last + 3):
            found[f"A{number}"] = name
            text = changes.get(name, formula)
            for column, letter in letters.items():
                text = text.replace(f"{{{column}}}", f"{letter}{first}:{letter}{last}")
            found[f"B{number}"] = f"={text}"
        for place, value in cells.items():
            name, row = place.split()
            found[f"{letters[name]}{first + int(row)}"] = value
        return Table(self.given, columns, cells=found)

    def save(self, path: Path, changes: Mapping[str, str] = {}, cells: Mapping[str, object] = {}) -> Path:
        return self.table(changes, cells).save(path)


_text = template_text("four-bar").replace(
    "[summary]", '[summary]\nleast = { of = "theta14", take = "min" }\nmost = { of = "theta14", take = "max" }', 1
)
CRANK = ("fi", "fi", "RADIANS({deg})")

TASKS = {
    "four-bar": Task(
        _text + FOUR, FOUR_BAR, tuple(four_bar()), {"least": "MIN({t14})", "most": "MAX({t14})"}
    ),
    "steering": Task(
        HEAD.format(name="steering") + STEERING,
        (
            ("track", "track", 1400.0), ("wheelbase", "wb", 2500.0), ("arm", "arm", 180.0), ("beta", "beta", 18.0),
            ("rod", "rod", "{track}-2*{arm}*SIN(RADIANS({beta}))"),
        ),
        (
            ("theta12", "deg", [-102.0 + 5 * n for n in range(13)]), CRANK,
            ("xL", "xL", "{arm}*COS({fi})"), ("yL", "yL", "{arm}*SIN({fi})"),
            ("s", "s", "SQRT(({track}-{xL})^2+{yL}^2)"), ("psi", "psi", "ATAN2({track}-{xL},-{yL})"),
            ("theta13", "t13", "{psi}-ACOS(({rod}^2+{s}^2-{arm}^2)/(2*{rod}*{s}))"),
            ("xR", "xR", "{xL}+{rod}*COS({t13})"), ("yR", "yR", "{yL}+{rod}*SIN({t13})"),
            ("theta14", "t14", "ATAN2({xR}-{track},{yR})"),
            ("error", "err", "DEGREES({t14}+PI()-ATAN({track}/{wb}*COS({fi})))-{beta}"),
        ),
        {"worst": "MAX({err})"},
    ),
    "slider": Task(
        HEAD.format(name="slider") + SLIDER,
        (("a2", "a2", 30.0), ("a3", "a3", 150.0), ("c", "c", 16.0)),
        (
            ("krank", "deg", STEPS), CRANK, ("q", "q", "ASIN(({c}-{a2}*SIN({fi}))/{a3})"),
            ("theta13", "t13", "PI()-{q}"), ("x_C", "xC", "{a2}*COS({fi})+{a3}*COS({t13})"), ("lean", "lean", "2*{t13}"),
        ),
        {"stroke": "MAX({xC})-MIN({xC})", "steepest": "MAX({t13})"},
    ),
    "lever": Task(
        HEAD.format(name="lever") + LEVER,
        (("a2", "a2", 40.0), ("d", "d", 90.0), ("b", "b", 200.0)),
        (
            ("krank", "deg", [10.0 + 20 * n for n in range(18)]), CRANK,
            ("u", "u", "{a2}*COS({fi})"), ("v", "v", "{a2}*SIN({fi})+{d}"),
            ("theta13", "t13", "ATAN2({u},{v})"), ("s3", "s3", "SQRT({u}^2+{v}^2)"), ("B x", "xB", "{b}*COS({t13})"),
            ("arc", "arc", "{b}*{t13}"),
        ),
        {"left": "MAX({t13})", "longest": "MAX({s3})"},
    ),
}  # fmt: skip
