"""How fast the engine computes columns that read each other row by row, as multiples of a loop written by hand in Python.

    python benchmarks/bench_rows.py [--check]

Newton steps side by side, started from the row above (119 columns); a loan that is paid back after 1,098 rows; a
Kalman filter; an Euler integration. The loop by hand does what one would write: no check, no snapping of sums that cancel.
Best CPU times in turn; the figure is their ratio. --check fails where a goal is missed.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable

import numpy as np
from bench_engine import best_of

from livesheet.engine import compile_book
from livesheet.formula.book import Book, BookBuilder
from livesheet.formula.parser import parse_formula

Side = Callable[[], "list[tuple[float, ...]]"]
FIRST = 5  # the first row of every table, counted from 0


def _book(constants: dict[str, float], starts: dict[str, float], columns: dict[str, str], rows: int) -> Book:
    """A sheet with names for constants, and columns: {x} is column x in this row, {-x} in the row above."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for col, (name, value) in enumerate(constants.items()):
        sheet.constant(0, col, value)
        builder.name(name, parse_formula(f"S!${_letters(col)}$1"))
    places = {name: _letters(col) for col, name in enumerate(columns)}
    cells = {name: f"{place}{FIRST + 1}" for name, place in places.items()}
    cells |= {f"-{name}": f"{place}{FIRST}" for name, place in places.items()}
    for col, (name, text) in enumerate(columns.items()):
        if name in starts:
            sheet.constant(FIRST - 1, col, starts[name])
        for other, cell in cells.items():
            text = text.replace(f"{{{other}}}", cell)
        sheet.block(FIRST, col, rows, 1, parse_formula(text))
    return builder.build()


