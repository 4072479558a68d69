"""Places by key, for the modules of the sheet of extremes that still read and hand out places so.

`extremes`, `one_extreme`, `limits` and `rivals` find and leave cells that are no quantities in
`Addresses.spots`, under keys that begin with "#". Here these keys become `Searched`, and places become keys; nobody else
knows any.
"""

from __future__ import annotations

from dataclasses import replace

from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.extremes import Extremes
from mechsheet.sheet.checks.limits import STRETCHES
from mechsheet.sheet.places import Extreme, Searched, Stretch
from mechsheet.sheet.plan import Plan


def hand_in(plan: Plan) -> None:
    """What these modules read."""
    places, spots = plan.places, plan.at.spots
    keyed = {"step": places.step, "position": places.position, "number": places.number, "rows": places.rows}
    keyed |= {"status": places.status, "inputs": places.inputs, "begun": plan.checked.begun}
    keyed |= {f"least_{group}": spot for group, spot in plan.checked.least.items()}
    keyed |= {f"grashof_{loop.group}": places.excess(loop.group) for loop in plan.found.four_bars}
    spots.update({f"#{key}": spot for key, spot in keyed.items() if spot is not None})


def handed_out(extremes: Extremes) -> Searched:
    """What they hand out."""
    plan = extremes.plan
    spots = plan.at.spots

    def at(key: str) -> Spot:
        return spots[f"#{key}"]

    limits = (at(f"limit_{number}") for number in range(1, extremes.limits.count + 1))
    return Searched(
        at("whole"), at("fine"), at("there"), at("all_rows"), at("stretches"), at("unsettled"), at("rows_only"),
        spots.get("#worst_group"),
        [Stretch(*(at(f"{key}_{number}") for key in ("first", "last", "from", "to", "stretch")))
         for number in range(1, STRETCHES + 1)],
        [replace(spot, named=plan.mechanism.references == "names") for spot in limits],
        {
            (way, symbol): Extreme(
                at(f"{way}_{symbol}"), at(f"{way}_at_{symbol}"), spots.get(f"#{way}_turns_{symbol}")
            )
            for symbol, way in extremes.sought
        },
        {symbol: at(f"wraps_{symbol}") for symbol in extremes.quantities},
        {(way, name): at(f"{way} {name}") for symbol, way in extremes.bands for name in plan.banded[symbol].derivatives},
        {number: (at(f"gap_least_{number}"), at(f"gap_row_{number}")) for number in extremes.gaps},
        {loop: at(f"reach_{loop}") for loop in extremes.loops if f"#reach_{loop}" in spots},
    )  # fmt: skip
