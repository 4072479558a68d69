"""The sheet that a student is given is a task: a figure, the links with their points, from which line each angle counts."""

from __future__ import annotations

import re

import openpyxl
import pytest

import mechsheet
from chosen import first
from homework.conventions import TASKS
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_names
from mechsheet.diagnostics import DescriptionError
from mechsheet.homework.classroom.exercise import exercise
from mechsheet.homework.classroom.statement import Names, Statement
from mechsheet.homework.expected_values import asked_of
from mechsheet.homework.headings import aliases_of, called

LETTERS = str.maketrans({"θ": "theta", "β": "beta"})


def statement(mechanism):
    return Statement(Compiled(mechanism), list(asked_of(mechanism).marks))


def told(lines):
    return [line.plain for line in lines]


@pytest.fixture(scope="module")
def steering():
    """The right lever's pin lies across its frame's x axis."""
    return loads(TASKS["steering"].text.replace('R = ["arm", 0]', 'R = [0, "-arm"]'), "own")


def test_each_angle_counts_from_a_line_between_points(steering):
    lines = told(statement(steering).meanings())
    assert "theta13: direction L→R  (angle of link 3, tierod)" in lines
    assert "theta14: direction R0→R plus 90°  (angle of link 4, right)" in lines
    assert told(statement(steering).driver()) == ["driven: theta12: direction L0→L"]
    assert not any("horizontal" in line or "frame" in line for line in lines)


def test_derived_dimensions_outputs_and_summaries_are_defined(steering):
    found = statement(steering)
    assert told(line for _, line in found.derived()) == ["rod [mm] = track − 2·arm·sin(β)"]
    lines = told(found.meanings())
    assert "error [deg] = θ14 + π − β − arctan(track/wheelbase·cos(θ12))" in lines
    assert "worst: largest error" in lines


def test_an_output_that_reads_others_is_defined_with_them():
    text = mechsheet.template("four-bar", language="en").text.split("[outputs]")[0].split("[summary]")[0]
    text += '[outputs]\nhalf = "height/2"\nheight = "B.y"\nother = "B.x"\n[exercise]\nasked = { half = 1 }\n'
    lines = told(statement(loads(text, "own")).meanings())
    assert "half [mm] = height/2" in lines
    assert "height [mm] = yB" in lines
    assert not any(line.startswith("other") for line in lines)


def test_a_derived_dimension_is_asked_for_as_the_message_says():
    """Each hint followed to the letter: an output of a length, an angle, a plain number."""
    text = TASKS["steering"].text.split("[exercise]")[0]
    text = text.replace(
        "[links", 'both = { formula = "2*beta", unit = "deg" }\nslim = { formula = "track/arm", unit = "1" }\n[links', 1
    )
    names = ("rod", "both", "slim")
    with pytest.raises(DescriptionError) as caught:
        loads(f"{text}[exercise]\nasked = {{ {', '.join(f'{name} = 1' for name in names)} }}\n", "own")
    hints = [fault.hint.removeprefix("write ").split(" in [outputs], and ask for ") for fault in caught.value.faults]
    followed = text.replace("[outputs]", "\n".join(["[outputs]", *(line for line, _ in hints)]), 1)
    asked = [name for _, name in hints]
    made = loads(f"{followed}[exercise]\nasked = {{ {', '.join(f'{name} = 1' for name in asked)} }}\n", "own")
    lines = told(statement(made).meanings())
    assert lines[:3] == ["rod_asked [mm] = rod", "both_asked [deg] = both", "slim_asked = slim"]


def test_points_stand_along_a_line_of_their_link(steering):
    lines = told(statement(steering).links())
    assert lines[0] == "1  ground: L0 (0; 0);  R0 (track; 0)  (x to the right, y upwards in the figure)"
    assert "4  right: R0, R;  R0R = arm" in lines
    halves = loads(
        TASKS["steering"].text.replace('R0 = ["track"', 'Q = ["2 - (-track)/2", "-track*arm/2"], R0 = ["track"'), "own"
    )
    assert "Q (2 − (−track/2); −track·arm/2)" in told(statement(halves).links())[0]
    moved = loads(TASKS["steering"].text.replace('L = ["arm", 0]', 'L = ["arm", 0], P = [20, -30]'), "own")
    assert "2  left: L0, L, P;  L0L = arm;  L0→P: 20 along L0→L, −30 to the left of L0→L" in told(
        statement(moved).links()
    )


