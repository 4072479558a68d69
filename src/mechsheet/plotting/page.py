"""One web page that needs nothing else: the drawing with a slider, and the curves with a marker at the position shown.

Places are pixels; `Move` holds them in hundredths, as whole numbers, since there are many.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from string import Template

import numpy as np

from livesheet.workbook import Axis, Cell, Chart, Fill, Series, SeriesRef, Workbook
from mechsheet.plotting.axes import Scale, scale_of, tick_text
from mechsheet.plotting.scenes import Curves, Piece, Points, Stage, comes_round
from mechsheet.shapes.positions import RING, Disc, Item, Label, Scene, Stroke, Window, layers_of, places_of
from mechsheet.words.catalogue import words

SIZE = 480
"""Pixels of the drawing: square."""

PIXELS = 4 / 3
"""Pixels of a point."""

FINE = 100
ROOM = 24.0
"""Pixels around a path."""

BESIDE = 5.0
"""Pixels between a marker and its label."""

SIDES = {"center": (0, 0), "right": (1, 0), "left": (-1, 0), "above": (0, -1), "below": (0, 1)}

CURVE_INNER = (58, 10, 14, 42)
"""Left, top, right and below the curves, in pixels, for numbers and titles."""

Numbers = list[int | None]
"""x, y, x, y … in hundredths of a pixel; None where there is nothing."""


@dataclass(frozen=True, slots=True)
class Move:
    """An element that changes: its id, and for each position its places, or its words.

    kind  "path": the corners of a line; "dots": the middles of the circles in a group; "label": the place of a text;
          "words": the content of a text
    """

    id: str
    kind: str
    frames: list[Numbers] | list[str]


@dataclass(frozen=True, slots=True)
class Figure:
    """The markup of a chart at one position, and what moves."""

    markup: str
    moves: list[Move]


def figure(chart: Chart, scenes: Sequence[Curves], shown: int, name: str, cut: bool = False) -> Figure:
    """A chart drawn at `scenes[shown]`; `name` begins the ids of its elements.

    cut  leave out what is empty over and under everything that is ever drawn
    """
    width, height = chart.anchor.width, chart.anchor.height
    axes = _axes(chart, scenes, width, height)
    parts = [_grid(chart, axes)] if chart.x_axis.visible else []
    moves: list[Move] = []
    tops, bottoms = [], []
    for index, piece in enumerate(scenes[shown]):
        for kind in _kinds(piece.series):
            places = [_placed(scene[index], axes, kind) for scene in scenes]
            key = f"{name}-{index}-{kind}"
            parts.append(_markup(piece, kind, key, places[shown]))
            moves += _moves(key, kind, places, [scene[index].words for scene in scenes] if kind == "label" else [])
            heights = [y for place in places for y in place[1::2] if y is not None]
            tops.append(min(heights, default=height * FINE) / FINE)
            bottoms.append(max(heights, default=0) / FINE)
    top, bottom = (max(min(tops) - ROOM, 0), min(max(bottoms) + ROOM, height)) if cut else (0, height)
    box = f"0 {top:g} {width} {bottom - top:g}"
    label = escape(chart.alt_text or chart.title)
    markup = f'<svg viewBox="{box}" role="img" aria-label="{label}">\n' + "\n".join(parts) + "\n</svg>"
    return Figure(markup, moves)


def drawing(scenes: Sequence[Scene], shown: int, title: str) -> Figure:
    """The mechanism at `scenes[shown]`; the ids of its elements begin with m."""
    parts: list[str] = []
    moves: list[Move] = []
    layers = [[each for item in scene.items for each in layers_of(item)] for scene in scenes]
    for index, item in enumerate(layers[shown]):
        items = [each[index] for each in layers]
        places = [_hundredths(_in_pixels(places_of(each), scenes[0].window)) for each in items]
        key = f"m-{index}"
        parts.append(_element(item, key, places[shown], scenes[0].window))
        kind = "path" if isinstance(item, Stroke) else "dots" if isinstance(item, Disc) else "label"
        moves += _moves(key, kind, places, [each.text for each in items if isinstance(each, Label)])
    box = f'viewBox="0 0 {SIZE} {SIZE}" role="img" aria-label="{escape(title)}"'
    return Figure(f"<svg {box}>\n" + "\n".join(parts) + "\n</svg>", moves)


def _moves(key: str, kind: str, places: list[Numbers], words: list[str]) -> Iterator[Move]:
    """What of an element is not the same in all positions: where it is, what it says."""
    if any(place != places[0] for place in places):
        yield Move(key, kind, places)
    if any(word != words[0] for word in words):
        yield Move(key, "words", words)


def _in_pixels(points: Points, window: Window) -> Points:
    scale = SIZE / 2 / window.half
    return (points - (window.x, window.y)) * (scale, -scale) + SIZE / 2


def _element(item: Item, key: str, places: Numbers, window: Window) -> str:
    match item:
        case Stroke(kind=kind, name=name, color=color, width=width, fill=fill):
            style = f'stroke="#{color}" stroke-width="{width * PIXELS:.4g}"' + (
                f' style="fill:#{fill}"' if fill else ""
            )
            title = f"<title>{escape(name)}</title>" if name else ""
            return f'<path id="{key}" class="line {kind}" {style} d="{path_data(places)}">{title}</path>'
        case Disc(kind=kind, fill=fill, line=line, radius=radius):
            where = _where("cx", "cy", places[0], places[1])
            size = f'r="{radius * SIZE / 2 / window.half:.4g}" stroke-width="{RING * PIXELS:g}"'
            return f'<g id="{key}" class="{kind}" fill="#{fill}" stroke="#{line}"><circle {size} {where}/></g>'
        case Label(kind=kind, text=text, size=size, middle=middle):
            style = f'class="{"center" if middle else "right"} {kind}" font-size="{size * PIXELS:.4g}"'
            return f'<text id="{key}" {style} {_where("x", "y", places[0], places[1])}>{escape(text)}</text>'


def _axes(chart: Chart, scenes: Sequence[Curves], width: int, height: int) -> tuple[Scale, Scale]:
    if chart.inner:
        x, y, wide, high = chart.inner
        left, right, top, bottom = x * width, (x + wide) * width, y * height, (y + high) * height
    else:
        left, top, right, bottom = CURVE_INNER[0], CURVE_INNER[1], width - CURVE_INNER[2], height - CURVE_INNER[3]
    curves = [piece.points for piece in scenes[0] if piece.series.line]
    return (
        scale_of(chart.x_axis, (points[:, 0] for points in curves), left, right),
        scale_of(chart.y_axis, (points[:, 1] for points in curves), bottom, top),
    )


def _placed(piece: Piece, axes: tuple[Scale, Scale], kind: str) -> Numbers:
    pixels = np.column_stack([axis.place(column) for axis, column in zip(axes, piece.points.T, strict=True)])
    if kind == "label" and piece.series.marker:
        pixels += np.array(SIDES[piece.series.label_side]) * (piece.series.marker_size * PIXELS / 2 + BESIDE)
    return _hundredths(pixels)


def _hundredths(pixels: Points) -> Numbers:
    return [None if math.isnan(value) else round(value * FINE) for value in pixels.ravel().tolist()]


# --- elements ----------------------------------------------------------------------------------------------------


def _kinds(series: Series) -> list[str]:
    """The elements that a series consists of, from back to front."""
    wanted = {"path": series.line, "dots": series.marker, "label": series.show_name}
    return [kind for kind, there in wanted.items() if there]


def _markup(piece: Piece, kind: str, key: str, places: Numbers) -> str:
    series = piece.series
    if kind == "path":
        style = f'stroke="#{series.line}" stroke-width="{series.width * PIXELS:.4g}"'
        return f'<path id="{key}" class="line" {style} d="{path_data(places)}"/>'
    if kind == "dots":
        return f'<g id="{key}" {_paint(series)}>{"".join(_circle(series, *place) for place in _pairs(places))}</g>'
    size = f'font-size="{series.label_size * PIXELS:.4g}"'
    where = _where("x", "y", places[0], places[1])
    return f'<text id="{key}" class="{series.label_side}" {size} {where}>{escape(piece.words)}</text>'


def _where(across: str, down: str, x: int | None, y: int | None) -> str:
    return 'visibility="hidden"' if x is None or y is None else f'{across}="{x / FINE:g}" {down}="{y / FINE:g}"'


def path_data(places: Numbers) -> str:
    """M x y L x y …; nothing is drawn across a gap. The page's script does the same."""
    data, pen = [], "M"
    for x, y in _pairs(places):
        if x is None or y is None:
            pen = "M"
        else:
            data.append(f"{pen}{x / FINE:g} {y / FINE:g}")
            pen = "L"
    return "".join(data)


