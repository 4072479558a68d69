"""`python -m mechsheet`, and what the command `mechsheet` runs: one job in a process of its own."""

from __future__ import annotations

import atexit
import gc

from .cli import main

_MANY = 200_000
"""Objects that are made before it is looked for circles among them, which trees and tables hardly have; Python looks after
700. That and the search when the process ends took a sixth of the time of a command. A small workbook is built and checked
with fewer objects than this; 50,000 still took a fortieth of both, and no memory was saved."""


def run() -> None:
    """The command line, in a process that ends with it."""
    gc.set_threshold(_MANY)
    atexit.register(gc.freeze)  # what is left then goes with the process, and nothing is searched
    main()


if __name__ == "__main__":
    run()
