"""How long the work on one file may take: asked for by `--seconds`, looked at wherever a workbook may keep us for ever."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from livesheet.diagnostics import Fault, UserError
from livesheet.said import say


class TimeLimitError(UserError):
    """The work took longer than it was given."""


_limit: ContextVar[tuple[float, float] | None] = ContextVar("limit", default=None)
"""(when it ends by the monotonic clock, how many seconds were given)"""


@contextmanager
def limited(seconds: float | None, file: str = "") -> Iterator[None]:
    """Let what is done inside take so many seconds; None: as long as it takes.

    It ends with TimeLimitError, which names `file`, at the next place that looks at the clock: a formula, a call of a
    function, a step of the work.
    """
    if seconds is None:
        yield
        return
    token = _limit.set((time.monotonic() + seconds, seconds))
    try:
        yield
    except TimeLimitError as error:
        raise TimeLimitError(Fault(error.faults[0].message, file, hint=error.faults[0].hint)) from error
    finally:
        _limit.reset(token)


def in_time(tell: Callable[[str], None]) -> Callable[[str], None]:
    """`tell`, which says what step of the work comes next, with a look at the clock."""

    def told(what: str) -> None:
        check_time()
        tell(what)

    return told


def check_time() -> None:
    """Raise TimeLimitError when the time is over."""
    limit = _limit.get()
    if limit is not None and time.monotonic() > limit[0]:
        message = say("not finished after {seconds:g} seconds", seconds=limit[1])
        raise TimeLimitError(Fault(message, hint=say("--seconds gives it more time")))
