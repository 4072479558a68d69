"""Which values of a lowering are needed, how often, until when, and which are computed straight into their cells."""

from __future__ import annotations

from .lowering import Effect, Lowering


def roots(effect: Effect) -> list[int]:
    """The values that an effect looks at."""
    if effect.what == "somewhere" and isinstance(effect.data, int):
        return [effect.value, effect.data]
    return [effect.value]


class Usage:
    """What the emitter must know before it writes the first line."""

    def __init__(self, lowering: Lowering) -> None:
        self.lowering = lowering
        self.values = lowering.values
        self.needed = self._needed()
        self.items = [item for item in lowering.order if isinstance(item, Effect) or item in self.needed]
        self.uses = self._uses()
        self.last = self._last_uses()
        self.outputs = self._outputs()

    def _needed(self) -> set[int]:
        stack = [v for item in self.lowering.order if isinstance(item, Effect) for v in roots(item)]
        found: set[int] = set()
        while stack:
            number = stack.pop()
            if number not in found:
                found.add(number)
                stack.extend(self.values[number].args)
        return found

    def _uses(self) -> dict[int, int]:
        uses = dict.fromkeys(self.needed, 0)
        for item in self.items:
            for number in roots(item) if isinstance(item, Effect) else self.values[item].args:
                uses[number] += 1
        return uses

    def _last_uses(self) -> dict[int, int]:
        last: dict[int, int] = {}
        for place, item in enumerate(self.items):
            for number in roots(item) if isinstance(item, Effect) else self.values[item].args:
                last[number] = place
        return last

    def _outputs(self) -> dict[int, int]:
        """Value -> where the column begins into whose cells it is computed directly."""
        found: dict[int, int] = {}
        for item in self.lowering.order:
            if isinstance(item, Effect) and item.what == "store" and isinstance(item.data, int):
                value = self.values[item.value]
                if value.along and value.op not in ("column", "count") and item.value not in found:
                    found[item.value] = item.data
        for number in list(found):
            value = self.values[number]
            if value.op == "snap" and self.uses[value.args[0]] == 1:
                found[value.args[0]] = found[number]
        return found
