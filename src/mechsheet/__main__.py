"""`python -m mechsheet`."""

from .cli import main

main()
