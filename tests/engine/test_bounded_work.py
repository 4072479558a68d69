"""One formula that would take for ever, or all memory, is one cell that is not computed: it keeps what the file holds."""

import re
import time
import zipfile

import openpyxl
import pytest

from asking import ours
from livesheet.engine import evaluate
from livesheet.engine.interpreter import environment
from livesheet.formats import read
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula
from livesheet.time_limit import TimeLimitError, limited
from mechsheet.diagnostics import MechsheetError
from mechsheet.library.recalculation import recalc

FIB = "LET(fib,LAMBDA(f,n,IF(n<2,n,f(f,n-1)+f(f,n-2))),fib(fib,{n}))"

ENDLESS = [
    FIB.format(n=60),
    "REDUCE(0,SEQUENCE(100,100),LAMBDA(a,x,a+REDUCE(0,SEQUENCE(100,100),LAMBDA(a,x,a+x))))",
    "SUM(MAP(SEQUENCE(200,200),LAMBDA(x,SUM(SEQUENCE(1000)))))",
    "MAKEARRAY(2000,2000,LAMBDA(r,c,SUM(SEQUENCE(r,c))))",
    "LET(f,LAMBDA(f,n,IF(n=0,A1,f(f,n-1):f(f,n-1))),SUM(f(f,40)))",
    "LET(f,LAMBDA(f,n,IF(n=0,LAMBDA(x,x),IF(f(f,n-1)(0)+f(f,n-1)(0)=0,LAMBDA(x,x),f(f,n-1)))),f(f,40)(3))",
    "SUM(COUNTIF(A1:A1000,SEQUENCE(20000)))",
    "SUM(WORKDAY(SEQUENCE(100000),SEQUENCE(1,100)))",
]

LARGE = [
    "SUM(SEQUENCE(1000000,16000))",
    "SUM(ROW(A1:A1048576)*COLUMN(A1:XFD1))",
    "SUM(IF(ROW(A1:A1048576)>0,COLUMN(A1:XFD1)))",
    "SUM(RANDARRAY(1000000,16000))",
    "SUM(EXPAND(A1:B2,1000000,1000))",
    "SUM(MAKEARRAY(1000000,100,LAMBDA(r,c,r)))",
    "SUM(MMULT(ROW(A1:A1000000),TRANSPOSE(ROW(A1:A1000000))))",
    'SUM(LEN(REPT("a",1000+ROW(A1:A30000))))',
    "REDUCE(1,SEQUENCE(40),LAMBDA(a,i,VSTACK(a,a)))",
    "REDUCE(1,SEQUENCE(40),LAMBDA(a,i,HSTACK(a,a)))",
]


def with_remarks(formula):
    """(value, remarks) of one formula beside a number."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constant(0, 0, 1.0)
    sheet.block(9, 5, 1, 1, parse_formula(formula))
    values = evaluate(builder.build())
    return values.get("S", 9, 5), [fault.message for fault in values.remarks]


@pytest.fixture
def little_patience(monkeypatch):
    """The same limits, smaller: reaching the real ones takes half a minute a formula."""
    monkeypatch.setattr(environment, "MOST_STEPS", 2000)
    monkeypatch.setattr(environment, "MOST_ALL", 8000)


@pytest.mark.parametrize("formula", ENDLESS)
def test_a_formula_without_end(formula, little_patience):
    value, remarks = with_remarks(formula)
    assert value == ErrorValue("#VALUE!")
    assert "not computed: it takes more than 2000 steps" in remarks


@pytest.mark.parametrize("formula", LARGE)
def test_an_array_that_fills_the_memory(formula, monkeypatch):
    for module in ("values.cells", "interpreter.calling", "kernels.array", "kernels.lambdas", "kernels.random"):
        monkeypatch.setattr(f"livesheet.engine.{module}.MOST_LISTED", 1 << 12)
    monkeypatch.setattr("livesheet.engine.values.cells.MOST_LETTERS", 1 << 22)
    start = time.process_time()
    value, remarks = with_remarks(formula)
    assert value == ErrorValue("#VALUE!")
    assert any("not computed" in text for text in remarks), remarks
    assert time.process_time() - start < 2


def test_what_ends_is_computed(little_patience):
    """The limits are each formula's own: what one has used up is not taken from the next."""
    assert ours([FIB.format(n=8)] * 20, []) == [21.0] * 20


@pytest.mark.slow
def test_many_endless_formulas_end_together(monkeypatch):
    """A column of them takes the steps of a few: the workbook's own limit."""
    monkeypatch.setattr(environment, "MOST_STEPS", 2000)
    monkeypatch.setattr(environment, "MOST_ALL", 8000)
    start = time.process_time()
    found = ours([FIB.format(n=60)] * 500, [])
    assert set(found) == {ErrorValue("#VALUE!")}
    assert time.process_time() - start < 5


@pytest.mark.slow
def test_time_is_over_in_the_midst_of_a_formula():
    start = time.monotonic()
    with pytest.raises(TimeLimitError, match=r"not finished after 0\.3 seconds"), limited(0.3):
        with_remarks(FIB.format(n=60))
    assert time.monotonic() - start < 3


def test_time_is_over_in_a_thread_with_a_deep_stack():
    deep = "1+" * 5 + "(" * 3000 + FIB.format(n=60) + ")" * 3000
    nested = "ABS(" * 2000 + FIB.format(n=60) + ")" * 2000
    for formula in (deep, nested):
        with pytest.raises(MechsheetError), limited(0.3):
            with_remarks(formula)


IN_A_FILE = (
    "=_xlfn.LET(_xlpm.fib,_xlfn.LAMBDA(_xlpm.f,_xlpm.n,IF(_xlpm.n<2,_xlpm.n,"
    "_xlpm.f(_xlpm.f,_xlpm.n-1)+_xlpm.f(_xlpm.f,_xlpm.n-2))),_xlpm.fib(_xlpm.fib,60))"
)


def test_its_stored_value_is_kept_and_written(tmp_path, little_patience):
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "S"
    sheet["A1"], sheet["A2"] = IN_A_FILE, "=A1+1"
    path = tmp_path / "slow.xlsx"
    book.save(path)
    _with_values(path, {"A1": 7, "A2": 8})
    found = recalc(path)
    assert (found.get("S", 0, 0), found.get("S", 1, 0)) == (7.0, 8.0)
    assert [fault.message for fault in found.remarks] == [
        "not computed: it takes more than 2000 steps: the stored value is kept"
    ]
    judged = found.compare_with_stored()
    assert (judged.formulas, judged.equal, judged.kept) == (1, 1, 1)
    assert judged.doubts
    found.write(tmp_path / "again.xlsx")
    cached = read(tmp_path / "again.xlsx").sheets[0].cached
    assert (cached.get(0, 0), cached.get(1, 0)) == (7.0, 8.0)


def _with_values(path, values):
    """The workbook with stored values, which openpyxl does not write."""
    with zipfile.ZipFile(path) as old:
        parts = {name: old.read(name) for name in old.namelist()}
    name = "xl/worksheets/sheet1.xml"
    text = parts[name].decode()
    for cell, value in values.items():
        text = re.sub(rf'(<c r="{cell}".*?</f>)<v\s*/?>(</v>)?', rf"\g<1><v>{value}</v>", text)
    parts[name] = text.encode()
    with zipfile.ZipFile(path, "w") as new:
        for part, content in parts.items():
            new.writestr(part, content)
