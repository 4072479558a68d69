"""Format 1 of the description as data: every key, what it may hold (in the shapes of `grammar`), and what it means.

`shape.py` checks a text against it; the manual's table of keys and a JSON Schema can be made from it. What cannot be said
of one key alone (names that must exist, circles, rows) is checked by the modules that read the parts.
"""

from __future__ import annotations

from mechsheet.description.asked.schema import EXERCISE, STUDY, SYNTHESIS, TOLERANCES
from mechsheet.description.grammar import (
    MOST_COLUMNS,
    MOST_ROWS,
    MOST_SERIES,
    Either,
    Integer,
    Items,
    Key,
    Kinds,
    Named,
    Number,
    Quantity,
    Table,
    Text,
    WithUnit,
    Words,
    YesNo,
)
from mechsheet.model import LAWS, SEGMENT_LAWS, TAKES
from mechsheet.words.catalogue import LANGUAGES

FORMAT = 1

PAIR = Items(Quantity(), 2, 2, "[x, y]")
_LABEL = Key(Words(), "what it is called, in one language or both")
_CELL = Key(Text(), "the name of its cell in the workbook")
_UNIT = Key(
    Text(longest=20),
    'the length unit (the default), "deg", "rad", "1" for a plain number; of forces and masses "N", "N/mm", "kg", "lbf" …',
)
_ANGLE = Key(Quantity(), "direction of the line in the frame of `on`; default 0")
_SYMBOL = Key(Text(), "the displacement: signed distance from `through` to `point` along the line")

MECHANISM = Table(
    {
        "name": Key(Text(longest=100), 'stem of the files that are built: letters, digits, "-" and "_"', True),
        "title": Key(Words(), "title of the workbook; the name by default"),
        "source": Key(Words(4000, lines=True), "where the numbers come from; printed in the workbook"),
        "length_unit": Key(Text(longest=20), 'label of all lengths; default "mm"'),
        "angle_unit": Key(Text(("deg", "rad")), 'unit of every plain number that is an angle; default "deg"'),
    }
)

DIMENSION = Table(
    {
        "value": Key(Either((Number(), WithUnit())), 'an input, in the dimension\'s own unit; or with it: "20 mm"'),
        "formula": Key(Text(longest=8000), "an expression over other dimensions"),
        "synthesis": Key(Text(names="result"), "or a result of [synthesis]"),
        "unit": _UNIT,
        "label": _LABEL,
        "cell": _CELL,
        "tolerance": Key(Number(0), "in the unit shown"),
    },
    ways=((("value",), ("formula",), ("synthesis",)),),
)

POINT = Table(
    {
        "r": Key(Quantity(), "distance from the frame's origin"),
        "angle": Key(Quantity(), "direction from the frame's x axis"),
        "distances": Key(Named(Quantity(), "point", 2, 2), "distances from two points of the same link"),
        "side": Key(Text(("left", "right")), "side of the line from the first point to the second"),
    },
    ways=((("r", "angle"), ("distances", "side")),),
)

_SPOT = Either((Text(names="point"), PAIR, POINT))
"""A point of a link by its name, or a place in the link's frame."""

MOST_POINTS = 1000
"""Of a link: their list must fit into a cell of Notes, which holds 32,767 characters."""

LINK = Table(
    {
        "points": Key(Named(Either((PAIR, POINT)), "point", most=MOST_POINTS), "its points, in its own frame", True),
        "label": _LABEL,
        "number": Key(Integer(1, 999), "overrides the counting; the ground is 1"),
        "redundant": Key(
            YesNo(), "true: it moves with the others anyway; left out of the solution, its length checked"
        ),
        "mass": Key(Quantity(), "in kg; a number or an expression over dimensions"),
        "center": Key(_SPOT, "its mass centre: one of its points, or a place in its frame; default: its only point"),
        "inertia": Key(Quantity(), "moment of inertia about the mass centre, in kg m²; default 0"),
    },
    later=("friction",),
)

