"""What writing costs: ours against plain XlsxWriter for the same cells, and .ods against .xlsx.

Every writer runs in a process of its own; printed are the CPU time of the whole process (start and imports included),
its peak memory, and the ratios, all from one run: seconds mean little on another machine.

    python benchmarks/writing.py [ROWS]
"""

from __future__ import annotations

import math
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROWS = 36_001
COLUMNS = 13
SHEETS = {"input": "Mechanism", "table": "Positions"}


def column_formulas():
    """Thirteen columns of a four-bar's table, as text for XlsxWriter and as trees for us, with a value of each row."""
    from livesheet.formula.parser import parse_formula

    texts = ["=(ROW()-2)*step"]
    letters = "ABCDEFGHIJKLM"
    for i in range(1, COLUMNS):
        a, b = letters[i - 1], letters[max(i - 2, 0)]
        texts.append(f"=IF(ABS({a}2)>1E+9,NA(),link_1*COS(RADIANS({a}2))+link_2*SIN(RADIANS({b}2)))")
    return texts, [parse_formula(text[1:]) for text in texts]


def column_values(rows):
    """Values of the usual length: 17 digits."""
    return [tuple(math.sin(0.001 * (row + 17 * col)) * 100 for row in range(rows)) for col in range(COLUMNS)]


def workbook(rows):
    from livesheet.workbook import Cell, Fill, Name, Sheet, Style, Workbook

    style = Style(number_format="0.000")
    names = ("step", "link_1", "link_2")
    _, trees = column_formulas()
    values = column_values(rows)
    fills = tuple(Fill(1, col, trees[col], style, rows, 1, values[col]) for col in range(COLUMNS))
    heads = tuple(Cell(0, col, f"column {col}") for col in range(COLUMNS))
    inputs = tuple(Cell(row, 0, 0.01 * (row + 1)) for row in range(len(names)))
    return Workbook(
        (Sheet("Mechanism", inputs), Sheet("Positions", heads, fills, freeze=(1, 0))),
        tuple(Name(name, "Mechanism", row, 0) for row, name in enumerate(names)),
    )


def nothing(path, rows):
    """What every writer has before it begins: the interpreter, our modules and the values."""
    workbook(rows)


def ours(path, rows):
    from livesheet.formats import write

    write(workbook(rows), path)


def plain_xlsxwriter(path, rows):
    import xlsxwriter

    texts, _ = column_formulas()
    values = column_values(rows)
    book = xlsxwriter.Workbook(path)
    inputs, table = book.add_worksheet("Mechanism"), book.add_worksheet("Positions")
    for row, name in enumerate(("step", "link_1", "link_2")):
        inputs.write_number(row, 0, 0.01 * (row + 1))
        book.define_name(name, f"=Mechanism!$A${row + 1}")
    look = book.add_format({"num_format": "0.000"})
    pieces = [text.replace("2)", "{0})") for text in texts]
    for col in range(COLUMNS):
        table.write_string(0, col, f"column {col}")
    for row in range(1, rows + 1):
        for col in range(COLUMNS):
            table.write_formula(row, col, pieces[col].format(row + 1), look, values[col][row - 1])
    book.close()


WRITERS = {
    "nothing": (nothing, ".none"),
    "ours .xlsx": (ours, ".xlsx"),
    "ours .ods": (ours, ".ods"),
    "plain XlsxWriter": (plain_xlsxwriter, ".xlsx"),
}


def measured(name, rows):
    """CPU seconds, peak megabytes and size of the file in megabytes of one writer."""
    _, suffix = WRITERS[name]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"out{suffix}"
        done = subprocess.run(
            [sys.executable, __file__, str(rows), name, str(path)], check=True, capture_output=True, text=True
        )
        cpu, peak = map(float, done.stdout.split())
        return cpu, peak, path.stat().st_size / 1e6 if path.exists() else 0.0


def main():
    rows = int(sys.argv[1]) if len(sys.argv) > 1 else ROWS
    if len(sys.argv) > 2:
        WRITERS[sys.argv[2]][0](Path(sys.argv[3]), rows)
        used = resource.getrusage(resource.RUSAGE_SELF)
        print(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)
        return
    print(f"{rows} rows x {COLUMNS} formula columns")
    results = {name: measured(name, rows) for name in WRITERS}
    for name, (cpu, peak, size) in results.items():
        print(f"{name:18} {cpu:7.2f} s CPU {peak:7.0f} MB peak {size:6.2f} MB file")
    xlsx, ods, plain = (results[name] for name in ("ours .xlsx", "ours .ods", "plain XlsxWriter"))
    print(f"ours .xlsx / plain XlsxWriter  {xlsx[0] / plain[0]:.3f} of the CPU (goal: at most 0.333)")
    print(f"ours .ods / ours .xlsx         {ods[0] / xlsx[0]:.2f} of the CPU (goal: at most 2)")


if __name__ == "__main__":
    main()
