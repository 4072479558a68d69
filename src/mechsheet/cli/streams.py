"""Standard output and the end of a command: code pages that lack signs, full disks, closed pipes, signals."""

from __future__ import annotations

import codecs
import errno
import io
import os
import signal
import sys
import threading
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import NoReturn

import click

from livesheet.diagnostics import system_reason
from livesheet.said import say

from .speaking import told

STOPPED = 130
"""Exit code after Ctrl-C, as shells have it: 128 and the number of the signal."""
CLOSED = 141
"""Exit code when the reader of our output has gone."""

_SIGNALS = ("SIGTERM", "SIGHUP")
_WORDS = {
    "°": " deg", "′": "'", "″": '"', "−": "-", "–": "-", "—": "-", "…": "...", "·": "*", "×": "x", "→": "->", "↔": "<->",
    "≤": "<=", "≥": ">=", "≠": "!=", "≈": "~", "±": "+-", "√": "sqrt", "∞": "inf", "²": "^2", "³": "^3", "ı": "i",
    "“": '"', "”": '"', "„": '"', "‘": "'", "’": "'", "•": "*", "Δ": "delta ", "ø": "o", "Ø": "O", "ß": "ss",
}  # fmt: skip
"""Signs that a code page may lack, in letters; Greek letters are called by their names."""


def _plainer(error: UnicodeError) -> tuple[str | bytes, int]:
    """What stands for signs that the output's code page lacks."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = "".join(_plain(sign) for sign in error.object[error.start : error.end])
    try:
        text.encode(error.encoding)
    except UnicodeEncodeError:
        text = text.encode("ascii", "replace").decode("ascii")
    return text, error.end


def _plain(sign: str) -> str:
    if sign in _WORDS:
        return _WORDS[sign]
    name = unicodedata.name(sign, "")
    if name.startswith("GREEK SMALL LETTER ") and " WITH " not in name:
        return name.rsplit(" ", 1)[-1].lower()
    letters = "".join(part for part in unicodedata.normalize("NFKD", sign) if part.isascii())
    return letters or "?"


codecs.register_error("mechsheet.plainer", _plainer)


def prepare_streams() -> None:
    """Signs that the code page of the output or of the messages lacks are written plainer instead of failing."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="mechsheet.plainer")


def print_file(content: str | bytes) -> None:
    """Print what is a file by rights (a description, a drawing, a table): UTF-8, whatever the code page of the screen."""
    # A file name that is no Unicode text comes as half a pair, which JSON may hold as an escape.
    click.echo(content.encode("utf-8", "backslashreplace") if isinstance(content, str) else content, nl=False)


@contextmanager
def ending_well() -> Iterator[None]:
    """Ctrl-C, and output that nobody takes, end the program with a short word or none; what else fails goes on."""
    try:
        yield
    except KeyboardInterrupt:
        _leave(STOPPED, told(say("stopped")))
    except OSError as error:
        # Everything that has to do with a file of the user's names it, or has become a MechsheetError.
        if error.filename is not None:
            raise
        if error.errno == errno.EPIPE or (os.name == "nt" and error.errno == errno.EINVAL):
            _leave(CLOSED)
        _leave(2, told(say("the output cannot be written: {reason}", reason=system_reason(error))))


def _leave(code: int, words: str = "") -> NoReturn:
    """End with that code; what is still to be written to standard output is given up."""
    with suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
    with suppress(OSError):
        if words:
            click.echo(words, err=True)
    raise SystemExit(code)


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """SIGTERM and SIGHUP end the program as an exception does: temporary files are removed, old ones stay whole."""

    def end(number: int, _: FrameType | None) -> NoReturn:
        raise SystemExit(128 + number)

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    numbers = [getattr(signal, name) for name in _SIGNALS if hasattr(signal, name)]
    # What was ignored (nohup) stays ignored.
    before = {number: signal.getsignal(number) for number in numbers}
    taken = [number for number in numbers if before[number] == signal.SIG_DFL]
    for number in taken:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, before[number])
