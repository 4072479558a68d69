"""A further driver turns two links about a pin that more of them share: what the pin exerts is told apart, link by link."""

import itertools

import pytest
from test_reactions import solved, weighed, worst_of

from chosen import first
from mechsheet.diagnostics import MechsheetError

HEAD = """
format = 1
[mechanism]
name = "pins"
[links.ground]
points = { A0 = [0, 0], B0 = [0, 0], C0 = [230, 0], E0 = [100, 250] }
"""
LINKS = {
    "arm": "A0 = [0, 0], A = [120, 0]",
    "boom": "A = [0, 0], B = [150, 0]",
    "stay": "A = [0, 0], C = [140, 0]",
    "strut": "C0 = [0, 0], C = [120, 0]",
    "tail": "A = [0, 0], E = [130, 0]",
    "tip": "E0 = [0, 0], E = [90, 0]",
    "slider": "C = [0, 0]",
}
SLIDE = """
[[joints]]
type = "prismatic"
link = "slider"
on = "ground"
point = "C"
through = [0, 20]
symbol = "s"
"""
SLEEVE = """
[[joints]]
type = "pin-slot"
point = "C0"
on = "boom"
through = "A"
symbol = "s"
"""
FROM_THE_ARM = ("arm", 60, 85, 5)
"""The pin lies on a link that is known before the two are."""
FROM_THE_STRUT = ("strut", 100, 130, 6)
"""The two are joined to one another's neighbours there, and to a third link of the group."""


def described(links, driven=FROM_THE_ARM, pair=("boom", "stay"), more=""):
    """The links in this order; the first of the pair is turned against the second."""
    text = HEAD + "".join(f"[links.{name}]\npoints = {{ {LINKS[name]} }}\n" for name in links) + more
    text += '[driver]\nlink = "{}"\nstart = {}\nstop = {}\nstep = {}\nspeed = 1\n'.format(*driven)
    text += f'[[drivers]]\nlink = "{pair[0]}"\nrelative_to = "{pair[1]}"\nsymbol = "phi"\nvalue = 50\n'
    places = {"A": (60, 104), "C": (200, 117 if "strut" in links else 20), "E": (150, 200)}
    known = [name for name in places if any(f"{name} =" in LINKS[link] for link in links)]
    return text + "[assembly]\n" + "".join(f"{name} = [{places[name][0]}, {places[name][1]}]\n" for name in known)


CHAIN = ("arm", "boom", "stay", "strut")
CASES = {
    **{f"outer: {' '.join(order)}": described(order) for order in itertools.permutations(CHAIN)},
    **{f"inner: {' '.join(order)}": described(order, FROM_THE_STRUT) for order in itertools.permutations(CHAIN)},
    "the other way round": described(CHAIN, pair=("stay", "boom")),
    "a fourth link": described(("tail", "stay", "arm", "boom", "strut", "tip")),
    "a fourth link, the pin between them": described(("stay", "tail", "arm", "boom", "strut", "tip"), FROM_THE_STRUT),
    "a slider": described(("arm", "boom", "stay", "slider"), more=SLIDE),
    "a sleeve": described(("arm", "boom", "stay"), more=SLEEVE),
}
SOME = ("outer: arm boom stay strut", "inner: stay arm boom strut", "a fourth link, the pin between them", "a sleeve")


@pytest.mark.parametrize("name", [*SOME, *first([name for name in CASES if name not in SOME], 0)])
def test_against_all_reactions_at_once(name):
    worst, count = worst_of(weighed(CASES[name], 3))
    assert count > 8
    assert worst < 1e-10


def test_what_the_pin_exerts_on_all_links_is_nothing_together():
    """Without weights the boom is held by the pin and the motor alone, and the arm by its two pins."""
    text = described(CHAIN) + '[[loads]]\nlink = "boom"\npoint = "B"\nforce = [0, -20]\n[dynamics]\ngravity = 0\n'
    values = solved(text.replace("speed = 1\n", ""))[3]
    assert values["F23.x"] == pytest.approx(0, abs=1e-9)
    assert values["F23.y"] == pytest.approx(20)
    lever = values["B.x"] - values["A.x"]
    assert values["T43"] == pytest.approx(20 * lever / 1000)
    assert values["F12.y"] == pytest.approx(values["F23.y"] + values["F24.y"])


def test_links_that_are_solved_all_at_once_are_refused_by_the_driver_that_is_meant():
    text = weighed(described(CHAIN), 3) + "[solution]\nforce = true\n"
    with pytest.raises(MechsheetError, match=r"drivers\.0\.link: the driver turns two moving links about A"):
        solved(text)