REASONS = {
    "friction": (
        '"friction" is not supported yet: joints are taken to be free of it',
        'a load against the motion may stand for it: [[loads]] with torque = "-0.2*omega14"',
    ),
    **dict.fromkeys(
        ("start", "stop", "step", "speed", "acceleration"),
        (
            "there is one sweep, and one speed, that of [driver]",
            'give `value`, one for all rows, `values`, one for each row, or `follows = "…"`, in which [driver] is named',
        ),
    ),
}
"""Keys that are refused by name: why, and what to do instead."""

PINNED = "links that name the same point are pinned there: no entry of [[joints]] is needed"
SLIDES = 'write "prismatic"'
MEANT = {
    **dict.fromkeys(("revolute", "pin", "pinned", "hinge", "rotary", "turning"), PINNED),
    **dict.fromkeys(("slider", "sliding", "slide", "translational", "linear", "cylinder"), SLIDES),
}
"""What to write in place of a type of joints that others know by this name."""

TAKES_MEANT = {
    **dict.fromkeys(("largest", "maximum", "greatest", "biggest", "highest", "peak"), "max"),
    **dict.fromkeys(("smallest", "minimum", "least", "lowest"), "min"),
    **dict.fromkeys(("average", "avg"), "mean"),
    **dict.fromkeys(("swing", "stroke", "span", "difference"), "range"),
}
"""What to write in place of a take that people call by this name."""

_TYPE = Key(Text(), "kind of the joint", True)
_NAME = Key(Text(), "what the driver calls it; the symbol by default")
_ON = Key(Text(names="link"), "the link that carries the line", True)
_THROUGH = Key(
    Either((Text(names="point"), PAIR)), "a point of the line: a point of `on`, or [x, y] in its frame", True
)

_PRESSURE = Key(
    Quantity(), "angle of the tooth force from the pitch line's tangent, where there are forces; default 20°"
)


def _wheels(senses: str) -> Table:
    """A gear or a belt."""
    return Table(
        {
            "type": _TYPE,
            "link": Key(Text(names="link"), "the wheel whose angle is meant", True),
            "on": Key(Text(names="link"), "the other wheel; the ground is a wheel that stands", True),
            "arm": Key(Text(names="link"), "the link that carries both axes; the ground by default"),
            "ratio": Key(
                Quantity(),
                f"angle(link) - angle(arm) = ratio * (angle(on) - angle(arm)) + phase, of {senses}",
                True,
            ),
            "phase": Key(Quantity(), "see `ratio`; default: as the sketch shows, else 0"),
            "pressure_angle": _PRESSURE,
        }
    )


JOINT = Kinds(
    "type",
    {
        "prismatic": Table(
            {
                "type": _TYPE,
                "name": _NAME,
                "link": Key(Text(names="link"), "the link that slides", True),
                "on": _ON,
                "point": Key(Text(names="point"), "the point of `link` that stays on the line", True),
                "through": _THROUGH,
                "angle": _ANGLE,
                "orientation": Key(Quantity(), "angle of `link`'s x axis from the line; default 0"),
                "symbol": _SYMBOL,
            },
            later=("friction",),
        ),
        "pin-slot": Table(
            {
                "type": _TYPE,
                "name": _NAME,
                "link": Key(Text(names="link"), "the link whose point moves; the first with `point` by default"),
                "on": _ON,
                "point": Key(Text(names="point"), "the point, of some other link, that moves along the line", True),
                "through": _THROUGH,
                "angle": _ANGLE,
                "symbol": _SYMBOL,
            },
            later=("friction",),
        ),
        "gear": _wheels("gear wheels: negative where they mesh outside, positive in a ring"),
        "belt": _wheels("a belt: negative where it is crossed"),
        "rack": Table(
            {
                "type": _TYPE,
                "joint": Key(Text(names="joint"), "the sliding joint that moves as the pinion turns", True),
                "link": Key(Text(names="link"), "the pinion", True),
                "arm": Key(
                    Text(names="link"),
                    "the side of the sliding joint on which the pinion is pivoted; found by itself when left out",
                ),
                "radius": Key(
                    Quantity(),
                    "displacement = radius * (angle of link - angle of arm) + phase; negative for the other sense",
                    True,
                ),
                "phase": Key(Quantity(), "the displacement at angle 0; default: as the sketch shows, else 0"),
                "pressure_angle": _PRESSURE,
            }
        ),
    },
)

