"""The fast path: runs of formulas as straight-line numpy code, where everything is plain numbers."""
