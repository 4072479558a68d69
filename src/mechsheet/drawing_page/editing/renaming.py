"""Points and links are given other names by whoever draws."""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula.names import folded
from mechsheet.description.scope import symbol_fault
from mechsheet.description.text.rewrite import Renamed, renamed
from mechsheet.drawing_page.editing.sheet import Sheet
from mechsheet.drawing_page.questions import Impossible, Refusal


def rename(sheet: Sheet, kind: Renamed, old: str, new: str) -> Sheet:
    """The sheet with another name for a point or a link, everywhere in its text. Raises Impossible for one that is taken."""
    new = new.strip()
    if kind == "point":
        taken = {point for link in sheet.parts.links for point in link.points}
        fault = symbol_fault(new)
    else:
        taken = {link.name for link in sheet.parts.links}
        sound = new[:1].isalpha() and all(sign.isalnum() or sign in "_-" for sign in new)
        fault = "" if sound else "-"
    if old not in taken:
        raise Refusal(f'there is no {kind} "{old}"')
    if new == old:
        return sheet
    if fault:
        raise Impossible(f"{kind}_name", name=new)
    if any(folded(new) == folded(name) for name in taken if name != old):
        raise Impossible("there_already", name=new)
    source = renamed(sheet.source, kind, old, new)
    places = {new if point == old and kind == "point" else point: at for point, at in sheet.drawn.places.items()}
    return replace(sheet.again(source, {}), drawn=replace(sheet.drawn, places=places))
