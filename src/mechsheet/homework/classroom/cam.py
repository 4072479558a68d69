"""A cam in the words of a task: how it turns, what it moves by which laws, what touches it, how its angles count."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, with_symbols
from livesheet.workbook import Rich
from mechsheet.sheet.mathematics import Part
from mechsheet.words.catalogue import words
from mechsheet.words.equations import link_words

if TYPE_CHECKING:
    from mechsheet.homework.classroom.statement import Statement


def cam_lines(told: Statement) -> Iterator[Rich]:
    """The cam and its angle, the segments of the motion one after another, what the profile is made for."""
    mechanism = told.mechanism
    driver = mechanism.driver
    clockwise = driver.link == mechanism.ground.name  # seen from the cam the ground is driven
    turned = driver.relative_to if clockwise else driver.link
    center = next(iter(mechanism.link(turned).points))
    sense = told.text("cam.clockwise" if clockwise else "cam.counter_clockwise")
    yield Rich(((told.text("cam.turns", symbol=driver.symbol, center=center, sense=sense), ""),))
    follows: dict[str, Node] = {}
    for dim in mechanism.dimensions:
        if not isinstance(dim.value, float) and dim.path:  # a cell of the sheet, which nobody is given
            follows[dim.symbol] = with_symbols(dim.value, follows)
    found_by_base = {dim.symbol for dim in mechanism.dimensions if dim.path == ("cam", "start")}

    def math(node: Node) -> list[Part]:
        return told.math(al.tidied(with_symbols(node, follows)))

    follower, motion = mechanism.follower, mechanism.segments
    assert follower is not None and motion is not None
    on_base = isinstance(motion.start, Symbol) and motion.start.name in found_by_base
    begins: list[Part] = [(told.text("cam.on_base"), "")] if on_base else math(motion.start)
    yield Rich(((f"{told.text('cam.moves', symbol=follower.symbol)} ", ""), *begins))
    for number, part in enumerate(motion.parts, 1):
        law = words(told.language, f"segment.{part.law}")
        line: list[Part] = [(f"{number}. {law}: {told.text('cam.over')} ", ""), *math(part.over)]
        if part.law != "dwell":
            line += [(f", {told.text('cam.by')} ", ""), *math(part.by)]
        yield Rich(tuple(line))
    yield from _touching(told)


def _touching(told: Statement) -> Iterator[Rich]:
    cam, mechanism = told.mechanism.cam, told.mechanism
    if cam is None:
        return
    base = [(f"{told.text('cam.base')} ", ""), *told.math(al.as_node(cam.base_radius)), (";  ", "")]
    if cam.radius is not None:
        roller = [(f"{told.text('cam.roller', point=cam.point)} ", ""), *told.math(al.as_node(cam.radius))]
        yield Rich((*base, *roller))
        return
    link = mechanism.link(cam.follower)
    face = told.text("cam.face", link=link_words(link).of(told.language), point=cam.point)
    angle = al.add(al.as_node(cam.face), al.as_node(0.0))
    aside = [] if al.is_zero(angle) else [(f" {told.text('cam.turned')} ", ""), *told.angle(cam.face)]
    yield Rich((*base, (f"{face} ", ""), *told.direction(link), *aside))


def sign_of(told: Statement, symbol: str) -> str:
    """How a column of the profile counts; "" for what needs no word."""
    if told.mechanism.cam is None or symbol not in ("alpha", "rho", "contact"):
        return ""
    return told.text(f"cam.sign.{symbol}")
