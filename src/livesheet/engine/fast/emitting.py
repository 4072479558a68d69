"""From lowered values to a Python function of numpy calls: no temporaries beyond a few reused buffers, no call twice.

The function computes rows [i, j) of all blocks of a segment. It stops with `TroubleError`, or an error of arithmetic that
numpy raises from the processor's flags, as soon as something is not plain numbers; then the interpreter does those
rows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from ..kernels.math import Arithmetic
from ..layout import Layout
from ..values.cells import NEAR, TEXT
from .generated import HELPERS, Singles, roots
from .lowering import Effect, Lowering, Value

CHUNK = 16_384
"""Cells of a column at a time: what fits the processor's second cache with a few buffers of it (docs/speed.md)."""

Code = Callable[..., None]


@dataclass(slots=True)
class _Pool:
    """Reusable buffers of one kind, as names in the code."""

    letter: str
    free: list[int] = field(default_factory=list)
    count: int = 0

    def take(self) -> str:
        if self.free:
            return f"{self.letter}{self.free.pop()}"
        self.count += 1
        return f"{self.letter}{self.count - 1}"

    def give(self, name: str) -> None:
        self.free.append(int(name[1:]))


def emit(lowering: Lowering, layout: Layout, arithmetic: Arithmetic) -> tuple[Code, str, dict[str, int]]:
    """The function `code(numbers, codes, buffers, i, j)`, its source, and how many buffers of each kind it needs.

    `buffers` maps "t" (a number a row) and "b" (a truth a row) to arrays of that many rows.
    """
    emitter = _Emitter(lowering, layout, arithmetic)
    emitter.write()
    source = emitter.source()
    namespace = emitter.namespace
    exec(compile(source, "<segment>", "exec"), namespace)
    return namespace["run"], source, {pool.letter: pool.count for pool in (emitter.numbers, emitter.masks)}


