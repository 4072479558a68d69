"""A study from its description to its folder: begin or go on, compute what is missing, count, rank."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from livesheet.diagnostics import Fault
from livesheet.formats import write
from livesheet.replacing import replace_file
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError
from mechsheet.model import Mechanism
from mechsheet.studies.book import book_of
from mechsheet.studies.designs import Designs
from mechsheet.studies.folder import Folder, locked
from mechsheet.studies.packages import arrow
from mechsheet.studies.parts import Counted, Order, counted, order_of
from mechsheet.studies.picture import picture_of
from mechsheet.studies.ranking import Studied, ranked, rows_of
from mechsheet.studies.workers import here, workers_within

BOOK = "study"
"""What the summary workbook and the picture are called."""


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a study is: designs done of all, of these kept; `earlier`: done before this run began."""

    done: int
    kept: int
    all: int
    earlier: int


def studied(
    mechanism: Mechanism,
    folder: Path,
    *,
    workers: int | None = None,
    on: str | None = None,
    resume: bool = False,
    limit_memory: int | None = None,
    formats: Sequence[str] = ("xlsx",),
    tell: Callable[[Progress], None] = lambda _: None,
) -> Studied:
    """Run a study, or go on with one, and rank what it keeps. Raises MechsheetError; what is done stays done.

    workers       processes on this machine, by default one for each core;  on: the address of a Dask scheduler instead
    limit_memory  bytes that all processes together may have: there are as many as fit
    formats       of the summary workbook: "xlsx", "ods"
    """
    arrow()
    if workers is not None and workers < 1:
        raise MechsheetError(Fault(say("at least 1 process, not {workers}", workers=workers), key="workers"))
    designs = Designs(mechanism)
    order = order_of(mechanism.text, designs.sampling.total)
    place = Folder(folder)
    processes = 0 if on is not None else workers_within(workers, limit_memory)
    place.open(resume)
    with locked(folder):
        place.begin(designs, order, resume)
        counts = place.done(order, len(designs.questions.conditions)) if resume else {}
        _compute(place, order, counts, processes, on, tell)
        place.check(order)
        return _finished(place, designs, order, counts, formats)


def _finished(
    place: Folder, designs: Designs, order: Order, counts: dict[int, Counted], formats: Sequence[str]
) -> Studied:
    """Count, rank, and write what people open."""
    paths = place.parts(order)
    result = place.finish(designs, (counts[number] for number in range(order.parts)))
    found = ranked(paths, designs.study.objectives, designs.study.best)
    best, front, apart = (rows_of(paths, order, numbers) for numbers in (found.best, found.front, found.apart))
    end = Studied(designs, order, place, result, found, best, front, apart)
    book = book_of(end)
    for form in formats:
        write(book, place.path / f"{BOOK}.{form}", form)
    replace_file(place.path / f"{BOOK}.svg", picture_of(end))
    return end


def _compute(
    place: Folder,
    order: Order,
    counts: dict[int, Counted],
    processes: int,
    on: str | None,
    tell: Callable[[Progress], None],
) -> None:
    """Compute the parts that are missing; `counts` gets what they say."""
    missing = [number for number in range(order.parts) if number not in counts]
    done, kept = (sum(getattr(part, name) for part in counts.values()) for name in ("designs", "kept"))
    earlier = done
    tell(Progress(done, kept, order.designs, earlier))
    if on is not None:
        from mechsheet.studies.workers import on_cluster

        parts = on_cluster(order, missing, on) if missing else iter(())
    else:
        parts = here(order, missing, min(processes, max(1, len(missing))))
    for part in parts:
        place.keep(part)
        told = counted(place.part(part.part))
        if told is None:
            raise MechsheetError(
                Fault(say("cannot be read again"), str(place.part(part.part)), hint=say("is the disk full?"))
            )
        counts[part.part] = told
        done, kept = done + told.designs, kept + told.kept
        tell(Progress(done, kept, order.designs, earlier))
