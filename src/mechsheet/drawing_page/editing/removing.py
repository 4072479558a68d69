"""What is taken away: links, points, sliding joints, and what nobody needs without them: their dimensions, their sketch."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from mechsheet.description.force_names import first_key
from mechsheet.description.parts import Parts, parts_of
from mechsheet.description.text.rewrite import without_key, without_table
from mechsheet.description.text.source import Source
from mechsheet.drawing_page.questions import Impossible, Refusal
from mechsheet.drawing_page.reading import read_by_guide, reads_of
from mechsheet.model import Joint


def without(source: Source, kind: str, name: str) -> Source:
    """The text without a link, a point or a joint, and without the dimensions that it alone read."""
    parts = parts_of(source)
    before = _read_by_places(parts) | _named_by_mass(source, name if kind in ("link", "mass") else "")
    if kind == "link":
        source = _without_link(source, parts, name)
    elif kind == "point":
        source = _without_point(source, parts, name)
    elif kind == "joint":
        source = _without_joint(source, parts, name)
    elif kind == "load":
        source = _without_entries(source, "loads", lambda load, n: str(load.get("name", f"L{n + 1}")) == name)
    elif kind == "mass":
        for key in ("mass", "center", "inertia"):
            source = without_key(source, ("links", name, key))
    else:
        raise Refusal(f'nothing of the kind "{kind}" can be deleted')
    if first_key(source.data.get("links", {}), source.data.get("loads", [])) is None:
        source = without_table(source, ("dynamics",))  # units and gravity of nothing
    return _without_dimensions(source, before - _read_by_places(parts_of(source)))


def _named_by_mass(source: Source, link: str) -> set[str]:
    """Dimensions that a link's mass and moment of inertia name."""
    own = source.data.get("links", {}).get(link, {})
    return {word for key in ("mass", "inertia") for text in _expressions(own.get(key)) for word in _words(text)}


def _without_entries(source: Source, key: str, gone: Callable[[Mapping[str, Any], int], bool]) -> Source:
    """The text without those entries of a list of tables; with their order in it."""
    given = source.data.get(key)
    entries = list(enumerate(given)) if isinstance(given, list) else []
    for number, entry in reversed(entries):  # from the last, so that the others keep their places
        if isinstance(entry, dict) and gone(entry, number):
            source = without_table(source, (key, number))
    return source


def _without_what_names(source: Source, names: set[str], keys: tuple[str, ...]) -> Source:
    """The text without gears, racks, loads and further drivers that name one of these links, joints or points."""

    def names_one(entry: Mapping[str, Any], _number: int) -> bool:
        ends = entry.get("between", [])
        return any(entry.get(key) in names for key in keys if isinstance(entry.get(key), str)) or bool(names & {*ends})

    for key in ("joints", "loads", "drivers"):
        source = _without_entries(source, key, names_one)
    return source


def _read_by_places(parts: Parts) -> set[str]:
    """The dimensions that places and guides follow from."""
    found = {symbol for link in parts.links for symbol in reads_of(link, parts)}
    return found.union(*(read_by_guide(joint) for joint in parts.joints))


def _without_link(source: Source, parts: Parts, name: str) -> Source:
    link = parts.link(name)
    if link is None or link is parts.links[0]:
        raise Impossible("ground_stays")
    source = _without_joints(source, parts, [joint for joint in parts.joints if name in (joint.link, joint.on)])
    source = _without_what_names(source, {name}, ("link", "on", "arm", "relative_to"))
    source = without_table(source, ("links", name, "points"))
    source = without_table(source, ("links", name))
    if parts.driver is not None and name in (parts.driver.link, parts.driver.relative_to):
        source = _without_driver(source)
    return _tidied(source, set(link.points))


def _without_joints(source: Source, parts: Parts, gone: list[Joint]) -> Source:
    """The text without sliding joints, and without a driver that is one of them."""
    for order in sorted((parts.orders[joint.name] for joint in gone), reverse=True):
        source = without_table(source, ("joints", order))
    names = {name for joint in gone for name in (joint.name, joint.symbol)}
    source = _without_what_names(source, {joint.name for joint in gone}, ("joint",))
    return _without_driver(source) if parts.driver is not None and parts.driver.joint in names else source


def _without_driver(source: Source) -> Source:
    return without_key(without_table(source, ("driver",)), ("assembly", "at"))


def _without_point(source: Source, parts: Parts, name: str) -> Source:
    """The point goes from every link. A link that it leaves with a single point, joined to nothing, goes too."""
    owners = parts.links_at(name)
    if not owners:
        raise Refusal(f'there is no point "{name}"')
    gone = [joint for joint in parts.joints if name in (joint.point, joint.through)]
    source = _without_joints(source, parts, gone)
    for link in owners:
        left = [point for point in link.points if point != name]
        sliding = any(link.name in (joint.link, joint.on) for joint in parts.joints if joint not in gone)
        if link is not parts.links[0] and (not left or (len(left) == 1 and not sliding)):
            found = parts_of(source)
            if found.link(link.name) is not None:
                source = _without_link(source, found, link.name)
        else:
            source = without_key(source, ("links", link.name, "points", name))
    return _tidied(_without_what_names(source, {name}, ("point",)), {name})


def _without_joint(source: Source, parts: Parts, name: str) -> Source:
    joint = next((joint for joint in parts.joints if joint.name == name), None)
    if joint is None:
        raise Refusal(f'there is no sliding joint "{name}"')
    source = _without_joints(source, parts, [joint])
    block = parts.link(joint.link)
    alone = block is not None and len(block.points) == 1 and joint.kind == "prismatic"
    if alone and block is not None and not any(joint.link in (o.link, o.on) for o in parts.joints if o is not joint):
        source = _without_link(source, parts_of(source), joint.link)
    return source


def _tidied(source: Source, points: set[str]) -> Source:
    """The sketch without points that no link has any more."""
    parts = parts_of(source)
    for point in points:
        if not parts.links_at(point):
            source = without_key(source, ("assembly", point))
    return source


def _without_dimensions(source: Source, symbols: set[str]) -> Source:
    """The text without dimensions, where nothing else in it names them."""
    for symbol in sorted(symbols):
        trial = without_key(source, ("dimensions", symbol))
        named = any(symbol in _words(text) for text in _expressions(trial.data))
        if not named:
            source = trial
    return source


def _expressions(value: object) -> list[str]:
    """All texts of the data, in which a dimension may be named."""
    if isinstance(value, str):
        return [value]
    if isinstance(value, dict):
        return [text for each in value.values() for text in _expressions(each)]
    return [text for each in value for text in _expressions(each)] if isinstance(value, list) else []


def _words(text: str) -> set[str]:
    return set(re.findall(r"[^\W\d][\w]*", text))
