"""What a kind of export is, and what it is asked to do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mechsheet.compiled import Compiled, compiled_of
from mechsheet.model import Mechanism


@dataclass(frozen=True, slots=True)
class Job:
    """One export.

    mechanism  its `language` is the language of the file
    name       what the program, module or drawing is called: the stem of the file
    at         the driver's value in its own unit (degrees, radians or the length unit), or None: the first position
    frames     how many positions of the sweep are wanted, one file each, or None: one position, one file
    """

    mechanism: Mechanism
    name: str
    at: float | None = None
    frames: int | None = None

    @property
    def compiled(self) -> Compiled:
        """The mechanism compiled."""
        return compiled_of(self.mechanism)


Writer = Callable[[Job], list[bytes]]
"""The content of each file: one, or as many as there are frames."""


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of export.

    name        what follows `--to`
    suffix      ending of its files, with the dot
    about       one line for the help
    write       makes the content of the files
    identifier  the file's stem is a name in a programming language: letters, digits and _
    positions   shows one position: takes `at`
    frames      can show several positions, one file each: takes `frames`
    behind      stands behind the stem of a file that nobody names, where `plot` would write a file of that name
    """

    name: str
    suffix: str
    about: str
    write: Writer
    identifier: bool = False
    positions: bool = False
    frames: bool = False
    behind: str = ""
