"""svg, dxf: a mechanism at the positions that an export asks for, from the list of shapes, in its own coordinates."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError, MechsheetError
from mechsheet.exporting.job import Job
from mechsheet.extras import missing_package
from mechsheet.plotting.sampling import LEAST, sample
from mechsheet.shapes.names import POINTS
from mechsheet.shapes.positions import RING, Disc, Label, Positions, Scene, Stroke, painted, there

if TYPE_CHECKING:
    from ezdxf.document import Drawing


@dataclass(frozen=True, slots=True)
class Drawn:
    """One position, in the mechanism's own length unit: the scene, and all points by name."""

    scene: Scene
    points: dict[str, tuple[float, float]]
    title: str
    unit: str

    def length(self, points: float) -> float:
        """So many points of a printer, in the length unit."""
        return points * self.scene.window.half / POINTS


def drawings(job: Job) -> Iterator[Drawn]:
    """The positions that a job asks for. Raises MechanismError where there is none."""
    mechanism = job.mechanism
    fine = len(job.compiled.driver) if mechanism.cam is not None else 0  # a profile is as fine as its rows
    found = sample(mechanism, job.at, None, max(LEAST, job.frames or 0, fine))
    if not any(found.exists):
        raise MechanismError(Fault(say("no position of the sweep exists"), key="driver"))
    rows = [found.shown]
    if job.frames:
        closing = [row for row in range(found.sweep) if found.exists[row]]
        if job.frames > len(closing):
            fault = say(
                "{frames} frames: the sweep has 1 position to draw"
                if len(closing) == 1
                else "{frames} frames: the sweep has {count} positions to draw",
                frames=job.frames,
                count=len(closing),
            )
            raise MechsheetError(Fault(fault, key="frames"))
        rows = [closing[round(place)] for place in np.linspace(0, len(closing) - 1, job.frames).tolist()]
    positions = Positions(found)
    names = dict.fromkeys(point for link in mechanism.links for point in link.points)
    columns = {name: (found.values[f"{name}.x"], found.values[f"{name}.y"]) for name in names}
    title = mechanism.title.of(mechanism.language)
    for row in rows:
        points = {name: (float(x[row]), float(y[row])) for name, (x, y) in columns.items()}
        yield Drawn(positions.at(row), points, title, mechanism.length_unit)


BASE = 0.35
"""How far the base line of letters lies under their middle, as a part of their height."""


def svg(job: Job) -> list[bytes]:
    """One file for each position, in UTF-8."""
    return [svg_picture(drawn) for drawn in drawings(job)]


def _number(value: float) -> str:
    """Twelve digits: more than any drawing needs, and the same on every machine."""
    return f"{value:.12g}" if abs(value) > 1e-300 else "0"


def svg_picture(drawn: Drawn) -> bytes:
    """The file of one position: y points upwards in it. The class of an element is its kind."""
    window, items = drawn.scene.window, drawn.scene.items
    corner = window.x - window.half, -window.y - window.half
    box = " ".join(_number(part) for part in (*corner, 2 * window.half, 2 * window.half))
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" width="480" height="480" viewBox="{box}">',
        f"<title>{escape(drawn.title)}</title>",
        f"<desc>1 = 1 {escape(drawn.unit)}; y points upwards</desc>",
        '<g transform="scale(1,-1)" fill="none" stroke-linejoin="round" stroke-linecap="round">',
    ]
    lines += [_svg_shape(each, drawn) for each in painted(items) if not isinstance(each, Label)]
    lines += ["</g>", '<g font-family="sans-serif" fill="#404040">']
    lines += [_svg_label(item, drawn) for item in items if isinstance(item, Label) and there(item)]
    lines += ["</g>", '<g id="points" transform="scale(1,-1)" fill="none">']
    lines += [
        f'<circle id="{escape(name)}" cx="{_number(a)}" cy="{_number(b)}" r="0"/>'
        for name, (a, b) in drawn.points.items()
    ]
    return "\n".join([*lines, "</g>", "</svg>", ""]).encode()


