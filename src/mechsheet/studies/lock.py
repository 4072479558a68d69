"""One study at a time in a folder: a lock that the system holds for a process, and lets go of however the process ends.

The file alone says nothing: one that a killed study has left is locked by nobody, and the next study takes it. On a file
system that has no locks a study goes on without one; then the parts, which name their study, tell what was mixed.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from livesheet.diagnostics import Fault, OutputError, readable_name
from livesheet.replacing import output_error
from livesheet.said import say

NAME = ".study.lock"
"""The file that is locked, in the study's folder."""

if sys.platform == "win32":
    import msvcrt

    def _lock(file: int) -> None:
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder that is there. Raises OutputError where another study holds it, or nobody may write."""
    path = folder / NAME
    file = _taken(path)
    try:
        yield
    finally:
        if sys.platform == "win32":  # an open file cannot be removed there
            os.close(file)
        with suppress(OSError):
            path.unlink()
        if sys.platform != "win32":
            os.close(file)


def _taken(path: Path) -> int:
    """The lock's file, open and locked."""
    while True:
        try:
            file = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        except OSError as error:
            if sys.platform == "win32" and isinstance(error, PermissionError) and path.exists():
                raise _busy(path) from error  # it is being removed
            raise output_error(path, error) from error
        try:
            _lock(file)
        except (BlockingIOError, PermissionError) as error:
            os.close(file)
            raise _busy(path) from error
        except OSError:
            return file  # a file system without locks
        if _is_at(path, file):
            return file
        os.close(file)  # whoever held it has removed it: it locks nothing any more


def _is_at(path: Path, file: int) -> bool:
    """Whether the file is still the one of that name."""
    try:
        return os.path.samestat(path.stat(), os.fstat(file))
    except OSError:
        return False


def _busy(path: Path) -> OutputError:
    message = say("another study is being computed in this folder")
    hint = say("wait for its end, or name another folder with -o")
    return OutputError(Fault(message, readable_name(path.parent), hint=hint))
