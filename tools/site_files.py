"""For mkdocs: pages link to ../templates and ../generated, where the files lie in the repository; the site has copies.

So a link leads to the same file when the page is read in the repository and when it is read on the site.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parent.parent
FOLDERS = ("templates", "generated")


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the descriptions and the finished workbooks."""
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).iterdir()):
            if path.suffix in (".toml", ".xlsx", ".ods"):
                files.append(File.generated(config, f"{folder}/{path.name}", abs_src_path=str(path)))
    return files


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Links to them as they are on the site."""
    return re.sub(rf"\]\(\.\./({'|'.join(FOLDERS)})/", r"](\1/", markdown)
