"""Computing the parts of a study on a Dask cluster whose scheduler is running: the same function, the same parts.

A worker that dies takes nothing with it but the part that it was at; the scheduler gives that to another.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError
from mechsheet.studies.packages import distributed, unlike
from mechsheet.studies.parts import Order, VersionsError, compute
from mechsheet.studies.running import AHEAD, Parts

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
