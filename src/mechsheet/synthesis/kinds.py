"""The kinds of synthesis: one line each."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from mechsheet.synthesis import dead_centres, function, guidance, quick_return_lever, quick_return_slider
from mechsheet.synthesis.writing import Kind, Task, Units, Writer

KINDS: Mapping[str, Kind] = {
    "function": function.write,
    "dead-centres": dead_centres.write,
    "guidance": guidance.write,
    "quick-return-slider": quick_return_slider.write,
    "quick-return-lever": quick_return_lever.write,
}


def written(kind: str, task: Task, units: Units, own: Collection[str], plain: Collection[str]) -> Writer:
    """The inputs, steps and results of a task; `own`, `plain` as of `Writer`."""
    writer = Writer(task, units, own, plain)
    KINDS[kind](writer)
    return writer
