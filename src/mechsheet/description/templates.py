"""The packaged descriptions to start from: one file per mechanism, each with its source and what to look at."""

from __future__ import annotations

from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from livesheet.diagnostics import Fault
from livesheet.said import Words, say
from mechsheet.description.report import suggestion
from mechsheet.diagnostics import DescriptionError, quoted

_SUFFIX = ".toml"


def template_names() -> tuple[str, ...]:
    """The names that `template_text` knows, in alphabetical order."""
    return tuple(sorted(entry.name.removesuffix(_SUFFIX) for entry in _folder().iterdir() if _is_template(entry)))


def template_titles() -> dict[str, Words]:
    """Name -> title, in alphabetical order of the names."""
    from mechsheet.description.reader import loads

    return {name: loads(template_text(name), name).title for name in template_names()}


def template_text(name: str) -> str:
    """The text of a packaged description; "four-bar" and "four-bar.toml" are the same.

    Raises DescriptionError with the near miss when there is no such template.
    """
    stem, names = name.removesuffix(_SUFFIX), template_names()
    if stem not in names:
        raise DescriptionError(
            Fault(say("no template is called {name}", name=quoted(name)), hint=suggestion(stem, names, "templates"))
        )
    return (_folder() / (stem + _SUFFIX)).read_text(encoding="utf-8")


def _folder() -> Traversable:
    """Inside the package in an installation; beside `src` in a source checkout."""
    packaged = files("mechsheet") / "templates"
    return packaged if packaged.is_dir() else Path(__file__).parents[3] / "templates"


def _is_template(entry: Traversable) -> bool:
    return entry.is_file() and entry.name.endswith(_SUFFIX) and not entry.name.startswith(".")
