"""What an evaluation knows of the book beyond the values of its cells: functions, formulas, and what has been computed;
and how far it may go.

A LAMBDA that calls itself, or a loop over arrays, ends where Excel would never end it (`Budget`). Trees deeper than Python's
stack are evaluated again with a stack that is large enough, in a thread of its own (`deeply`).
"""

from __future__ import annotations

import contextvars
import sys
import threading
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from ...diagnostics import Fault
from ...formula.book import Book
from ...formula.nodes import FunctionRef, Node, Scalar
from ...formula.references import cell_address
from ...said import say
from ...time_limit import check_time
from ..kernels.math import FAST, Arithmetic
from ..layout import Area
from ..values.cells import UnsupportedError

_SIZES = (512 << 20, 64 << 20)
"""Address space for a stack, of which only what is used is taken from the memory; the second where there is less."""
_BYTES_A_LEVEL = 2560
_NAME = "livesheet-deep"

_one_at_a_time = threading.Lock()

Found = TypeVar("Found")


def deeply(compute: Callable[[], Found]) -> Found:
    """What `compute` returns or raises. RecursionError only beyond every reasonable depth."""
    try:
        return compute()
    except RecursionError:
        if threading.current_thread().name == _NAME:
            raise
    with _one_at_a_time:
        for size in _SIZES:
            try:
                return _in_deep_thread(compute, size)
            except _NoThreadError:
                continue
    raise RecursionError


class _NoThreadError(Exception):
    """There is no room for a stack of that size."""


def _in_deep_thread(compute: Callable[[], Found], size: int) -> Found:
    found: list[Found] = []
    problems: list[BaseException] = []

    def run() -> None:
        try:
            found.append(compute())
        except BaseException as problem:  # raised again in the thread that waits
            problems.append(problem)

    limit, usual = sys.getrecursionlimit(), threading.stack_size(size)
    try:
        sys.setrecursionlimit(max(limit, size // _BYTES_A_LEVEL))
        # A thread begins without what its maker was given, such as the time it may take.
        thread = threading.Thread(target=contextvars.copy_context().run, args=(run,), name=_NAME)
        try:
            thread.start()
        except RuntimeError as problem:
            raise _NoThreadError from problem
        thread.join()
    finally:
        threading.stack_size(usual)
        sys.setrecursionlimit(limit)
    if problems:
        raise problems[0]
    return found[0]


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


_MOST = 100
"""Cells of which the same is remarked."""


def _no_reference(text: str, in_a1: bool, sheet: str, row: int, col: int) -> Node | None:
    del text, in_a1, sheet, row, col
    return None


def _all_there(area: Area, but: Collection[int]) -> None:
    del area, but


@dataclass(slots=True)
class Environment:
    """`reference` reads a text as a reference; `check` raises NotReadyError for cells of an area that are not computed yet
    and not of some producers.

    arithmetic  which code the elementary functions have
    closely  whether every cell that is read is checked, not only those that no formula names
    sizes    the size that each dynamic array has, by its block
    remarks  what could not be computed as it is meant, with its cell
    budget   how much work formulas have been
    kept     formulas that could not be computed, (sheet, row, column)
    """

    book: Book = field(default_factory=lambda: Book([]))
    functions: Mapping[FunctionRef, Node] = field(default_factory=dict)
    reference: Callable[[str, bool, str, int, int], Node | None] = _no_reference
    check: Callable[[Area, Collection[int]], None] = _all_there
    arithmetic: Arithmetic = FAST
    closely: bool = False
    sizes: dict[int, tuple[int, int]] = field(default_factory=dict)
    remarks: list[Fault] = field(default_factory=list)
    budget: Budget = field(default_factory=Budget)
    kept: set[tuple[int, int, int]] = field(default_factory=set)
    _said: dict[str, int] = field(default_factory=dict)

    def need(self, area: Area) -> None:
        """Raise NotReadyError when not all cells of an area have been computed."""
        self.check(area, ())

    def stored(self, sheet: int, row: int, col: int) -> Scalar:
        """The value that the file holds for a formula, None where it holds none."""
        return self.book.sheets[sheet].cached.get(row, col) if sheet < len(self.book.sheets) else None

    def remark(self, message: str, sheet: int, row: int, col: int) -> None:
        """Note what could not be computed in a cell."""
        place = cell_address(self.book.sheets[sheet].title, row, col) if sheet < len(self.book.sheets) else ""
        said = self._said[message] = self._said.get(message, 0) + 1
        if said <= _MOST:
            fault = Fault(
                say("{message} (and more cells)", message=message) if said == _MOST else message,
                file=self.book.source,
                key=place,
            )
            if fault not in self.remarks:
                self.remarks.append(fault)
