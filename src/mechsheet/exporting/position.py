"""One position in numbers, step by step: what a solution on paper writes down."""

from __future__ import annotations

import math

import numpy as np

from mechsheet.exporting.lowering import Lowering, Step
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import value
from mechsheet.model import Mechanism
from mechsheet.plotting.sampling import Sample, sample
from mechsheet.sheet.plan import Plan


class Position:
    """A row of a sample: the steps of its equations, and the value of every symbol in internal units.

    steps  by the equation that they belong to
    """

    def __init__(self, mechanism: Mechanism, at: float | None) -> None:
        self.sample: Sample = sample(mechanism, at, None)
        self.steps = Lowering(self.sample).steps
        self.values = {symbol: float(column[self.sample.shown]) for symbol, column in self.sample.values.items()}
        with np.errstate(all="ignore"):
            for symbol, steps in self.steps.items():
                self._add_helpers(symbol, steps)

    def _add_helpers(self, symbol: str, steps: tuple[Step, ...]) -> None:
        """The values of the steps before an equation's own."""
        for step in steps[:-1]:
            if step.counts_turns:
                within = self.values[steps[0].symbol]
                self.values[step.symbol] = float(np.round((self.values[symbol] - within) / math.tau))
            else:
                self.values[step.symbol] = float(value(step.expression, self.values, rooted=True))

    @property
    def plan(self) -> Plan:
        """Where everything is in the workbook."""
        return self.sample.plan

    @property
    def equations(self) -> Equations:
        """The equations, in order of solution."""
        return self.sample.equations

    def value(self, symbol: str) -> float:
        """A quantity in internal units: dimension, constant, mode, driver or column. NaN where it has no number."""
        return self.values[symbol]
