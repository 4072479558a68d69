"""The seal of a workbook: a digest of its parts among its properties. Whoever saves the file anew breaks it."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

from .archive import contents_of
from .reading.package import DAMAGED

PROPERTIES = ("docProps/core.xml", "meta.xml")
"""Where the properties of an .xlsx and of an .ods stand; this part is written last and is not under the seal."""

_SEAL = re.compile(rb"[A-Za-z]+:([0-9a-f]{32})")
_MOST = 1 << 20
"""Properties are small; a larger part of that name is something else."""


def seal(author: str, contents: str) -> str:
    """The seal as the properties hold it: the program that wrote the file, and the digest of all other parts."""
    return f"{author}:{contents}"


def is_untouched(path: Path) -> bool:
    """Whether a file is a workbook exactly as it was written, by this or another version.

    False for everything else: saved by a spreadsheet program, recalculated with other values, not a workbook. Raises
    OSError when it cannot be read.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            entries = archive.infolist()
            holders = [entry for entry in entries if entry.filename in PROPERTIES]
            if len(holders) != 1 or holders[0].file_size > _MOST:
                return False
            found = _SEAL.findall(archive.read(holders[0]))
    except (*DAMAGED, RuntimeError, ValueError):  # the last two: a password, a name that is no text
        return False
    others = contents_of(entry for entry in entries if entry is not holders[0])
    return found[-1:] == [others.encode()]
