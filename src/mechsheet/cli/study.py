"""`mechsheet study`: millions of designs, those kept as Parquet, the best as a table."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from livesheet.diagnostics import Fault
from livesheet.said import Said, say, say_count
from mechsheet.diagnostics import MechanismError

from .common import FILE, FORMATS_COMPLETED, Explained, at_lines_of, bar_of, change_options, described, on_terminal
from .speaking import told

if TYPE_CHECKING:
    from mechsheet.studies.ranking import Studied
    from mechsheet.studies.run import Progress


@click.command(cls=Explained, short_help="Try millions of designs and keep the good ones.")
@click.argument("description", type=FILE)
@click.option("-o", "--output", required=True, metavar="FOLDER", type=FILE, help="Folder to write into.")
@click.option("--workers", type=click.IntRange(1), metavar="N", help="Number of processes.  [default: one per core]")
@click.option("--on", metavar="ADDRESS", help="Compute on a Dask scheduler: tcp://HOST:8786.")
@click.option("--resume", is_flag=True, help="Continue the study in the folder.")
@click.option("--limit-memory", metavar="SIZE", help="Memory for all processes together, such as 2GiB.")
@click.option(
    "--format",
    "formats",
    shell_complete=FORMATS_COMPLETED,
    help="Of the summary workbook: xlsx, ods, or both with a comma.  [default: xlsx]",
)
@change_options
def study(
    description: Path,
    output: Path,
    workers: int | None,
    on: str | None,
    resume: bool,
    limit_memory: str | None,
    formats: str | None,
    **changes: Any,
) -> None:
    """Try the designs that [study] of the description asks for: grids or samples of any size.

    \b
    mechsheet study wiper.toml -o wiper                        on all cores
    mechsheet study wiper.toml -o wiper --resume               continues
    mechsheet study wiper.toml -o wiper --on tcp://10.0.0.5:8786

    It writes FOLDER/parts/*.parquet (a row for each design that meets all conditions), study.json, result.json, the
    summary workbook study.xlsx and the picture study.svg, and prints the best designs, with * for those on the front. The
    same study gives the same bytes, however it was computed. `mechsheet build wiper.toml --design wiper:17` writes the
    workbook of design 17.
    """
    from mechsheet.library.studying import bytes_of, known_formats
    from mechsheet.studies.run import studied

    mechanism = described(description, **changes)
    memory = bytes_of(limit_memory)
    forms = known_formats(formats)
    with at_lines_of(mechanism, description), _bar() as tell:
        found = studied(
            mechanism, output, workers=workers, on=on, resume=resume, limit_memory=memory, formats=forms, tell=tell
        )
    with at_lines_of(mechanism, description):
        _tell(found)
    click.echo(_table(found))


def _tell(found: Studied) -> None:
    """The counts; where nothing is kept they are an error."""
    result = found.result
    lines = [say("{count:>16,} fail {condition}", count=count, condition=text) for text, count in result.failed]
    if not result.kept and result.failed:
        hint = say("each design is counted once, by the first condition that it fails:{lines}", lines=_below(lines))
        message = say("none of {designs} meets all conditions", designs=_designs(result.designs))
        raise MechanismError(Fault(message, key="study.keep", hint=hint))
    share = 100 * result.kept / result.designs
    kept = say(
        "{kept:>16,} kept of {designs} ({share:.3g} %)", kept=result.kept, designs=_designs(result.designs), share=share
    )
    lines.append(kept)
    if result.apart:
        lines.append(
            say(
                "{count:>16,} of them set apart, not ranked: a number that decides is marked in the workbook (rows only, "
                "grows without bound)",
                count=result.apart,
            )
        )
    click.echo("\n".join(map(told, lines)), err=True)


def _designs(count: int) -> Said:
    return say_count("{count:,} design", "{count:,} designs", count)


def _below(lines: Sequence[Said]) -> Said:
    """Each on a line of its own, to be said as a whole."""
    whole = say("")
    for line in lines:
        whole = say("{above}\n{line}", above=whole, line=line)
    return whole


def _table(found: Studied) -> str:
    """The best designs, one a line; * marks those on the front."""
    from mechsheet.studies.designs import DESIGN
    from mechsheet.studies.parts import heads_of, told_of

    if found.best is None:
        return ""
    front = set(found.ranked.front.tolist())
    best, remarks = told_of(found.best)
    heads = ["", *heads_of(best)]
    rows = [
        ["*" if row[DESIGN] in front else "", *("–" if value is None else f"{value:.7g}" for value in row.values())]
        for row in best.to_pylist()
    ]
    widths = [max(len(line[at]) for line in [heads, *rows]) for at in range(len(heads))]
    return "\n".join(
        "  ".join([*(text.rjust(width) for text, width in zip(line, widths, strict=True)), *([said] if said else [])])
        for line, said in zip([heads, *rows], [None, *remarks], strict=True)
    )


def _bar() -> AbstractContextManager[Callable[[Progress], None]]:
    """A bar on a terminal: designs, share kept, designs a second, time left; nothing in a pipe."""
    begun = time.monotonic()

    def line(progress: Progress) -> str:
        passed = max(time.monotonic() - begun, 1e-9)
        rate = (progress.done - progress.earlier) / passed
        words = f"{bar_of(progress.done, progress.all)} " + told(
            say("{done:,} of {designs}", done=progress.done, designs=_designs(progress.all))
        )
        if progress.done:
            words += told(say(", {share:.3g} % kept", share=100 * progress.kept / progress.done))
        if rate:
            left = _duration((progress.all - progress.done) / rate)
            words += told(say(", {rate:,.0f}/s, {left} left", rate=rate, left=left))
        return words

    return on_terminal(line)


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    clock = f"{hours}:{minutes:02d}:{rest:02d}" if hours or days else f"{minutes}:{rest:02d}"
    return f"{days} d {clock}" if days else clock
