"""Do engine, stored values, reference and other programs agree? The only place where they meet."""

from __future__ import annotations

from typing import TYPE_CHECKING

from livesheet.on_demand import names_of

if TYPE_CHECKING:
    from mechsheet.checking.baseline import Baseline, read_baseline
    from mechsheet.checking.books_compared import with_twins
    from mechsheet.checking.cells_apart import Rules, difference
    from mechsheet.checking.comparison import TOLERANCE, Comparison, Tally
    from mechsheet.checking.judging import check, judge
    from mechsheet.checking.mutation import Mutation, mutate
    from mechsheet.checking.perturbation import Perturbation, perturb
    from mechsheet.checking.report import Edit, Report
    from mechsheet.checking.stored import Stored

_HOMES = {
    "Baseline": "baseline",
    "read_baseline": "baseline",
    "check": "judging",
    "judge": "judging",
    "Mutation": "mutation",
    "mutate": "mutation",
    "Perturbation": "perturbation",
    "perturb": "perturbation",
    "TOLERANCE": "comparison",
    "Comparison": "comparison",
    "Edit": "report",
    "Report": "report",
    "Tally": "comparison",
    "difference": "cells_apart",
    "Rules": "cells_apart",
    "Stored": "stored",
    "with_twins": "books_compared",
}
"""Name -> module: imported when first used, so that `recalc --check` loads nothing of mechanisms."""

__all__ = [
    "TOLERANCE",
    "Baseline",
    "Comparison",
    "Edit",
    "Mutation",
    "Perturbation",
    "Report",
    "Rules",
    "Stored",
    "Tally",
    "check",
    "difference",
    "judge",
    "mutate",
    "perturb",
    "read_baseline",
    "with_twins",
]

__getattr__ = names_of(__name__, _HOMES)
