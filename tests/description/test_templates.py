"""Packaged descriptions are found, and every one of them loads."""

import pytest

from mechsheet.description import loads
from mechsheet.description.templates import template_names, template_text
from mechsheet.diagnostics import DescriptionError


def test_there_are_templates() -> None:
    assert {"four-bar", "slider-crank"} <= set(template_names())
    assert list(template_names()) == sorted(template_names())


@pytest.mark.slow
def test_all_load_under_their_own_names() -> None:
    for name in template_names():
        assert loads(template_text(name), f"{name}.toml").name == name


def test_suffix_may_be_written() -> None:
    assert template_text("four-bar.toml") == template_text("four-bar")


@pytest.mark.parametrize("name", ["for-bar", "Four-Bar"])
def test_near_miss(name: str) -> None:
    with pytest.raises(DescriptionError, match=f'no template is called "{name}"\n +=.*did you mean "four-bar"'):
        template_text(name)


@pytest.mark.parametrize("name", ["", "../pyproject", "/etc/passwd", "four-bar/", "."])
def test_names_only(name: str) -> None:
    with pytest.raises(DescriptionError, match="no template is called"):
        template_text(name)
