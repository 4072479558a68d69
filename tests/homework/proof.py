"""The figures of docs/proof.md on workbooks made by hand: right ones are not blamed, damaged ones are mended.

PYTHONPATH=src:tests python tests/homework/proof.py right 60 [TEMPLATE...]
PYTHONPATH=src:tests python tests/homework/proof.py damaged 20 [TEMPLATE...]
"""

from __future__ import annotations

import random
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

import mechsheet
from homework.methods import METHODS, NotConvergedError
from homework.styles import STYLES
from livesheet.formula.book import Book
from livesheet.formula.printer import print_formula
from livesheet.formula.references import area_name
from livesheet.formula.slips import damages
from mechsheet.description.templates import template_names
from mechsheet.diagnostics import DescriptionError, MechanismError, MechsheetError
from mechsheet.homework.audit import Audit, audited
from mechsheet.homework.classroom.exercise import with_dimensions
from mechsheet.homework.expected_values import asked_of
from mechsheet.homework.formula_strips import upright
from mechsheet.kinematics.solve import solve
from mechsheet.model import Mechanism


def by_hand(mechanism: Mechanism) -> bool:
    """Whether a mechanism is one that people solve by hand: no links that are solved all at once."""
    try:
        return not any(group.system is not None for group in solve(mechanism).groups)
    except MechanismError:
        return False


def judged(book: Book, mechanism: Mechanism) -> Audit:
    """The audit of a workbook."""
    return audited(upright(book), mechanism, asked_of(mechanism), mechanism.name)


def other_inputs(mechanism: Mechanism, draw: random.Random) -> Mechanism:
    """The mechanism with each dimension changed by up to one per cent; drawn again where it cannot be built so."""
    while True:
        try:
            found = _changed(mechanism, draw)
            solve(found)
        except (DescriptionError, MechanismError):
            continue
        return found


def _changed(mechanism: Mechanism, draw: random.Random) -> Mechanism:
    values = {}
    for dim in mechanism.dimensions:
        if not (dim.derived or dim.path) and isinstance(dim.value, float):
            shown = float(dim.unit.to_shown(dim.value))
            moved = shown and dim.unit.kind in ("length", "angle")
            values[dim.symbol] = round(shown * (1 + draw.uniform(-0.01, 0.01)), 4) if moved else shown
    return with_dimensions(mechanism, values)


@dataclass(frozen=True)
class Damaged:
    """A workbook with one wrong formula. `lost`: the asked quantities whose own cells hold it."""

    style: str
    cells: str
    was: str
    now: str
    kind: str
    audit: Audit
    lost: frozenset[str]

    @property
    def harmless(self) -> bool:
        """Whether what is asked is as right as before, in numbers."""
        return all(one.verdict in ("right", "not live") for one in self.audit.asked.values())

    @property
    def found(self) -> bool:
        """Whether the first fault that is told is the damage."""
        return bool(self.audit.faults) and self.audit.faults[0].cells == self.cells

    @property
    def mended(self) -> bool:
        """Whether one mend puts all right."""
        verdicts = {symbol: one.verdict for symbol, one in self.audit.asked.items()}
        good = all(verdict in ("right", "follows") or symbol in self.lost for symbol, verdict in verdicts.items())
        return self.found and len(self.audit.faults) == 1 and bool(self.audit.faults[0].mend) and good

    @property
    def exact(self) -> bool:
        """Whether the marks are those of the damage: what holds it loses, nothing else."""
        return abs(self.audit.follow_through - (self.audit.of - len(self.lost))) < 1e-9

    @property
    def blamed(self) -> bool:
        """Whether a fault is told where none is."""
        return any(fault.cells != self.cells and fault.mend for fault in self.audit.faults)