_SPEED_UNITS = ("rad/s", "deg/s", "rpm")
_ACCELERATION_UNITS = ("rad/s^2", "deg/s^2", "rpm/s")


def _rate(units: tuple[str, ...], per: str) -> Either:
    """A number (of the first unit), an expression, a number with its unit, or one for each of the driver's values."""
    note = " or ".join(f'"{unit}"' for unit in units) + f'; of a displacement "LENGTH UNIT/{per}"'
    with_unit = Table({"value": Key(Number(), "a number", True), "unit": Key(Text(), note, True)})
    return Either((Quantity(), with_unit, Items(Quantity(), 1, note="a list with one for each of `values`")))


MOTION = Table(
    {
        "law": Key(Text(LAWS), "how the way grows with the time", True),
        "duration": Key(Quantity(), "time from start to stop, in s", True),
        "rows": Key(Integer(2, MOST_ROWS), "positions, equally spaced in time; default 41"),
    }
)

SEGMENT = Table(
    {
        "law": Key(Text(SEGMENT_LAWS), "how the way grows with the cam's angle", True),
        "over": Key(Quantity(), "over which angle of the cam; of the last segment what is left of the turn"),
        "by": Key(Quantity(), "how far the follower goes"),
        "to": Key(Quantity(), "or to which way from its start; 0: back"),
    }
)

MOST_SEGMENTS = 40
"""Of a motion: each is one more choice in a formula, and programs nest no more than 64."""

CAM = Table(
    {
        "center": Key(Text(names="point"), "the point of the ground about which the cam turns", True),
        "symbol": Key(Text(), "its angle; default phi"),
        "base_radius": Key(Quantity(), "radius of the base circle", True),
        "roller": Key(
            Table(
                {
                    "point": Key(Text(names="point"), "its centre, a point of any moving link", True),
                    "radius": Key(Quantity(), "its radius; 0 for a knife edge", True),
                }
            ),
            "the roller that runs on the cam",
        ),
        "face": Key(
            Table(
                {
                    "link": Key(Text(names="link"), "the link that has it", True),
                    "point": Key(Text(names="point"), "a point of the link on it", True),
                    "angle": Key(Quantity(), "its direction against the link's x axis; default 0"),
                }
            ),
            "or a flat face",
        ),
        "pressure_angle": Key(
            Quantity(), "the largest pressure angle that is usual; default 30° for a slide, 45° for a rocker"
        ),
        "turns": Key(Integer(-1, 1), "1 counter-clockwise, the default; -1 clockwise"),
    },
    ways=((("roller",), ("face",)),),
)

DRIVER = Table(
    {
        "link": Key(Text(names="link"), "the link that turns"),
        "relative_to": Key(Text(names="link"), "the link it turns against; the ground by default"),
        "joint": Key(Text(names="joint"), "or the sliding joint whose displacement is given"),
        "symbol": Key(Text(), "default: the link's angle, the joint's displacement"),
        "start": Key(Quantity(), "first value"),
        "stop": Key(Quantity(), "last value, when the steps land on it"),
        "step": Key(Quantity(), "from row to row"),
        "values": Key(Items(Quantity(), 1), "or all values one by one"),
        "motion": Key(MOTION, "or from start to stop in a given time, by a motion law"),
        "segments": Key(
            Items(SEGMENT, 1, MOST_SEGMENTS), "or segments of motion over the angle of a cam, one after another"
        ),
        "closed": Key(YesNo(), "whether segments come back to where they began; default true"),
        "speed": Key(
            _rate(_SPEED_UNITS, "s"),
            "in rad/s (of a displacement in length units/s); an expression may read the driver, too; "
            "or a list, one for each of `values`",
        ),
        "acceleration": Key(
            _rate(_ACCELERATION_UNITS, "s^2"),
            "in rad/s^2; default 0, or as the speed changes with the driver; or a list, likewise",
        ),
    },
    ways=(
        (("link",), ("joint",)),
        (("start", "stop", "step"), ("values",), ("start", "stop", "motion"), ("segments", "step", "start?")),
    ),
)

