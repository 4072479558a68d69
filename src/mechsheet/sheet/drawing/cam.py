"""A cam in the drawing's cells: its profile, pitch curve and base circle, which turn with it, and what touches it."""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import CellRef, Node, RangeRef
from mechsheet.model import Cam
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import CHART_X, CHART_Y, FIRST, INK, NAME, SECOND, Frame, Page
from mechsheet.sheet.drawing.points import PointCells
from mechsheet.sheet.drawing.shapes import PAD, filled, link_color, local_path, series_of
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.symbols import plain
from mechsheet.sheet.workbook import Area, Series, SeriesRef
from mechsheet.words.equations import link_words

PALE = "A0A8B0"
CORNERS = 72
"""Of a circle."""


class CamDrawing:
    """The cam of one drawing."""

    def __init__(self, page: Page) -> None:
        plan = page.plan
        self.page, self.cam = page, plan.mechanism.cam
        self.reach: list[CellRef] = []
        if self.cam is None:
            return
        link = next(link for link in plan.mechanism.links if link.name == self.cam.link)
        self.color = link_color(link, self.cam.link)
        self.name = link_words(link).of(plan.language)
        page.section(self.name, ["cos", "sin", plan.text("drawing.radius")])
        angle = page.at_position(link.angle_symbol)
        page.put(NAME, self.name, styles.LABEL)
        self.cosine = page.formula(FIRST, formula("COS(angle)", angle=angle))
        self.sine = page.formula(SECOND, formula("SIN(angle)", angle=angle))
        far = page.column(f"{self.name} r", formula("SQRT(SUMSQ(x,y))", x=page.read("cam.x"), y=page.read("cam.y")))
        self.reach.append(page.formula(SECOND + 1, formula("MAX(far)", far=_range(far))))
        page.row += 1

    def around(self, point: str) -> list[CellRef]:
        """How far the cam reaches from the point about which it turns."""
        return self.reach if self.cam is not None and point == self.cam.center else []

    def series(self, frame: Frame, cells: Mapping[str, PointCells]) -> list[Series]:
        """From back to front."""
        cam = self.cam
        if cam is None:
            return []
        text, center = self.page.plan.text, cells[cam.center]
        found = [self._circle(text("drawing.cam.base"), frame, center, al.as_node(cam.base_radius), PALE, 0.75)]
        if cam.radius is not None:
            found.append(self._curve(text("drawing.cam.pitch"), "pitch", frame, center, PALE, 0.75))
        found.append(self._curve(self.name, "cam", frame, center, self.color, 2.5))
        if cam.radius is None:
            return [*found, self._face(cam, frame, cells[cam.point])]
        radius = al.as_node(cam.radius)
        if not al.is_zero(radius):
            found.append(self._circle(text("drawing.cam.roller"), frame, cells[cam.point], radius, INK, 1.25))
        return found

    def _curve(self, name: str, curve: str, frame: Frame, center: PointCells, color: str, width: float) -> Series:
        """A curve in the axes of the cam, as the cam stands."""
        page = self.page
        place = {"a": page.read(f"{curve}.x"), "b": page.read(f"{curve}.y"), "c": self.cosine, "s": self.sine}
        x = page.column(f"X {plain(name)}", frame.chart_x(formula("x+a*c-b*s", x=center.x, **place)))
        y = page.column(f"Y {plain(name)}", frame.chart_y(formula("y+a*s+b*c", y=center.y, **place)))
        return Series(name, SeriesRef(page.title, x), SeriesRef(page.title, y), line=color, width=width)

    def _circle(self, name: str, frame: Frame, center: PointCells, radius: Node, color: str, width: float) -> Series:
        page, start = self.page, self.page.row
        local_path(page, name, [(360.0 * corner / CORNERS, 1.0) for corner in range(CORNERS + 1)])
        out = al.div(page.plan.at.bind(radius, page.title), frame.half)
        turn = CellRef(start, FIRST, col_abs=True)
        x = formula("x+out*COS(RADIANS(turn))", x=center.chart_x, out=out, turn=turn)
        y = formula("y+out*SIN(RADIANS(turn))", y=center.chart_y, out=out, turn=turn)
        filled(page, start, x, y)
        return series_of(page, name, start, color, width)

    def _face(self, cam: Cam, frame: Frame, at: PointCells) -> Series:
        """As long as it is touched and a little more."""
        page, plan = self.page, self.page.plan
        name = plan.text("drawing.cam.face")
        link = next(link for link in plan.mechanism.links if link.name == cam.follower)
        page.section(name, [plan.text("drawing.from"), plan.text("drawing.to")])
        ends = page.extremes(plain("contact"), ["contact"])
        angle = al.add(page.at_position(link.angle_symbol), plan.at.bind(al.as_node(cam.face), page.title))
        start = page.row
        for end, pad in zip(ends, (-PAD, PAD), strict=True):
            far = al.add(al.div(end, frame.half), al.number(pad))
            page.put(NAME, name if page.row == start else "")
            page.formula(CHART_X, formula("x+far*COS(angle)", x=at.chart_x, far=far, angle=angle))
            page.formula(CHART_Y, formula("y+far*SIN(angle)", y=at.chart_y, far=far, angle=angle))
            page.row += 1
        return series_of(page, name, start, link_color(link, cam.link), 2.5)


def _range(area: Area) -> RangeRef:
    first = CellRef(area.first_row, area.first_col, True, True)
    return RangeRef(first, CellRef(area.last_row, area.last_col, True, True))
