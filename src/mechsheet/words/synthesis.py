"""What the inputs of a synthesis and the steps of its solution are."""

from __future__ import annotations

from livesheet.said import Words

from .catalogue import Phrase

ENDS = (Phrase("step.end.first"), Phrase("step.end.last"))


def step_words(key: str, **parts: object) -> Words:
    """What an input of a task or a step of its solution is, its {parts} filled in."""
    return Phrase(f"step.{key}", tuple(parts.items()))