class _Emitter(Singles):
    def __init__(self, lowering: Lowering, layout: Layout, arithmetic: Arithmetic) -> None:
        super().__init__(lowering, layout, arithmetic)
        self.boxed: set[int] = set()
        self.numbers, self.masks = _Pool("t"), _Pool("b")
        self.owned: dict[int, tuple[_Pool, str]] = {}
        self.namespace.update(
            array=np.array, copyto=np.copyto, zero=np.zeros(()), near=np.array(NEAR),
        )  # fmt: skip
        self.uses, self.outputs = self.usage.uses, self.usage.outputs

    # code

    def write(self) -> None:
        for place, item in enumerate(self.usage.items):
            if isinstance(item, Effect):
                self._effect(item)
                self._release(roots(item), place)
            else:
                self._define(item, place)
        self.check_singles()

    def source(self) -> str:
        head = ["def run(numbers, codes, buffers, i, j):", "    n = j - i", "    item = numbers.item"]
        for pool in (self.numbers, self.masks):
            for number in range(pool.count):
                head.append(f'    {pool.letter}{number} = buffers["{pool.letter}"][{number}][:n]')
        return "\n".join([*head, *self.lines, "    return"]) + "\n"

    def _release(self, numbers: list[int] | tuple[int, ...], place: int) -> None:
        for number in numbers:
            if self.usage.last.get(number) == place and number in self.owned:
                pool, name = self.owned.pop(number)
                pool.give(name)

    def _target(self, number: int) -> str:
        """Where a value along the rows is computed: its column's cells, or a buffer."""
        value = self.values[number]
        column = self.outputs.get(number)
        if column is not None:
            name = f"o{column}"
            line = f"{name} = numbers[{column} + i:{column} + j]"
            if f"    {line}" not in self.lines:
                self.line(line)
            return name
        pool = self.masks if value.kind == "mask" else self.numbers
        name = pool.take()
        self.owned[number] = pool, name
        return name

    def _argument(self, number: int) -> str:
        """An operand's name; a single number among columns as an array without axes, which numpy takes faster."""
        value, name = self.values[number], self.names[number]
        if value.along or value.kind != "number":
            return name
        if value.op == "constant":
            box = f"k{number}"
            self.namespace[box] = np.array(float(str(value.data)))
            return box
        if number not in self.boxed:
            self.boxed.add(number)
            self.line(f"z{number} = array({name})")
        return f"z{number}"

    def _define(self, number: int, place: int) -> None:
        value = self.values[number]
        if value.along:
            self._along(number, value, place)
        else:
            self.define(number)

    def _along(self, number: int, value: Value, place: int) -> None:
        if value.op == "column":
            self.names[number] = f"c{number}"
            self.line(f"c{number} = numbers[{value.data} + i:{value.data} + j]")
            return
        if value.op == "count":
            self.namespace[f"count{number}"] = np.arange(float(str(value.data)), float(str(value.data)) + self._rows())
            self.names[number] = f"c{number}"
            self.line(f"c{number} = count{number}[i:j]")
            return
        args = [self._argument(arg) for arg in value.args]
        special = self._SPECIAL.get(value.op)
        if special is not None:
            special(self, number, value, args)
            self._release(value.args, place)
            return
        # An operand's buffer may take the result: cell by cell they are the same place.
        self._release(value.args, place)
        self.names[number] = target = self._target(number)
        # numpy wants the word for these two; for the others the place alone is faster
        out = f"out={target}" if value.op in ("minimum", "maximum") else target
        self.line(f"{self.function(value.op)}({', '.join(args)}, {out})")

    def _rows(self) -> int:
        return max(self.layout.blocks[block].rows for block in self.lowering.results)

    def _where(self, number: int, value: Value, args: list[str]) -> None:
        self.names[number] = target = self._target(number)
        if not self.values[value.args[0]].along:
            self.line(f"copyto({target}, {args[1]} if {args[0]} else {args[2]})")
            return
        self.line(f"copyto({target}, {args[2]})")
        self.line(f"copyto({target}, {args[1]}, where={args[0]})")

    def _snap(self, number: int, value: Value, args: list[str]) -> None:
        result, left = value.args
        if result in self.outputs and self.outputs.get(number) == self.outputs[result] and self.uses[result] == 1:
            self.names[number] = target = args[0]
        elif self.uses[result] == 1 and result in self.owned:
            self.owned[number] = self.owned.pop(result)
            self.names[number] = target = args[0]
        else:
            self.names[number] = target = self._target(number)
            self.line(f"copyto({target}, {args[0]})")
        size, mask = self.numbers.take(), self.masks.take()
        self.line(f"{self.function('absolute')}({target}, {size})")
        if self.values[left].along:
            limit = self.numbers.take()
            self.line(f"absolute({args[1]}, {limit})")
            self.line(f"{self.function('multiply')}({limit}, near, {limit})")
            self.numbers.give(limit)
        else:
            limit = f"NEAR * abs({self.names[left]})"
        self.line(f"{self.function('less')}({size}, {limit}, {mask})")
        self.line(f"if {mask}.tobytes().find(1) >= 0: {target}[{mask} & ({size} < 1)] = 0.0")
        self.numbers.give(size)
        self.masks.give(mask)

    def _helped(self, number: int, value: Value, args: list[str]) -> None:
        self.namespace[value.op] = HELPERS[value.op]
        self.names[number] = target = self._target(number)
        digits = f", {value.data}" if value.op == "rounded" else ""
        self.line(f"copyto({target}, {value.op}({', '.join(args)}{digits}))")

    _SPECIAL: ClassVar[dict[str, Callable[[_Emitter, int, Value, list[str]], None]]] = {
        "where": _where, "snap": _snap, "rounded": _helped, "pick": _helped,
    }  # fmt: skip

    def _effect(self, effect: Effect) -> None:
        if effect.what == "store" and isinstance(effect.data, int):
            self._store(effect.value, effect.data)
        elif effect.what == "somewhere" and isinstance(effect.data, int):
            self._somewhere(effect.value, effect.data)
        else:
            name, wrong = self.names[effect.value], 1 if effect.what == "never" else 0
            if self.values[effect.value].along:
                self.line(f"if {name}.tobytes().find({wrong}) >= 0: raise TroubleError")
            else:
                self.line(f"if {'not ' * (1 - wrong)}{name}: raise TroubleError")

    def _somewhere(self, x: int, y: int) -> None:
        """ATAN2(0, 0) is an error that the processor does not know."""
        a, b = self.names[x], self.names[y]
        if not (self.values[x].along and self.values[y].along):
            single, other = (b, a) if self.values[x].along else (a, b)
            test = f"({other} == 0).any()" if self.values[x].along or self.values[y].along else f"{other} == 0"
            self.line(f"if {single} == 0 and {test}: raise TroubleError")
            return
        mask = self.masks.take()
        self.line(f"{self.function('equal')}({a}, zero, {mask})")
        self.masks.give(mask)
        self.line(f"if {mask}.tobytes().find(1) >= 0 and ({mask} & ({b} == 0)).any(): raise TroubleError")

    def _store(self, number: int, column: int) -> None:
        cells = f"[{column} + i:{column} + j]"
        if self.values[number].kind == "text":
            self.line(f"codes{cells} = {TEXT}")
        if self.outputs.get(number) != column:
            self.line(f"numbers{cells} = {self.names[number]}")