def damaged(name: str, count: int, seed: int = 2) -> Iterator[Damaged]:
    """Damaged workbooks of a template, each in the next style; those whose damage changes nothing asked are left out."""
    mechanism = mechsheet.template(name)
    draw = random.Random(f"{name} {seed}")
    right: dict[str, Audit] = {}
    done = 0
    for _ in range(12 * count):
        if done == count:
            return
        style = list(STYLES)[done % len(STYLES)]
        if style not in right:
            right[style] = judged(STYLES[style](mechanism), mechanism)
            if not right[style].right:
                raise KeyError("the plain export itself is not right")  # a rack's displacement by an angle that jumps
        book = STYLES[style](mechanism)
        sheet = book.sheets[-1]
        place = draw.randrange(len(sheet.blocks))
        block = sheet.blocks[place]
        ways = damages(block.formula)
        if not ways:
            continue
        damage = draw.choice(ways)
        new = damage.of(block.formula)
        sheet.blocks[place] = replace(block, formula=new)
        cells = f"{sheet.title}!{area_name(block.row, block.col, block.rows, block.cols)}"
        lost = frozenset(symbol for symbol, one in right[style].asked.items() if one.cells == cells)
        try:
            found = judged(book, mechanism)
        except MechsheetError:
            print("refused", name, style, cells, print_formula(block.formula), "->", print_formula(new))
            raise
        one = Damaged(style, cells, print_formula(block.formula), print_formula(new), damage.kind, found, lost)
        if not one.harmless:
            done += 1
            yield one


def right(name: str, count: int, seed: int = 1) -> Iterator[tuple[str, Audit]]:
    """(style, audit) of right workbooks of a template, each with other inputs and in the next style."""
    mechanism = mechsheet.template(name)
    draw = random.Random(f"{name} {seed}")
    made = {**STYLES, **METHODS}
    for number in range(count):
        style = list(made)[(number + len(name)) % len(made)]
        own = mechanism if number == 0 else other_inputs(mechanism, draw)
        try:
            book = made[style](own)
        except NotConvergedError:
            style = "down"
            book = made[style](own)
        yield style, judged(book, own)


def _of_right(names: list[str], count: int) -> None:
    start, total, blamed, styles = time.process_time(), 0, 0, Counter[str]()
    for name in names:
        own, own_blamed, began = 0, 0, time.process_time()
        try:
            for style, audit in right(name, count):
                own += 1
                styles[style] += 1
                if not audit.right or audit.faults:
                    own_blamed += 1
                    print(name, style, {s: one.verdict for s, one in audit.asked.items()}, audit.faults, flush=True)
        except (MechsheetError, KeyError) as error:
            print(name, "not tried:", type(error).__name__, str(error)[:100], flush=True)
        total, blamed, took = total + own, blamed + own_blamed, time.process_time() - began
        print(f"= {name}: {own - own_blamed} of {own} right, {took:.0f} s CPU", flush=True)
    print(f"{total} right workbooks, {blamed} blamed; {dict(styles)}; {time.process_time() - start:.0f} s CPU")


def _of_damaged(names: list[str], count: int) -> None:
    start, totals = time.process_time(), Counter[str]()
    for name in names:
        began = first = time.process_time()
        own = Counter[str]()
        try:
            for one in damaged(name, count):
                own["workbooks"] += 1
                for what in ("found", "mended", "exact", "blamed"):
                    own[what] += getattr(one, what)
                took, began = time.process_time() - began, time.process_time()
                if not (one.found and one.mended and one.exact) or one.blamed or took > 12:
                    print(f"{name} {one.style} {one.cells} {one.was} -> {one.now} ({one.kind}), {took:.1f} s")
                    print("   ", {symbol: result.verdict for symbol, result in one.audit.asked.items()}, set(one.lost))
                    for fault in one.audit.faults:
                        print("   ", fault.cells, fault.formula, "=>", fault.mend, f"({fault.kind})", fault.rights)
                    sys.stdout.flush()
        except (MechsheetError, KeyError) as error:
            print(name, "not tried:", type(error).__name__, str(error)[:100], flush=True)
        totals += own
        print(f"= {name}: {dict(own)}, {time.process_time() - first:.0f} s CPU", flush=True)
    print(dict(totals), f"{time.process_time() - start:.0f} s CPU")


if __name__ == "__main__":
    kind, number, *given = sys.argv[1:]
    chosen = given or [name for name in template_names() if by_hand(mechsheet.template(name))]
    {"right": _of_right, "damaged": _of_damaged}[kind](chosen, int(number))
