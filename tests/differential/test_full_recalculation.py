"""LibreOffice's full recalculation (Ctrl+Shift+F9): no cell of ours may become an error, whatever the number of rows.

It computes neighbouring columns of a hundred rows and more together. Where a cell is computed from one of them and read by
its neighbour, that is a circle to it (Err:522): the drawing of every sweep of 101 rows and more vanished.
"""

import re

import pytest

import mechsheet
from chosen import part
from livesheet.engine import evaluate
from livesheet.formats import read
from mechsheet.checking.cells import compare_program
from mechsheet.checking.inputs import description_in, plan_inside
from mechsheet.description.templates import template_text
from office_macros import Job, with_macros

pytestmark = pytest.mark.libreoffice


def swept(rows, name="four-bar"):
    """A template whose crank turns once in so many rows."""
    text = template_text(name)
    found, count = re.subn(r"(?m)^step = \d+$", f"step = {360 / (rows - 1):.12g}", text)
    assert count == 1
    return mechsheet.loads(found)


def agree(paths):
    for path, answer in zip(paths, with_macros([Job(path) for path in paths]), strict=True):
        book = read(path)
        plan = plan_inside(description_in(book), path.name)
        compared = compare_program("libreoffice", book, evaluate(book), answer.get, plan, path.name)
        assert compared.agrees, (path.name, compared)


@pytest.mark.ci
@pytest.mark.parametrize("rows", part([101, 99, 361, 3601], of=4))
def test_no_circle_whatever_the_rows(rows, tmp_path):
    agree(mechsheet.build(swept(rows), tmp_path, ("xlsx", "ods") if rows == 101 else ("xlsx",)))


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.parametrize("name", ["adjustable-pump", "six-link-dwell", "stephenson-i"])
def test_no_circle_with_more_groups(name, tmp_path):
    """Whether a row exists depends on columns left and right of those that ask for it: Err:522 at the second press."""
    agree(mechsheet.build(swept(121, name), tmp_path, ("ods",)))
