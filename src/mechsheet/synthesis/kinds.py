"""The kinds of synthesis: one line each."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from mechsheet.model import Synthesis
from mechsheet.synthesis import dead_centres, function, guidance, quick_return
from mechsheet.synthesis.kind import Kind
from mechsheet.synthesis.writing import Task, Units, Writer

KINDS: Mapping[str, Kind] = {
    "function": function.KIND,
    "dead-centres": dead_centres.KIND,
    "guidance": guidance.KIND,
    "quick-return-slider": quick_return.SLIDER,
    "quick-return-lever": quick_return.LEVER,
}


def kind_of(task: Synthesis) -> Kind:
    """What its kind declares."""
    return KINDS[task.kind]


def written(kind: str, task: Task, units: Units, own: Collection[str], plain: Collection[str]) -> Writer:
    """The inputs, steps and results of a task; `own`, `plain` as of `Writer`."""
    writer = Writer(task, units, own, plain)
    KINDS[kind].write(writer)
    return writer
