"""Case files of branches and degenerate geometry: a description, and what must happen."""

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

CASES = Path(__file__).parent / "cases"


@dataclass(frozen=True)
class Case:
    """One case.

    why           what it is about
    description   the text of the description
    missing       rows without a position, from 0 on
    undetermined  those of them in which links can turn freely: the reference tells them apart
    leaps         rows that a link reaches by a turn of more than 90 degrees
    says          a part of the status of every missing row; or of the message, where the description is refused
    refused       True where building must fail with a message
    values        {symbol: {row: value}} as people read them
    """

    name: str
    why: str
    description: str
    missing: frozenset[int] = frozenset()
    undetermined: frozenset[int] = frozenset()
    leaps: frozenset[int] = frozenset()
    says: str = ""
    refused: bool = False
    values: dict[str, dict[int, float]] = field(default_factory=dict)


def cases(folder: str) -> list[Case]:
    """The cases of a folder, by name."""
    return [_case(path) for path in sorted((CASES / folder).glob("*.toml"))]


def _case(path: Path) -> Case:
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    expect = data.get("expect", {})
    sets = {key: frozenset(_rows(expect.get(key, []))) for key in ("missing", "undetermined", "leaps")}
    values = {
        symbol: {int(row): value for row, value in rows.items()} for symbol, rows in expect.get("values", {}).items()
    }
    return Case(
        path.stem,
        data["why"],
        data["description"],
        **sets,
        says=expect.get("says", ""),
        refused=expect.get("refused", False),
        values=values,
    )


def _rows(entries: list[int | list[int]]) -> list[int]:
    """Rows, one by one or as [first, last]."""
    return [row for entry in entries for row in (range(entry[0], entry[1] + 1) if isinstance(entry, list) else [entry])]
