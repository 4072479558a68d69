"""svg: the mechanism at a position, its coordinates those of the mechanism (in its length unit, y upwards)."""

from __future__ import annotations

from html import escape

from mechsheet.exporting.job import Job
from mechsheet.exporting.shapes import Disc, Drawn, Label, Stroke, drawings

POINTS_HIGH = 360.0
"""Points of a printer that the window is high: so wide are lines of the workbook's drawing."""

ANCHORS = {"center": ("middle", 0.35), "right": ("start", 0.35), "left": ("end", 0.35), "above": ("middle", 0.0),
           "below": ("middle", 0.7)}  # fmt: skip
"""Side of a label -> its alignment, and how far its base line lies under the place, as a part of its height."""


def write(job: Job) -> list[bytes]:
    """One file for each position, in UTF-8."""
    return [picture(drawn) for drawn in drawings(job)]


def _number(value: float) -> str:
    """Twelve digits: more than any drawing needs, and the same on every machine."""
    return f"{value:.12g}" if abs(value) > 1e-300 else "0"


def picture(drawn: Drawn) -> bytes:
    """The file of one position."""
    (x, y), half = drawn.middle, drawn.half
    box = " ".join(_number(part) for part in (x - half, -y - half, 2 * half, 2 * half))
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" width="480" height="480" viewBox="{box}">',
        f"<title>{escape(drawn.title)}</title>",
        f"<desc>1 = 1 {escape(drawn.unit)}; y points upwards</desc>",
        '<g transform="scale(1,-1)" fill="none" stroke-linejoin="round" stroke-linecap="round">',
    ]
    lines += [_shape(shape, drawn) for shape in drawn.shapes if not isinstance(shape, Label)]
    lines += ["</g>", '<g font-family="sans-serif" fill="#404040">']
    lines += [_label(shape) for shape in drawn.shapes if isinstance(shape, Label)]
    lines += ["</g>", '<g id="points" transform="scale(1,-1)" fill="none">']
    lines += [
        f'<circle id="{escape(name)}" cx="{_number(a)}" cy="{_number(b)}" r="0"/>'
        for name, (a, b) in drawn.points.items()
    ]
    return "\n".join([*lines, "</g>", "</svg>", ""]).encode()


def _shape(shape: Stroke | Disc, drawn: Drawn) -> str:
    if isinstance(shape, Stroke):
        places = " ".join(f"{_number(x)},{_number(y)}" for x, y in shape.points.tolist())
        width = _number(shape.width * 2 * drawn.half / POINTS_HIGH)
        title = f"<title>{escape(shape.name)}</title>"
        return f'<polyline stroke="#{shape.color}" stroke-width="{width}" points="{places}">{title}</polyline>'
    fill = f' fill="#{shape.fill}"' if shape.fill else ""
    line = f' stroke="#{shape.line}" stroke-width="{_number(shape.radius / 6)}"' if shape.line else ""
    return f'<circle cx="{_number(shape.x)}" cy="{_number(shape.y)}" r="{_number(shape.radius)}"{fill}{line}/>'


def _label(label: Label) -> str:
    anchor, down = ANCHORS[label.side]
    place = f'x="{_number(label.x)}" y="{_number(-label.y + down * label.height)}"'
    size = _number(label.height)
    return f'<text {place} font-size="{size}" text-anchor="{anchor}">{escape(label.text)}</text>'
