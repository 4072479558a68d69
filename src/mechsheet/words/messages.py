"""Messages in the language of whoever reads them; see `said`."""

from __future__ import annotations

from dataclasses import replace

from livesheet.diagnostics import Fault
from livesheet.said import translated

from .catalogue import ENGLISH, catalogue


def text_in(text: str, language: str) -> str:
    """A message in a language."""
    return text if language == ENGLISH else translated(text, catalogue(language), language)


def in_language(fault: Fault, language: str) -> Fault:
    """A fault with its message and its hint in a language."""
    return replace(fault, message=text_in(fault.message, language), hint=text_in(fault.hint, language))
