"""Files replaced so that a failure leaves the old one whole, folders made, and why that may fail."""

from __future__ import annotations

import errno
import os
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from livesheet.diagnostics import Fault, OutputError, readable_name, system_reason
from livesheet.said import say

_REASONS = {
    errno.ENOSPC: say("the disk is full"),
    errno.EDQUOT: say("the disk quota is used up"),
    errno.EACCES: say("no permission to write here (or the file is open in another program)"),
    errno.EPERM: say("no permission to write here (or the file is open in another program)"),
    errno.EROFS: say("the disk is read-only"),
    errno.ENOENT: say("there is no such folder"),
    errno.ENOTDIR: say("there is no such folder"),
    errno.EISDIR: say("this is a folder"),
    errno.EEXIST: say("this is a file, not a folder"),
    errno.ENAMETOOLONG: say("the file name is too long"),
    errno.ELOOP: say("the link leads round to itself"),
}


@contextmanager
def replacing(path: Path) -> Iterator[BinaryIO]:
    """A new file that becomes `path` when the block ends well and is removed when it does not.

    A symbolic link stays one: what it leads to is replaced. A device or a pipe is written through once all is there.
    Raises OutputError for everything that the system refuses (no folder, no permission, a full disk, a folder of
    that name); BrokenPipeError when the reader of a pipe has gone.
    """
    try:
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, "is a directory")
        with _written_through(path) if is_stream(path) else _written_beside(path) as file:
            yield file
    except BrokenPipeError:
        raise
    except (OSError, ValueError) as error:
        if isinstance(error, ValueError) and "\0" not in str(path):
            raise
        raise output_error(path, error) from error


@contextmanager
def _written_beside(path: Path) -> Iterator[BinaryIO]:
    """A new file in the folder of what `path` leads to, moved into place when the block ends well."""
    place = path
    if path.is_symlink():
        place = Path(os.path.realpath(path))
        with suppress(FileNotFoundError):  # it may lead to a file that is not there yet, but not round to itself
            place.stat()
    temporary = place.with_name(f".{place.name}.{os.urandom(4).hex()}.tmp")
    try:
        with temporary.open("xb") as file:
            yield file
        if place.exists():
            shutil.copymode(place, temporary)
        temporary.replace(place)
    finally:
        # After a success there is nothing left to remove; after a failure nothing may hide its cause.
        with suppress(OSError, ValueError):
            temporary.unlink(missing_ok=True)


@contextmanager
def _written_through(path: Path) -> Iterator[BinaryIO]:
    """A file without a name (an archive must be able to go back in it), copied into `path` when the block ends well."""
    with tempfile.TemporaryFile() as held:
        yield held
        held.seek(0)
        with path.open("ab") as stream:
            shutil.copyfileobj(held, stream)


def is_stream(path: Path) -> bool:
    """Whether `path` is a device or a pipe: what is written goes somewhere, and there is no file to replace.

    `/dev/stdout` is one wherever it leads to: whoever redirected it holds the file open.
    """
    if path.is_absolute() and path.parts[1:2] in (("dev",), ("proc",)):
        return True
    try:
        mode = path.stat().st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def replace_file(path: Path, data: bytes) -> None:
    """Make `data` the content of the file `path`, or leave it as it was and raise OutputError."""
    with replacing(path) as file:
        file.write(data)


def make_folder(path: Path) -> None:
    """The folder that files are to be written into, made when its own folder is there; OutputError when it cannot be."""
    try:
        path.mkdir(exist_ok=True)
    except (OSError, ValueError) as error:
        raise output_error(path, error) from error


def output_error(path: Path, error: OSError | ValueError) -> OutputError:
    """What is told where a file or folder cannot be written."""
    if isinstance(error, OSError):
        reason = _REASONS.get(error.errno or 0) or system_reason(error)
    else:
        reason = say("a null character in the name")
    return OutputError(Fault(say("cannot be written: {reason}", reason=reason), file=readable_name(path)))
