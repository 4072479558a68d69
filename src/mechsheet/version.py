"""Which release this is: for all that say it, and for the package that is built."""

__version__ = "1.0.0"
