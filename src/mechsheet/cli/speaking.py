"""Which language the command line speaks: that of the description, or else of the machine; English where it has neither.

What other programs read (--json, --csv, --junit, the names of files) is the same everywhere.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

import click

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError
from mechsheet.words.catalogue import ENGLISH, LANGUAGES

_KEY = "mechsheet.language"
"""Where click's contexts, which share one mapping, keep the language of what is worked on."""

_IN_DESCRIPTION = re.compile(r"""^[^#\n]*\blanguage\s*=\s*["'](\w+)["']""", re.MULTILINE)
"""`language = "tr"`, also in a description that has other faults."""


def machine_language(environment: Mapping[str, str] = os.environ) -> str:
    """What the machine is set to, as other programs read it (LANGUAGE, LC_ALL, LC_MESSAGES, LANG).

    On Windows, where these are seldom set, the language of its menus.
    """
    locale = next((value for name in ("LC_ALL", "LC_MESSAGES", "LANG") if (value := environment.get(name))), "")
    if not locale:
        return _menus()
    plain = locale.partition(".")[0] in ("C", "POSIX")
    wanted = locale if plain else environment.get("LANGUAGE") or locale
    return _ours(wanted)


def _menus() -> str:
    """The language of Windows' menus; English elsewhere."""
    if sys.platform != "win32":
        return ENGLISH
    import ctypes
    import locale

    number: int = ctypes.windll.kernel32.GetUserDefaultUILanguage()
    return _ours(locale.windows_locale.get(number, ""))


def _ours(wanted: str) -> str:
    """The language of a locale, tr of tr_TR.UTF-8, where there is a catalogue of it; else English."""
    language = re.split(r"\W|_", wanted)[0]
    return language if language in LANGUAGES else ENGLISH


def language_of(text: str) -> str:
    """The language that a description names, whatever else is wrong with it; "" when it names none."""
    found = _IN_DESCRIPTION.search(text)
    return found[1] if found else ""


def speak(language: str | None) -> None:
    """Say in which language what is worked on is: --language, or else the description's."""
    context = click.get_current_context(silent=True)
    if context is not None and language:
        context.meta[_KEY] = language


def speak_of(path: Path) -> None:
    """The same of a description that is about to be read elsewhere."""
    from mechsheet.description.text.source import read_text

    if path.suffix.lower() == ".toml":
        with suppress(MechsheetError):  # told by whoever reads it next
            speak(language_of(read_text(path)))


def spoken() -> str:
    """The language of messages."""
    context = click.get_current_context(silent=True)
    ours = None if context is None else context.meta.get(_KEY)
    return ours if ours in LANGUAGES and ours != ENGLISH else machine_language()


def told(text: str) -> str:
    """A text as it is printed: what was said, in the language that is spoken."""
    if spoken() == ENGLISH:
        return text
    from mechsheet.words.catalogue import text_in

    return text_in(text, spoken())


def fault_told(fault: Fault) -> str:
    """A fault as it is printed."""
    if spoken() == ENGLISH:
        return str(fault)
    from mechsheet.words.catalogue import in_language

    return str(in_language(fault, spoken()))


def note(text: str) -> None:
    """`note: …` on standard error."""
    click.echo(told(say("note: {text}", text=text)), err=True)


def wrote(name: str) -> None:
    """`wrote mine.toml` on standard error."""
    click.echo(told(say("wrote {name}", name=name)), err=True)