def _letters(col: int) -> str:
    return (chr(64 + col // 26) if col >= 26 else "") + chr(65 + col % 26)


# --- Newton steps ------------------------------------------------------------------------------------------------------

LINKAGE = {"r": 1.0, "leg": 4.0, "side": 3.0, "far": 2.5, "corner": 0.7, "gx": 6.0, "gy": 0.5, "l": 3.5, "hx": 1.5,
           "hy": 6.5, "m": 3.2, "step": 0.0}  # fmt: skip
PASSES = 6


def newton(rows: int) -> Book:
    """A class III group: a ternary link on three legs, one of them carried by the crank."""
    columns = {
        "n": "{-n}+1",
        "theta": "{n}*step",
        "dx": "r*COS({theta})",
        "dy": "r*SIN({theta})",
        "size": "{-det6}*0+1",
    }
    for k in range(1, PASSES + 1):
        a, b = ("{-a7}", "{-b7}") if k == 1 else (f"{{a{k}}}", f"{{b{k}}}")
        part = {
            "c": f"COS({a})", "s": f"SIN({a})", "u": f"side*COS({b})", "v": f"side*SIN({b})",
            "w": f"far*COS({b}+corner)", "z": f"far*SIN({b}+corner)", "px": "{dx}+leg*{c#}", "py": "{dy}+leg*{s#}",
            "ax": "{px#}+{u#}-gx", "ay": "{py#}+{v#}-gy", "bx": "{px#}+{w#}-hx", "by": "{py#}+{z#}-hy",
            "f": "({ax#}^2+{ay#}^2-l^2)/2", "g": "({bx#}^2+{by#}^2-m^2)/2",
            "det": "leg*({ay#}*{c#}-{ax#}*{s#})*({by#}*{w#}-{bx#}*{z#})"
                   "-leg*({by#}*{c#}-{bx#}*{s#})*({ay#}*{u#}-{ax#}*{v#})",
            "da": "({f#}*({by#}*{w#}-{bx#}*{z#})-{g#}*({ay#}*{u#}-{ax#}*{v#}))/{det#}",
            "db": "leg*({g#}*({ay#}*{c#}-{ax#}*{s#})-{f#}*({by#}*{c#}-{bx#}*{s#}))/{det#}",
        }  # fmt: skip
        columns |= {f"{name}{k}": text.replace("#", str(k)) for name, text in part.items()}
        columns |= {f"a{k + 1}": f"{a}-{{da{k}}}", f"b{k + 1}": f"{b}-{{db{k}}}"}
    starts = {"n": -1.0, "a7": 0.9, "b7": -0.6, "det6": 1.0}
    return _book(LINKAGE | {"step": 2 * math.pi / 3600}, starts, columns, rows)


def newton_by_hand(rows: int) -> list[tuple[float, ...]]:
    """The same 119 values a row."""
    r, leg, side, far, corner, gx, gy, k, hx, hy, m, _ = LINKAGE.values()
    step, cos, sin = 2 * math.pi / 3600, math.cos, math.sin
    a, b, found = 0.9, -0.6, []
    for n in range(rows):
        theta = n * step
        dx, dy = r * cos(theta), r * sin(theta)
        row = [n, theta, dx, dy, 1.0]
        for _ in range(PASSES):
            c, s, u, v = cos(a), sin(a), side * cos(b), side * sin(b)
            w, z = far * cos(b + corner), far * sin(b + corner)
            px, py = dx + leg * c, dy + leg * s
            ax, ay, bx, by = px + u - gx, py + v - gy, px + w - hx, py + z - hy
            f, g = (ax * ax + ay * ay - k * k) / 2, (bx * bx + by * by - m * m) / 2
            f_a, g_a, f_b, g_b = ay * c - ax * s, by * c - bx * s, ay * u - ax * v, by * w - bx * z
            det = leg * f_a * g_b - leg * g_a * f_b
            da, db = (f * g_b - g * f_b) / det, leg * (g * f_a - f * g_a) / det
            a, b = a - da, b - db
            row += (c, s, u, v, w, z, px, py, ax, ay, bx, by, f, g, det, da, db, a, b)
        found.append(tuple(row))
    return found


# --- other people's workbooks -------------------------------------------------------------------------------------------


RATE, PAYMENT, AMOUNT = 0.04, 3_080.0, 900_000.0


def loan(rows: int) -> Book:
    """Balance, interest, payment, principal, as far as there is anything to pay back; then texts without letters."""
    columns = {
        "n": "{-n}+1",
        "before": 'IF({-after}="","",IF({-after}<0.005,"",{-after}))',
        "interest": 'IF({before}="","",ROUND({before}*rate/12,2))',
        "paid": 'IF({before}="","",MIN(payment,{before}+{interest}))',
        "principal": 'IF({before}="","",{paid}-{interest})',
        "after": 'IF({before}="","",{before}-{principal})',
    }
    return _book({"rate": RATE, "payment": PAYMENT}, {"n": 0.0, "after": AMOUNT}, columns, rows)


def loan_by_hand(rows: int) -> list[tuple[float, ...]]:
    after, found = AMOUNT, []
    for n in range(1, rows + 1):
        before = after
        if before < 0.005:
            break
        interest = math.floor(before * RATE / 12 * 100 + 0.5) / 100
        paid = min(PAYMENT, before + interest)
        principal = paid - interest
        after = before - principal
        found.append((n, before, interest, paid, principal, after))
    return found


def kalman(rows: int) -> Book:
    """Position and velocity from noisy positions: prediction, gain, correction."""
    columns = {
        "z": "SIN(ROW()/50)+0.1*SIN(ROW()*7.3)", "x": "{-xc}+dt*{-vc}", "v": "{-vc}",
        "p": "{-pc}+2*dt*{-qc}+dt^2*{-sc}+noise", "q": "{-qc}+dt*{-sc}", "s": "{-sc}+noise",
        "k": "{p}/({p}+error)", "h": "{q}/({p}+error)", "e": "{z}-{x}", "xc": "{x}+{k}*{e}", "vc": "{v}+{h}*{e}",
        "pc": "(1-{k})*{p}", "qc": "(1-{k})*{q}", "sc": "{s}-{h}*{q}",
    }  # fmt: skip
    return _book(
        {"dt": 0.1, "noise": 0.001, "error": 0.01}, dict.fromkeys(("xc", "vc", "pc", "qc", "sc"), 1.0), columns, rows
    )


def kalman_by_hand(rows: int) -> list[tuple[float, ...]]:
    dt, noise, error, sin = 0.1, 0.001, 0.01, math.sin
    xc = vc = pc = qc = sc = 1.0
    found = []
    for row in range(FIRST + 1, FIRST + 1 + rows):
        z = sin(row / 50) + 0.1 * sin(row * 7.3)
        x, v = xc + dt * vc, vc
        p, q, s = pc + 2 * dt * qc + dt**2 * sc + noise, qc + dt * sc, sc + noise
        k, h, e = p / (p + error), q / (p + error), z - x
        xc, vc, pc, qc, sc = x + k * e, v + h * e, (1 - k) * p, (1 - k) * q, s - h * q
        found.append((z, x, v, p, q, s, k, h, e, xc, vc, pc, qc, sc))
    return found


def euler(rows: int) -> Book:
    """A damped pendulum, driven."""
    columns = {
        "t": "{-t}+dt",
        "a": "-SIN({-x})-damping*{-v}+push*COS({-t})",
        "v": "{-v}+dt*{a}",
        "x": "{-x}+dt*{v}",
        "energy": "{v}^2/2+1-COS({x})",
    }
    return _book({"dt": 0.01, "damping": 0.1, "push": 0.4}, {"t": 0.0, "v": 0.0, "x": 1.0}, columns, rows)


def euler_by_hand(rows: int) -> list[tuple[float, ...]]:
    dt, damping, push, sin, cos = 0.01, 0.1, 0.4, math.sin, math.cos
    t, v, x, found = 0.0, 0.0, 1.0, []
    for _ in range(rows):
        a = -sin(x) - damping * v + push * cos(t)
        t += dt
        v += dt * a
        x += dt * v
        found.append((t, a, v, x, v**2 / 2 + 1 - cos(x)))
    return found


CASES: dict[str, tuple[Callable[[int], Book], Callable[[int], list[tuple[float, ...]]], tuple[int, ...], float]] = {
    "Newton steps": (newton, newton_by_hand, (201, 3_601, 36_001), 3.0),
    "loan": (loan, loan_by_hand, (361, 1_200), 5.0),
    "Kalman filter": (kalman, kalman_by_hand, (361, 10_000), 3.0),
    "Euler": (euler, euler_by_hand, (361, 10_000), 3.0),
}


def worst(book: Book, expected: list[tuple[float, ...]]) -> float:
    """The largest difference, relative to the column's largest value."""
    values, columns = compile_book(book).evaluate(), np.transpose(expected)
    found = [values.arrays("S", col, FIRST, FIRST + len(expected) - 1)[0] for col in range(len(columns))]
    return max(float(np.max(np.abs(a - b)) / max(1.0, np.max(np.abs(b)))) for a, b in zip(found, columns, strict=True))


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    missed = False
    print(
        f"{'':<14} {'rows':>6} {'columns':>7} {'by hand ms':>10} {'engine ms':>10} {'ratio':>6} {'goal':>5}  difference"
    )
    for name, (build, by_hand, sizes, goal) in CASES.items():
        for rows in sizes:
            plan, expected = compile_book(build(rows)), by_hand(rows)
            plan.evaluate()
            hand, ours = best_of([lambda by_hand=by_hand, rows=rows: by_hand(rows), plan.evaluate], options.seconds)
            apart = worst(build(rows), expected)
            missed |= ours / hand > goal or apart > 1e-9
            print(f"{name:<14} {rows:>6} {len(expected[0]):>7} {hand * 1e3:>10.2f} {ours * 1e3:>10.2f} {ours / hand:>6.2f} "
                  f"{goal:>5.1f}  {apart:.1e}")  # fmt: skip
    return int(options.check and missed)


if __name__ == "__main__":
    sys.exit(main())
