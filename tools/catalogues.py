"""Puts the entries of every catalogue in order: `python tools/catalogues.py`, after texts were added."""

import re
from pathlib import Path

FOLDER = Path(__file__).parents[1] / "src" / "mechsheet" / "words" / "catalogues"
ID = re.compile(r'^(msgctxt|msgid) (".*")$', re.MULTILINE)


def place(entry: str) -> list[str]:
    """Where an entry belongs: what has a context is behind what has none."""
    found = dict(ID.findall(entry))
    return [found.get("msgctxt", ""), found["msgid"]]


def ordered(text: str) -> str:
    """A catalogue with its entries in order."""
    head, *entries = text.rstrip("\n").split("\n\n")
    return "\n\n".join([head, *sorted((entry.strip("\n") for entry in entries), key=place)]) + "\n"


if __name__ == "__main__":
    for path in FOLDER.glob("*.po"):
        path.write_text(ordered(path.read_text(encoding="utf-8")), encoding="utf-8")
