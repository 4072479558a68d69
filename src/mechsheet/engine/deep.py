"""Trees deeper than Python's stack: evaluated again with a stack that is large enough, in a thread of its own."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from typing import TypeVar

_LEVELS = 200_000
_BYTES = 512 << 20
"""Address space, of which only what is used is taken from the memory."""

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
        return _in_deep_thread(compute)


_NAME = "mechsheet-deep"


def _in_deep_thread(compute: Callable[[], Found]) -> Found:
    found: list[Found] = []
    problems: list[BaseException] = []

    def run() -> None:
        try:
            found.append(compute())
        except BaseException as problem:  # raised again in the thread that waits
            problems.append(problem)

    limit, size = sys.getrecursionlimit(), threading.stack_size(_BYTES)
    try:
        sys.setrecursionlimit(max(limit, _LEVELS))
        thread = threading.Thread(target=run, name=_NAME)
        thread.start()
        thread.join()
    finally:
        threading.stack_size(size)
        sys.setrecursionlimit(limit)
    if problems:
        raise problems[0]
    return found[0]
