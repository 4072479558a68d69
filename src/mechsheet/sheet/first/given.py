"""What stands behind the input cells of the driver's motion, of gears, of masses and of loads."""

from __future__ import annotations

from mechsheet.model import Dimension, Rack
from mechsheet.sheet.plan import Plan
from mechsheet.words.equations import link_words
from mechsheet.words.symbols import plain


def given_words(plan: Plan, dim: Dimension) -> str:
    """What a dimension is that the description gives elsewhere than among its dimensions; "" for one of these."""
    match dim.place:
        case ():
            return ""
        case ("driver", "motion", "duration"):
            law = plan.mechanism.driver.law
            return plan.text("motion.duration", law=plan.text(f"law.{law.name}"), rows=law.rows) if law else ""
        case ("driver", "segments", int(number), str(key)):
            parts = next(driver.segments.parts for driver in plan.mechanism.drivers if driver.segments is not None)
            return plan.text(f"cam.{key}", number=number + 1, law=plan.text(f"segment.{parts[number].law}"))
        case ("driver", "start") if plan.mechanism.driver.law is None:
            return plan.text("cam.start")
        case ("cam", str(key), *_):
            return plan.text(f"cam.{key}")
        case ("driver", ("start" | "stop") as key):
            return plan.text(f"motion.{key}")
        case ("driver", str(key)):
            return plan.text(f"motion.{key}{'.own' if dim.symbol == key else ''}")  # in a unit of its own
        case ("drivers", int(), "value"):
            return plan.text("drivers.value")
        case ("joints", int(order), str(key)):
            relation = next(relation for relation in plan.mechanism.relations if relation.order == order)
            kind, on = ("rack", relation.joint) if isinstance(relation, Rack) else (relation.kind, relation.on)
            links = {link.name: link_words(link).of(plan.language) for link in plan.mechanism.links}
            return plan.text(f"gears.{kind}.{key}", link=links[relation.link], on=links.get(on, plain(on)))
        case ("flywheel", _):
            return plan.text("motion.fluctuation")
        case ("dynamics", "gravity"):
            return plan.text("masses.gravity")
        case ("dynamics", "gravity", int(axis)):
            return plan.text("masses.gravity.part", axis="xy"[axis])
        case ("links", str(name), str(key), *rest):
            return plan.text(f"masses.{key}", axis="xy"[int(rest[0])] if rest else "", **_link(plan, name))
        case ("loads", int(number), str(key), *rest):
            dynamics = plan.mechanism.dynamics
            load = next((load for load in dynamics.loads if load.order == number), None) if dynamics else None
            if load is None:
                return plan.text(f"loads.{key}", number=number + 1)
            own = ".link" if load.in_link and key == "force" else ""
            return plan.text(f"loads.{key}{own}", axis="xy"[int(rest[0])] if rest else "", **_link(plan, load.link))
    raise ValueError(f"a dimension from nowhere: {dim.symbol}")


def words_of(plan: Plan, symbol: str) -> str:
    """What a quantity is: of an equation, or one that is given row by row beside the driver."""
    mechanism = plan.mechanism
    if symbol not in mechanism.given_by_row:
        return plan.equations.of(symbol).label.of(plan.language)
    if symbol in mechanism.listed_symbols:
        return plan.text("drivers.listed")
    keys = dict(zip(mechanism.driver_rates, ("speed", "acceleration"), strict=True))
    return plan.text(f"given.{keys.get(symbol, symbol)}")


def _link(plan: Plan, name: str) -> dict[str, object]:
    link = next(link for link in plan.mechanism.links if link.name == name)
    return {"number": link.number, "link": link_words(link).of(plan.language)}
