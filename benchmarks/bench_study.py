"""How fast a study evaluates four-bars with a coupler point, beside the same written by hand in numpy.

    python benchmarks/bench_study.py [--designs 1000000] [--rows 73] [--dask] [--check]

Of each design: Grashof's condition first; then the whole turn, whether it closes, the transmission angle and the height of
the coupler point; kept are those whose angle is above 40 degrees. By hand a row is as near as one comes to an extreme; the
study also looks between the rows. Both run in turn in one process, chunk by chunk, on one core; CPU time. --dask: what a
scheduler costs, with tasks that do nothing. --check fails where a goal is missed.
"""

from __future__ import annotations

import argparse
import resource
import sys
import time

import numpy as np

from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.studies.chunk import Kept, kept_of
from mechsheet.studies.designs import Designs
from mechsheet.studies.parts import CHUNK

RATIO = 1.3
"""To what is written by hand."""

BLOCK = 16_384
"""Numbers in an array by hand, too: a block that fits the cache."""

STUDY = """
[study]
sample = "sobol"
count = {designs}
vary = {{ a2 = [10, 60], a3 = [50, 120], a4 = [30, 100] }}
keep = ["grashof(A0ABB0)", "closes", "mu_min > 40"]
minimize = ["max(C.y) - min(C.y)"]
maximize = ["mu_min"]
"""


def designs_of(count: int, rows: int) -> Designs:
    """The template's four-bar, with the one summary that is asked for."""
    text = template_text("four-bar").replace("step = 15", f"step = {360 / (rows - 1)!r}")
    lines = [line for line in text.splitlines() if not line.startswith(("mu_max =", "swing ="))]
    return Designs(loads("\n".join(lines) + STUDY.format(designs=count)))


def by_hand(lengths: np.ndarray, rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(which are kept, their least transmission angle [deg], the range of the coupler point's height)."""
    a1, b3, c3 = 70.0, 126.6, 84.1
    sides = np.concatenate([np.full((len(lengths), 1), a1), lengths], axis=1)
    turns = np.flatnonzero(2 * (sides.min(axis=1) + sides.max(axis=1)) < sides.sum(axis=1))
    theta12 = np.linspace(0, 2 * np.pi, rows)
    cos, sin = np.cos(theta12), np.sin(theta12)
    kept, angles, heights = [], [], []
    for first in range(0, len(turns), BLOCK // rows):
        some = turns[first : first + BLOCK // rows]
        a2, a3, a4 = (lengths[some, at][:, None] for at in range(3))
        gamma = np.arccos((a3**2 + b3**2 - c3**2) / (2 * a3 * b3))
        x, y = a2 * cos - a1, a2 * sin
        s2 = x * x + y * y
        s = np.sqrt(s2)
        product = (a4 + s + a3) * (a4 + s - a3) * (a3 + (a4 - s)) * (a3 - (a4 - s))
        closes = (np.minimum(a3 + a4 - s, s - np.abs(a3 - a4)) >= -1e-10).all(axis=1)
        area = np.sqrt(np.maximum(product, 0.0))
        mu = np.arctan2(area, a3 * a3 + a4 * a4 - s2)
        theta13 = np.arctan2(y, x) - np.arctan2(area, a4 * a4 + s2 - a3 * a3) - mu
        height = y + b3 * np.sin(theta13 + gamma)
        least = np.degrees(mu.min(axis=1))
        fine = closes & (least > 40)
        kept.append(some[fine])
        angles.append(least[fine])
        heights.append((height.max(axis=1) - height.min(axis=1))[fine])
    return np.concatenate(kept), np.concatenate(angles), np.concatenate(heights)


def compared(designs: Designs, count: int) -> tuple[float, float, int]:
    """CPU seconds of the study and by hand for the same designs, in turn, and how many are kept."""
    ours = theirs = 0.0
    kept = 0
    for first in range(0, count, CHUNK):
        size = min(CHUNK, count - first)
        begun = time.process_time()
        found = kept_of(designs, first, size)
        ours += time.process_time() - begun
        begun = time.process_time()
        lengths = designs.sampling.values(np.arange(first, first + size))
        with np.errstate(invalid="ignore"):
            by_hand(lengths, designs.rows)
        theirs += time.process_time() - begun
        kept += len(found.numbers)
    return ours, theirs, kept


def agree(designs: Designs, count: int) -> Kept:
    """What both keep is the same but for designs whose extreme lies between the rows; raises AssertionError."""
    found = kept_of(designs, 0, count)
    with np.errstate(invalid="ignore"):
        kept, angles, heights = by_hand(designs.sampling.values(np.arange(count)), designs.rows)
    assert np.isin(found.numbers, kept).all()
    both = np.isin(kept, found.numbers)
    assert both.mean() > 0.95
    finer = designs.study.objectives[0].text
    assert np.all(found.columns["mu_min"] <= angles[both] + 1e-9)
    assert np.all(found.columns["mu_min"] >= angles[both] - 0.2)
    known = np.isfinite(heights[both])
    assert np.all(found.columns[finer][known] >= heights[both][known] - 1e-9)
    return found


def of_scheduler(tasks: int) -> tuple[float, float]:
    """CPU seconds a task of a Dask scheduler and client, with results of 4 KiB; and its memory afterwards [MiB]."""
    import distributed

    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as client,
    ):
        begun = time.process_time()
        waiting = distributed.as_completed([client.submit(bytes, 4096, pure=False) for _ in range(16)])
        left = tasks - 16
        for future in waiting:
            future.result()
            future.release()
            if left > 0:
                waiting.add(client.submit(bytes, 4096, pure=False))
                left -= 1
        cost = (time.process_time() - begun) / tasks
    return cost, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--designs", type=int, default=1_000_000)
    parser.add_argument("--rows", type=int, default=73)
    parser.add_argument("--dask", type=int, default=0, metavar="TASKS")
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    designs = designs_of(args.designs, args.rows)
    agree(designs, CHUNK)
    ours, theirs, kept = compared(designs, args.designs)
    ratio = ours / theirs
    print(f"{args.designs:,} four-bars with a coupler point x {args.rows} rows, {kept:,} kept, CPU time of one core")
    print(f"  study    {args.designs / ours:>10,.0f} designs/s   (with what lies between the rows)")
    print(f"  by hand  {args.designs / theirs:>10,.0f} designs/s   ratio {ratio:.2f}, goal {RATIO}")
    print(f"  memory   {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:>10,.0f} MiB at most")
    if args.dask:
        cost, memory = of_scheduler(args.dask)
        print(f"  Dask     {cost * 1e3:.2f} ms of CPU a task in all, {args.dask:,} tasks, {memory:,.0f} MiB")
    if args.check and ratio > RATIO:
        sys.exit(f"ratio {ratio:.2f} is above {RATIO}")


if __name__ == "__main__":
    main()
