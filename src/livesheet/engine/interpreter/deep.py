"""Trees deeper than Python's stack: evaluated again with a stack that is large enough, in a thread of its own."""

from __future__ import annotations

import contextvars
import sys
import threading
from collections.abc import Callable
from typing import TypeVar

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
