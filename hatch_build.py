"""What a package index shows: README without what leads to other files of the repository, which the index does not have."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

_PICTURE = re.compile(r"!\[[^\]]*\]\([^)]*\)")
_ASIDE = re.compile(r" ?\(\[[^\]]+\]\((?!https?:)[^)]*\)\)")
_LINK = re.compile(r"\[([^\]]+)\]\((?!https?:)[^)]*\)")
_GALLERY = re.compile(r"^## Gallery\n.*?(?=^\[All )", re.DOTALL | re.MULTILINE)


def for_an_index(readme: str) -> str:
    """README without its pictures and its table of them, of links to its files only the words."""
    text = _LINK.sub(r"\1", _ASIDE.sub("", _PICTURE.sub("", _GALLERY.sub("## Gallery\n\n", readme))))
    return re.sub(r"\n{3,}", "\n\n", text)


class Readme(MetadataHookInterface):
    """Sets the long description."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Called by hatchling while wheel and sdist are built."""
        readme = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        metadata["readme"] = {"content-type": "text/markdown", "text": for_an_index(readme)}
