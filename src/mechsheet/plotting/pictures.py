"""Scenes drawn by matplotlib: a picture (SVG, PNG) and an animation (GIF). The same scene gives the same bytes.

A picture is 360 points square, as large as the drawing on the workbook's first sheet.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from livesheet.said import say
from mechsheet.extras import missing_package
from mechsheet.shapes.positions import RING, Disc, Item, Label, Scene, Stroke, painted

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from PIL.Image import Image

Codes = NDArray[np.int32]

SIDE = 5.0
"""Inches."""

PNG_DPI, GIF_DPI = 192, 80

FRAME_MILLISECONDS = 60
"""A multiple of 10: what a GIF can say."""

COLORS, APART = 64, 24
"""Colours of an animation: the lines' own and the steps between them and the paper; how far they are apart at least."""


@contextmanager
def settings() -> Iterator[None]:
    """Matplotlib's own defaults, whatever the user's are, and nothing random in the file."""
    try:
        import matplotlib as mpl
    except ImportError as error:
        raise missing_package("matplotlib", "plot", say("it draws the pictures")) from error
    # `rcdefaults` does so, too, but reads all of matplotlib's style sheets first.
    defaults: dict[Any, Any] = {name: value for name, value in mpl.rcParamsDefault.items() if name != "backend"}
    ours = {"svg.hashsalt": "mechsheet", "pdf.fonttype": 42, "font.family": "DejaVu Sans", "path.simplify": False}
    with mpl.rc_context(defaults | ours):
        yield


def svg(scene: Scene, title: str) -> bytes:
    """A picture as SVG; letters are outlines, so it looks the same everywhere. Raises MissingProgramError.

    What belongs to an item is in a group whose class is its kind.
    """
    made = _saved(scene, "svg", {"Title": title, "Date": None, "Creator": None})
    return re.sub(rb'<g id="([a-z]+)-(\d+)">', rb'<g id="\1-\2" class="\1">', made)


def png(scene: Scene, title: str) -> bytes:
    """A picture of 960 x 960 pixels as PNG. Raises MissingProgramError."""
    return _saved(scene, "png", {"Title": title, "Software": None}, dpi=PNG_DPI)


def gif(scenes: Sequence[Scene], title: str) -> bytes:
    """An animation of 400 x 400 pixels that starts again at its end. Raises MissingProgramError."""
    with settings():
        frames = few_colors([_pixels(scene) for scene in scenes])
    file = io.BytesIO()
    frames[0].save(
        file,
        "GIF",
        save_all=True,
        append_images=frames[1:],
        duration=FRAME_MILLISECONDS,
        loop=0,
        comment=title.encode(),
    )
    return file.getvalue()


def _saved(scene: Scene, kind: str, metadata: dict[str, Any], dpi: float = 72) -> bytes:
    file = io.BytesIO()
    with settings():
        _figure(scene).savefig(file, format=kind, metadata=metadata, dpi=dpi)
    return file.getvalue()


def _figure(scene: Scene) -> Figure:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(SIDE, SIDE))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    draw(axes, scene)
    return figure


def draw(axes: Any, scene: Scene, scale: float = 1.0) -> None:
    """A position in axes that are a square; `scale`: how large it is, as a part of 360 points.

    Letters become no larger than they are there.
    """
    window = scene.window
    axes.set_axis_off()
    axes.set_xlim(window.x - window.half, window.x + window.half)
    axes.set_ylim(window.y - window.half, window.y + window.half)
    axes.set_aspect("equal")
    for order, item in enumerate(painted(scene.items)):
        for artist in _artists(axes, item, scale):
            artist.set(gid=f"{item.kind}-{order}", zorder=order)


def _artists(axes: Any, item: Item, scale: float) -> list[Any]:
    from matplotlib.patches import Circle, Polygon

    match item:
        case Stroke(points=points, fill=fill) if fill:
            closed = bool(np.array_equal(points[0], points[-1]))
            return [axes.add_patch(Polygon(
                points, closed=closed, facecolor=f"#{fill}", edgecolor=f"#{item.color}", linewidth=item.width * scale,
                joinstyle="round", capstyle="round",
            ))]  # fmt: skip
        case Stroke(points=points):
            x, y = points.T
            style = {"solid_joinstyle": "round", "solid_capstyle": "round"}
            return list(axes.plot(x, y, color=f"#{item.color}", linewidth=item.width * scale, **style))
        case Disc(x=x, y=y):
            return [axes.add_patch(Circle(
                (x, y), item.radius, facecolor=f"#{item.fill}", edgecolor=f"#{item.line}", linewidth=RING * scale
            ))]  # fmt: skip
        case Label(x=x, y=y):
            side = "center" if item.middle else "left"
            return [axes.text(x, y, item.text, fontsize=item.size * min(scale, 1.0), ha=side, va="center")]


def _pixels(scene: Scene) -> Codes:
    """The picture as one number a pixel: red * 65536 + green * 256 + blue."""
    file = io.BytesIO()
    _figure(scene).savefig(file, format="rgba", dpi=GIF_DPI)
    side = round(SIDE * GIF_DPI)
    channels = np.frombuffer(file.getvalue(), np.uint8).reshape(side, side, 4).astype(np.int32)
    return channels[..., 0] << 16 | channels[..., 1] << 8 | channels[..., 2]


def few_colors(frames: Sequence[Codes], most: int = COLORS, apart: int = APART) -> list[Image]:
    """All frames in one palette: then a frame of the file holds only what has changed since the one before.

    The palette takes the most frequent colours that are not too much alike; every other becomes the nearest of these.
    """
    from PIL import Image

    found, counts = np.unique(np.concatenate([frame.ravel() for frame in frames]), return_counts=True)
    colors = np.column_stack([found >> 16, found >> 8 & 255, found & 255])
    chosen: list[int] = []
    for index in np.argsort(-counts, kind="stable"):
        if len(chosen) < most and all(np.abs(colors[index] - colors[other]).max() >= apart for other in chosen):
            chosen.append(int(index))
    distances = np.stack([((colors - colors[index]) ** 2).sum(axis=1) for index in chosen])
    nearest = distances.argmin(axis=0).astype(np.uint8)
    palette = colors[chosen].ravel().tolist()
    images = []
    for frame in frames:
        image = Image.frombytes("P", (frame.shape[1], frame.shape[0]), nearest[np.searchsorted(found, frame)].tobytes())
        image.putpalette(palette)
        images.append(image)
    return images
