"""Every place of a plan by a text, as tests ask for them."""

from dataclasses import fields

from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.columns.bands import ROOT, WORST
from mechsheet.sheet.table.tolerance import lines_of
from mechsheet.sheet.task_rows import VALUE


def places_of(plan):
    """Quantities by symbol; the others by what they are: "verdict", "rows_closed", "summary high", "max_at_s14"."""
    places, found = plan.places, {}
    for part in filter(None, (places, plan.extremes, plan.checks)):
        spots = {field.name: getattr(part, field.name) for field in fields(part)}
        found |= {name: spot for name, spot in spots.items() if isinstance(spot, Spot)}
    found |= {f"show_{kind}": spot for kind, spot in places.arrows.items()}
    found |= {f"summary {symbol}": spot for symbol, spot in places.summaries.items()}
    found |= {f"band {symbol}": spot for symbol, spot in places.bands.items()}
    found |= {f"{key}_at": spot for key, spot in places.occurs.items()}
    for line in lines_of(plan) if plan.bands else ():
        of = f"of {line.key}" if line.summary else f"{line.kind} {line.key}"
        found |= {f"{part} {of}": line.spot(plan, part) for part in (WORST, ROOT)}
    if plan.extremes is not None:
        found |= {f"limit_{number}": spot for number, spot in enumerate(plan.extremes.limits, 1)}
        found |= {f"reach_{loop}": spot for loop, spot in plan.extremes.reach.items()}
        for (way, symbol), extreme in plan.extremes.extremes.items():
            found |= {f"{way}_{symbol}": extreme.value, f"{way}_at_{symbol}": extreme.occurs}
    if plan.synthesis is not None:
        title, rows = plan.at.titles["synthesis"], plan.synthesis.of.items()
        found |= {f"does {key}": Spot(title, row, VALUE) for (block, key), row in rows if block == "does"}
    return found | {**places.lines} | plan.at.spots
