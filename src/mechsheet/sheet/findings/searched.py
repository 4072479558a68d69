"""The motion as a search in Python finds it, which reads no formula (`kinematics.search`): what cells are compared with.

What the sheet finds by probes beside the rows is found here by many places and narrowing. A limit is right to 1e-4 of a
step, an extreme to 1e-4 of its range; where the sheet itself says "about", or a group nearly comes apart, less is asked.
What the sheet warns of (a gap between rows, links that turn far in one step) is compared as a warning, and nothing that
hangs on it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from livesheet.formula.nodes import Scalar
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.search import Search
from mechsheet.sheet.checks.checks import LEAP
from mechsheet.sheet.checks.search_rules import STRETCHES
from mechsheet.sheet.plan import Plan

EXACT = 1e-4
"""So much of a step a limit may be off, of its range an extreme."""

ABOUT = 5e-2
"""The same where the sheet says "about", or a group nearly comes apart; then a limit need only lie in its step."""

STEPPED = 9
"""To so many decimals [rad]: a step of 90 degrees is no larger one."""


@dataclass(frozen=True, slots=True)
class Expected:
    """What a search finds for a cell, as people read it.

    numbers  one of them; none where there is no number
    allowed  so much the cell may be off
    warning  the cell counts what is to be warned of: compared is whether it is 0
    told     whether it is better than the cell's own number, so that the library tells it
    words    one of them stands in the words beside the cell; none where nobody asks
    """

    numbers: Sequence[float]
    allowed: float = 1e-9
    warning: bool = False
    told: bool = True
    words: Sequence[str] = ()


class SearchedMotion:
    """A search, in the units in which people read a workbook.

    `sure` is False where the mechanism nearly comes apart, or a link turns far between two rows: then nothing is to be said
    of what hangs on it. `leaps`: a link turns by more than `LEAP` between two rows. `too_many`: more stretches than
    extremes are looked for in.
    """

    def __init__(self, plan: Plan, search: Search) -> None:
        self.plan, self.search = plan, search
        mechanism = plan.mechanism
        self.driver_scale = math.degrees(1.0) if mechanism.driver.unit.in_degrees else 1.0
        self.angle_scale = math.degrees(1.0) if mechanism.angle_unit.in_degrees else 1.0
        self.page = mechanism.layout == "page"
        both = search.row_there[1:] & search.row_there[:-1]
        turned = [column[both] for column in search.turns_between_rows().values()]
        if mechanism.driver.unit.kind == "angle" and search.stepped:
            turned.append(np.abs(np.diff(search.driver(np.arange(1.0, search.rows + 1)))))
        self.leaps = any(np.any(np.round(column, STEPPED) > np.round(math.radians(LEAP), STEPPED)) for column in turned)
        self.too_many = not self.page and len(search.row_stretches) > STRETCHES
        self.sure = not (search.holes or search.doubtful or self.leaps)

    def scale(self, symbol: str) -> float:
        """From the equations' unit of a quantity to the one that people read."""
        return self.angle_scale if self.search.is_angle(symbol) else 1.0

    def drivers(self, places: Iterable[float]) -> list[float]:
        """Values of the driver at such rows, as people read them."""
        return [float(self.search.driver(place)) * self.driver_scale for place in places]

    # --- what the cells themselves say --------------------------------------------------------------------------

    def number(self, key: str) -> Scalar:
        """The number that a finding's cell shows; None where no cells are looked at."""
        return None

    def says(self, key: str, word: str) -> bool:
        """Whether the words beside it say that it is `about` right, `within` a step, of `rows.only`, or `beyond`."""
        return False

    def part(self, key: str) -> float:
        """So much of its range a number may be off."""
        return ABOUT if self.says(key, "about") else EXACT

    def where(self, key: str, best: float, missed: Callable[[Array], Array], allowed: float) -> dict[str, Expected]:
        """What is expected of the cell that says where a number occurs: any place is right at which it is as good.

        best  the best row, a fraction between two;  missed  by how much the number is missed at such rows
        """
        search, at = self.search, f"{key}_at"
        if not search.stepped:
            return {}
        (right,), shown = self.drivers([best]), self.number(at)
        if isinstance(shown, float):
            row = 1 + (shown / self.driver_scale - float(search.driver(1))) / search.step
            if 1 - EXACT <= row <= search.last + EXACT and missed(np.array([row]))[0] <= allowed:
                right = shown
        return {at: Expected([right], EXACT * abs(search.step) * self.driver_scale, told=False)}

    def allowed_where(self) -> float:
        """By how much a limit may be off."""
        part = 1.0 if self.search.doubtful or self.says("limits", "within") else EXACT
        return max(part * abs(self.search.step) * self.driver_scale, 1e-9)

    def as_far(self, key: str, expected: list[float], of_rows: list[float]) -> list[float]:
        """What is expected; where the sheet says that there may be more elsewhere, all from that of the rows on is right."""
        found = self.number(key)
        if not (expected and of_rows and isinstance(found, float) and self.says(key, "beyond")):
            return expected
        low, high = sorted((expected[0], of_rows[0]))
        return [min(max(found, low), high)]
