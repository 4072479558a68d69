"""How much work a formula may be: a LAMBDA that calls itself, or a loop over arrays, ends as Excel would never end it."""

from __future__ import annotations

from dataclasses import dataclass

from ...said import say
from ...time_limit import check_time
from ..values.frames import UnsupportedError

MOST_STEPS = 1 << 21
"""Steps of one formula: calls of functions, and names and cells of arrays that they read. MAP over a whole column of a sheet
with a name or two is as many, some 20 seconds; what takes more is a mistake or malice (fib(60) takes 10^13)."""

MOST_ALL = 1 << 23
"""Steps in functions of one evaluation of a workbook, in which a few formulas may take as long."""

CELLS_A_STEP = 1024
"""Cells of an array that numpy gets through while Python takes a step."""

LIFTED_STEPS = 8
"""Steps that a function takes for one cell of an array where it wants a single value: it is called anew for each."""


class StepsError(UnsupportedError):
    """A formula that takes too long."""


@dataclass(slots=True)
class Budget:
    """What has been spent.

    depth    functions that are being called;  formula  steps of the formula that is being computed
    called   steps in functions, of the whole evaluation
    """

    depth: int = 0
    formula: int = 0
    called: int = 0

    def begin(self) -> None:
        """Another formula. Raises TimeLimitError."""
        self.formula = 0
        check_time()

    def spend(self, steps: int) -> None:
        """Take steps. Raises StepsError when there were too many, TimeLimitError when they took too long."""
        self.formula += steps
        if self.formula > MOST_STEPS:
            raise StepsError(say("not computed: it takes more than {most} steps", most=MOST_STEPS))
        if self.depth:
            self.called += steps
            if self.called > MOST_ALL:
                raise StepsError(
                    say("not computed: functions took more than {most} steps in this workbook", most=MOST_ALL)
                )
        check_time()
