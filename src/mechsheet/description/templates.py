"""The packaged descriptions that `mechsheet new` starts from."""

from __future__ import annotations

from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from mechsheet.diagnostics import DescriptionError, Fault, near_miss


def _folder() -> Traversable:
    """The wheel carries the templates inside the package; in a checkout they lie beside `src`."""
    packaged = files("mechsheet") / "templates"
    return packaged if packaged.is_dir() else Path(__file__).parents[3] / "templates"


def template_names() -> tuple[str, ...]:
    """Names of the templates, in alphabetical order."""
    names = (entry.name for entry in _folder().iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))


def template_text(name: str) -> str:
    """The description of that name, as it lies in the package. Raises DescriptionError for a name that is none."""
    names = template_names()
    if name not in names:
        hint = near_miss(name, names) or f"templates: {', '.join(names)}"
        raise DescriptionError(Fault(f'no template is called "{name}"', hint=hint))
    return (_folder() / f"{name}.toml").read_text(encoding="utf-8")