def test_a_slide_says_from_where_it_counts():
    lines = told(statement(TASKS["slider"].mechanism).joints())
    told_so = "in the direction 0°; s14 is the distance of C from there, positive that way"
    assert f"C of piston slides on ground, along a line through (0; c), {told_so}" in lines


def test_the_direction_of_a_block_is_that_of_its_guide():
    lines = told(statement(mechsheet.template("oldham", language="en")).meanings())
    assert "theta14: direction in which s43 grows less 90°  (angle of link 4, driven hub)" in lines


def test_what_forces_follow_from_is_given():
    text = mechsheet.template("four-bar-forces").text + "\n[exercise]\nasked = { T12 = 1 }\n"
    found = statement(loads(text, "forces", Overrides(language="en")))
    assert {"omega12", "m_3", "J_3", "M"} <= {dim.symbol for dim, _, _ in found.given()}
    assert "torque M on rocker" in told(found.loads())
    assert any("B0→G4: xG4 along B0→B, yG4 to the left of B0→B" in line for line in told(found.links()))
    own = text.replace("[dimensions]", '[dimensions]\nk = "2 lbf/in"').replace(
        "[exercise]",
        """
[[loads]]
name = "K"
between = ["A", "B0"]
stiffness = "2*k"
[exercise]""",
    )
    sprung = statement(loads(own, "sprung", Overrides(language="en")))
    assert "k" in {dim.symbol for dim, _, _ in sprung.given()}
    assert "k_K [lbf/in] = 2·k  (stiffness of the spring, load 3)" in told(line for _, line in sprung.derived())
    assert any("stiffness kK, " in line for line in told(sprung.loads()))
    positions = mechsheet.template("four-bar-forces").text + "\n[exercise]\nasked = { theta14 = 1 }\n"
    plain = statement(loads(positions, "positions"))
    assert told(plain.loads()) == []
    assert "m_3" not in {dim.symbol for dim, _, _ in plain.given()}


@pytest.mark.parametrize("name", first(template_names(), 4))
@pytest.mark.parametrize("language", ["en", "tr"])
def test_every_template_can_be_told(name, language):
    """Each asked angle has a line, each asked quantity a meaning."""
    mechanism = mechsheet.template(name, language=language)
    found = statement(mechanism)
    lines = told(found.meanings())
    for symbol in found.asked:
        (line,) = [line for line in lines if line.startswith((f"{symbol}:", f"{symbol} [", f"{symbol} ="))]
        assert len(line) > len(symbol) + 3
    assert len(told(found.links())) == len(mechanism.whole_links)


def test_angles_are_said_as_a_person_says_them():
    """No `less (−β − π/2)`: what is added before what is taken off, degrees beside degrees; from where the driver counts."""
    text = TASKS["steering"].text
    own = text.replace('L = ["arm", 0]', 'L = { r = "arm", angle = "beta - pi/2" }')
    own = own.replace('R = ["arm", 0]', 'R = { r = "arm", angle = "-beta - pi/2" }')
    for unit, quarter, ends in (("deg", "90°", (-30, 30, 10)), ("rad", "π/2", (-0.5, 0.5, 0.1))):
        drawn = own.replace("[mechanism]", f'[mechanism]\nangle_unit = "{unit}"')
        for typed, end in zip(("start = -102", "stop = -42", "step = 5"), ends, strict=True):
            drawn = drawn.replace(typed, f"{typed.split()[0]} = {end}")
        found = statement(loads(drawn, "own"))
        assert told(found.links())[1].endswith(f"L0L = arm, counter-clockwise from theta12 by β − {quarter}")
        assert told(found.links())[3].endswith(f"R0R = arm, clockwise from theta14 by β + {quarter}")
        zero = f"theta12 = 0 where the direction L0→L is β − {quarter}"
        assert told(found.driver()) == [f"driven: theta12: direction L0→L plus {quarter} − β;  {zero}"]
        assert f"theta14: direction R0→R plus β + {quarter}  (angle of link 4, right)" in told(found.meanings())


def test_what_is_asked_stands_behind_what_it_reads_with_its_marks():
    text = TASKS["steering"].text.replace("[summary]", 'size = { formula = "abs(error)", unit = "deg" }\n[summary]')
    text = text.replace('of = "error"', 'of = "size"').split("[exercise]")[0]
    found = statement(loads(f"{text}[exercise]\nasked = {{ worst = 1.5, size = 1 }}\n", "own"))
    lines = told(found.meanings())
    assert [line.split(" ")[0] for line in lines[:3]] == ["error", "size", "worst:"]
    (worst,) = [line for line in found.meanings() if line.plain.startswith("worst")]
    assert ("size", "italic") in worst.parts
    assert told(found.marks()) == ["Marks: worst: 1.5, size: 1"]


