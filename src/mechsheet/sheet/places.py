"""Where cells stand that are no quantities of the mechanism: whoever lays a sheet out hands them out.

What a layout or a mechanism does not have is None.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from livesheet.formula.nodes import RangeRef
from mechsheet.model import Way
from mechsheet.sheet.addresses import Spot

Found = TypeVar("Found")


@dataclass(frozen=True, slots=True)
class Starts:
    """Of a group that Newton's method solves, on the sheet of iterations.

    needed  the column that says how many passes each row needs;  lost: the column that says in which of
            its first passes the assembly could not be kept
    table, values  the left upper cells of the table in which the group begins, and of its start values
    """

    needed: Spot
    lost: Spot
    table: Spot
    values: Spot


@dataclass(frozen=True, slots=True)
class Places:
    """Of the first sheet, or of a page, and of the tables beside it.

    status     the column that says whether a row closes;  rates: the same of the rates;  number: that of the row's number
    rows       how many rows the table has: counted in a cell, since a person may insert some
    position   which row is drawn;  arrows: by kind, whether they are
    start, step  of the driver, where its values are not listed
    verdict    the line under the title
    lines      by key the values of what is said of the mechanism;  occurs: where in the motion these are
    summaries  by symbol, and of outputs that follow from them;  bands: by symbol of a quantity or of a summary
    unsolved   not 0 where the task of a synthesis has no solution;  synthesis: the line that says
               whether all is done
    lengths    by their names sides of four-bar loops that are no dimensions
    starts     by number of the group
    reasons, dead  what is said of a row that does not close, or is a dead centre, in order of solution
    sheets     by key whether a sheet that a person may delete is there;  left: what can be said without;  well: what the
               line under the title says where nothing is wrong, which a page writes where it is said
    """

    status: Spot
    rows: Spot
    verdict: Spot
    lines: Mapping[str, Spot]
    summaries: Mapping[str, Spot]
    number: Spot | None = None
    rates: Spot | None = None
    position: Spot | None = None
    start: Spot | None = None
    step: Spot | None = None
    unsolved: Spot | None = None
    synthesis: Spot | None = None
    arrows: Mapping[str, Spot] = field(default_factory=dict)
    occurs: Mapping[str, Spot] = field(default_factory=dict)
    bands: Mapping[str, Spot] = field(default_factory=dict)
    lengths: Mapping[str, Spot] = field(default_factory=dict)
    starts: Mapping[int, Starts] = field(default_factory=dict)
    reasons: RangeRef | None = None
    dead: RangeRef | None = None
    sheets: Mapping[str, Spot] = field(default_factory=dict)
    left: Spot | None = None
    well: Spot | None = None

    @property
    def inputs(self) -> Spot:
        """The number of the first input that cannot be, 0 where all can."""
        return self.lines["inputs"]

    @property
    def closed(self) -> Spot:
        """In how many rows the mechanism closes."""
        return self.lines["rows_closed"]

    @property
    def leaps(self) -> Spot:
        """How often a link turns far between two rows."""
        return self.lines["leaps"]

    def excess(self, loop: int) -> Spot:
        """Of a four-bar loop, by its group: shortest + longest - the other two."""
        return self.lines[f"grashof_{loop}"]


@dataclass(frozen=True, slots=True)
class Stretch:
    """Rows one after another in which the mechanism closes: the first and the last of them, counted from 1, where between
    rows the stretch begins and ends, and what is said of it."""

    first: Spot
    last: Spot
    begin: Spot
    end: Spot
    words: Spot


@dataclass(frozen=True, slots=True)
class Extreme:
    """The smallest or the largest value of a quantity, the driver's value there, and how much the value is to be doubted.

    turns, turns_doubt  where the quantity turns back [rows], if a ratio of times is asked for, and how much that is
    boundless           whether there is no such value, where there may be none
    """

    value: Spot
    occurs: Spot
    doubt: Spot
    turns: Spot | None
    turns_doubt: Spot | None
    boundless: Spot | None


@dataclass(frozen=True, slots=True)
class Searched:
    """Of the sheet of extremes.

    whole      1 for whole turns whose last row is the first again, 2 where that row is left out, else 0
    fine, there  whether all inputs can be; whether the position that is drawn is one
    rows       how many rows the table has;  rows_apart: in how many of the sheets that have them they differ
    count      how many stretches there are, of which the first ones have places;  worst_group: which of several angles of
               transmission is the least;  doubts: what is added to words of an extreme that is not sure, by doubt
    unsettled  whether a limit is known to a step only;  rows_only: whether only rows are known
    limits     the driver's values there
    extremes, wraps  by quantity; whether the rows at the ends of the table are neighbours for it
    derivatives  by way and by the symbol of the derivative, where a quantity with a band is smallest or largest
    means      of quantities whose mean is asked for, where rows may be a turn without the one that closes it: by the
               trapezoidal rule, and that of all rows alike
    gaps       by group its least margin between rows, and the row there;  reach: of a loop, whether tolerances do
    """

    whole: Spot
    fine: Spot
    there: Spot
    rows: Spot
    rows_apart: Spot
    count: Spot
    unsettled: Spot
    rows_only: Spot
    worst_group: Spot | None
    doubts: RangeRef
    stretches: Sequence[Stretch]
    limits: Sequence[Spot]
    extremes: Mapping[tuple[Way, str], Extreme]
    wraps: Mapping[str, Spot]
    derivatives: Mapping[tuple[Way, str], Spot]
    means: Mapping[str, tuple[Spot, Spot]]
    gaps: Mapping[int, tuple[Spot, Spot]]
    reach: Mapping[int, Spot]


@dataclass(frozen=True, slots=True)
class Checked:
    """Of the sheet of checks.

    begun     the column that counts stretches;  typed: how many cells were typed over;  rounding: which gaps are none
    least     by group the column of its least margin near each row
    crossed   by group the least of the products of sines before and after, and the driver's value there
    strongest  the joints of the largest force, in words; None where there are no joint forces
    """

    begun: Spot
    typed: Spot
    rounding: Spot
    least: Mapping[int, Spot]
    crossed: Mapping[int, tuple[Spot, Spot]]
    strongest: Spot | None


def there(place: Found | None) -> Found:
    """A place that this layout of this mechanism has."""
    if place is None:
        raise ValueError("a place that this layout does not have is read")
    return place
