"""`generated/` is, byte for byte, what `build` makes of `templates/` now."""

from pathlib import Path

import pytest

from mechsheet.building import FORMATS, build
from mechsheet.description import load

ROOT = Path(__file__).parent.parent
TEMPLATES = sorted((ROOT / "templates").glob("*.toml"))


def test_nothing_else_is_there():
    expected = {f"{template.stem}.{suffix}" for template in TEMPLATES for suffix in FORMATS}
    assert len(expected) >= 42
    assert {path.name for path in (ROOT / "generated").iterdir()} == expected


@pytest.mark.parametrize("template", TEMPLATES, ids=lambda path: path.stem)
def test_same_bytes(template, tmp_path):
    for path in build(load(template), tmp_path, FORMATS):
        assert path.read_bytes() == (ROOT / "generated" / path.name).read_bytes(), f"{path.name}: run `make demo`"
