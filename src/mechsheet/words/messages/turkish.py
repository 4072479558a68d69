"""The Turkish of all messages, by their English patterns."""

from __future__ import annotations

from .asked import ASKED
from .cams import CAMS
from .checks import CHECKS
from .commands import COMMANDS
from .files import FILES
from .formulas import FORMULAS
from .library import LIBRARY
from .mechanism import MECHANISM
from .studies import STUDIES
from .text import TEXT

TURKISH: dict[str, str] = TEXT | MECHANISM | CAMS | ASKED | CHECKS | LIBRARY | STUDIES | FILES | FORMULAS | COMMANDS
