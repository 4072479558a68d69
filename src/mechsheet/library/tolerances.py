"""What the tolerances of a design come to: the bands of its outputs and summaries, as its workbook has them."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass, replace

from mechsheet.description import Overrides
from mechsheet.description.reader import with_settings
from mechsheet.library.building import told
from mechsheet.library.named import Named
from mechsheet.model import Mechanism
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.columns.bands import ROOT, WORST
from mechsheet.sheet.plan import MEANING
from mechsheet.sheet.shown import shown_unit
from mechsheet.sheet.table.tolerance import lines_of
from mechsheet.units import behind_number


@dataclass(frozen=True, slots=True)
class Band:
    """Of one quantity or summary; None for no number (a dead centre, no position).

    value       of a summary; None for a quantity, which has one in every row
    worst, rss  the worst case and the root sum of squares, in `unit`; of a quantity where its band is largest
    shares      by dimension (S t)^2 of the sum of squares, at most 1
    words       what the first sheet says
    """

    value: float | None
    worst: float | None
    rss: float | None
    unit: str
    shares: dict[str, float | None]
    words: str

    def __str__(self) -> str:
        unit = behind_number(self.unit)
        if self.worst is None or self.rss is None:
            return f": {self.words}"
        shares = sorted(self.shares.items(), key=lambda pair: -(pair[1] or 0.0))
        said = ", ".join(f"{dimension} {share:.0%}" for dimension, share in shares if share is not None)
        return f" ± {self.worst:.3g}{unit} (RSS {self.rss:.3g}{unit}): {said}; {self.words}"


def bands_of(mechanism: Mechanism, file: str = "<text>") -> Named[Band]:
    """The bands of a mechanism's [tolerance]; without one of all its outputs and summaries.

    file  what messages call its description

    Raises DescriptionError where no dimension has a tolerance or nothing can have a band, MechanismError where the mechanism
    cannot be solved.
    """
    compiled = told(with_settings(mechanism, Overrides(tolerance=True), file))
    plan = compiled.plan

    def number(spot: Spot) -> float | None:
        found = compiled.number(spot)
        return None if math.isnan(found) else found

    result: Named[Band] = Named()
    for line in lines_of(plan):
        if line.kind == "shown":
            continue
        key = line.key
        band, spot = plan.banded[line.quantity], plan.places.bands[key]
        title = plan.at.titles["tolerance"]
        words = compiled.value(replace(spot, col=MEANING))
        result[key] = Band(
            value=number(plan.places.summaries[key]) if line.summary else None,
            worst=number(line.spot(plan, WORST)),
            rss=number(line.spot(plan, ROOT)),
            unit=shown_unit(plan, line.quantity),
            shares={
                name: number(Spot(title, line.row + 1, plan.at.spots[symbol].col))
                for name, symbol in zip(band.dimensions, band.derivatives, strict=True)
            },
            words=words if isinstance(words, str) else "",
        )
    return result


def bands_text(mechanism: Mechanism, file: str = "<text>") -> str:
    """The same, one a line: `swing ± 0.28° (RSS 0.156°): a2 66%, a4 20%, a1 9%, a3 5%; 78.9° ± 0.3°; mostly a₂ (66 %)`."""
    return str(bands_of(mechanism, file))


def bands_json(mechanism: Mechanism, file: str = "<text>") -> str:
    """{"swing": {"value": 78.9, "worst": 0.28, "rss": 0.156, "unit": "°", "shares": {"a2": 0.66, ...}, "words": "..."}}."""
    found = {name: asdict(band) for name, band in bands_of(mechanism, file).items()}
    return json.dumps(found, ensure_ascii=False, indent=1)
