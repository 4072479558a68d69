"""Synthesis a second time: complex numbers, linear systems and bisection, on plain numbers in radians.

It shares no expression with `mechsheet.synthesis`, whose formulas it judges.
"""
