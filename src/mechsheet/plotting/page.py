"""One web page that needs nothing else: the drawing with a slider, and the curves with a marker at the position shown."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from html import escape
from importlib.resources import files
from string import Template

from livesheet.workbook import Cell, Chart, Fill, SeriesRef, Workbook
from mechsheet.plotting.figures import Figure, Move, drawing, figure
from mechsheet.plotting.scenes import Curves, Piece, Stage, comes_round
from mechsheet.words.catalogue import words


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
