"""Makes the case tables of the engine's functions from `tests/cases/engine/calls.txt`, by asking other programs.

    python tools/engine_cases.py             what the programs say where they do not all agree with the tables
    python tools/engine_cases.py --write     write the tables and the differences

A value goes into a table when at least one other program gives it, too; where none does, it must stand in `decided.toml`,
with the reason. What the programs give where they differ from a table goes to `differences_<program>.toml`.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import openpyxl
from openpyxl.worksheet.formula import ArrayFormula

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from engine_cases import COLUMN, FIRST_ROW, FOLDER, answered, book_of, cells, load, same, scalar  # noqa: E402
from mechsheet.engine import evaluate  # noqa: E402
from mechsheet.formula.functions import FUNCTIONS  # noqa: E402
from mechsheet.formula.nodes import Call, ErrorValue, Node, Text, walk  # noqa: E402
from mechsheet.formula.parser import parse_formula  # noqa: E402
from mechsheet.formula.printer import print_formula  # noqa: E402
from mechsheet.programs import answers, convert_with_libreoffice  # noqa: E402

PROGRAMS = ("ironcalc", "gnumeric", "libreoffice")
SINGLE = "ntbda"
VARIANTS = ("A3", "A6", "A5", "A7", "A4")
"""What takes the place of a single value: a text, an error, a blank cell, a text that shows a number, a truth value."""


def calls() -> dict[str, list[str]]:
    """Table -> its formulas, with their variants."""
    tables: dict[str, list[str]] = {}
    for line in (FOLDER / "calls.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            current = tables.setdefault(line.strip("[]"), [])
        elif line.startswith("! "):
            current.append(line[2:])
        elif line and not line.startswith("#"):
            current.extend(variants(line))
    left_out = set(load(FOLDER / "decided.toml")["left_out"])
    return {name: [f for f in dict.fromkeys(formulas) if f not in left_out] for name, formulas in tables.items()}


def variants(formula: str) -> list[str]:
    """A call, and the call with each of its single values replaced."""
    node = parse_formula(formula)
    assert isinstance(node, Call)
    found = [formula]
    kinds = FUNCTIONS[node.name].kinds_of(len(node.args))
    for place, kind in enumerate(kinds):
        if kind not in SINGLE + "v":
            continue
        if kind == "v" and place:
            continue
        shown = [print_formula(arg) for arg in node.args]
        for other in VARIANTS:
            found.append(f"{node.name}({','.join([*shown[:place], other, *shown[place + 1 :]])})")
        if kind in SINGLE and place == 0 and not any(isinstance(part, Text) for part in walk(node.args[0])):
            array = "{" + shown[0] + ";" + shown[0] + "}" if re.fullmatch(r"-?[\d.]+", shown[0]) else ""
            if array:
                found.append(f"SUMPRODUCT({node.name}({','.join([array, *shown[1:]])}))")
    return found


def workbook(formulas: list[str], path: Path, arrays: bool) -> None:
    """All formulas in one file without stored values."""
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "S"
    for row, col, value in cells():
        cell = sheet.cell(row + 1, col + 1)
        if isinstance(value, ErrorValue):
            cell.value, cell.data_type = value.code, "e"
        elif value == "":
            cell.value = '=""'
        else:
            cell.value = value
            cell.data_type = "s" if isinstance(value, str) else cell.data_type
    for row, formula in enumerate(formulas, FIRST_ROW):
        cell = sheet.cell(row + 1, COLUMN + 1)
        shown = "=" + print_formula(parse_formula(formula))
        cell.value = ArrayFormula(cell.coordinate, shown) if arrays else shown
    book.save(path)


def asked(formulas: list[str]) -> dict[str, list[object]]:
    """What each program gives for each formula."""
    found: dict[str, list[object]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for program in PROGRAMS:
            path = Path(folder) / f"{program}.xlsx"
            workbook(formulas, path, arrays=program != "ironcalc")
            rows = range(FIRST_ROW, FIRST_ROW + len(formulas))
            if program == "ironcalc":
                given = answers(program, path)
                found[program] = [given.get("S", row, COLUMN) for row in rows]
                continue
            result = Path(folder) / "answers" / f"{program}.xlsx"
            result.parent.mkdir(exist_ok=True)
            if program == "gnumeric":
                subprocess.run(["ssconvert", "--recalc", str(path), str(result)], check=True, capture_output=True)
            else:
                convert_with_libreoffice([path], "xlsx", result.parent)
            sheet = openpyxl.load_workbook(result, data_only=True)["S"]
            found[program] = [answered(sheet.cell(row + 1, COLUMN + 1).value) for row in rows]
    return found


def ours(formulas: list[str]) -> list[object]:
    """What the engine gives."""
    values = evaluate(book_of(formulas))
    return [values.get("S", row, COLUMN) for row in range(FIRST_ROW, FIRST_ROW + len(formulas))]


def agree(mine: object, other: object) -> bool:
    """Equal values, any errors; an empty text may stand for nothing."""
    if isinstance(mine, ErrorValue) and isinstance(other, ErrorValue):
        return True
    if isinstance(mine, float) and isinstance(other, int) and not isinstance(other, bool):
        other = float(other)
    if mine in ("", 0.0) and other in (None, ""):
        return True
    return same(mine, other, 1e-9)


def spelt(value: object) -> str:
    """A value as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
    text = value.code if isinstance(value, ErrorValue) else "" if value is None else str(value)
    return quoted(text)


