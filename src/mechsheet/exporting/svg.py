"""svg: the mechanism at a position, its coordinates those of the mechanism (in its length unit, y upwards)."""

from __future__ import annotations

from html import escape

import numpy as np

from mechsheet.exporting.job import Job
from mechsheet.exporting.shapes import Drawn, drawings
from mechsheet.shapes.positions import RING, Disc, Label, Stroke, painted, there

BASE = 0.35
"""How far the base line of letters lies under their middle, as a part of their height."""


def write(job: Job) -> list[bytes]:
    """One file for each position, in UTF-8."""
    return [picture(drawn) for drawn in drawings(job)]


def _number(value: float) -> str:
    """Twelve digits: more than any drawing needs, and the same on every machine."""
    return f"{value:.12g}" if abs(value) > 1e-300 else "0"


def picture(drawn: Drawn) -> bytes:
    """The file of one position. The class of an element is its kind."""
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
    lines += [_shape(each, drawn) for each in painted(items) if not isinstance(each, Label)]
    lines += ["</g>", '<g font-family="sans-serif" fill="#404040">']
    lines += [_label(item, drawn) for item in items if isinstance(item, Label) and there(item)]
    lines += ["</g>", '<g id="points" transform="scale(1,-1)" fill="none">']
    lines += [
        f'<circle id="{escape(name)}" cx="{_number(a)}" cy="{_number(b)}" r="0"/>'
        for name, (a, b) in drawn.points.items()
    ]
    return "\n".join([*lines, "</g>", "</svg>", ""]).encode()


def _shape(item: Stroke | Disc, drawn: Drawn) -> str:
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


def _label(label: Label, drawn: Drawn) -> str:
    height = drawn.length(label.size)
    place = f'x="{_number(label.x)}" y="{_number(-label.y + BASE * height)}"'
    style = f'class="{label.kind}" font-size="{_number(height)}" text-anchor="{"middle" if label.middle else "start"}"'
    return f"<text {style} {place}>{escape(label.text)}</text>"
