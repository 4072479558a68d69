"""What a workbook sets about computing that is not done here: it is said, and the values stored in the file are kept."""

from __future__ import annotations

from livesheet.diagnostics import Fault
from livesheet.formula.book import Settings
from livesheet.said import say


def settings_remarks(settings: Settings, file: str) -> list[Fault]:
    """The remarks on a file with these settings."""
    if not settings.as_shown:
        return []
    message = say("every value is rounded as it is shown (a setting of this workbook): stored values are kept")
    return [Fault(message, file, hint=say("switch “precision as displayed” off to have it computed"))]