def quoted(formula: str) -> str:
    """A text as TOML."""
    return json.dumps(formula, ensure_ascii=False)


def decided() -> dict[str, object]:
    """Formula -> the value chosen by hand."""
    return {formula: scalar(value) for formula, value in load(FOLDER / "decided.toml")["values"].items()}


def main() -> None:
    """Ask, compare, and write."""
    tables = calls()
    formulas = [formula for name in tables for formula in tables[name]]
    mine, theirs, chosen = ours(formulas), asked(formulas), decided()
    unknown = {name for formula in formulas for name in _names(parse_formula(formula))} - FUNCTIONS.keys()
    assert not unknown, unknown
    values: dict[str, object] = {}
    open_ = 0
    for place, formula in enumerate(formulas):
        given = {program: theirs[program][place] for program in PROGRAMS}
        value = chosen.get(formula, mine[place])
        confirmed = any(agree(value, other) and code_agrees(value, given) for other in given.values())
        if not confirmed and formula not in chosen:
            open_ += 1
            print(f"{formula:60s} ours {mine[place]!s:24} " + "  ".join(f"{p} {v!s}" for p, v in given.items()))
        elif "--doubtful" in sys.argv and formula not in chosen and outvoted(value, given):
            print(f"{formula:60s} ours {mine[place]!s:24} " + "  ".join(f"{p} {v!s}" for p, v in given.items()))
        elif formula in chosen and not agree(chosen[formula], mine[place]):
            print(f"WRONG {formula}: decided {chosen[formula]!s}, ours {mine[place]!s}")
        values[formula] = value
    print(len(formulas), "formulas,", open_, "open")
    if "--write" in sys.argv:
        write(tables, values, formulas, theirs)


def outvoted(value: object, given: dict[str, object]) -> bool:
    """Whether two programs agree on another value."""
    others = [other for other in given.values() if not agree(value, other) and str(other) not in ("#NAME?", "#N/IMPL!")]
    return any(agree(a, b) for i, a in enumerate(others) for b in others[i + 1 :])


def code_agrees(value: object, given: dict[str, object]) -> bool:
    """Whether ironcalc or gnumeric name the same error, where they name one."""
    if not isinstance(value, ErrorValue):
        return True
    codes = {
        other.code for program, other in given.items() if isinstance(other, ErrorValue) and program != "libreoffice"
    }
    return not codes or value.code in codes


def _names(node: Node) -> set[str]:
    return {part.name for part in walk(node) if isinstance(part, Call)}


def write(
    tables: dict[str, list[str]], values: dict[str, object], formulas: list[str], theirs: dict[str, list[object]]
) -> None:
    """The case tables, and what the programs say otherwise."""
    for name, own in tables.items():
        lines = [f"  [{quoted(formula)}, {spelt(values[formula])}]," for formula in own]
        text = "# made by tools/engine_cases.py from calls.txt\narrays = true\ncases = [\n" + "\n".join(lines) + "\n]\n"
        (FOLDER / f"{name}.toml").write_text(text, encoding="utf-8")
    for program in PROGRAMS:
        lines = [
            f"{quoted(formula)} = {spelt(other)}"
            for formula, other in zip(formulas, theirs[program], strict=True)
            if not agree(values[formula], other)
        ]
        text = f"# what {program} gives where it differs from the tables; made by tools/engine_cases.py\n[values]\n"
        (FOLDER / f"differences_{program}.toml").write_text(text + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
