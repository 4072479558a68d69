"""Computing the parts of a study: here, in one process or several, or on a Dask cluster. The same parts, the same bytes.

A worker of a cluster that dies takes nothing with it but the part that it was at; the scheduler gives that to another.
"""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from pathlib import Path
from threading import Thread
from typing import Any, TypeAlias

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError
from mechsheet.studies.packages import distributed, unlike
from mechsheet.studies.parts import Done, Order, VersionsError, compute

Parts: TypeAlias = Iterator[Done]
"""Parts as they come, in any order."""

AHEAD = 2
"""Parts that wait for each process: none stands still, and few results are held."""

OF_A_PROCESS = 320 * 2**20
"""Bytes that a process has at most, in round numbers: the packages (150 to 180 MiB), what it evaluates at once, and the
rows that it has not written yet."""


def workers_within(workers: int | None, memory: int | None) -> int:
    """How many processes: those asked for, or one for each core; no more than fit. Raises MechsheetError where none does.

    memory  bytes for all of them; None: three quarters of what there is, where nobody says how many processes he wants
    """
    if memory is not None and memory < OF_A_PROCESS:
        message = say(
            "{memory:.0f} MiB are too little: one process needs {least} MiB",
            memory=memory / 2**20,
            least=OF_A_PROCESS // 2**20,
        )
        raise MechsheetError(Fault(message, key="limit_memory"))
    if memory is None and workers is None:
        memory = memory_there() * 3 // 4
    wanted = workers if workers is not None else _cores()
    if memory is None or wanted == 1:
        return wanted
    return max(1, min(wanted, memory // OF_A_PROCESS - 1))  # and the one that writes


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")
"""Where Linux says how much a container, or a job of a cluster, may have."""


def memory_there() -> int:
    """Bytes of this machine, or that this container may have; 2^50 where the system does not say."""
    found = [2**50]
    if hasattr(os, "sysconf") and "SC_PHYS_PAGES" in os.sysconf_names:
        found.append(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    for path in LIMITS:
        with suppress(OSError, ValueError):  # no such file, or "max"
            found.append(int(Path(path).read_text("ascii")))
    return min(found)


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
        message = say("a process of the study was ended from outside, perhaps for want of memory")
        hint = say("what is done is kept: go on with --resume, with fewer --workers")
        raise MechsheetError(Fault(message, hint=hint)) from error
    finally:
        pool.shutdown(cancel_futures=True)


def _end_with_parent() -> None:
    """A process whose parent is killed would wait for parts for ever: it ends, too."""

    def watch() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
            os._exit(1)

    Thread(target=watch, daemon=True).start()


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


# --- a cluster -------------------------------------------------------------------------------------------------------------

SECONDS = 10
"""So long an address may take to answer, and workers to come."""

LEAST_AHEAD = 8


def on_cluster(order: Order, parts: Iterable[int], address: str) -> Parts:
    """Compute parts on the workers of the scheduler at `address`. Raises MechsheetError where nobody answers or works."""
    dask = distributed()
    client = _client(dask, address)
    try:
        client.wait_for_workers(1, timeout=SECONDS)
    except (TimeoutError, dask.TimeoutError) as error:
        client.close()
        message = say("the scheduler has no workers after {seconds} s", seconds=SECONDS)
        raise MechsheetError(
            Fault(message, key=f"--on {address}", hint=say("dask worker {address}", address=address))
        ) from error
    try:
        yield from _computed(dask, client, order, parts)
    except VersionsError as error:
        message = say(
            "a worker would not compute the same bytes: {differing}", differing=unlike(*map(dict, error.args))
        )
        hint = say("the same releases, on processors that compute alike")
        raise MechsheetError(Fault(message, key=f"--on {address}", hint=hint)) from error
    except (dask.KilledWorker, dask.client.FutureCancelledError, OSError) as error:
        message = say("the cluster has given a part up: {reason}", reason=error)
        hint = say("what is done is kept: go on with --resume")
        raise MechsheetError(Fault(message, key=f"--on {address}", hint=hint)) from error
    finally:
        client.close(timeout=SECONDS)


def _client(dask: Any, address: str) -> Any:
    hint = say("the address that `dask scheduler` prints, for example tcp://10.0.0.5:8786")
    wrong = _wrong_with(dask, address)  # of which a client could not be told, and which it could not end
    if wrong:
        raise MechsheetError(
            Fault(say("cannot be reached: {reason}", reason=wrong), key=f"--on {address}".strip(), hint=hint)
        )
    try:
        return dask.Client(address, timeout=SECONDS, set_as_default=False)
    except (OSError, TimeoutError) as error:
        message = say("nobody answers within {seconds} s", seconds=SECONDS)
        raise MechsheetError(Fault(message, key=f"--on {address}", hint=hint)) from error


def _wrong_with(dask: Any, address: str) -> str:
    """What is wrong with an address before anybody is asked; "" for nothing."""
    try:
        dask.comm.resolve_address(address)
    except ValueError as error:
        return str(error)
    except OSError:
        pass  # a name that is not known now is asked for again
    if address.startswith("tls:") and not dask.Security().get_connection_args("client").get("ssl_context"):
        return "tls needs certificates, which Dask's configuration does not name"
    return ""


def _computed(dask: Any, client: Any, order: Order, parts: Iterable[int]) -> Parts:
    """Parts are submitted a few ahead of the workers that there are: memory stays bounded, and workers may come and go."""
    rest = iter(parts)
    waiting = dask.as_completed(loop=client.loop)
    held = 0

    def submit() -> int:
        count = 0
        while held + count < max(LEAST_AHEAD, AHEAD * sum(client.nthreads().values())):
            part = next(rest, None)
            if part is None:
                break
            waiting.add(client.submit(compute, order, part, pure=False))
            count += 1
        return count

    held += submit()
    while held:
        future = next(waiting)
        held -= 1
        done = future.result()
        future.release()
        held += submit()
        yield done
