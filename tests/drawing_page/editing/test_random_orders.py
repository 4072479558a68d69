"""Whatever is drawn in whatever order: the text can be read, its comments stay, and nothing ends in a traceback."""

import contextlib
import random

import pytest
from asking_page import Drawing, pin, spot

from chosen import part
from folders import TEMPLATE_FILES
from mechsheet.diagnostics import MechsheetError
from mechsheet.drawing_page.questions import Impossible, Refusal

ORDERS = 8


def an_order(chance, look):
    """One that a page could give, sensible or not."""
    points = [*look.get("frames", {}).get("points", {}), "nothing"]
    links = [link["name"] for link in look["links"]]
    joints = [*(joint["name"] for joint in look["joints"]), "nothing"]

    def place():
        return [chance.randint(-100, 100), chance.randint(-100, 100)]

    def end():
        return pin(chance.choice(points)) if chance.random() < 0.6 else spot(*place())

    kinds = {
        "ground": lambda: {"end": end()},
        "link": lambda: {"ends": [end(), end()]},
        "plate": lambda: {"link": chance.choice(links), "end": end()},
        "slide": lambda: {
            "kind": chance.choice(["prismatic", "pin-slot"]),
            "end": end(),
            "on": chance.choice([end(), {"link": chance.choice(links)}]),
        },
        "driver": lambda: chance.choice([{"link": chance.choice(links)}, {"joint": chance.choice(joints)}]),
        "delete": lambda: chance.choice(
            [{"link": chance.choice(links)}, {"point": chance.choice(points)}, {"joint": chance.choice(joints)}]
        ),
        "move": lambda: {"point": chance.choice(points), "to": place()},
    }
    do = chance.choice(list(kinds))
    return {"do": do, **kinds[do]()}


def comments(text):
    return [line for line in text.splitlines() if line.startswith("#")]


@pytest.mark.parametrize("seed", part(range(60), 10))
def test_any_orders(seed):
    chance = random.Random(seed)
    begin = chance.choice(TEMPLATE_FILES).read_text(encoding="utf-8") if seed % 2 else None
    drawing = Drawing(begin)
    before = comments(drawing.text)
    for _ in range(ORDERS):
        with contextlib.suppress(Impossible, Refusal, MechsheetError):
            drawing.do(**an_order(chance, drawing.look))
        assert drawing.look["readable"]
        assert comments(drawing.text) == before