def _circle(series: Series, x: int | None, y: int | None) -> str:
    return f'<circle r="{series.marker_size * PIXELS / 2:.4g}" {_where("cx", "cy", x, y)}/>'


def _paint(series: Series) -> str:
    fill = f"#{series.marker_fill}" if series.marker_fill else "none"
    if series.marker_line in ("", series.marker_fill):
        return f'fill="{fill}"'
    return f'fill="{fill}" stroke="#{series.marker_line}"'


def _pairs(places: Numbers) -> Iterator[tuple[int | None, int | None]]:
    return zip(places[::2], places[1::2], strict=True)


# --- axes --------------------------------------------------------------------------------------------------------


def _grid(chart: Chart, axes: tuple[Scale, Scale]) -> str:
    x, y = axes
    parts = ['<g class="grid">']
    for value, at in zip(x.ticks, x.place(np.array(x.ticks)), strict=True):
        parts.append(f'<path d="M{at:.2f} {y.start:g}V{y.end:g}"/>')
        parts.append(f'<text x="{at:.2f}" y="{y.start + 15:g}" class="center">{tick_text(value)}</text>')
    for value, at in zip(y.ticks, y.place(np.array(y.ticks)), strict=True):
        parts.append(f'<path d="M{x.start:g} {at:.2f}H{x.end:g}"/>')
        parts.append(f'<text x="{x.start - 6:g}" y="{at:.2f}" class="left">{tick_text(value)}</text>')
    parts.append(_titles(chart.x_axis, chart.y_axis, axes) + "</g>")
    return "\n".join(parts)


