"""Functions in Basic, read as formulas: against numbers by hand, against LibreOffice, and as our own modules have them."""

import math

import pytest

import mechsheet
from command_line import run
from folders import TEMPLATES
from livesheet.basic import decoded, functions_in, lambdas
from livesheet.engine import evaluate
from livesheet.formula.book import BookBuilder, DefinedName
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula
from mechsheet.library.recalculation import recalc
from mechsheet.library.routines import with_modules
from office_macros import Job, with_macros

MODULE = """\
Attribute VB_Name = "Deneme"
Option Explicit
Const Pi = 3.1415926, Eps As Double = 1E-7
Private Count As Long

Function Fact(ByVal n)   ' a loop that counts
    Dim i As Integer
    Fact = 1
    For i = 1 To n
        Fact = Fact * i
    Next i
End Function

Function Root(ByVal x As Double) As Double
    Dim y As Double, d As Double
    y = 1: d = 1
    Do While Abs(d) > Eps
        d = (y * y - x - 1) / (2 * y)
        y = y - d
    Loop
    Root = y
End Function

Function Above(ByVal x)
    Do
        x = x + 3
        If x > 50 Then Exit Do
    Loop Until x > 20
    Above = x
End Function

Function Part(ByVal x)
    If x < 1 Then
        Part = -1
    ElseIf x < 3 Then
        Part = x ^ 2
        If x = 2 Then Exit Function
    Else
        Part = 10 Mod x + 7 \\ x
    End If
    Part = Part + 0.5
End Function

Function Inverse(ByVal x)
    On Error GoTo NotThere
    Inverse = 1 / x
    Exit Function
NotThere:
    Inverse = -1
End Function

Function Back(ByVal n)
    Dim k
    For k = 10 To 1 Step -1
        If k * k < n Then Exit For
        Back = Back + k
    Next
    Back = Back * 100 + k
End Function

Function Nested(ByVal n)
    Dim i As Long, j As Long
    For i = 1 To n
        For j = i To n
            If (i + j) Mod 2 = 0 And Not i = j Then Nested = Nested + i * j Else Nested = Nested - 1
        Next
    Next
End Function

Function Rounded(ByVal x)
    Dim whole As Long
    whole = x / 2
    Rounded = whole - x ^ 2 - -2 ^ 2 _
        + Boy(3, x)
End Function

Function Boy(ByVal X, ByVal Y)
    Boy = Sqr(X ^ 2 + Y ^ 2)
End Function

Function Keeps(x)
    Count = Count + x
    Keeps = Count
End Function

Function Tells(x)
    MsgBox "x"
    Tells = 1
End Function

Sub Nothing_(x)
    Range("A1") = 1
End Sub
"""
LINES = {"Keeps": 82, "Tells": 87}

