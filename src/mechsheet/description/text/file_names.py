"""Names of files that every system can have."""

from __future__ import annotations

import re

_DEVICE = re.compile(r"(con|prn|aux|nul|(com|lpt)[0-9¹²³])(\..*)?", re.IGNORECASE)
_NEVER = re.compile(r'[<>:"/\\|?*\x00-\x1f]')


def is_device(name: str) -> bool:
    """Whether Windows takes a name for a device, whatever its ending: what is written there is lost."""
    return _DEVICE.fullmatch(name) is not None


def is_file_name(name: str) -> bool:
    """Whether a name is that of a file in a folder, on Linux, macOS and Windows alike: no path, no device, not hidden."""
    return not (_NEVER.search(name) or name.startswith(".") or name != name.rstrip(". ") or is_device(name))
