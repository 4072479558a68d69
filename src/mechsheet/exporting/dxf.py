"""dxf: the mechanism at a position for CAD, in its own length unit; a layer for each link, named points on one of their own.

Written by ezdxf, which is an extra of this package. The same position gives the same bytes.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from mechsheet.exporting.job import Job
from mechsheet.exporting.shapes import Drawn, drawings
from mechsheet.extras import missing_package
from mechsheet.shapes.positions import Disc, Label, Stroke, there

if TYPE_CHECKING:
    from ezdxf.document import Drawing

UNITS = {"in": 1, "inch": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6, "km": 7, "yd": 10, "um": 13, "µm": 13, "dm": 14}
"""Length units that DXF has a number for ($INSUNITS); 0 says nothing."""

CLOSES = 1e-9
"""Ends of a cam's curve that are nearer than this part of half the window are one place."""

POINTS, TEXTS, PINS = "POINTS", "TEXT", "PINS"


def write(job: Job) -> list[bytes]:
    """One file for each position. Raises MissingProgramError without ezdxf."""
    with _ezdxf():  # before anything is computed: without it there is no use in that
        return [drawing(drawn) for drawn in drawings(job)]


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


def drawing(drawn: Drawn) -> bytes:
    """The file of one position. Raises MissingProgramError without ezdxf."""
    with _ezdxf():
        return _file(drawn)


def _file(drawn: Drawn) -> bytes:
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
        space.add_point(place, dxfattribs={"layer": _layer(document, f"{POINTS} {name}", "000000")})
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
