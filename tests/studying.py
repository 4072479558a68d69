"""Studies of templates for tests: a template's text with a part [study], and what its workbook says of a design."""

from __future__ import annotations

from pathlib import Path

from mechsheet.compiled import Compiled
from mechsheet.description import Overrides
from mechsheet.description.templates import template_text
from mechsheet.library.changed import loads
from mechsheet.model import Mechanism

FOUR_BAR = """
[study]
vary = { a2 = [20, 60, 5], a3 = { from = 46, to = 118, by = 8 }, a4 = { values = [40, 50, 56, 60, 80] } }
"""


def study_of(part: str = FOUR_BAR, template: str = "four-bar", rows: int | None = None) -> Mechanism:
    """A template with a study; its own, which stands last in it, is left out."""
    text = template_text(template).partition("\n[study]")[0]
    return loads(f"{text}\n{part}", overrides=Overrides(rows=None if rows is None else str(rows)))


def small(count: int = 30_000) -> Mechanism:
    """A study in several parts, of which some designs are kept."""
    return study_of(f"""
[study]
sample = "sobol"
count = {count}
seed = 3
vary = {{ a2 = [10, 60], a3 = [50, 110], a4 = [30, 100] }}
keep = ["grashof(A0ABB0)", "closes", "mu_min > 35"]
maximize = ["swing", "mu_min"]
best = 10
""")


def in_workbook(mechanism: Mechanism, values: dict[str, float], modes: dict[str, int]) -> dict[str, float]:
    """The summaries of a design as its workbook's formulas compute them."""
    changes = [(name, repr(float(value))) for name, value in values.items()]
    changes += [(name, str(mode)) for name, mode in modes.items()]
    compiled = Compiled(loads(mechanism.text, overrides=Overrides(changes)))
    row = compiled.plan.blocks["summary"].rows
    from mechsheet.sheet.addresses import Spot
    from mechsheet.sheet.plan import VALUE

    return {name: compiled.number(Spot(compiled.plan.main, at, VALUE)) for name, at in row.items()}


def contents(folder: Path) -> dict[str, bytes]:
    """All files of a folder."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
