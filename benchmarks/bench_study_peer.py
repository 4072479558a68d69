"""A study beside pylinkage (MIT): the same four-bars with a coupler point, their whole turn, the same heights.

    python benchmarks/bench_study_peer.py [--designs 2000] [--rows 73]

pylinkage's `Ensemble` simulates many sets of dimensions of one linkage, one after another, by numba where it is installed
and by plain Python where not. It is given the crank-rockers only, and asked for positions only; the study is given all
designs, finds the transmission angles, and looks between the rows. Both in one process, CPU time; where pylinkage is not
installed, this says so. Heights of the designs kept are compared one by one.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import importlib.util
import math
import time

import numpy as np
from bench_study import by_hand, designs_of

from mechsheet.studies.chunk import kept_of

GROUND, B3, C3 = 70.0, 126.6, 84.1
"""Of the packaged four-bar: the ground, and from A and B to the coupler point."""


def placed(lengths: np.ndarray, angle: float) -> np.ndarray:
    """A0, B0, A, B and C of each design at one crank angle: (n, 5, 2)."""
    a2, a3, a4 = lengths.T
    points = np.zeros((len(lengths), 5, 2))
    points[:, 1, 0] = GROUND
    points[:, 2] = np.stack([a2 * math.cos(angle), a2 * math.sin(angle)], axis=1)
    way = points[:, 2] - points[:, 1]
    s = np.hypot(*way.T)
    theta14 = np.arctan2(*way.T[::-1]) - np.arccos((a4**2 + s**2 - a3**2) / (2 * a4 * s))
    points[:, 3] = points[:, 1] + a4[:, None] * np.stack([np.cos(theta14), np.sin(theta14)], axis=1)
    along = points[:, 3] - points[:, 2]
    theta3c = np.arctan2(*along.T[::-1]) + coupler_angle(a3)
    points[:, 4] = points[:, 2] + B3 * np.stack([np.cos(theta3c), np.sin(theta3c)], axis=1)
    return points


def coupler_angle(a3: np.ndarray) -> np.ndarray:
    """From the coupler AB to AC."""
    return np.arccos((a3**2 + B3**2 - C3**2) / (2 * a3 * B3))


def ensemble_of(lengths: np.ndarray, rows: int):
    """pylinkage's ensemble: each begins a step before the first row."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import FixedDyad, RRRDyad
    from pylinkage.population import Ensemble
    from pylinkage.simulation import Linkage

    step = 2 * math.pi / (rows - 1)
    starts = placed(lengths, -step)
    a2, a3, a4 = lengths[0]
    ground, pivot = Ground(0.0, 0.0), Ground(GROUND, 0.0)
    crank = Crank(ground, float(a2), step, -step)
    rocker = RRRDyad(crank.output, pivot, float(a3), float(a4), *map(float, starts[0, 3]))
    point = FixedDyad(crank.output, rocker, B3, float(coupler_angle(a3)))
    linkage = Linkage([ground, pivot, crank, rocker, point])
    own = np.full(len(lengths), B3)
    dimensions = np.stack([*lengths.T, own, coupler_angle(lengths[:, 1])], axis=1)
    return Ensemble(linkage, dimensions, starts)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--designs", type=int, default=2_000)
    parser.add_argument("--rows", type=int, default=73)
    args = parser.parse_args()
    if importlib.util.find_spec("pylinkage") is None:
        print("pylinkage is not installed: pip install pylinkage numba")
        return
    designs = designs_of(args.designs, args.rows)
    lengths = designs.sampling.values(np.arange(args.designs))
    sides = np.concatenate([np.full((len(lengths), 1), GROUND), lengths], axis=1)
    grashof = 2 * (sides.min(axis=1) + sides.max(axis=1)) < sides.sum(axis=1)
    rockers = lengths[grashof & (lengths[:, 0] == sides.min(axis=1))]
    # a design whose coupler triangle cannot be has no point C
    rockers = rockers[np.isfinite(coupler_angle(rockers[:, 1]))]

    ensemble_of(rockers[:2], args.rows).simulate()  # where numba is, it compiles here
    begun = time.process_time()
    found = ensemble_of(rockers, args.rows).simulate(args.rows - 1, store=False)
    theirs = time.process_time() - begun
    heights = np.ptp(found[:, :, 4, 1], axis=1)
    expected = by_hand(rockers, args.rows)
    worst = float(np.abs(heights[expected[0]] - expected[2]).max())

    kept_of(designs, 0, args.designs)
    begun = time.process_time()
    kept_of(designs, 0, args.designs)
    ours = time.process_time() - begun

    release = importlib.metadata.version("pylinkage")
    numba = "with numba" if importlib.util.find_spec("numba") else "without numba"
    print(f"{len(rockers):,} crank-rockers of {args.designs:,} four-bars x {args.rows} rows, CPU time of one core")
    print(f"  study      {ours:.4f} s: all designs, conditions, what lies between the rows")
    print(f"  pylinkage  {theirs:.4f} s: positions of the crank-rockers, {theirs / ours:.1f} times ({release} {numba})")
    print(f"  heights of {len(expected[0]):,} coupler points differ by {worst:.1e} at most")


if __name__ == "__main__":
    main()
