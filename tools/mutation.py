"""Would the tests notice? One small fault at a time is put into a copy of the source, and the tests must fail.

    python tools/mutation.py --tests tests/kinematics tests/golden --sample 60 src/mechsheet/kinematics/dyads/*.py ...

Faults: a comparison or its limit, + for -, * for /, a constant plus one, `and` for `or`, one of the conditions left out or
turned round, two arguments for one another, a result that is None. Printed are the share that was noticed and each fault
that was not, with its line. A fault that changes nothing a user could see (an order of tests, a limit that no number meets
exactly) may stay. A module's own tests (those named as it, else those of its folder) run besides.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
SOURCE = ROOT / "src"
OTHER = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
TURNED_BY_OPERATOR = (ast.Eq, ast.NotEq, ast.In, ast.NotIn, ast.Is, ast.IsNot)
"""Comparisons whose other operator is their opposite: turning the whole condition round would be the same fault twice."""

SYMMETRIC = (
    "min",
    "max",
    "math.hypot",
    "np.hypot",
    "np.minimum",
    "np.maximum",
    "math.gcd",
    "math.isclose",
    "np.isclose",
)


@dataclass(frozen=True)
class Mutant:
    """A module with one fault: its text, and what was changed where."""

    module: Path
    line: int
    change: str
    text: str


def mutants(module: Path) -> Iterator[Mutant]:
    """Every fault that can be put into a module."""
    tree = ast.parse(module.read_text(encoding="utf-8"))
    for node in _code(tree):
        for owner, field, other in _faults(node):
            before, kept = ast.unparse(node), getattr(owner, field)
            setattr(owner, field, other)
            change = f"{_short(before)}  ->  {_short(ast.unparse(node))}"
            yield Mutant(module, node.lineno, change, ast.unparse(ast.fix_missing_locations(tree)))
            setattr(owner, field, kept)


def _code(node: ast.AST) -> Iterator[Any]:
    """The nodes of what is executed: no annotations, no texts of errors."""
    for field, child in ast.iter_fields(node):
        if field in ("annotation", "returns", "decorator_list") or isinstance(node, ast.Raise):
            continue
        for each in child if isinstance(child, list) else [child]:
            if isinstance(each, ast.AST):
                yield each
                yield from _code(each)


def _faults(node: ast.AST) -> Iterator[tuple[Any, str, Any]]:
    """(node, its field, the wrong value of that) of each fault of a node."""
    match node:
        case ast.Compare(ops=ops):
            for index, op in enumerate(ops):
                yield node, "ops", [*ops[:index], OTHER[type(op)](), *ops[index + 1 :]]
        case ast.BinOp(op=op) | ast.BoolOp(op=op) if type(op) in OTHER:
            yield node, "op", OTHER[type(op)]()
            if isinstance(node, ast.BoolOp):
                for index in range(len(node.values)):
                    yield node, "values", [*node.values[:index], *node.values[index + 1 :]]
        case ast.Call(func=called, args=[first, second, *others]) if _matters(called, first, second):
            yield node, "args", [second, first, *others]
        case ast.Constant(value=value) if type(value) in (int, float):
            yield node, "value", value + 1
        case ast.Return(value=value) if value is not None and ast.unparse(value) != "None":
            yield node, "value", ast.Constant(None)
        case ast.If(test=test) | ast.IfExp(test=test) | ast.While(test=test) if _turns(test):
            yield node, "test", ast.UnaryOp(ast.Not(), test)
        case ast.UnaryOp(op=ast.USub()):
            yield node, "op", ast.UAdd()
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield node, "operand", ast.UnaryOp(ast.Not(), operand)


def _matters(called: ast.expr, *arguments: ast.expr) -> bool:
    """Whether the order of the arguments may matter."""
    return ast.unparse(called) not in SYMMETRIC and not any(isinstance(each, ast.Starred) for each in arguments)


def _turns(test: ast.expr) -> bool:
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        return not isinstance(test.ops[0], TURNED_BY_OPERATOR)
    return not (isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not))


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 90 else line[:87] + "..."


def own_tests(module: Path) -> list[str]:
    """The files of tests that carry a module's name, below those of its room; where there are none, those of its folder."""
    own = Path(*module.relative_to(SOURCE).parts[1:])
    named = (ROOT / "tests" / own.parts[0]).rglob(f"test_{module.stem}.py")
    return sorted(str(path.relative_to(ROOT)) for path in named) or sorted(
        str(path.relative_to(ROOT)) for path in (ROOT / "tests" / own.parent).glob("test_*.py")
    )


def passes(source: Path, tests: Sequence[str], seconds: float) -> bool | None:
    """Whether the tests pass with the package in `source`; None for a run that takes longer than `seconds`."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    try:
        done = subprocess.run(
            command,
            cwd=ROOT,
            env={**os.environ, "PYTHONPATH": str(source), "PYTHONDONTWRITEBYTECODE": "1"},
            capture_output=True,
            timeout=seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return None
    return done.returncode == 0


def run(
    tried: Sequence[Mutant], source: Path, tests: Sequence[str], limit: float, budget: float
) -> Counter[bool | None]:
    """How many runs passed, failed and did not end; the faults that were not noticed are printed."""
    begin, found = time.monotonic(), Counter[bool | None]()
    for mutant in tried:
        if time.monotonic() - begin > budget:
            break
        place = source / mutant.module.relative_to(SOURCE)
        kept = place.read_text(encoding="utf-8")
        place.write_text(mutant.text, encoding="utf-8")
        passed = passes(source, [*own_tests(mutant.module), *tests], limit)
        found[passed] += 1
        if passed is not False:
            late = " (not ended)" if passed is None else ""
            print(f"{mutant.module.relative_to(ROOT)}:{mutant.line}: {mutant.change}{late}", flush=True)
        place.write_text(kept, encoding="utf-8")
    return found


def main() -> int:
    """Run the faults of the modules named, or a sample of them."""
    parser = argparse.ArgumentParser()
    parser.add_argument("modules", nargs="+", type=Path, help="modules, or folders of them")
    parser.add_argument("--tests", nargs="+", required=True, help="what pytest is given, the fastest first")
    parser.add_argument("--quick", action="store_true", help="without the tests that are slow or need other programs")
    parser.add_argument("--sample", type=int, default=0, help="so many faults, drawn from all (0: all of them)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--limit", type=float, default=600.0, help="a run that takes longer than so many seconds is stopped"
    )
    parser.add_argument("--budget", type=float, default=3600.0, help="no new fault after so many seconds")
    options = parser.parse_args()
    modules = [
        path for place in options.modules for path in ([place] if place.is_file() else sorted(place.rglob("*.py")))
    ]
    found = [mutant for module in modules for mutant in mutants(module.resolve())]
    tried = found
    if 0 < options.sample < len(found):
        tried = random.Random(options.seed).sample(found, options.sample)
    tests = [*(["--quick"] if options.quick else []), *options.tests]
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "src"
        shutil.copytree(SOURCE, source)
        shutil.copytree(ROOT / "templates", Path(folder) / "templates")  # the package finds them beside its source
        if not passes(source, tests, 3600.0):
            print("the tests fail without any fault")
            return 2
        runs = run(tried, source, tests, options.limit, options.budget)
    late = f", {runs[None]} runs did not end" if runs[None] else ""
    print(
        f"{runs[False]} of {runs.total()} faults noticed{late} ({len(found)} possible), {time.monotonic() - begin:.0f} s"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
