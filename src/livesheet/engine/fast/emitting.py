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

from ..kernels.arithmetic import Arithmetic
from ..layout import Layout
from ..values.cells import NEAR, TEXT
from .helpers import HELPERS
from .lowering import COLS, ROWS, Effect, Lowering, Value
from .recurrence import unwrapped
from .singles import Singles
from .usage import roots

CHUNK = 16_384
"""Cells of a column at a time: what fits the processor's second cache with a few buffers of it (docs/speed.md)."""

_LARGE = 4096
"""Cells from which on a reduction of an array is faster than it is to write another one."""

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

    `buffers` maps "t", "b" (one value or truth a row) and "w", "v" (the same for wide blocks) to arrays of that many rows.
    """
    emitter = _Emitter(lowering, layout, arithmetic)
    emitter.write()
    source = emitter.source()
    namespace = emitter.namespace
    exec(compile(source, "<segment>", "exec"), namespace)
    return namespace["run"], source, {pool.letter: pool.count for pool in emitter.pools.values()}


class _Emitter(Singles):
    def __init__(self, lowering: Lowering, layout: Layout, arithmetic: Arithmetic) -> None:
        super().__init__(lowering, layout, arithmetic)
        self.boxed: set[int] = set()
        self.pools = {key: _Pool(letter) for key, letter in zip("tbwv", "tbwv", strict=True)}
        self.owned: dict[int, tuple[_Pool, str]] = {}
        self.namespace.update(
            array=np.array, copyto=np.copyto, zero=np.zeros(()), near=np.array(NEAR),
        )  # fmt: skip
        self.needed, self.uses, self.outputs = self.usage.needed, self.usage.uses, self.usage.outputs

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
        wide = next((b.cols for b in map(self.layout.blocks.__getitem__, self.lowering.results) if b.cols > 1), 1)
        for pool in self.pools.values():
            for number in range(pool.count):
                place = f'buffers["{pool.letter}"][{number}]'
                view = f"[:n * {wide}].reshape({wide}, n)" if pool.letter in "wv" else "[:n]"
                head.append(f"    {pool.letter}{number} = {place}{view}")
        return "\n".join([*head, *self.lines, "    return"]) + "\n"

    def _release(self, numbers: list[int] | tuple[int, ...], place: int) -> None:
        for number in numbers:
            if self.usage.last.get(number) == place and number in self.owned:
                pool, name = self.owned.pop(number)
                pool.give(name)

    def _pool(self, extent: int, mask: bool) -> _Pool:
        wide = bool(extent & COLS)
        return self.pools["v" if mask and wide else "b" if mask else "w" if wide else "t"]

    def _target(self, number: int) -> str:
        """Where a value along the rows is computed: its block's cells, or a buffer."""
        value = self.values[number]
        block = self.outputs.get(number)
        if block is not None:
            name = f"o{block}"
            line = f"{name} = {self._cells(block)}"
            if f"    {line}" not in self.lines:
                self.line(line)
            return name
        pool = self._pool(value.extent, value.kind == "mask")
        name = pool.take()
        self.owned[number] = pool, name
        return name

    def _cells(self, block: int) -> str:
        shape, start = self.layout.blocks[block], self.layout.block_offsets[block]
        if shape.cols == 1:
            return f"numbers[{start} + i:{start} + j]"
        return f"numbers[{start}:{start + shape.rows * shape.cols}].reshape({shape.cols}, {shape.rows})[:, i:j]"

    def _argument(self, number: int, along: bool) -> str:
        """An operand's name; a single number among columns as an array without axes, which numpy takes faster."""
        value, name = self.values[number], self.names[number]
        if not along or value.extent or value.kind != "number":
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
        if value.extent & ROWS:
            self._along(number, value, place)
        elif value.extent == COLS:
            self.names[number] = f"r{number}"
            self._across(number, value)
            self._release(value.args, place)
        else:
            self.define(number)

    def _across(self, number: int, value: Value) -> None:
        args = [self.names[arg] for arg in value.args]
        if value.op == "across":
            self.namespace[f"places{number}"] = np.array(value.data)[:, None]
            text = f"numbers[places{number}]"
        elif value.op.startswith("columns_") and isinstance(value.data, tuple):
            parts = ", ".join(f"numbers[{start}:{end}].{value.op[8:]}()" for start, end in value.data)
            text = f"array([{parts}])[:, None]"
        elif value.op in HELPERS:
            self.namespace[value.op] = self.helper(value.op)
            text = f"{value.op}({', '.join(args)}{f', {value.data}' if value.op == 'rounded' else ''})"
        elif value.op == "snap":
            result, left = args
            text = (
                f"{self.function('where')}((abs({result}) < NEAR * abs({left})) & (abs({result}) < 1), 0.0, {result})"
            )
        else:
            text = f"{self.function(value.op)}({', '.join(args)})"
        self.line(f"r{number} = {text}")

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
        args = [self._argument(arg, True) for arg in value.args]
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

    def _cells_in_all(self) -> int:
        return max(block.rows * block.cols for block in map(self.layout.blocks.__getitem__, self.lowering.results))

    def _where(self, number: int, value: Value, args: list[str]) -> None:
        self.names[number] = target = self._target(number)
        if self.values[value.args[0]].extent == 0:
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
        values, masks = self._pool(value.extent, False), self._pool(value.extent, True)
        size, mask = values.take(), masks.take()
        self.line(f"{self.function('absolute')}({target}, {size})")
        inside = ""
        if self.values[left].extent == value.extent:
            limit = values.take()
            if self._cells_in_all() > _LARGE:
                # Least and largest are found in half the time of a comparison cell by cell, once there are many.
                self.namespace["least"], self.namespace["most"] = np.minimum.reduce, np.maximum.reduce
                most = f"max(most({args[1]}, None), -least({args[1]}, None))"
                self.line(f"if least({size}, None) < NEAR * {most}:")
                inside = "    "
            self.line(f"{inside}absolute({args[1]}, {limit})")
            self.line(f"{inside}{self.function('multiply')}({limit}, near, {limit})")
            values.give(limit)
        else:
            limit = f"NEAR * abs({self.names[left]})"
        self.line(f"{inside}{self.function('less')}({size}, {limit}, {mask})")
        self.line(f"{inside}if {mask}.tobytes().find(1) >= 0: {target}[{mask} & ({size} < 1)] = 0.0")
        values.give(size)
        masks.give(mask)

    def _running(self, number: int, value: Value, args: list[str]) -> None:
        place = value.data[0] if isinstance(value.data, tuple) else 0
        self.names[number] = target = self._target(number)
        values, masks = self.pools["t"], self.pools["b"]
        steps, mask = values.take(), masks.take()
        self.line(f"copyto({steps}, {args[0]})")
        self.line(f"{steps}[0] = item({place} + i) + item_of({steps})")
        self.namespace["item_of"] = HELPERS["item_of"]
        self.namespace["accumulate"] = np.add.accumulate
        self.line(f"accumulate({steps}, 0, None, {target})")
        # A sum that cancels to almost nothing is snapped, and what follows starts from 0: the interpreter does that.
        self.line(f"{self.function('absolute')}({target}, {steps})")
        limit = values.take()
        self.line(f"absolute({args[0]}, {limit})")
        self.line(f"{self.function('multiply')}({limit}, 2 * NEAR, {limit})")
        self.line(f"{self.function('less')}({steps}, {limit}, {mask})")
        self.line(f"if {mask}.tobytes().find(1) >= 0 and ({mask} & ({target} != 0)).any(): raise TroubleError")
        for name in (steps, limit):
            values.give(name)
        masks.give(mask)

    def _helped(self, number: int, value: Value, args: list[str]) -> None:
        self.namespace[value.op] = HELPERS[value.op]
        self.names[number] = target = self._target(number)
        digits = f", {value.data}" if value.op == "rounded" else ""
        self.line(f"copyto({target}, {value.op}({', '.join(args)}{digits}))")

    def _unwrapped(self, number: int, value: Value, args: list[str]) -> None:
        self.names[number] = target = self._target(number)
        self.namespace["unwrapped"] = unwrapped
        # into a buffer first: what is the same in all rows is one number
        self.line(f"copyto({target}, {args[0]})")
        above = f'buffers["above"][{value.data}] if i == 0 else item({value.data} + i)'
        self.line(f"copyto({target}, unwrapped({target}, {args[1]}, {above}))")

    _SPECIAL: ClassVar[dict[str, Callable[[_Emitter, int, Value, list[str]], None]]] = {
        "where": _where, "snap": _snap, "running": _running, "rounded": _helped, "unwrapped": _unwrapped,
        "pick": _helped,
    }  # fmt: skip

    def _effect(self, effect: Effect) -> None:
        if effect.what == "store" and isinstance(effect.data, int):
            self._store(effect.value, effect.data)
        elif effect.what == "somewhere" and isinstance(effect.data, int):
            self._somewhere(effect.value, effect.data)
        else:
            name, wrong = self.names[effect.value], 1 if effect.what == "never" else 0
            if self.values[effect.value].extent:
                self.line(f"if {name}.tobytes().find({wrong}) >= 0: raise TroubleError")
            else:
                self.line(f"if {'not ' * (1 - wrong)}{name}: raise TroubleError")

    def _somewhere(self, x: int, y: int) -> None:
        """ATAN2(0, 0) is an error that the processor does not know."""
        a, b = self.names[x], self.names[y]
        if self.values[x].extent == 0 or self.values[y].extent == 0:
            single, other = (x, b) if self.values[x].extent == 0 else (y, a)
            test = f"({other} == 0).any()" if self.values[x].extent or self.values[y].extent else f"{other} == 0"
            self.line(f"if {self.names[single]} == 0 and {test}: raise TroubleError")
            return
        extent = self.values[x].extent
        if extent & ROWS:
            pool = self._pool(extent, True)
            mask = pool.take()
            self.line(f"{self.function('equal')}({a}, zero, {mask})")
            pool.give(mask)
        else:
            mask = "beside"
            self.line(f"beside = {a} == 0")
        self.line(f"if {mask}.tobytes().find(1) >= 0 and ({mask} & ({b} == 0)).any(): raise TroubleError")

    def _store(self, number: int, block: int) -> None:
        if self.values[number].kind == "text":
            self.line(f"{self._cells(block).replace('numbers', 'codes')}.fill({TEXT})")
        if self.outputs.get(number) == block:
            return
        shape = self.layout.blocks[block]
        if shape.rows == shape.cols == 1:
            self.line(f"numbers[{self.layout.block_offsets[block]}] = {self.names[number]}")
        else:
            self.line(f"{self._cells(block)}[...] = {self.names[number]}")
