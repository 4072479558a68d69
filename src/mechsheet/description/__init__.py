"""The description: TOML text in, a model out, every fault reported at once."""

from mechsheet.description.overrides import Overrides
from mechsheet.description.reader import load, loads
from mechsheet.description.text.source import MAX_BYTES, text_of

__all__ = ["MAX_BYTES", "Overrides", "load", "loads", "text_of"]
