"""What is not drawn but written: speed, motion law, loads, masses, a spring, a gear; each ready, with a remark behind it.

The names in it are those of the drawing, so what is written works at once, and its numbers are there to be changed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import count

from livesheet.formula.names import folded
from mechsheet.description.text.index import key_text
from mechsheet.description.text.rewrite import without_key
from mechsheet.description.text.rewrite_tables import with_last_key, with_table
from mechsheet.drawing_page.editing.links import ground_pin, link
from mechsheet.drawing_page.editing.naming import free_symbol
from mechsheet.drawing_page.editing.shaping import size_of
from mechsheet.drawing_page.editing.sheet import Sheet, rounded
from mechsheet.drawing_page.positions import Point, local_places
from mechsheet.drawing_page.questions import Impossible, Refusal
from mechsheet.model import Link
from mechsheet.words.catalogue import Language, words

WIDE = 26
"""Characters before a remark, so that those of one table stand below one another."""
WHEEL = 0.5
"""The distance of a new wheel's axis, of the drawing's size."""


@dataclass(frozen=True, slots=True)
class Wish:
    """What shall be inserted for whom.

    chosen    the link or point that is chosen on the page, "" for none
    mobility  degrees of freedom of what is drawn;  language: of the remarks
    """

    link: str = ""
    point: str = ""
    mobility: int | None = None
    language: Language = "en"

    def noted(self, value: str, key: str, **parts: str) -> str:
        """A value with a remark behind it; `key`: what it is the value of, if that is written elsewhere."""
        note = words(self.language, f"draw.insert.note.{key}", **parts)
        return f"{value:<{WIDE - len(key) - 3}}  # {note}"

    def line(self, key: str, value: str, **parts: str) -> str:
        """A line of TOML, `key = value`, with a remark behind it."""
        return f"{key} = {self.noted(value, key, **parts)}"


def insert(sheet: Sheet, what: str, wish: Wish) -> Sheet:
    """The sheet with something more in its text. Raises Impossible where the drawing has nothing that it could belong to."""
    if what not in KINDS:
        raise Refusal(f'nothing that can be inserted is called "{what}"')
    return KINDS[what](sheet, wish)


# --- the driver's motion ---------------------------------------------------------------------------------------------


def _speed(sheet: Sheet, wish: Wish) -> Sheet:
    driver = _driver_table(sheet, "speed", "motion")
    unit, value = ("rpm", "60") if driver.get("link") else (f"{sheet.parts.length_unit}/s", "100")
    line = wish.noted(f'{{ value = {value}, unit = "{unit}" }}', "speed")
    return sheet.again(with_last_key(sheet.source, ("driver",), "speed", line), {})


def _motion(sheet: Sheet, wish: Wish) -> Sheet:
    if "values" in _driver_table(sheet, "motion"):
        raise Impossible("listed")
    source = sheet.source
    for key in ("step", "speed", "acceleration"):  # the law says all of them
        source = without_key(source, ("driver", key))
    line = wish.noted('{ law = "cycloidal", duration = 2 }', "motion")
    return sheet.again(with_last_key(source, ("driver",), "motion", line), {})


def _driver_table(sheet: Sheet, *taken: str) -> Mapping[str, object]:
    """What is written of the driver; none of the keys `taken` may be there."""
    driver = sheet.source.data.get("driver")
    spot = sheet.source.spots.get(("driver",))
    if not isinstance(driver, dict) or spot is None or spot.how != "header":
        raise Impossible("drive_first")
    for key in taken:
        if key in driver:
            raise Impossible("there_already", name=f"[driver] {key}")
    return driver


# --- loads -----------------------------------------------------------------------------------------------------------


def _force(sheet: Sheet, wish: Wish) -> Sheet:
    loaded = _loaded(sheet, wish)
    points = list(loaded.points)
    free = [point for point in points if point not in sheet.ground.points] or points
    point = wish.point if wish.point in points else free[-1] if free else ""
    lines = [wish.line("name", f'"{_load_name(sheet, "P")}"'), wish.line("link", _quoted(loaded.name))]
    if len(points) > 1:
        lines.append(wish.line("point", _quoted(point)))
    lines.append(wish.line("force", "[0, -100]", unit=_force_unit(sheet)))
    return _with_load(sheet, lines)


def _torque(sheet: Sheet, wish: Wish) -> Sheet:
    lines = [
        wish.line("name", f'"{_load_name(sheet, "M")}"'),
        wish.line("link", _quoted(_loaded(sheet, wish).name)),
        wish.line("torque", "-1"),
    ]
    return _with_load(sheet, lines)


def _spring(sheet: Sheet, wish: Wish) -> Sheet:
    first, second = _apart(sheet, wish.point)
    length = rounded(math.dist(sheet.drawn.places[first], sheet.drawn.places[second]), sheet.digits)
    lines = [
        wish.line("name", f'"{_load_name(sheet, "K")}"'),
        wish.line("between", f"[{_quoted(first)}, {_quoted(second)}]"),
        wish.line("stiffness", "0.5", unit=f"{_force_unit(sheet)}/{sheet.parts.length_unit}"),
        wish.line("free_length", length),
        wish.line("damping", "0", unit=f"{_force_unit(sheet)} s/{sheet.parts.length_unit}"),
    ]
    return _with_load(sheet, lines)


def _masses(sheet: Sheet, wish: Wish) -> Sheet:
    source = sheet.source
    described = source.data.get("links")
    for moving in sheet.parts.links[1:]:
        own = described.get(moving.name) if isinstance(described, dict) else None
        spot = source.spots.get(("links", moving.name))
        if not isinstance(own, dict) or "mass" in own or spot is None or spot.how != "header":
            continue
        path = ("links", moving.name)
        source = with_last_key(source, path, "mass", wish.noted("1", "mass"))
        if len(moving.points) > 1:
            places = list(local_places(moving, sheet.parts.numbers).values())
            middle = [rounded(sum(part) / len(places), sheet.digits) for part in zip(*places, strict=True)]
            source = with_last_key(source, path, "center", wish.noted(f"[{', '.join(middle)}]", "center"))
    if source is sheet.source:
        raise Impossible("there_already", name="mass")
    if "gravity" not in source.data.get("dynamics", {}):
        source = with_last_key(source, ("dynamics",), "gravity", "9.81")
    return sheet.again(source, {})


def _loaded(sheet: Sheet, wish: Wish) -> Link:
    """The link that a load acts on: the chosen one, one at the chosen point, else the last, which is not driven."""
    moving = list(sheet.parts.links[1:])
    driven = sheet.parts.driver.link if sheet.parts.driver else ""
    wanted = [each for each in moving if each.name == wish.link]
    wanted += [each for each in moving if wish.point in each.points]
    wanted += [each for each in reversed(moving) if each.name != driven] + moving
    if not wanted:
        raise Impossible("draw_first")
    return wanted[0]


def _apart(sheet: Sheet, chosen: str) -> tuple[str, str]:
    """Two points whose distance changes: of the ground and of a link far from it, or the chosen one and another."""
    fixed = list(sheet.ground.points)
    moving = [point for each in reversed(sheet.parts.links[1:]) for point in each.points if point not in fixed]
    first = [chosen] if chosen in moving else moving
    owners = {point: {each.name for each in sheet.parts.links_at(point)} for point in (*moving, *fixed)}
    pairs = [(a, b) for a in first for b in (*fixed, *moving) if a != b and not owners[a] & owners[b]]
    if not pairs or any(point not in sheet.drawn.places for point in pairs[0]):
        raise Impossible("spring_apart")
    return pairs[0]


def _load_name(sheet: Sheet, wanted: str) -> str:
    loads = sheet.source.data.get("loads")
    listed = loads if isinstance(loads, list) else []
    used = {folded(str(load.get("name", f"L{n}"))) for n, load in enumerate(listed, 1) if isinstance(load, dict)}
    names = (wanted if n == 1 else f"{wanted}{n}" for n in count(1))
    return next(name for name in names if folded(name) not in used and free_symbol(sheet.parts, name) == name)


def _force_unit(sheet: Sheet) -> str:
    given = sheet.source.data.get("dynamics")
    unit = given.get("force_unit") if isinstance(given, dict) else None
    return unit if isinstance(unit, str) else "N"


def _with_load(sheet: Sheet, lines: list[str]) -> Sheet:
    loads = sheet.source.data.get("loads")
    number = len(loads) if isinstance(loads, list) else 0
    return sheet.again(with_table(sheet.source, ("loads", number), lines), {})


# --- gears -----------------------------------------------------------------------------------------------------------


def _gear(sheet: Sheet, wish: Wish) -> Sheet:
    """Between two links that turn about pins of the ground where the drawing has a freedom too many; else a new wheel."""
    turning = [each for each in sheet.parts.links[1:] if _pivot(sheet, each)]
    driven = sheet.parts.driver.link if sheet.parts.driver else ""
    turning.sort(key=lambda each: (each.name != wish.link, each.name != driven))
    if not turning:
        raise Impossible("gear_pivot")
    on, *others = turning
    joined = [other for other in reversed(others) if not set(other.points) & set(on.points)]
    further = sheet.source.data.get("drivers")
    driven_ones = 1 + (len(further) if isinstance(further, list) else 0)
    if wish.mobility is not None and wish.mobility > driven_ones and joined:
        meshing = joined[0].name
    else:
        sheet, meshing = _with_wheel(sheet, _pivot(sheet, on))
    lines = [
        wish.line("type", '"gear"'),
        f"link = {wish.noted(_quoted(meshing), 'gear')}",
        wish.line("on", _quoted(on.name)),
        wish.line("ratio", '"-1"'),
    ]
    source = sheet.source
    return sheet.again(with_table(source, ("joints", len(sheet.parts.orders)), lines), {})


def _pivot(sheet: Sheet, turning: Link) -> str:
    """The pin of the ground about which a link turns, "" for none."""
    return next((point for point in turning.points if point in sheet.ground.points), "")


def _with_wheel(sheet: Sheet, beside: str) -> tuple[Sheet, str]:
    """A new link that turns about a new pin of the ground, right of everything that is drawn, and its name."""
    places = sheet.drawn.places
    size = size_of(places)
    right, height = max(x for x, _ in places.values()), places[beside][1]
    axis = (round(right + WHEEL * size, max(0, sheet.digits - 2)), height)
    sheet = ground_pin(sheet, {"at": list(axis)})
    pin = next(point for point, place in sheet.drawn.places.items() if point not in places and place == axis)
    rim: Point = (axis[0], round(height + WHEEL * size / 4, sheet.digits))
    known = {each.name for each in sheet.parts.links}
    sheet = link(sheet, [{"point": pin}, {"at": list(rim)}])
    return sheet, next(each.name for each in sheet.parts.links if each.name not in known)


def _quoted(name: str) -> str:
    """A name as a text of TOML."""
    text = key_text(name)
    return text if text.startswith(('"', "'")) else f'"{text}"'


KINDS: dict[str, Callable[[Sheet, Wish], Sheet]] = {
    "speed": _speed,
    "motion": _motion,
    "force": _force,
    "torque": _torque,
    "spring": _spring,
    "masses": _masses,
    "gear": _gear,
}
"""What can be inserted, in the order of the page's menu."""
