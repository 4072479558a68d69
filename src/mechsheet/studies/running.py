"""Computing the parts of a study: here, in one process or several, or on a Dask cluster. The same parts, the same bytes."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from threading import Thread
from typing import TypeAlias

from mechsheet.diagnostics import Fault, MechsheetError
from mechsheet.studies.parts import Done, Order, compute

Parts: TypeAlias = Iterator[Done]
"""Parts as they come, in any order."""

AHEAD = 2
"""Parts that wait for each process: none stands still, and few results are held."""

OF_A_PROCESS = 192 * 2**20
"""Bytes that a process has at most, in round numbers: the packages, and what it evaluates at once."""


def workers_within(workers: int | None, memory: int | None) -> int:
    """How many processes: those asked for, or one for each core; no more than fit. Raises MechsheetError where none does."""
    wanted = workers if workers is not None else _cores()
    if memory is None:
        return wanted
    fit = memory // OF_A_PROCESS - (1 if wanted > 1 else 0)  # the one that writes
    if memory < OF_A_PROCESS:
        message = f"{memory / 2**20:.0f} MiB are too little: one process needs {OF_A_PROCESS // 2**20} MiB"
        raise MechsheetError(Fault(message, key="limit_memory"))
    return max(1, min(wanted, fit))


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def here(order: Order, parts: Iterable[int], workers: int) -> Parts:
    """Compute parts on this machine."""
    if workers == 1:
        for part in parts:
            yield compute(order, part)
        return
    # new processes, not copies of this one: it may run threads
    pool = ProcessPoolExecutor(workers, multiprocessing.get_context("spawn"), initializer=_end_with_parent)
    try:
        yield from ahead(lambda part: pool.submit(compute, order, part), parts, AHEAD * workers)
    except BrokenProcessPool as error:
        message = "a process of the study was ended from outside, perhaps for want of memory"
        hint = "what is done is kept: go on with --resume, with fewer --workers"
        raise MechsheetError(Fault(message, hint=hint)) from error
    finally:
        pool.shutdown(cancel_futures=True)


def _end_with_parent() -> None:
    """A process whose parent is killed would wait for parts for ever: it ends, too."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        Thread(target=lambda: (parent.join(), os._exit(1)), daemon=True).start()


def ahead(submit: Callable[[int], Future[Done]], parts: Iterable[int], most: int) -> Parts:
    """The results of parts that are submitted, no more than `most` at a time, as they are done."""
    waiting: set[Future[Done]] = set()
    rest = iter(parts)
    while True:
        for part in rest:
            waiting.add(submit(part))
            if len(waiting) >= most:
                break
        if not waiting:
            return
        done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
        for future in done:
            yield future.result()