EXPECTED = {
    "Fact": lambda x: float(math.factorial(int(x))),
    "Root": lambda x: math.sqrt(x + 1),
    "Above": lambda x: next(x + 3 * k for k in range(1, 20) if x + 3 * k > 20),
    "Part": lambda x: {0: -0.5, 1: 1.5, 2: 4.0}.get(x, 10 % x + 7 // x + 0.5 if x else 0.0),
    "Inverse": lambda x: 1 / x if x else -1.0,
    "Back": lambda n: (
        100.0 * sum(k for k in range(1, 11) if k * k >= n) + max((k for k in range(11) if k * k < n), default=0)
    ),
    "Nested": lambda n: float(
        sum(i * j if (i + j) % 2 == 0 and i != j else -1 for i in range(1, int(n) + 1) for j in range(i, int(n) + 1))
    ),
    "Rounded": lambda x: round(x / 2) - x**2 + 4 + math.hypot(3, x),
}
ARGUMENTS = [float(x) for x in range(13)]


def names_of(text):
    functions, faults = functions_in(text, "deneme.bas")
    names, further = lambdas(functions, "deneme.bas")
    return names, [*faults, *further]


def computed(names, formulas):
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row, formula in enumerate(formulas):
        sheet.block(row, 0, 1, 1, parse_formula(formula))
    book = builder.build()
    book.names = [*book.names, *names]
    values = evaluate(book)
    return [values.get("S", row, 0) for row in range(len(formulas))]


@pytest.mark.parametrize("name", EXPECTED)
def test_a_function_gives_what_basic_says(name):
    names, _ = names_of(MODULE)
    found = computed(names, [f"{name}({x:g})" for x in ARGUMENTS])
    assert found == pytest.approx([EXPECTED[name](x) for x in ARGUMENTS], rel=1e-12)


@pytest.mark.slow
def test_columns_of_calls_are_computed_row_by_row():
    """Filled down over cells, where rows take other branches and more rounds than others."""
    names, _ = names_of(MODULE)
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row, value in enumerate(ARGUMENTS):
        sheet.constant(row, 0, value)
    for col, name in enumerate(EXPECTED, 1):
        sheet.block(0, col, len(ARGUMENTS), 1, parse_formula(f"{name}(A1)"))
    book = builder.build()
    book.names = list(names)
    values = evaluate(book)
    for col, name in enumerate(EXPECTED, 1):
        found = [values.get("S", row, col) for row in range(len(ARGUMENTS))]
        assert found == pytest.approx([EXPECTED[name](x) for x in ARGUMENTS], rel=1e-12), name


def test_what_is_not_read_is_left_out_and_told():
    """Variables that keep their values, messages: the function is left out with its line, the others stay."""
    names, faults = names_of(MODULE)
    assert {name.name for name in names} == {*EXPECTED, "Boy"}
    assert {fault.line for fault in faults} == set(LINES.values())
    assert [str(fault).split(" is left out")[0].split("function ")[1] for fault in faults] == list(LINES)


@pytest.mark.parametrize(("body", "refused"), [
    ("F = A(1)", True), ("Dim q(3)\nF = 1", True), ("F = Rnd()", True), ("Set F = x", True), ("GoTo Up\nUp:\nF = x", False),
    ("Up:\nF = x\nGoTo Up", True), ("While F < x\nF = F + 1\nWend", False), ("Select Case x\nEnd Select", True),
    ("F = Application.WorksheetFunction.Atan2(1, x)", False), ('F = "a" & x', True), ("Static n\nF = n", True),
    ("Dim d#, n%\nd# = 2.5: n% = d#\nF = n", False), ("F = x:Dim e", False), ("F = 1 + Not x", True),
    ("F = +x - -(+2)", False),
    ("F = Sqr(x", True),
])  # fmt: skip
def test_each_thing_is_read_or_refused(body, refused):
    names, faults = names_of(f"Function F(x)\n{body}\nEnd Function\n")
    assert (len(names), len(faults)) == ((0, 1) if refused else (1, 0)), [str(fault) for fault in faults]


def test_a_function_that_changes_its_callers_variable_is_refused():
    text = "Function G(x)\nx = x + 1\nG = x\nEnd Function\nFunction F(ByVal y)\nF = G(y) + y\nEnd Function\n"
    names, faults = names_of(text)
    assert ([name.name for name in names], len(faults)) == (["G"], 1)
    names, faults = names_of(text.replace("G(x)", "G(ByVal x)"))
    assert not faults
    assert computed(names, ["F(2)"]) == [5.0]


def test_an_error_that_nobody_catches_breaks_off():
    names, _ = names_of("Function F(x)\nDim y\ny = 1 / x\nF = 5\nEnd Function\n")
    assert computed(names, ["F(0)", "F(1)"]) == [ErrorValue("#VALUE!"), 5.0]


def test_a_turkish_module_of_windows_is_read():
    assert "Açı" in decoded("Function Açı(x)".encode("cp1254"))
    names, _ = names_of(decoded("Function Açı(ByVal Ölçü)\nAçı = 2 * Ölçü\nEnd Function".encode("cp1254")))
    assert computed(names, ["Açı(4)"]) == [8.0]


@pytest.mark.ci
@pytest.mark.libreoffice
def test_libreoffice_computes_the_same():
    """Where its Basic differs from Excel's (a sign before a power, Not before a comparison) there are parentheses, and no
    halves are rounded; what a function never set is a text there."""
    formulas = [f"={name}({x:g})" for name in EXPECTED for x in ARGUMENTS]
    text = MODULE.replace('Attribute VB_Name = "Deneme"\n', "")
    text = text.replace("-2 ^ 2", "-(2 ^ 2)").replace("Not i = j", "Not (i = j)").replace("x / 2", "x / 3")
    (answers,) = with_macros([Job(module=text.encode("ascii"), formulas=formulas)])
    names, _ = names_of(text)
    mine = computed(names, [formula[1:] for formula in formulas])
    theirs = [answers.get("Sheet1", row, 0) or 0.0 for row in range(len(formulas))]
    assert mine == pytest.approx(theirs, rel=1e-12)


@pytest.mark.ci
@pytest.mark.slow
def test_the_five_link_that_calls_vba_agrees_with_its_module(tmp_path):
    """`build --functions vba`: columns that call functions, and the module beside them, read for other lengths."""
    mechanism = mechsheet.load(TEMPLATES / "fivelink.toml")
    paths = mechsheet.build(mechanism, tmp_path, functions="vba")
    assert [path.name for path in paths] == ["fivelink.xlsx", "fivelink-vba.xlsx", "fivelink-vba.bas"]
    result = run("check", paths[1], "--functions", paths[2])
    assert "all agree" in result.output, result.output
    assert "not computed" not in result.output
    assert "not computed" in run("check", paths[1]).output
    for settings in ({"Krank": 55}, {"mode_2": -1}):
        found = recalc(paths[1], settings, [paths[2]])
        lesson = [found.values.get("Adım adım", row, 5) for row in range(6, 25)]
        assert sum(isinstance(value, float) for value in lesson) > 5
        worst = [found.values.get("Adım adım", 5, col) for col in (4, 5)]
        assert max(worst) < 1e-10


@pytest.mark.slow
def test_typical_mistakes_have_a_message(tmp_path):
    """A file that is not there, or no module, is refused with exit code 2."""
    book = tmp_path / "b.xlsx"
    mechsheet.build(mechsheet.load(TEMPLATES / "oldham.toml"), book)
    text = tmp_path / "none.bas"
    text.write_text("Sub A()\nEnd Sub\n", encoding="utf-8")
    for file in (tmp_path / "gone.bas", text, book):
        for words in (["recalc"], ["check"], ["audit"]):
            result = run(*words, book, "--functions", file)
            assert result.exit_code == 2, (words, file, result.output)
            assert file.name in result.output


def test_what_the_book_defines_itself_stays(tmp_path):
    """A LAMBDA of the book is not overwritten by a module's function."""
    module = tmp_path / "deneme.bas"
    module.write_text(MODULE, encoding="utf-8")
    builder = BookBuilder()
    builder.sheet("S").block(0, 0, 1, 1, parse_formula("Boy(3,4)+Fact(3)"))
    book = builder.build()
    book.names = [DefinedName("Boy", parse_formula("LAMBDA(x,y,x*y)"))]
    assert evaluate(with_modules(book, [module])).get("S", 0, 0) == 18.0


HOSTILE = {
    "parentheses": "f = " + "(" * 100 + "x" + ")" * 100,
    "signs": "f = " + "-" * 100 + "x",
    "not": "f = " + "Not " * 100 + "x",
    "a sum": "f = " + " + ".join(["x"] * 5000),
    "blocks": "If x > 1 Then\n" * 2000 + "f = 1\n" + "End If\n" * 2000,
    "in one line": "If x > 1 Then " * 200 + "f = 1",
    "branches": "If x > 1 Then\n" + "ElseIf x > 2 Then\nf = 1\n" * 2000 + "End If",
    "behind each other": "If x > 1 Then f = f + 1\n" * 3000,
    "ways": "".join(f"L{n}:\nIf x > {n} Then GoTo L{n + 1}\nIf x < -{n} Then GoTo L{n + 2}\n" for n in range(18))
    + "L18:\nL19:\nf = 1",
}


@pytest.mark.parametrize("body", HOSTILE.values(), ids=HOSTILE)
def test_a_function_that_is_made_to_be_too_much_is_left_out_and_said(body):
    text = f"Function f(x)\n{body}\nEnd Function\nFunction g(x)\ng = x + 1\nEnd Function\n"
    functions, faults = functions_in(text)
    names, further = lambdas(functions)
    assert [name.name for name in names] == ["g"]
    (fault,) = [*faults, *further]
    assert "the function f is left out" in fault.message
