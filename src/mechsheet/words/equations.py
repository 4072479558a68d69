"""What quantities, links and groups are called: those of equations, the steps of a synthesis, and numbers that a description
gives elsewhere than among its dimensions."""

from __future__ import annotations

from collections.abc import Iterable

from livesheet.said import Words
from mechsheet.model import Dimension, Label, Link, Mechanism, Rack
from mechsheet.words.catalogue import Language, words
from mechsheet.words.symbols import plain

from .catalogue import Listed, Phrase, Term

NOTHING = Label("")

BLOCK = "block of "
"""How the massless block of a pin-slot joint is called, before the joint's symbol."""


def phrase(key: str, **parts: str | Words) -> Words:
    """What a quantity is called, with its parts in place."""
    return Phrase(f"equation.{key}", tuple(parts.items()))


def listed(names: Iterable[Words]) -> Words:
    """Names beside each other."""
    return Listed(tuple(names), " + ")


def several(names: Iterable[Words]) -> Words:
    """Names one after another."""
    return Listed(tuple(names), ", ")


def link_words(link: Link) -> Words:
    """A link: the label of the description, or the field's own word for a common name; another name stays as it is."""
    return link.label or Term("link", link.name)


def body_words(mechanism: Mechanism, name: str) -> Words:
    """A link, or the block of a pin-slot joint, by its name."""
    if name.startswith(BLOCK):
        return phrase("block", symbol=name.removeprefix(BLOCK))
    return next((link_words(link) for link in mechanism.links if link.name == name), Label(name))


ENDS = (Phrase("step.end.first"), Phrase("step.end.last"))


def step_words(key: str, **parts: object) -> Words:
    """What an input of a task or a step of its solution is, its {parts} filled in."""
    return Phrase(f"step.{key}", tuple(parts.items()))


def given_words(mechanism: Mechanism, language: Language, dim: Dimension) -> str:
    """What a dimension is that the description gives elsewhere than among its dimensions; "" for one of these."""
    match dim.path:
        case ():
            return ""
        case ("driver", "motion", "duration"):
            law = mechanism.driver.law
            return (
                words(language, "motion.duration", law=words(language, f"law.{law.name}"), rows=law.rows) if law else ""
            )
        case ("driver", "segments", int(number), str(key)):
            parts = mechanism.segments.parts if mechanism.segments is not None else ()
            return words(language, f"cam.{key}", number=number + 1, law=words(language, f"segment.{parts[number].law}"))
        case ("driver", "start") if mechanism.driver.law is None:
            return words(language, "cam.start")
        case ("cam", str(key), *_):
            return words(language, f"cam.{key}")
        case ("driver", ("start" | "stop") as key):
            return words(language, f"motion.{key}")
        case ("driver", str(key)):
            return words(language, f"motion.{key}{'.own' if dim.symbol == key else ''}")  # in a unit of its own
        case ("drivers", int(), "value"):
            return words(language, "drivers.value")
        case ("joints", int(order), str(key)):
            relation = next(relation for relation in mechanism.relations if relation.order == order)
            kind, on = ("rack", relation.joint) if isinstance(relation, Rack) else (relation.kind, relation.on)
            links = {link.name: link_words(link).of(language) for link in mechanism.links}
            return words(language, f"gears.{kind}.{key}", link=links[relation.link], on=links.get(on, plain(on)))
        case ("flywheel", _):
            return words(language, "motion.fluctuation")
        case ("dynamics", "gravity"):
            return words(language, "masses.gravity")
        case ("dynamics", "gravity", int(axis)):
            return words(language, "masses.gravity.part", axis="xy"[axis])
        case ("links", str(name), str(key), *rest):
            return words(
                language, f"masses.{key}", axis="xy"[int(rest[0])] if rest else "", **_link(mechanism, language, name)
            )
        case ("loads", int(number), str(key), *rest):
            dynamics = mechanism.dynamics
            load = next((load for load in dynamics.loads if load.order == number), None) if dynamics else None
            if load is None:
                return words(language, f"loads.{key}", number=number + 1)
            own = ".link" if load.in_link and key == "force" else ""
            return words(
                language,
                f"loads.{key}{own}",
                axis="xy"[int(rest[0])] if rest else "",
                **_link(mechanism, language, load.link),
            )
    raise ValueError(f"a dimension from nowhere: {dim.symbol}")


def _link(mechanism: Mechanism, language: Language, name: str) -> dict[str, object]:
    link = mechanism.link(name)
    return {"number": link.number, "link": link_words(link).of(language)}