def test_a_second_driver_whose_values_are_listed_is_no_question():
    """It stood twice in the table: with its values, and as a column to fill in."""
    found = statement(mechsheet.template("five-bar-robot", language="en"))
    assert "theta15" not in found.asked
    assert {"theta13", "theta14"} <= set(found.asked)


@pytest.fixture(scope="module")
def handed_out(tmp_path_factory):
    """A student's sheet with everything in it."""
    folder = tmp_path_factory.mktemp("handed out")
    text = TASKS["steering"].text + "vary = { arm = [160, 200, 5] }\n"
    (folder / "class.csv").write_text("id,name\n7,Ayşe\n", encoding="utf-8")
    exercise(loads(text, "own"), folder / "class.csv", folder / "out")
    return openpyxl.load_workbook(folder / "out" / "student" / "7.xlsx", rich_text=True)


@pytest.mark.slow
def test_every_cell_that_is_to_be_filled_in_has_its_unit(handed_out):
    rows = [[str(cell.value) for cell in row] for row in handed_out.worksheets[0].iter_rows()]
    assert ["θ12 [deg]", "θ13 [deg]", "θ14 [deg]", "error [deg]"] in [row[:4] for row in rows]
    assert ["worst [deg]", "None"] in [row[:2] for row in rows]
    assert ["rod [mm]", "None", "rod [mm] = track − 2·arm·sin(β)"] in [row[:3] for row in rows]
    assert any(row[0].startswith("Marks: θ13: 1") for row in rows)


@pytest.mark.slow
def test_a_long_name_of_an_output_has_room(tmp_path):
    """It took two lines in a row that is as high as one."""
    (tmp_path / "class.csv").write_text("id\n7\n", encoding="utf-8")
    text = TASKS["steering"].text.replace("error", "error_of_the_right_wheel")
    exercise(loads(text, "own"), tmp_path / "class.csv", tmp_path / "out")
    sheet = openpyxl.load_workbook(tmp_path / "out" / "student" / "7.xlsx").worksheets[0]
    heads = [str(cell.value) for row in sheet.iter_rows() for cell in row if str(cell.value).endswith("wheel [deg]")]
    assert sheet.column_dimensions["B"].width > len(heads[0])


@pytest.mark.slow
def test_names_are_set_as_in_the_figure(handed_out):
    """θ with 12 lowered, L with 0 lowered."""
    cells = [cell.value for row in handed_out.worksheets[0].iter_rows() for cell in row]
    (line,) = [value for value in cells if str(value).startswith("driven: ")]
    lowered = [str(part) for part in line if getattr(getattr(part, "font", None), "vertAlign", None) == "subscript"]
    assert str(line) == "driven: θ12: direction L0→L"
    assert lowered == ["12", "0"]


@pytest.mark.slow
def test_the_figure_has_the_shape_of_the_mechanism(handed_out):
    """A steering is long and low: as wide as paper, and no wider in x than in y."""
    (chart,) = handed_out.worksheets[0]._charts
    width, height = chart.anchor.ext.width, chart.anchor.ext.height
    assert width / 9525 == 600
    assert height < width / 2
    across, up = (axis.scaling.max - axis.scaling.min for axis in (chart.x_axis, chart.y_axis))
    assert across / width == pytest.approx(up / height, rel=0.01)


