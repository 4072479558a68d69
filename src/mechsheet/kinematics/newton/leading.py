"""What leads to what a group reads: the quantities that may change, and all that follows from them on the way."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence


def leading(
    wanted: Sequence[str], rules: Mapping[str, Collection[str]], changing: Collection[str]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """(those of `changing` that `wanted` follows from, the rules between them in order); the rest stays as it is.

    rules     by symbol what it reads, in order of solution
    changing  symbols that are given, whatever rule they have
    """
    moving = set(changing)
    for symbol, reads in rules.items():
        if not moving.isdisjoint(reads):
            moving.add(symbol)
    needed = set(wanted) & moving
    for symbol, reads in reversed([*rules.items()]):
        if symbol in needed and symbol not in changing:
            needed.update(moving.intersection(reads))
    return (
        tuple(symbol for symbol in changing if symbol in needed),
        tuple(symbol for symbol in rules if symbol in needed and symbol not in changing),
    )
