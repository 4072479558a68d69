"""Messages in the language of whoever reads them; see `said`. A module for each subject has their Turkish."""

from __future__ import annotations

from dataclasses import replace

from livesheet.diagnostics import Fault
from livesheet.said import in_turkish


def text_in(text: str, language: str) -> str:
    """A message in "en" or "tr"."""
    if language != "tr":
        return text
    from .turkish import TURKISH  # a thousand texts, and most messages are English

    return in_turkish(text, TURKISH)


def in_language(fault: Fault, language: str) -> Fault:
    """A fault with its message and its hint in "en" or "tr"."""
    return replace(fault, message=text_in(fault.message, language), hint=text_in(fault.hint, language))