def _titles(x_axis: Axis, y_axis: Axis, axes: tuple[Scale, Scale]) -> str:
    x, y = axes
    middle = (y.start + y.end) / 2
    return (
        f'<text x="{(x.start + x.end) / 2:g}" y="{y.start + 33:g}" class="center">{escape(x_axis.title)}</text>'
        f'<text x="12" y="{middle:g}" class="center" transform="rotate(-90 12 {middle:g})">{escape(y_axis.title)}</text>'
    )


# --- the page -------------------------------------------------------------------------------------------------------------


def page(stage: Stage) -> bytes:
    """The page, UTF-8. Every position of the sweep stands in it: the script only shows them."""
    sample = stage.sample
    mechanism, language = sample.plan.mechanism, sample.plan.language
    rows = range(sample.sweep)
    scenes = [stage.drawing(row) for row in rows]
    picture = drawing(scenes, sample.shown, sample.layout.sheets[0].charts[0].alt_text)
    curves = [stage.at(row, stage.charts) for row in rows]
    by_chart: list[list[Curves]] = [[found[index] for found in curves] for index in range(len(stage.charts))]
    figures = [
        _curve(chart, found, sample.shown, f"c{index}", sample.layout)
        for index, (chart, found) in enumerate(zip(stage.charts, by_chart, strict=True), 1)
    ]
    driver = [mechanism.driver.unit.to_shown(sample.plan.driver[row]) for row in rows]
    captions = [scene.caption for scene in scenes]
    data = {
        "driver": [round(value, 9) for value in driver],
        "captions": captions,
        "round": all(sample.exists[: sample.sweep]) and comes_round(scenes[0], scenes[-1]),
        "play": words(language, "picture.play"),
        "pause": words(language, "picture.pause"),
        "moves": [[move.id, move.kind, move.frames] for made in (picture, *figures) for move in made.moves],
    }
    source = mechanism.source.of(language)
    text = Template(_part("page.html")).substitute(
        language=language,
        title=escape(mechanism.title.of(language)),
        source=f"<p>{words(language, 'picture.source')}: {escape(source)}</p>" if source else "",
        style=_part("page.css"),
        script=_part("page.js"),
        picture=picture.markup,
        charts="\n".join(made.markup for made in figures),
        data=_json(data),
        last=len(captions) - 1,
        shown=sample.shown,
        caption=escape(captions[sample.shown]),
        play=words(language, "picture.play"),
        position=words(language, "picture.position"),
        drawing=words(language, "picture.drawing"),
        curves=words(language, "picture.curves"),
        help=words(language, "picture.help"),
        no_script=words(language, "picture.no_script"),
    )
    return text.encode()


def _part(name: str) -> str:
    return files("mechsheet.plotting").joinpath(name).read_text(encoding="utf-8")


def _json(data: object) -> str:
    """JSON that cannot end the script element it stands in."""
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")


def _curve(chart: Chart, scenes: Sequence[Curves], shown: int, name: str, workbook: Workbook) -> Figure:
    """A chart with its title over it, and the value of each curve at the position shown."""
    made = figure(chart, scenes, shown, name, cut=not chart.x_axis.visible)
    items, moves = [], list(made.moves)
    if chart.x_axis.visible:
        for index, piece in enumerate(scenes[shown]):
            if piece.series.marker:
                digits = _decimals(workbook, _curve_of(scenes[shown], piece))
                values = [_value(scene[index], digits) for scene in scenes]
                key = f"{name}-{index}-value"
                color = f'style="--color: #{piece.series.marker_fill}"'
                items.append(f'<li {color}>{escape(piece.words)} = <span id="{key}">{values[shown]}</span></li>')
                moves.append(Move(key, "words", values))
    listed = f'<ul class="values">{"".join(items)}</ul>\n' if items else ""
    return Figure(f"<figure>\n<h2>{escape(chart.title)}</h2>\n{listed}{made.markup}\n</figure>", moves)


def _value(piece: Piece, digits: int) -> str:
    value = float(piece.points[0, 1])
    return "–" if math.isnan(value) else f"{value:.{digits}f}".replace("-", "−")


def _curve_of(scene: Curves, marker: Piece) -> SeriesRef:
    """The column of the curve that a marker runs on."""
    return next(p.series.y for p in scene if p.series.line == marker.series.marker_fill and p.words == marker.words)


def _decimals(workbook: Workbook, column: SeriesRef) -> int:
    """As many decimals as the workbook shows in that column (the driver's may hold constants, the others formulas)."""
    sheet = workbook.sheet(column.sheet)
    place = column.area.first_row, column.area.first_col
    entries: list[Fill | Cell] = [*sheet.fills, *sheet.cells]
    first = next(entry for entry in entries if (entry.row, entry.col) == place)
    return len(first.style.number_format.partition(".")[2])
