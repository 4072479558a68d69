"""Which loops of four links have a Grashof type: the first link is pivoted to the ground and holds the loop's pin."""

from planned import planned

BEGIN = 'format = 1\n[mechanism]\nname = "loops"\n'
DRIVEN = '[driver]\nlink = "crank"\nstart = 0\nstop = 90\nstep = 15\n'


def loops(text):
    found = planned(BEGIN + text + DRIVEN).found.four_bars
    return [(loop.name, loop.first.name, loop.coupler.name, loop.last.name) for loop in found]


def test_of_two_links_on_the_ground_the_one_at_the_loops_pin_is_meant():
    """`arm` is described first, and no part of the first loop: with its length the type would be another."""
    text = (
        "[links.ground]\npoints = { A0 = [0, 0], B0 = [70, 0], C0 = [150, 0] }\n"
        "[links.arm]\npoints = { C0 = [0, 0], D = [60, 0] }\n"
        "[links.crank]\npoints = { A0 = [0, 0], A = [35, 0] }\n"
        "[links.coupler]\npoints = { A = [0, 0], B = [62, 0] }\n"
        "[links.rocker]\npoints = { B0 = [0, 0], B = [56, 0], C = [40, 20] }\n"
        "[links.rod]\npoints = { C = [0, 0], D = [70, 0] }\n"
    )
    assert loops(text) == [("A0ABB0", "crank", "coupler", "rocker"), ("B0CDC0", "rocker", "rod", "arm")]


def test_three_links_about_one_pin_of_the_ground_are_no_loop_of_four():
    """A triangle that turns as a whole: there is no fixed link between its two bearings."""
    text = (
        "[links.ground]\npoints = { O = [0, 0] }\n"
        "[links.crank]\npoints = { O = [0, 0], A = [35, 0] }\n"
        "[links.rod]\npoints = { A = [0, 0], B = [50, 0] }\n"
        "[links.stay]\npoints = { O = [0, 0], B = [40, 0] }\n"
    )
    assert loops(text) == []
