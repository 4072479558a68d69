"""The description: TOML text in, a model out, every fault reported at once."""

from mechsheet.description.reader import load, loads

__all__ = ["load", "loads"]