FURTHER_DRIVER = Table(
    {
        "link": DRIVER.keys["link"],
        "relative_to": DRIVER.keys["relative_to"],
        "joint": DRIVER.keys["joint"],
        "symbol": DRIVER.keys["symbol"],
        "value": Key(Quantity(), "one value for all rows: a cell, turned by hand; or an expression over dimensions"),
        "follows": Key(Text(longest=8000), "an expression over dimensions and the symbols of other drivers"),
        "values": Key(Items(Quantity(), 1), "one value for each row of [driver]"),
    },
    ways=((("link",), ("joint",)), (("value",), ("follows",), ("values",))),
    later=("speed", "acceleration", "start", "stop", "step"),
)

RATES = Table(
    {
        "points": Key(
            Items(Text(names="point")),
            "points whose velocity and acceleration are wanted; default: those with a path in a chart, "
            "else those that are no joint",
        )
    }
)

DYNAMICS = Table(
    {
        "gravity": Key(
            Either((Quantity(), PAIR)),
            "acceleration of gravity downwards, in m/s², or [gx, gy]; 9.81 on earth; default 0",
        ),
        "force_unit": Key(
            Text(longest=20), "unit of forces, where lengths are not in mm, cm, dm or m; default with in and ft: lbf"
        ),
        "mass_unit": Key(Text(longest=20), "unit of masses, likewise; default with in: lbf s²/in, with ft: slug"),
    },
    later=("friction",),
)

FLYWHEEL = Table(
    {"fluctuation": Key(Number(), "coefficient of fluctuation of speed that is allowed, (ω max − ω min)/ω mean", True)}
)

LOAD = Table(
    {
        "name": Key(Text(longest=40), "what its cells are called; by default L1, L2 …"),
        "link": Key(Text(names="link"), "the link that is loaded"),
        "point": Key(
            _SPOT, "where the force acts: a point of the link, or a place in its frame; default: its only point"
        ),
        "force": Key(PAIR, "its components in N: numbers, or expressions over dimensions, positions and rates"),
        "torque": Key(Quantity(), "or a torque in N m, counter-clockwise, likewise"),
        "frame": Key(Text(("ground", "link")), "in which the components are given; default ground"),
        "between": Key(
            Items(Text(names="point"), 2, 2),
            "or a spring and damper between two points, each of the first link that has it",
        ),
        "stiffness": Key(Quantity(), "of the spring, in N per length unit; default 0"),
        "free_length": Key(Quantity(), "of the spring; default 0"),
        "damping": Key(Quantity(), "of the damper, in N s per length unit; default 0"),
    },
    ways=((("force",), ("torque",), ("between",)),),
    later=("friction",),
)

OUTPUT = Table(
    {
        "formula": Key(
            Text(longest=8000),
            "an expression over variables, dimensions and other outputs, or over summaries and dimensions",
            True,
        ),
        "unit": Key(
            Text(longest=20), 'as for a dimension, or any label but for an angle; "deg": the formula yields radians'
        ),
        "label": _LABEL,
        "cell": _CELL,
    }
)

SUMMARY = Table(
    {
        "of": Key(Text(names="variable or output"), "what is looked at over the whole sweep", True),
        "take": Key(Text(tuple(TAKES)), "which number is taken", True),
        "label": _LABEL,
        "cell": _CELL,
    }
)

CHART = Table(
    {
        "title": Key(Words(), "title of the chart"),
        "x": Key(Text(names="variable or output"), "the horizontal axis"),
        "y": Key(Items(Text(names="variable or output"), 1, MOST_SERIES), "the curves"),
        "paths": Key(Items(Text(names="point"), 1, MOST_SERIES), "curves of points, x and y at the same scale"),
        "hodographs": Key(
            Items(Text(names="point"), 1, MOST_SERIES), "curves of the ends of points' velocity vectors, at true scale"
        ),
        "profile": Key(YesNo(), "true: the profile of the cam at true scale, with base circle and pitch curve"),
        **{
            f"{axis}_{end}": Key(Number(), f"where the {way} axis {verb}, in the unit shown; chosen when left out")
            for axis, way in (("x", "horizontal"), ("y", "vertical"))
            for end, verb in (("min", "begins"), ("max", "ends"))
        },
    },
    ways=((("x", "y"), ("paths",), ("hodographs",), ("profile",)),),
)

