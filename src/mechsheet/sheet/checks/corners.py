"""Places of the driver's motion that are asked beforehand: where its pieces meet, and where their laws are fastest.

Where pieces meet a quantity may be extreme without turning back: probes come near such a corner slowly. A segment that is
narrower than a row they may miss altogether. Each place is one row of the
sheet of extremes, with all quantities; each search takes the best of them.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from livesheet.formula.nodes import Call, CellRef, Node, Number, RangeRef, with_symbols
from mechsheet.model import Way
from mechsheet.sheet import styles
from mechsheet.sheet.checks import search_rules as rules
from mechsheet.sheet.checks.search_table import LABEL, NEAR, PLACE_COL, SearchTable
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.units import turn as whole_turn

WORKING = ("at_corner", "corner", "cornered", "best_known")
"""Working cells beside a search: the best value of all corners, its place, whether the search begins there, and the better
of that value and the best row's."""


@dataclass(frozen=True)
class Corners:
    """Their rows, from `row` on.

    angles  of the driver (`Mechanism.seams`);  at: the first working cell beside a search
    """

    table: SearchTable
    row: int
    angles: tuple[Node, ...]
    at: int

    def write(self, quantities: Collection[str]) -> None:
        """The rows of all places."""
        plan, table = self.table.plan, self.table
        in_degrees = plan.mechanism.driver.unit.in_degrees
        sweep = {name: there(spot).cell for name, spot in (("start", plan.places.start), ("step", plan.places.step))}
        known = {**sweep, "rows": table.rows, "whole": plan.searched.whole.cell, "turn": Number(whole_turn(in_degrees))}
        for row, angle in enumerate(self.angles, self.row):
            table.put(row, LABEL, plan.text("extremes.corner"), styles.LABEL)
            shown = Call("DEGREES", (angle,)) if in_degrees else angle
            place = with_symbols(rules.CORNER_PLACE, {**known, "angle": shown})
            there_ = table.fill(row, PLACE_COL, place)
            table.fill(row, NEAR, formula("MAX(1,MIN(rows,ROUND(place,0)))", rows=table.rows, place=there_))
        table.lay(self.row, len(self.angles), quantities)

    def beside(self, row: int) -> dict[str, Node]:
        """The cells beside a search that begins in a row, as its rules read them."""
        return {name: self.table.near(row, self.at + work) for work, name in enumerate(WORKING)}

    def write_beside(self, row: int, symbol: str, way: Way, known: Mapping[str, Node]) -> None:
        """Them; `known`: what the rules read."""
        table = self.table
        first = table.probed(symbol, self.row, anchored=True)
        column, places = (
            RangeRef(cell, replace(cell, row=self.row + len(self.angles) - 1))
            for cell in (first, CellRef(self.row, PLACE_COL, True, True))
        )
        trees = {
            "at_corner": formula('IFERROR(best,"")', best=Call(way.upper(), (column,))),
            "corner": formula('IFERROR(INDEX(places,MATCH(at_corner,column,0)),"")', places=places, column=column),
            "cornered": rules.CORNERED,
            "best_known": rules.OF_ROWS_AND_CORNERS,
        }
        for work, name in enumerate(WORKING):
            table.work(row, self.at + work, "value", value=with_symbols(trees[name], known))


def corners_of(plan: Plan) -> tuple[Node, ...]:
    """Those angles of the driver; none where nobody looks between the rows."""
    return () if plan.rows_only else plan.mechanism.seams
