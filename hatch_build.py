"""What building adds: the catalogues of languages, compiled; and README for a package index.

An index does not have the other files of the repository: its README is without what leads to them.
"""

from __future__ import annotations

import re
import runpy
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
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


class Catalogues(BuildHookInterface):
    """Puts a compiled catalogue into the wheel for each one of the sources."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by hatchling before a wheel is built; an editable one reads the sources themselves."""
        if version == "editable":
            return
        words = Path(self.root) / "src" / "mechsheet" / "words"
        compiled = runpy.run_path(str(words / "compiling.py"))["compiled"]
        self.folder = tempfile.TemporaryDirectory()
        for path in sorted((words / "catalogues").glob("*.po")):
            made = Path(self.folder.name) / f"{path.stem}.mo"
            made.write_bytes(compiled(path.read_text(encoding="utf-8")))
            build_data["force_include"][str(made)] = f"mechsheet/words/catalogues/{made.name}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Called when the wheel is there."""
        if version != "editable":
            self.folder.cleanup()