MOST_PAIRS = 400
"""Cells of a table whose value is a summary: each has a column of helpers, and more where its formula is long."""

MOST_CELLS = 100_000
"""Helper cells of such a table: its cells times the driver's values."""

_VALUES = Named(Items(Quantity(), 1, MOST_COLUMNS), "dimension", 1, 1)

TABLE = Table(
    {
        "title": Key(Words(), "title of the table"),
        "rows": Key(
            Either((Text(names="driver"), _VALUES)), "the driver's symbol; for a summary one input and its values", True
        ),
        "columns": Key(_VALUES, "one input and its values", True),
        "value": Key(Text(names="variable, output or summary"), "what stands in the cells", True),
    }
)

WORKBOOK = Table(
    {
        "language": Key(Text(LANGUAGES), "language of sheet names, headings and notes; default en"),
        "layout": Key(Text(("sheets", "page")), "several sheets, or all on one; default sheets"),
        "drawing": Key(YesNo(), "false leaves the drawing out of the layout page; default true"),
        "references": Key(
            Text(("names", "anchors")), "how formulas name a dimension; default names, in the layout page anchors"
        ),
    }
)

SOLUTION = Table(
    {
        "passes": Key(
            Integer(3, 12),
            "Newton steps a row, where links must be solved all at once; default 6, or more where needed",
        ),
        "force": Key(YesNo(), "true solves every group so, for comparison; default false"),
    }
)

OF_SYNTHESIS = Table({"synthesis": Key(Text(names="result"), "the result that says it", True)})

ASSEMBLY = Named(
    Either((PAIR, Quantity(), OF_SYNTHESIS)),
    "point or variable; or an assembly mode that is a result of [synthesis]",
    keys={"at": Key(Quantity(), "the driver value that the sketch shows; by default the first")},
)

DESCRIPTION = Table(
    {
        "format": Key(Integer(FORMAT, FORMAT), "version of this format", True),
        "mechanism": Key(MECHANISM, "what is described", True),
        "synthesis": Key(SYNTHESIS, "a task from which dimensions are found"),
        "dimensions": Key(
            Named(Either((Number(), WithUnit(), DIMENSION)), "dimension"), "named constants, one cell each"
        ),
        "links": Key(Named(LINK, "link", 2), "rigid links; the first is the ground", True),
        "joints": Key(Items(JOINT), "sliding joints, gears, belts and racks"),
        "driver": Key(DRIVER, "what is driven, and its values", True),
        "drivers": Key(Items(FURTHER_DRIVER), "what is driven besides: as many as the mobility needs"),
        "cam": Key(CAM, "the cam whose profile moves the driven joint or link, by segments of [driver]"),
        "rates": Key(RATES, "velocities and accelerations, where the driver has a speed"),
        "dynamics": Key(DYNAMICS, "gravity and units, where links have masses or loads"),
        "loads": Key(Items(LOAD), "forces and torques on links"),
        "flywheel": Key(FLYWHEEL, "how large one must be, for whole turns at constant speed"),
        "assembly": Key(ASSEMBLY, "a rough position, which picks the assembly"),
        "outputs": Key(
            Named(Either((Text(longest=8000), OUTPUT)), "output"),
            "further quantities of every row; of the whole motion where they name summaries; a text is the formula",
        ),
        "summary": Key(Named(SUMMARY, "summary"), "one number from a whole sweep"),
        "tolerance": Key(TOLERANCES, "bands that follow from the tolerances of dimensions; needs no keys"),
        "charts": Key(Items(CHART), "charts; sensible ones are chosen when left out"),
        "tables": Key(Items(TABLE), "two-way tables"),
        "workbook": Key(WORKBOOK, "how the workbook is written"),
        "solution": Key(SOLUTION, "how groups of links are solved that have no closed form"),
        "exercise": Key(EXERCISE, "what is asked of students, and what varies from one to the next"),
        "study": Key(STUDY, "which of millions of designs are kept, and what is best of them"),
    },
    later=("friction",),
)
