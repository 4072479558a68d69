"""Where files go: what a name given for an output means, the same in every command and function that writes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from livesheet.replacing import make_folder

_SLASHES = tuple(sign for sign in (os.sep, os.altsep, "/") if sign)


def names_folder(output: str | Path) -> bool:
    """Whether a name means a folder to write into: an existing folder, or a name that ends with a slash."""
    try:
        return str(output).endswith(_SLASHES) or Path(output).is_dir()
    except (OSError, ValueError):  # a name too long, a null character: whoever writes there says so
        return False


def is_there(path: Path) -> bool:
    """Whether a file or folder of that name can be seen."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


def file_in(output: str | Path | None, default: str) -> Path:
    """The file to write: the one that `output` names, or `default` in the folder that it names, or `default` here."""
    if output is None:
        return Path(default)
    return Path(output) / default if names_folder(output) else Path(output)


@contextmanager
def folder_ready(output: str | Path | None) -> Iterator[None]:
    """The folder that `output` names is there while files are written; a new one goes again when nothing was.

    Raises OutputError when it cannot be made (its own folder must be there: a misspelt path is told).
    """
    folder = Path(output) if output is not None and names_folder(output) else None
    if folder is None or is_there(folder):
        yield
        return
    make_folder(folder)
    try:
        yield
    except BaseException:
        with suppress(OSError):  # something was written: the folder stays
            folder.rmdir()
        raise
