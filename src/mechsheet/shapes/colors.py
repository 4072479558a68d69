"""Colours, as RRGGBB: of curves and links, paths, arrows."""

from __future__ import annotations

from mechsheet.model import Link

SERIES = ("1F4E79", "C8501E", "2E8B57", "7B3FA0", "B8860B", "00838F", "AD1457", "5D4037")
"""Of curves and links, in turn."""

PATHS = ("8FAFCB", "E0A98F", "93C7A6", "BFA0CF", "D9BE7E", "80BFC6", "D58FAC", "AD9A92")
"""Of paths behind the drawing: the colours of curves, paler."""

INK, QUIET = "404040", "9AA0A6"
DRIVEN = SERIES[1]
LINKS = tuple(color for color in SERIES if color != DRIVEN)

VELOCITY, ACCELERATION, FORCE, SPRING = "0096FF", "FF0000", "E600C8", "546E7A"
"""No link has these colours."""


PALE = 0.78
"""How much of the way to white the inside of a plate is from its border."""


def pale(color: str) -> str:
    """The colour of a plate inside a border."""
    parts = [int(color[at : at + 2], 16) for at in (0, 2, 4)]
    return "".join(f"{round(part + PALE * (255 - part)):02X}" for part in parts)


def link_color(link: Link, driven: str) -> str:
    """The colour of a link: one for the driven link, the others in turn; grey for the ground."""
    if link.name == driven:
        return DRIVEN
    return INK if link.number == 1 else LINKS[(link.number - 2) % len(LINKS)]