@pytest.mark.parametrize("symbol", ["theta14", "C.x", "mu_min", "Delta_x", "theta13.d", "power"])
def test_a_heading_is_set_only_as_mark_reads_it(symbol):
    """Δx is no name that is read as Delta_x: it stays as the description spells it; any unit may stand behind a name."""
    made = loads(mechsheet.template("four-bar", language="en").text, "own")
    names = Names(Compiled(made))
    names.symbols.add(symbol)
    names.name = re.compile(re.escape(symbol))
    for unit in ("", " [deg]", " [N·m]", " [mm/s²]"):
        head = names.head(symbol + unit, symbol)
        text = head if isinstance(head, str) else head.plain
        assert called((text,), aliases_of((symbol,))).symbols == {symbol}


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "tr"])
def test_the_sheet_has_the_figure_and_no_answer(tmp_path, language):
    """The figure is of the description's own dimensions, its places rounded; it stands on the first sheet."""
    text = TASKS["steering"].text + "vary = { arm = [160, 200, 5], beta = [14, 22, 1] }\n"
    mechanism = loads(text, "own", Overrides(language=language))
    (tmp_path / "class.csv").write_text("id,name\n7,Ayşe\n8,Bora\n", encoding="utf-8")
    exercise(mechanism, tmp_path / "class.csv", tmp_path / "out")
    book = openpyxl.load_workbook(tmp_path / "out" / "student" / "7.xlsx")
    task, figure = book.worksheets
    assert figure.sheet_state == "hidden"  # who prints the whole workbook wants no sheets of numbers
    (chart,) = task._charts
    names = {series.tx.strRef is None and series.tx.v for series in chart.series}
    assert {"L0", "L", "R", "R0"} <= {name.translate(str.maketrans("₀", "0")) for name in names if name}
    numbers = [cell.value for row in figure.iter_rows() for cell in row if isinstance(cell.value, float)]
    assert numbers
    assert all(round(number, 3) == number for number in numbers)
    assert task.cell(2, 2).value == "7"
    assert not any(
        isinstance(cell.value, str) and cell.value.startswith("=") for row in task.iter_rows() for cell in row
    )


@pytest.mark.slow
def test_who_has_which_numbers_is_told(tmp_path):
    text = TASKS["steering"].text + "vary = { arm = [160, 200, 5], beta = [14, 22, 1] }\n"
    (tmp_path / "class.csv").write_text("id,name\n7,Ayşe\n8,=Bora\n", encoding="utf-8")
    found = exercise(loads(text, "own"), tmp_path / "class.csv", tmp_path / "out", seed=3)
    lines = (tmp_path / "out" / "numbers.csv").read_text(encoding="utf-8-sig").splitlines()
    own = [one.dimensions for one in found.students]
    assert lines == [
        "id,name,arm [mm],beta [deg],seed",
        f"7,Ayşe,{own[0]['arm']:g},{own[0]['beta']:g},3",
        f"8,'=Bora,{own[1]['arm']:g},{own[1]['beta']:g},3",
    ]
    assert tmp_path / "out" / "numbers.csv" in found.files


@pytest.mark.slow
def test_a_task_filled_in_by_hand_is_right(tmp_path):
    """The sheet itself, with the solution's formulas typed into its columns; its figure is no table."""
    task = TASKS["steering"]
    (tmp_path / "class.csv").write_text("id\n7\n", encoding="utf-8")
    exercise(task.mechanism, tmp_path / "class.csv", tmp_path / "out")
    path = tmp_path / "out" / "student" / "7.xlsx"
    book = openpyxl.load_workbook(path)
    sheet = book.worksheets[0]
    where = {
        str(cell.value).split(" [")[0].translate(LETTERS): cell
        for row in sheet.iter_rows()
        for cell in row
        if cell.value is not None
    }
    given = {name: f"$B${where[name].row}" for name in ("track", "wheelbase", "arm", "beta")}
    top = where["theta12"].row
    rod = "({track}-2*{arm}*SIN(RADIANS({beta})))".format(**given)
    for row in range(top + 1, top + 14):
        fi = f"RADIANS($A{row})"
        x, y = f"({given['arm']}*COS({fi}))", f"({given['arm']}*SIN({fi}))"
        s = f"SQRT(({given['track']}-{x})^2+{y}^2)"
        cosine = f"({rod}^2+{s}^2-{given['arm']}^2)/(2*{rod}*{s})"
        cells = {
            "theta13": f"=ATAN2({given['track']}-{x},-{y})-ACOS({cosine})",
            "theta14": f"=ATAN2({x}+{rod}*COS(B{row})-{given['track']},{y}+{rod}*SIN(B{row}))",
            "error": f"=DEGREES(C{row}+PI()-ATAN({given['track']}/{given['wheelbase']}*COS({fi})))-{given['beta']}",
        }
        for symbol, formula in cells.items():
            sheet.cell(row, where[symbol].column, formula)
    sheet.cell(where["worst"].row, 2, f"=MAX(D{top + 1}:D{top + 13})")
    book.save(path)
    (one,) = mechsheet.mark(path, tmp_path / "out" / "key.json").students
    assert (one.id, one.mark) == ("7", 4.0)
