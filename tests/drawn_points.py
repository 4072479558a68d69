"""Pictures hold no lengths: where points should be is compared after the one scale and shift that fit best."""

import numpy as np

from mechsheet.shapes.described import moving_points, pins_of


def fitted(found, true):
    """(scale, worst distance) of the map  found = scale * true + shift  with one scale for both axes, y up."""
    found, true = np.asarray(found, float), np.asarray(true, float)
    center_found, center_true = found.mean(axis=0), true.mean(axis=0)
    a, b = found - center_found, true - center_true
    scale = float((a * b).sum() / (b * b).sum())
    return scale, float(np.abs(a - scale * b).max())


def drawn_points(mechanism):
    """Names of the points that the drawing marks: those with rings, and the others."""
    pins = pins_of(mechanism)
    return pins, tuple(name for name in moving_points(mechanism) if name not in pins)


def expected(mechanism, solution, row):
    """The reference's places of all marked points, in the order of the drawing."""
    return np.array([solution.points[name][row] for names in drawn_points(mechanism) for name in names])
