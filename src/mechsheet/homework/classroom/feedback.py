"""A student's picture beside the right one, as SVG for a page: where links do not meet there is a ring."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from html import escape

from mechsheet.homework.drawn_by_numbers import Laid, Picture, Point
from mechsheet.shapes.colors import INK, LINKS, QUIET
from mechsheet.shapes.positions import in_digits
from mechsheet.units import behind_number
from mechsheet.words.catalogue import said
from mechsheet.words.symbols import plain

SIDE = 340
"""Pixels of a picture."""

AROUND = 0.12
"""What is free around what is drawn, of its size."""

MEET = 0.004
"""Ends that are nearer than this part of the size meet."""

WRONG = "C0202B"


def pictures(found: Picture, language: str) -> str:
    """HTML: both pictures side by side, and the numbers that differ most there."""
    driver = found.mechanism.driver
    unit = behind_number(driver.unit.text)
    at = f"{plain(driver.symbol)} = {in_digits(float(driver.unit.to_shown(found.at)), 5)}{unit}"
    pairs = "; ".join(
        said(
            language,
            "page.compare",
            symbol=plain(symbol),
            theirs=_shown(found, symbol, a),
            right=_shown(found, symbol, b),
        )
        for symbol, (a, b) in found.numbers.items()
    )
    drawn = [
        (said(language, "page.theirs"), _svg(found, found.theirs, found.marks)),
        (said(language, "page.right"), _svg(found, found.right, {})),
    ]
    figures = "".join(f"<figure>{svg}<figcaption>{escape(words)}</figcaption></figure>\n" for words, svg in drawn)
    head = said(language, "page.at", at=at)
    return f'<h2>{escape(head)}</h2>\n<div class="both">\n{figures}</div>\n<p>{escape(pairs)}</p>\n'


def _shown(found: Picture, symbol: str, number: float) -> str:
    mechanism = found.mechanism
    angle = symbol in {link.angle_symbol for link in mechanism.links} or any(
        output.symbol == symbol and output.unit.kind == "angle" for output in mechanism.outputs
    )
    if angle:
        unit = mechanism.angle_unit
        return f"{in_digits(float(unit.to_shown(number)), 5)}{behind_number(unit.text)}"
    return f"{in_digits(number, 5)} {mechanism.length_unit}"


def _svg(found: Picture, laid: Laid, marks: Mapping[str, Point]) -> str:
    """One picture; both have the same scale."""
    places = [place for each in (found.theirs, found.right) for link in each.values() for place in link.values()]
    places += list(found.marks.values())
    low, high = ([min_or_max(part) for part in zip(*places, strict=True)] for min_or_max in (min, max))
    size = max(high[0] - low[0], high[1] - low[1]) or 1.0
    middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    scale = SIDE / (size * (1 + 2 * AROUND))

    def at(place: Point) -> str:
        return f"{SIDE / 2 + (place[0] - middle[0]) * scale:.1f},{SIDE / 2 - (place[1] - middle[1]) * scale:.1f}"

    lines = []
    ground, *moving = found.mechanism.links
    for point in ground.points:
        x, y = at(laid[ground.name][point]).split(",")
        lines.append(f'<path transform="translate({x},{y})" d="M0,0L-8,13H8ZM-12,13H12" fill="#fff" stroke="#{INK}"/>')
    for number, link in enumerate(moving):
        corners = [at(place) for place in laid[link.name].values()]
        closed = "Z" if len(corners) > 2 else ""
        color = LINKS[number % len(LINKS)]
        if len(corners) > 1:
            path = f'd="M{"L".join(corners)}{closed}" stroke="#{color}" stroke-width="5" stroke-linejoin="round"'
            lines.append(f'<path {path} stroke-linecap="round" fill="none"/>')
        else:
            x, y = corners[0].split(",")
            lines.append(
                f'<rect x="{float(x) - 11:.1f}" y="{float(y) - 7:.1f}" width="22" height="14" fill="#{color}"/>'
            )
    lines += _pins(laid, at, MEET * size)
    for point, place in marks.items():
        x, y = at(place).split(",")
        cross = f'<path transform="translate({x},{y})" d="M-6,-6L6,6M-6,6L6,-6" stroke="#{WRONG}" stroke-width="2"/>'
        lines.append(f"{cross}{_text(point, x, y)}")
    return (
        f'<svg width="{SIDE}" height="{SIDE}" viewBox="0 0 {SIDE} {SIDE}" role="img">\n' + "\n".join(lines) + "\n</svg>"
    )


def _pins(laid: Laid, at: Callable[[Point], str], near: float) -> list[str]:
    """Every point; one that links have in different places is a ring at each."""
    lines = []
    for point in dict.fromkeys(point for places in laid.values() for point in places):
        spots = [places[point] for places in laid.values() if point in places]
        torn = any(math.dist(spot, spots[0]) > near for spot in spots)
        for number, spot in enumerate(spots if torn else spots[:1]):
            x, y = at(spot).split(",")
            color, radius = (WRONG, 7) if torn else (INK, 4)
            fill = "none" if torn else "#fff"
            lines.append(f'<circle cx="{x}" cy="{y}" r="{radius}" fill="{fill}" stroke="#{color}" stroke-width="2"/>')
            if not number:
                lines.append(_text(point, x, y))
        if torn:
            way = "L".join(map(at, spots))
            lines.append(f'<path d="M{way}" stroke="#{QUIET}" stroke-dasharray="4 4" fill="none"/>')
    return lines


def _text(point: str, x: str, y: str) -> str:
    place = f'x="{float(x) + 8:.1f}" y="{float(y) - 8:.1f}"'
    return f'<text {place} font-size="14" font-style="italic" fill="#{INK}">{escape(plain(point))}</text>'
