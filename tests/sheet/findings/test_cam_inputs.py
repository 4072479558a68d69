"""Numbers typed into a cam's cells that a description would refuse: the sheet names the cell, and `check` refuses it."""

import random
import re

import pytest
from both_layouts import Book
from laid import Laid
from placed import places_of

from livesheet.diagnostics import WorkbookError
from livesheet.evaluation import book_of
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_address
from mechsheet.checking.inputs import inputs_in
from mechsheet.checking.perturbation import drawn
from mechsheet.description.templates import template_text
from mechsheet.sheet.findings.inputs import marks_of
from mechsheet.sheet.inputs import inputs_of
from mechsheet.sheet.plan import VALUE
from random_cams import ON_A_SLIDE

PARTS = (
    """{ law = "3-4-5", over = 90, by = 12 }, { law = "dwell", over = 60 }, { law = "cycloidal", over = 120, to = 0 }"""
)
CLOSED = ON_A_SLIDE + f'driver = {{ joint = "s", step = 15, segments = [{PARTS}, {{ law = "dwell" }}] }}'
OPEN = ON_A_SLIDE + f'driver = {{ joint = "s", step = 15, closed = false, segments = [{PARTS}] }}'
BY_DIMENSIONS = """
dimensions = { d = 70, beta = { value = 90, unit = "deg" } }
""" + CLOSED.replace("base_radius = 35", 'base_radius = "d/2"').replace('"3-4-5", over = 90', '"3-4-5", over = "beta"')
A_ROCKER = template_text("cam-rocker").partition("[summary]")[0]
DIVIDED = "\ndimensions = { k = 4, m = 1 }\n" + CLOSED.replace('"3-4-5", over = 90', '"3-4-5", over = "pi/(k/2)*m"')

CANNOT_BE = [
    (CLOSED, {"over_1": -5}, "over_1"),
    (CLOSED, {"over_2": 0}, "over_2"),
    (CLOSED, {"over_1": 400}, "over_1"),
    (CLOSED, {"over_2": 150}, "over_3"),  # the sum is 360: nothing is left for the last
    (OPEN, {"over_3": 211}, "over_3"),
    (CLOSED, {"base_radius": -5}, "base_radius"),
    (CLOSED, {"base_radius": 0}, "base_radius"),
    (CLOSED, {"roller_radius": -3}, "roller_radius"),
    (CLOSED, {"base_radius": 1, "roller_radius": 3}, "base_radius"),  # the slide passes the centre at 5
    (A_ROCKER, {"rb": 161}, "rb"),  # farther than pivot and arm reach together
    (A_ROCKER, {"c": 131}, "rb"),
    (BY_DIMENSIONS, {"d": 0}, "d"),
    (BY_DIMENSIONS, {"beta": -90}, "beta"),
    (BY_DIMENSIONS, {"beta": 250}, "over_3"),
    (DIVIDED, {"k": 0}, "k"),
]
CAN_BE = [
    (CLOSED, {"over_2": 149}),
    (OPEN, {"over_3": 210}),
    (CLOSED, {"roller_radius": 0}),
    (CLOSED, {"base_radius": 1, "roller_radius": 5}),
    (BY_DIMENSIONS, {"d": 80, "beta": 100}),
]


@pytest.mark.slow
@pytest.mark.cases(6)
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize(("text", "typed", "named"), CANNOT_BE)
def test_the_cell_is_named_and_red(text, typed, named, layout):
    book = Book(text, layout).type(**typed)
    first = min(each.row for each in inputs_of(book.plan))
    (told,) = (each for each in inputs_of(book.plan) if each.row == first + int(book.number("inputs")) - 1)
    cell = places_of(book.plan)[named]
    assert told.spot == cell
    assert book.words("inputs") == book.line
    assert re.fullmatch("look at .*: no value that it can have", book.line)
    red = [each for each in inputs_of(book.plan) if book.colour(each.row, VALUE) == "red"]
    assert (red, book.line_colour) == ([told], "red")


@pytest.mark.slow
@pytest.mark.cases(6)
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize(("text", "typed"), CAN_BE)
def test_what_a_description_takes_is_taken(text, typed, layout):
    book = Book(text, layout).type(**typed)
    assert (book.number("inputs"), book.words("inputs")) == (0, "all hold possible values")


@pytest.mark.slow
@pytest.mark.cases(7)
@pytest.mark.parametrize(("text", "typed", "named"), CANNOT_BE)
def test_check_refuses_it_at_its_cell(text, typed, named):
    laid = Laid(text).change(**typed)
    with pytest.raises(WorkbookError) as refused:
        inputs_in(book_of(laid.workbook), laid.values, laid.plan, "cam.xlsx")
    spot = places_of(laid.plan)[named]
    assert [fault.key for fault in refused.value.faults] == [cell_address(spot.sheet, spot.row, spot.col)]


@pytest.mark.slow
def test_check_says_it_in_the_words_of_a_description():
    said = []
    out_of_reach = {"base_radius": 1, "roller_radius": 3}
    for typed in (
        {"over_1": -5},
        {"over_1": 400},
        {"over_2": 150},
        {"base_radius": 0},
        {"roller_radius": -3},
        out_of_reach,
    ):
        laid = Laid(CLOSED).change(**typed)
        with pytest.raises(WorkbookError) as refused:
            inputs_in(book_of(laid.workbook), laid.values, laid.plan, "cam.xlsx")
        said.append(str(refused.value.faults[0].message))
    assert said == [
        "a segment goes over an angle greater than 0",
        "the segments leave the turn: they end at 400°",
        "nothing is left of the turn: the segments before end at 360°",
        "the radius of the base circle must be greater than 0",
        "a radius is not negative; 0 is a knife edge",
        "the roller never touches a base circle of this radius",
    ]


@pytest.mark.slow
def test_sets_that_are_drawn_are_such_as_a_cam_can_have():
    """By far too large changes half the sets would leave the turn."""
    laid = Laid(CLOSED)
    for seed in range(40):
        typed = drawn(laid.plan, random.Random(seed))
        assert laid.change(**typed).spot("inputs") == 0, typed


@pytest.mark.slow
def test_it_is_said_in_turkish_too():
    book = Book(CLOSED, "sheets", "tr").type(over_1=400)
    assert re.fullmatch("over.* hücresine bakın: boş ya da olamaz", book.line)


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_as_many_segments_as_may_be_fit_into_a_cell(layout):
    """40 segments are what a description takes at most; the last one is asked for the sum of all."""
    parts = ", ".join(f'{{ law = "3-4-5", over = 8.75, to = {12 if place % 2 else 2} }}' for place in range(39))
    text = ON_A_SLIDE + f'driver = {{ joint = "s", step = 45, segments = [{parts}, {{ law = "3-4-5", to = 0 }}] }}'
    plan = Book(text, layout).plan
    assert max(len(print_formula(each)) for each in marks_of(plan).values()) <= 400
