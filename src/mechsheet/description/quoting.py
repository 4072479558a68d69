"""How messages show what somebody has written: in quotes, shortened, and safe to print."""

from __future__ import annotations

MOST = 60
"""Characters of somebody's text that a message shows."""


def printable(text: str) -> str:
    """The text with everything that could disturb a terminal written as an escape."""
    return "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in text)


def quoted(text: str) -> str:
    """The text in quotes, shortened, and safe to print."""
    text = printable(text)
    return f'"{text}"' if len(text) <= MOST else f'"{text[: MOST - 1]}…"'
