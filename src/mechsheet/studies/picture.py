"""The picture of a study, as SVG: designs kept and their front over two objectives, the best as parallel coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

from livesheet.workbook import Axis
from mechsheet.plotting.axes import scale_of, tick_text
from mechsheet.studies.designs import APART
from mechsheet.studies.packages import arrow
from mechsheet.studies.parts import heads_of
from mechsheet.studies.ranking import Studied
from mechsheet.words.catalogue import words

Array = NDArray[np.float64]

WIDTH, HEIGHT = 900, 420
LEFT, RIGHT, TOP, BOTTOM = 80, 30, 50, 60
CLOUD = 4_000
"""Designs kept that are drawn, some of each part."""

INK, QUIET, KEPT, FRONT = "#1F2933", "#6B7280", "#B7C3D0", "#C8501E"


def picture_of(found: Studied) -> bytes:
    """The picture; without objectives, or with one, the parallel coordinates alone."""
    panels = []
    objectives = list(dict.fromkeys(each.text for each in found.designs.study.objectives))
    if len(objectives) > 1 and found.front is not None:
        panels.append(_scatter(found, objectives[:2]))
    if found.best is not None:
        panels.append(_parallel(found))
    height = HEIGHT * max(1, len(panels))
    body = "".join(f'<g transform="translate(0 {HEIGHT * at})">\n{panel}</g>\n' for at, panel in enumerate(panels))
    box = f'viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" font-size="12"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {box}>\n'
    return f'{head}<rect width="{WIDTH}" height="{height}" fill="white"/>\n{body}</svg>\n'.encode()


def _said(found: Studied, key: str) -> str:
    return words(found.designs.mechanism.language, f"study.{key}")


def _cloud(found: Studied, names: Sequence[str]) -> Array:
    """Some of the designs that are compared, the same number of each part; one part is held at a time."""
    paths = found.folder.parts(found.order)
    most = max(1, CLOUD // len(paths))
    points = []
    for path in paths[:: max(1, len(paths) // CLOUD)]:
        part = arrow().parquet.read_table(path, columns=list(names), filters=[(APART, "=", False)])
        points.append(_numbers(part[:: max(1, part.num_rows // most)], names))
    return np.concatenate(points)


def _numbers(table: Any, names: Sequence[str]) -> Array:
    columns = [np.asarray(table.column(name).to_numpy(zero_copy_only=False), float) for name in names]
    found = np.stack(columns, axis=1) if columns else np.zeros((0, 0))
    return np.asarray(found[np.isfinite(found).all(axis=1)])


def _scatter(found: Studied, names: Sequence[str]) -> str:
    cloud, front = _cloud(found, names), _numbers(found.front, names)
    every = np.concatenate([cloud, front])
    heads = dict(zip(found.front.column_names, heads_of(found.front), strict=True))
    spans = (LEFT, WIDTH - RIGHT), (HEIGHT - BOTTOM, TOP)
    across, up = (scale_of(Axis(heads[name]), [every[:, at]], *spans[at]) for at, name in enumerate(names))
    lines = [_title(_said(found, "front.title")), _legend(found)]
    for value, x in zip(across.ticks, across.place(np.array(across.ticks)), strict=True):
        words = _text(x, HEIGHT - BOTTOM + 18, tick_text(value), "middle")
        lines.append(_line(x, HEIGHT - BOTTOM, x, TOP, "#E5E7EB") + words)
    for value, y in zip(up.ticks, up.place(np.array(up.ticks)), strict=True):
        lines.append(_line(LEFT, y, WIDTH - RIGHT, y, "#E5E7EB") + _text(LEFT - 8, y + 4, tick_text(value), "end"))
    lines.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 18, heads[names[0]], "middle"))
    lines.append(_text(LEFT, TOP - 10, heads[names[1]], "start"))
    for points, radius, color in ((cloud, 1.6, KEPT), (front, 3.5, FRONT)):
        for x, y in zip(across.place(points[:, 0]), up.place(points[:, 1]), strict=True):
            lines.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{color}"/>')
    return "\n".join(lines) + "\n"


def _parallel(found: Studied) -> str:
    """Each axis from the least to the largest value of the best; designs on the front stand out."""
    names = list(dict.fromkeys([*found.designs.varied, *(each.text for each in found.designs.study.objectives)]))
    rows = [[row[name] for name in names] for row in found.best.to_pylist()]
    front = set(found.ranked.front.tolist())
    heads = dict(zip(found.best.column_names, heads_of(found.best), strict=True))
    values = np.array([[np.nan if value is None else value for value in row] for row in rows], float)
    lines = [_title(_said(found, "parallel")), _legend(found) if front else ""]
    step = (WIDTH - LEFT - RIGHT - 40) / max(1, len(names) - 1)
    bottom, places = HEIGHT - BOTTOM, []
    for at, name in enumerate(names):
        x = LEFT + step * at
        anchor = "start" if at == 0 else "end" if at == len(names) - 1 else "middle"  # a long name is not cut off
        known = values[:, at][np.isfinite(values[:, at])]
        low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 0.0)
        lines.append(_line(x, bottom, x, TOP + 20, QUIET) + _text(x, bottom + 34, heads[name], anchor))
        lines.append(_text(x, bottom + 16, f"{low:.4g}", "middle") + _text(x, TOP + 12, f"{high:.4g}", "middle"))
        share = (values[:, at] - low) / (high - low) if high > low else np.full(len(values), 0.5)
        places.append(bottom + (TOP + 20 - bottom) * np.nan_to_num(share, nan=0.5))
    for number, row in enumerate(found.best.column("design").to_pylist()):
        points = " ".join(f"{LEFT + step * at:.1f},{column[number]:.1f}" for at, column in enumerate(places))
        color = FRONT if row in front else KEPT
        lines.append(
            f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.2" stroke-opacity="0.8"/>'
        )
    return "\n".join(lines) + "\n"


def _title(words: str) -> str:
    return f'<text x="{LEFT}" y="22" font-size="15" font-weight="bold" fill="{INK}">{escape(words)}</text>'


def _legend(found: Studied) -> str:
    """What the two colours mean, at the right end above a panel."""
    lines, right = [], WIDTH - RIGHT
    for key, color in (("cloud", KEPT), ("on_front", FRONT)):
        words = _said(found, key)
        lines.append(_text(right, TOP - 10, words, "end"))
        right -= 6 * len(words) + 10
        lines.append(f'<circle cx="{right}" cy="{TOP - 14}" r="4" fill="{color}"/>')
        right -= 16
    return "".join(lines)


def _text(x: float, y: float, words: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{QUIET}">{escape(words)}</text>'


def _line(x1: float, y1: float, x2: float, y2: float, color: str) -> str:
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{color}"/>'
