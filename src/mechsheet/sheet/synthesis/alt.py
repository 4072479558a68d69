"""Alt's chart of crank-rockers: the best least transmission angle over the rocker's swing and the crank's turn meanwhile.

Two tables of one formula each, filled both ways, over psi across and phi down, in degrees: the best mu_min, and the lam that
has it. The last column and the last row are the task's own psi and phi, so that their corner is what is best for the task.
With L = lam^2, t = tan(phi/2), delta = phi - psi the best L is t^2/Q, Q = 2 s cosine - 2/3 the positive root of the cubic
that `mechsheet.synthesis.dead_centres` has,

    s^2 = t^2/3 + 4/9,   w = (t^2 (1 + t^2)/(2 tan(delta/2)^2) - 8/27 - t^2/3)/s^3,   cosine = cos(acos(w)/3)

or, for w > 1, with the cube roots of w +- sqrt(w^2 - 1), whose mean it then is. There is always one positive root: w > -1.
The text's lengths for that lam, put into cos(mu) where crank and ground are in line, leave

    cos(mu_min) = (|sin(psi/2) - sin(phi - psi/2)| (L - 1)/2 + sqrt(sin(delta/2)^2 + cos(delta/2)^2 L))
                  / sqrt(L (sin(phi/2)^2 + cos(phi/2)^2 L))

Towards the lam from which the dead centres lie on both assemblies mu_min goes down to 0, so the best is always below it: the
bounds are those of `best`, 1 and `LAST_RATIO`.
Sources: E. Soeylemez, Mechanisms, section 7.1; F. Freudenstein and E. J. F. Primrose (1972). Such charts go back to H. Alt.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import cycle

from livesheet.formula.nodes import Call, CellRef, Node
from livesheet.workbook import (
    Anchor,
    Area,
    Axis,
    Cell,
    Chart,
    Column,
    Conditional,
    Fill,
    Merge,
    PrintSetup,
    Series,
    SeriesRef,
    Sheet,
    Style,
)
from mechsheet.sheet import styles
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.synthesis.page import Naming
from mechsheet.sheet.transmission import POOR
from mechsheet.synthesis.four_bar import LAST_RATIO

SWINGS = tuple(range(10, 130, 10))
"""psi of the columns, degrees; the task's own follows them."""

TURNS = tuple(range(150, 240, 10))
"""phi of the rows, likewise."""

DOWN, ACROSS = len(TURNS) + 1, len(SWINGS) + 1

TITLE_ROW, LINE_ROW, HINT_ROW = range(3)
ANGLES = 4
"""The row of the heading over the table of mu_min; over that of lam: `RATIOS`."""

RATIOS = ANGLES + 2 + DOWN + 1
CHART_ROW = RATIOS + 2 + DOWN + 1
LAST_ROW = CHART_ROW + 26
HELPERS = ACROSS + 2
"""The first of the columns of helpers, folded: t^2, s, then w for each column of the tables."""

WIDTH, HEIGHT = 840, 400

AT_A_HALF_TURN = 1e-9
"""cos(phi/2) below it: the time ratio is 1, mu_min only rises with lam."""


def alt_sheet(plan: Plan) -> Sheet:
    """The sheet of a task of dead centres."""
    return _Alt(plan).sheet()


