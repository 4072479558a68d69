"""The Turkish of messages, by their English patterns; see `said`. A module for each subject."""

from __future__ import annotations

from dataclasses import replace

from mechsheet.diagnostics import Fault
from mechsheet.said import in_turkish

from .asked import ASKED
from .checks import CHECKS
from .commands import COMMANDS
from .files import FILES
from .formulas import FORMULAS
from .library import LIBRARY
from .mechanism import MECHANISM
from .studies import STUDIES
from .text import TEXT

TURKISH: dict[str, str] = TEXT | MECHANISM | ASKED | CHECKS | LIBRARY | STUDIES | FILES | FORMULAS | COMMANDS


def text_in(text: str, language: str) -> str:
    """A message in "en" or "tr"."""
    return in_turkish(text, TURKISH) if language == "tr" else text


def in_language(fault: Fault, language: str) -> Fault:
    """A fault with its message and its hint in "en" or "tr"."""
    return replace(fault, message=text_in(fault.message, language), hint=text_in(fault.hint, language))