def _svg_shape(item: Stroke | Disc, drawn: Drawn) -> str:
    if isinstance(item, Stroke):
        places = item.points[np.isfinite(item.points).all(axis=1)].tolist()
        points = " ".join(f"{_number(x)},{_number(y)}" for x, y in places)
        style = f'class="{item.kind}" stroke="#{item.color}" stroke-width="{_number(drawn.length(item.width))}"'
        style += f' fill="#{item.fill}"' if item.fill else ""
        return f'<polyline {style} points="{points}"><title>{escape(item.name)}</title></polyline>'
    style = (
        f'class="{item.kind}" fill="#{item.fill}" stroke="#{item.line}" stroke-width="{_number(drawn.length(RING))}"'
    )
    return f'<circle {style} cx="{_number(item.x)}" cy="{_number(item.y)}" r="{_number(item.radius)}"/>'


def _svg_label(label: Label, drawn: Drawn) -> str:
    height = drawn.length(label.size)
    place = f'x="{_number(label.x)}" y="{_number(-label.y + BASE * height)}"'
    style = f'class="{label.kind}" font-size="{_number(height)}" text-anchor="{"middle" if label.middle else "start"}"'
    return f"<text {style} {place}>{escape(label.text)}</text>"


UNITS = {"in": 1, "inch": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6, "km": 7, "yd": 10, "um": 13, "µm": 13, "dm": 14}
"""Length units that DXF has a number for ($INSUNITS); 0 says nothing."""

CLOSES = 1e-9
"""Ends of a cam's curve that are nearer than this part of half the window are one place."""

NAMED, TEXTS, PINS = "POINTS", "TEXT", "PINS"
"""Layers of points with their names, of texts, of pins."""


def dxf(job: Job) -> list[bytes]:
    """One file for each position, written by ezdxf. Raises MissingProgramError without it."""
    with _ezdxf():  # before anything is computed: without it there is no use in that
        return [dxf_drawing(drawn) for drawn in drawings(job)]


@contextmanager
def _ezdxf() -> Iterator[None]:
    """ezdxf with no clock and nothing random in its files."""
    try:
        import ezdxf
    except ImportError as error:
        raise missing_package("ezdxf", "dxf", "it writes DXF files") from error
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def dxf_drawing(drawn: Drawn) -> bytes:
    """The file of one position for CAD: a layer for each link, named points on one of their own."""
    import ezdxf
    from ezdxf.enums import TextEntityAlignment

    document = ezdxf.new("R2010", units=UNITS.get(drawn.unit.casefold(), 0))
    space = document.modelspace()
    for item in filter(there, drawn.scene.items):
        match item:
            case Stroke(name=name, points=points, color=color, circle=True):
                middle = points[:-1].mean(axis=0)
                radius = float(np.hypot(*(points[0] - middle)))
                space.add_circle(middle.tolist(), radius, dxfattribs={"layer": _layer(document, name, color)})
            case Stroke(name=name, points=points, color=color):
                layer = _layer(document, name or "PATHS", color)
                corners = points[np.isfinite(points).all(axis=1)]
                closed = (
                    item.kind == "cam"
                    and len(corners) > 2
                    and np.allclose(corners[0], corners[-1], atol=CLOSES * drawn.scene.window.half)
                )
                space.add_lwpolyline(
                    corners[: -1 if closed else None].tolist(), close=closed, dxfattribs={"layer": layer}
                )
            case Disc(x=x, y=y, radius=radius):
                space.add_circle((x, y), radius, dxfattribs={"layer": _layer(document, PINS, "404040")})
            case Label(x=x, y=y):
                layer = _layer(document, TEXTS, "404040")
                note = space.add_text(item.text, height=drawn.length(item.size) * 0.7, dxfattribs={"layer": layer})
                side = TextEntityAlignment.MIDDLE_CENTER if item.middle else TextEntityAlignment.MIDDLE_LEFT
                note.set_placement((x, y), align=side)
    for name, place in drawn.points.items():
        space.add_point(place, dxfattribs={"layer": _layer(document, f"{NAMED} {name}", "000000")})
    for kind in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(kind)  # ezdxf would take them from a set, in another order each time
    stream = io.StringIO(newline="\n")
    document.write(stream)
    return stream.getvalue().encode("utf-8", "surrogateescape")


def _layer(document: Drawing, name: str, color: str) -> str:
    """The layer of that name, made when it is new. Some characters cannot stand in its name."""
    plain = re.sub(r'[<>/\\":;?*|=`,]', "_", " ".join(name.split()))[:200] or "0"
    if plain not in document.layers:
        document.layers.add(plain, true_color=int(color, 16))
    return plain