class _Alt(Cells):
    """The sheet while it is being laid out."""

    def __init__(self, plan: Plan) -> None:
        super().__init__(plan, plan.at.titles["alt"])
        task = plan.mechanism.synthesis
        if task is None:
            raise ValueError("the mechanism has no synthesis")
        self.naming = Naming(plan, task)
        self.own = CellRef(RATIOS + 2, HELPERS, True, True)
        self.best_angle, self.best_ratio = (CellRef(first + 1 + DOWN, ACROSS, True, True) for first in (ANGLES, RATIOS))

    def text(self, key: str) -> str:
        """A word of the sheet."""
        return self.plan.text(f"alt.{key}")

    def sheet(self) -> Sheet:
        """Everything on it."""
        self.put(TITLE_ROW, 0, self.text("title"), styles.TITLE)
        self._across(LINE_ROW, self._line(), styles.LINE)
        self._across(HINT_ROW, self.text("hint"), styles.NOTE)
        self._table(ANGLES, "angles", self._angle(), 1)
        self._table(RATIOS, "ratios", self._ratio(), 3)
        self._helpers()
        return Sheet(
            self.title,
            tuple(self.cells),
            tuple(self.fills),
            columns=(
                Column(0, 0, 12),
                Column(1, ACROSS, 8),
                Column(HELPERS - 1, HELPERS - 1, 3),
                Column(HELPERS, HELPERS + 1 + ACROSS, 10, level=1),
            ),
            row_heights=((TITLE_ROW, 26.0), (LINE_ROW, 34.0), (HINT_ROW, 44.0)),
            merges=tuple(Merge(Area(row, 0, row, ACROSS)) for row in (LINE_ROW, HINT_ROW)),
            charts=(self._chart(),),
            conditionals=tuple(self._colours()),
            selected=(ANGLES + 1 + DOWN, ACROSS),
            gridlines=False,
            tab_color="B8860B",
            print_setup=PrintSetup(
                landscape=False, fit_height=1, area=Area(0, 0, LAST_ROW, ACROSS), footer=self.plan.footer
            ),
        )

    def _colours(self) -> Iterator[Conditional]:
        """Grey where there is no best lam, green where it transmits well; else the task's own row and column stand out."""
        good = formula("IFERROR(cell>=poor,FALSE)", cell=CellRef(ANGLES + 2, 1), poor=POOR)
        for first in (ANGLES, RATIOS):
            top, bottom = first + 2, first + 1 + DOWN
            whole = Area(top, 1, bottom, ACROSS)
            yield Conditional(whole, formula("ISNA(cell)", cell=CellRef(top, 1)), styles.MISSING)
            if first == ANGLES:
                yield Conditional(whole, good, styles.GOOD)
            for area in (Area(bottom, 1, bottom, ACROSS), Area(top, ACROSS, bottom - 1, ACROSS)):
                there = formula("ISNUMBER(cell)", cell=CellRef(area.first_row, area.first_col))
                yield Conditional(area, there, styles.CURRENT)

    # --- cells

    def _across(self, row: int, content: Node | str, style: Style) -> None:
        """A text over all columns of the tables."""
        if isinstance(content, str):
            self.put(row, 0, content, style)
        else:
            self.formula(row, 0, content, style)
        self.cells.extend(Cell(row, col, None, style) for col in range(1, ACROSS + 1))

    def _table(self, first: int, key: str, node: Node, places: int) -> None:
        """A heading, psi across, phi down, and the formula in all cells."""
        across = [self.text(key), self.text("swing"), *[None] * (ACROSS - 1)]
        self.cells.extend(Cell(first, col, content, styles.SECTION) for col, content in enumerate(across))
        head = first + 1
        self.put(head, 0, self.text("turn"), styles.HEAD)
        self.cells.extend(Cell(head, col, float(psi), styles.HEAD) for col, psi in enumerate(SWINGS, 1))
        self.cells.extend(Cell(head + number, 0, float(phi), styles.HEAD) for number, phi in enumerate(TURNS, 1))
        own = styles.decimals(styles.HEAD, 1)
        self.formula(head, ACROSS, self._asked("psi"), own)
        self.formula(head + DOWN, 0, self._asked("phi"), own)
        self.fills.append(Fill(head + 1, 1, node, styles.decimals(styles.centred(styles.COLUMN), places), DOWN, ACROSS))

    def _asked(self, name: str) -> Node:
        """An angle of the task's, in degrees."""
        return formula("IF(ISNUMBER(cell),cell,NA())", cell=self._degrees(self.naming.symbols[name]))

    def _degrees(self, symbol: str) -> Node:
        cell = self.plan.at.cell(symbol, self.title, None)
        return cell if self.plan.mechanism.angle_unit.in_degrees else Call("DEGREES", (cell,))

    def _line(self) -> Node:
        """What is best for the task, and what this mechanism has."""
        own = formula("IFERROR(ROUND(own,2),dash)", own=self.own, dash="–")
        best = joined(
            self.text("line.best"), formula("ROUND(best,2)", best=self.best_angle), "°, λ = ",
            formula("ROUND(best,3)", best=self.best_ratio), self.text("line.own"), own, "°",
        )  # fmt: skip
        return formula("IF(ISNUMBER(angle),best,none)", angle=self.best_angle, best=best, none=self.text("line.none"))

    # --- formulas, each as the first cell of its table has it

    def _at(self, first: int) -> dict[str, CellRef]:
        """psi and phi of a cell of the table that begins there; its row's t^2 and s, and its own w."""
        return {
            "psi": CellRef(first + 1, 1, row_abs=True),
            "phi": CellRef(first + 2, 0, col_abs=True),
            "t2": CellRef(ANGLES + 2, HELPERS, col_abs=True),
            "s": CellRef(ANGLES + 2, HELPERS + 1, col_abs=True),
            "w": CellRef(ANGLES + 2, HELPERS + 2),
        }

    def _helpers(self) -> None:
        """t^2 and s of each row, w of each cell; mu_min of this mechanism."""
        at = self._at(ANGLES)
        style = styles.decimals(styles.INNER, 6)
        heads = ("t²", "s", "w", *[None] * (ACROSS - 1))
        self.cells.extend(Cell(ANGLES + 1, HELPERS + col, head, styles.HEAD) for col, head in enumerate(heads))
        t2 = formula(
            "IF(ABS(COS(RADIANS(phi)/2))>least,TAN(RADIANS(phi)/2)^2,NA())", phi=at["phi"], least=AT_A_HALF_TURN
        )
        s = formula("SQRT(square/3+4/9)", square=at["t2"])
        inside = formula("AND(psi>0,psi<180,phi>90+psi/2,phi<270+psi/2)", psi=at["psi"], phi=at["phi"])
        w = formula(
            "IF(inside,(square*(1+square)/TAN(RADIANS(phi-psi)/2)^2/2-8/27-square/3)/s^3,NA())",
            inside=inside, square=at["t2"], s=at["s"], psi=at["psi"], phi=at["phi"],
        )  # fmt: skip
        self.put(RATIOS + 1, HELPERS, self.text("own"), styles.HEAD)
        self.formula(self.own.row, HELPERS, self._asked("mu_min"), style)
        for col, node, cols in ((0, t2, 1), (1, s, 1), (2, w, ACROSS)):
            self.fills.append(Fill(ANGLES + 2, HELPERS + col, node, style, DOWN, cols))

    def _ratio(self) -> Node:
        """The best lam, #N/A from `LAST_RATIO` on."""
        at = self._at(RATIOS)
        cosine = formula("IF(w>1,((w+SQRT(w^2-1))^(1/3)+(w-SQRT(w^2-1))^(1/3))/2,COS(ACOS(w)/3))", w=at["w"])
        root = formula("2*s*cosine-2/3", s=at["s"], cosine=cosine)
        found = formula("SQRT(square/root)", square=at["t2"], root=root)
        return formula("IF(ISNUMBER(w),found,NA())", w=at["w"], found=found)

    def _angle(self) -> Node:
        """The best mu_min."""
        at = self._at(ANGLES)
        lam = CellRef(RATIOS + 2, 1)
        part = formula("ABS(SIN(RADIANS(psi)/2)-SIN(RADIANS(phi-psi/2)))", psi=at["psi"], phi=at["phi"])
        crank, rocker = (
            formula("SIN(RADIANS(angle)/2)^2+(COS(RADIANS(angle)/2)*lam)^2", angle=angle, lam=lam)
            for angle in (formula("phi-psi", phi=at["phi"], psi=at["psi"]), at["phi"])
        )
        cosine = formula(
            "(part*(lam^2-1)/2+SQRT(crank))/(lam*SQRT(rocker))", part=part, lam=lam, crank=crank, rocker=rocker
        )
        return formula(
            "IF(AND(lam>1,lam<longest),DEGREES(ACOS(cosine)),NA())", lam=lam, longest=float(LAST_RATIO), cosine=cosine
        )

    # --- the chart

    def _chart(self) -> Chart:
        """A curve for each phi that has values, the task's own, and this mechanism."""
        series = [
            replace(self._row(number, f"φ = {phi}°", color, 1.25), dash="dash" if phi < 180 else "solid")
            for (number, phi), color in zip(enumerate(TURNS, 1), cycle(styles.SERIES))
            if phi != 180
        ]
        series.append(self._row(DOWN, self.text("task"), styles.INK, 2.5))
        return Chart(
            self.text("title"),
            Anchor(CHART_ROW, 0, WIDTH, HEIGHT),
            (*series, self._here()),
            Axis("ψ [°]", low=0.0, high=120.0, step=10.0),
            Axis("μ min [°]", low=0.0),
            legend="right",
            name="synthesis alt",
            alt_text=self.text("title"),
        )

    def _row(self, number: int, name: str, color: str, width: float) -> Series:
        head = ANGLES + 1
        x, y = (SeriesRef(self.title, Area(row, 1, row, len(SWINGS))) for row in (head, head + number))
        return Series(name, x, y, line=color, width=width)

    def _here(self) -> Series:
        """This mechanism: on the curve of its phi where its lam is the best, else below."""
        x, y = (Area(row, col, row, col) for row, col in ((ANGLES + 1, ACROSS), (self.own.row, self.own.col)))
        return Series(
            self.text("own"), SeriesRef(self.title, x), SeriesRef(self.title, y), marker="circle", marker_size=9,
            marker_line=styles.SERIES[1], marker_fill=styles.SERIES[1],
        )  # fmt: skip
