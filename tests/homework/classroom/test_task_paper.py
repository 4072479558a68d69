"""The task on paper: pages of A4 that say what the sheet says, with no answer; the same bytes each time."""

import dataclasses

import pytest

from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.homework.classroom.figure import figure_of
from mechsheet.homework.classroom.task_paper import _Task, task_pdf
from mechsheet.plotting.pictures import settings

A4 = (210 / 25.4, 297 / 25.4)


def mechanism(name, language="en"):
    return loads(template_text(name), name, Overrides(language=language))


def lines(name, language="en"):
    """The texts of a task's pages, those of one height joined."""
    found = mechanism(name, language)
    with settings():
        pages = _Task(Compiled(found), "", figure_of(found)).pages
        texts = [list(page.figure.texts) for page in pages]
    rows = {}
    for number, page in enumerate(texts):
        for text in page:
            small = text.get_fontsize() < 7
            x, y = text.get_position()
            near = next(
                (key for key in rows if key[0] == number and abs(key[1] - y) < (0.005 if small else 0.001)), (number, y)
            )
            rows.setdefault(near, []).append((x, text.get_text()))
    return ["".join(piece for _, piece in sorted(row)) for row in rows.values()]


@pytest.mark.slow
def test_it_is_a4_and_says_what_is_given_and_asked_with_lowered_digits():
    found = lines("four-bar")
    assert "2  crank: A0, A;  A0A = a2" in found
    assert "θ13: direction A→B  (angle of link 3, coupler)" in found
    assert "for θ12 = 0, 15, 30 … 360° (25 values)" in found
    assert any(line.startswith("a₃62.3 mmcoupler AB") for line in found)
    with settings():
        made = mechanism("four-bar")
        (page,) = _Task(Compiled(made), "", figure_of(made)).pages
    assert tuple(page.figure.get_size_inches()) == pytest.approx(A4)


def test_no_answer_stands_on_it():
    """What is asked: at the position of the figure, and in the first row."""
    compiled = Compiled(mechanism("four-bar"))
    answers = {f"{round(float(abs(value)) * 180 / 3.141592653589793, 2):g}" for value in compiled.values["theta14"]}
    text = " ".join(lines("four-bar"))
    assert not [answer for answer in answers if len(answer) > 4 and answer in text]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["shaper", "desk-lamp"])
def test_no_line_is_cut_off(name):
    """Every piece of text ends inside the margins."""
    made = mechanism(name, "tr")
    with settings():
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        pages = _Task(Compiled(made), "", figure_of(made)).pages
        for page in pages:
            canvas = FigureCanvasAgg(page.figure)
            width, height = canvas.get_width_height()
            for text in page.figure.texts:
                box = text.get_window_extent(canvas.get_renderer())
                assert box.x0 >= 0.07 * width
                assert box.x1 <= 0.93 * width
                assert box.y0 >= 0.04 * height


@pytest.mark.ci
@pytest.mark.slow
def test_each_student_has_a_task_of_their_own_and_it_is_the_same_again():
    made = mechanism("shaper")
    people = [("1", "Ayşe"), ("2", "Bob")]
    pdf = task_pdf(made, people)
    assert pdf.startswith(b"%PDF")
    assert pdf == task_pdf(made, people)
    assert len(pdf) > len(task_pdf(made, people[:1])) > 0
    assert task_pdf(made, people, seed=1) != pdf
    alone = dataclasses.replace(made, exercise=None)
    assert task_pdf(alone) == task_pdf(alone, (), 5)
