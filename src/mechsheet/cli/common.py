"""What the commands share: options, a progress line, and mistakes told with the description's lines."""

from __future__ import annotations

import contextlib
import re
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mechsheet.diagnostics import DescriptionWarning, Fault, MechanismError, MechsheetError, readable_name

if TYPE_CHECKING:
    from mechsheet.model import Mechanism


STANDARD_INPUT = Path("-")


def described(path: Path, settings: tuple[str, ...] = (), language: str | None = None) -> Mechanism:
    """The mechanism of a file, or of standard input when it is called `-`, with the changes of `--set`."""
    from mechsheet.description import MAX_BYTES, load, loads, text_of

    changes = settings_of(settings)
    if path != STANDARD_INPUT:
        return load(path, changes, language)
    text = text_of(sys.stdin.buffer.read(MAX_BYTES + 1), _name_of(path))
    return loads(text, _name_of(path), changes, language)


def _name_of(path: Path) -> str:
    return "<stdin>" if path == STANDARD_INPUT else readable_name(path)


@contextlib.contextmanager
def at_lines_of(mechanism: Mechanism, path: Path) -> Iterator[None]:
    """What is wrong with a mechanism, and what is doubtful, is told with the description's file and line."""
    from mechsheet.description.locate import located

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", DescriptionWarning)
        try:
            yield
        except MechanismError as error:
            raise located(error, mechanism.text, _name_of(path)) from error
    doubts = [warning.message.fault for warning in caught if isinstance(warning.message, DescriptionWarning)]
    for fault in located(MechanismError(dict.fromkeys(doubts)), mechanism.text, _name_of(path)).faults:
        click.echo(f"warning: {fault}", err=True)
    for warning in caught:
        if not isinstance(warning.message, DescriptionWarning):
            warnings.warn_explicit(warning.message, warning.category, warning.filename, warning.lineno)


@contextlib.contextmanager
def progress(label: str) -> Iterator[Callable[[str], None]]:
    """Say on a terminal what is being done; nothing in a pipe."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return

    def say(what: str) -> None:
        click.echo(f"\r\033[K{label}: {what} …", nl=False, err=True)

    try:
        yield say
    finally:
        click.echo("\r\033[K", nl=False, err=True)


_QUOTED = re.compile(r"'(?:[^']|'')*'!")
"""A sheet's name in quotes, in which a `=` means nothing."""


def settings_of(pairs: tuple[str, ...]) -> dict[str, str]:
    """`a1=65` options as a mapping."""
    found = {}
    faults = []
    for pair in pairs:
        quoted = _QUOTED.match(pair)
        start = quoted.end() if quoted else 0
        name, equals, value = pair[start:].partition("=")
        name = pair[:start] + name
        if not equals or not name.strip() or not value.strip():
            faults.append(Fault(f'"{pair}" is not NAME=VALUE', key="--set", hint="for example --set a1=65"))
        found[name.strip()] = value.strip()
    if faults:
        raise MechsheetError(faults)
    return found


SET = click.option(
    "--set", "settings", multiple=True, metavar="NAME=VALUE", help="Change a dimension; may be repeated."
)
JSON = click.option("--json", "as_json", is_flag=True, help="Print JSON.")
