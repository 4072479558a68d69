"""What a description said before it was changed on its way into a workbook, as a comment that travels in its text.

Options change it (a length, the rows, bands), and so does what its sketch shows (a redundant link, the turn of a phase). Who
asks later whether the file was changed since the workbook was built must not take that for a change of the file.
"""

from __future__ import annotations

import hashlib
import json
import re
from typing import Any

from mechsheet.description.text.source import parse

_OF_BUILD = ("layout", "language", "references")
"""Keys of [workbook] that do not change a number, and that `build` has options for."""

_MARK = "# changed when it was built from a description of the fingerprint "
_MARKED = re.compile(rf"^{_MARK}(\w+)\n?", re.MULTILINE)


def meaning(text: str, file: str) -> dict[str, Any]:
    """The data of a text that decide what is built; `file` is what messages call it."""
    data = parse(text, file).data
    workbook = data.get("workbook", {})
    if isinstance(workbook, dict):
        data = {**data, "workbook": {key: value for key, value in workbook.items() if key not in _OF_BUILD}}
    return data


def with_origin(text: str, read: str, file: str) -> str:
    """The text that was made of `read`, marked with the fingerprint of that where it means something else."""
    if text == read or _MARKED.search(text):
        return text
    origin = meaning(read, file)
    return text if meaning(text, file) == origin else f"{text.rstrip()}\n{_MARK}{_fingerprint(origin)}\n"


def without_origin(text: str) -> str:
    """The text without that mark: it is a description of its own."""
    return _MARKED.sub("", text)


def is_origin(data: dict[str, Any], text: str) -> bool:
    """Whether a text was made of the description that means `data`."""
    mark = _MARKED.search(text)
    return mark is not None and mark[1] == _fingerprint(data)


def _fingerprint(data: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(data, sort_keys=True, default=str).encode()).hexdigest()[:16]
