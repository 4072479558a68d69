"""Other programs as judges: what LibreOffice, gnumeric, formulas, IronCalc and ONLYOFFICE compute from a finished file."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from livesheet.diagnostics import Fault, WorkbookError, near_miss, readable_name
from livesheet.formula.book import Book
from livesheet.formula.nodes import Binary, ErrorValue, Node, Scalar, walk
from livesheet.formula.references import cell_name
from livesheet.said import say
from mechsheet.diagnostics import MissingProgramError
from mechsheet.extras import command_for, missing_package, missing_program

TIMEOUT = 600
"""Seconds that a spreadsheet program may take."""

_ALWAYS = (
    '<item oor:path="/org.openoffice.Office.Calc/Formula/Load">'
    '<prop oor:name="{}" oor:op="fuse"><value>0</value></prop></item>'
)

RECALCULATE = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<oor:items xmlns:oor="http://openoffice.org/2001/registry" xmlns:xs="http://www.w3.org/2001/XMLSchema" '
    'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">'
    f"{_ALWAYS.format('OOXMLRecalcMode')}{_ALWAYS.format('ODFRecalcMode')}</oor:items>\n"
)
"""LibreOffice believes the values stored in an .xlsx unless its profile says otherwise."""


class Answers:
    """Values by sheet title, row and column."""

    def __init__(self, find: Callable[[str, int, int], Scalar]) -> None:
        self._find = find

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """The program's value of a cell."""
        return self._find(sheet, row, col)


def answers(program: str, path: Path) -> Answers:
    """What a program computes from the file. Raises MissingProgramError, or WorkbookError when the program fails."""
    refuse_unknown([program])
    return PROGRAMS[program](path)


def names_of(programs: str | Iterable[str]) -> list[str]:
    """The programs asked for: several names, or one text with commas between them."""
    names = programs.split(",") if isinstance(programs, str) else list(programs)
    if not all(isinstance(name, str) for name in names):
        raise MissingProgramError(Fault(say("programs are named by texts: {programs}", programs=", ".join(PROGRAMS))))
    return list(dict.fromkeys(name.strip() for name in names if name.strip()))


def refuse_unknown(programs: Iterable[str]) -> None:
    """Raise MissingProgramError with a near miss for every name that is no program's."""
    unknown = [program for program in programs if program not in PROGRAMS]
    if unknown:
        every = say("programs: {programs}", programs=", ".join(PROGRAMS))
        raise MissingProgramError(
            Fault(say('no program is called "{program}"', program=program), hint=near_miss(program, PROGRAMS) or every)
            for program in unknown
        )


def answers_to_all(program: str, paths: Sequence[Path]) -> Iterator[Answers]:
    """What a program computes from each of many files; LibreOffice opens them all in one go (starting it is slow)."""
    if program != "libreoffice":
        yield from (answers(program, path) for path in paths)
        return
    with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
        yield from map(stored_values, convert_with_libreoffice(list(paths), "xlsx", Path(folder)))


LIBREOFFICE_PLACES = (
    "C:/Program Files/LibreOffice/program/soffice.exe",
    "C:/Program Files (x86)/LibreOffice/program/soffice.exe",
    "/Applications/LibreOffice.app/Contents/MacOS/soffice",
)
"""Where its installers for Windows and macOS put it, which is not where a shell looks for commands."""


def libreoffice_command() -> str | None:
    """The command that starts LibreOffice, or None."""
    usual = (place for place in LIBREOFFICE_PLACES if Path(place).is_file())
    return shutil.which("soffice") or shutil.which("libreoffice") or next(usual, None)


def convert_with_libreoffice(paths: list[Path], suffix: str, folder: Path) -> list[Path]:
    """Recalculate files from scratch and write them into `folder` in another format; one call for all (starting is slow)."""
    command = libreoffice_command()
    if command is None:
        raise missing_program("LibreOffice")
    with tempfile.TemporaryDirectory(prefix="mechsheet-office-") as profile:
        user = Path(profile) / "user"
        user.mkdir()
        (user / "registrymodifications.xcu").write_text(RECALCULATE, encoding="utf-8")
        arguments = [f"-env:UserInstallation={Path(profile).as_uri()}", "--headless", "--convert-to", suffix]
        _run([command, *arguments, "--outdir", str(folder), *map(str, paths)])
    results = [folder / f"{path.stem}.{suffix.split(':')[0]}" for path in paths]
    missing = [path for path, result in zip(paths, results, strict=True) if not result.exists()]
    if missing:
        raise WorkbookError(Fault(say("LibreOffice could not open it"), readable_name(missing[0])))
    return results


def _run(command: list[str]) -> None:
    try:
        subprocess.run(command, check=True, capture_output=True, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        raise WorkbookError(
            say("{name} did not answer within {timeout} s", name=Path(command[0]).name, timeout=TIMEOUT)
        ) from None
    except subprocess.CalledProcessError as error:
        said = error.stderr.decode(errors="replace").strip().splitlines()
        raise WorkbookError(
            say("{name} failed: {reason}", name=Path(command[0]).name, reason=said[-1] if said else error.returncode)
        ) from None


def stored_values(path: Path) -> Answers:
    """The values stored in a workbook file, by whichever program wrote it."""
    from livesheet.formats import read

    book = read(path)

    def find(title: str, row: int, col: int) -> Scalar:
        sheet = book.sheet(title)
        if sheet is None:
            return None
        value = sheet.cached.get(row, col)
        return sheet.constants.get(row, col) if value is None else value

    return Answers(find)


def _libreoffice(path: Path) -> Answers:
    with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
        (result,) = convert_with_libreoffice([path], "xlsx", Path(folder))
        return stored_values(result)


def _gnumeric(path: Path) -> Answers:
    command = shutil.which("ssconvert")
    if command is None:
        raise missing_program("gnumeric")
    with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
        result = Path(folder) / "answers.xlsx"
        _run([command, "--recalc", str(path), str(result)])
        return stored_values(result)


def _only_xlsx(path: Path, program: str) -> None:
    if path.suffix.lower() not in (".xlsx", ".xlsm"):
        hint = say("libreoffice and gnumeric read both formats")
        raise WorkbookError(Fault(say("{program} reads .xlsx only", program=program), readable_name(path), hint=hint))


def _formulas(path: Path) -> Answers:
    """The `formulas` package: cell by cell, about 2 ms each."""
    _only_xlsx(path, "formulas")
    import logging
    import os
    import warnings

    import numpy

    os.environ.setdefault("TQDM_DISABLE", "1")  # read when the package loads: no bar of its own on our standard error

    logging.getLogger("formulas").setLevel(logging.ERROR)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            import formulas
            import openpyxl  # noqa: F401  (it reads the file for `formulas`, when asked)
        except ImportError:
            raise missing_package("formulas", "formulas") from None

        solution = formulas.ExcelModel().loads(str(path)).finish().calculate()
    values: dict[str, Scalar] = {}
    for ranges in solution.values():
        if not hasattr(ranges, "ranges") or len(ranges.ranges) != 1:
            continue
        area = ranges.ranges[0]
        if "sheet" not in area:
            continue  # a constant or an empty cell that some formula reads
        sheet, first_row, first_col = area["sheet"].casefold(), int(area["r1"]), int(area["n1"])
        for (down, right), value in numpy.ndenumerate(numpy.atleast_2d(ranges.value)):
            values[f"{sheet}!{cell_name(first_row - 1 + down, first_col - 1 + right)}"] = _plain(value)
    return Answers(lambda sheet, row, col: values.get(f"{sheet.casefold()}!{cell_name(row, col)}"))


def _plain(value: object) -> Scalar:
    """A value of `formulas` as one of ours: its errors are objects that print as Excel's codes."""
    import numpy

    if isinstance(value, bool | numpy.bool_):
        return bool(value)
    if isinstance(value, int | float | numpy.integer | numpy.floating):
        return float(value)
    return _said(str(value))


def _said(text: str) -> Scalar:
    """A text as it is, or the error whose code it is: one word that begins with #."""
    return ErrorValue(text) if text.startswith("#") and " " not in text else text


def _ironcalc(path: Path) -> Answers:
    try:
        import ironcalc
    except ImportError:
        raise missing_package("ironcalc", "ironcalc") from None
    _only_xlsx(path, "ironcalc")
    model = ironcalc.load_from_xlsx(str(path), "en", "UTC", "en")
    model.evaluate()
    sheets = {sheet["name"].casefold(): index for index, sheet in enumerate(model.get_worksheets_properties())}

    def find(title: str, row: int, col: int) -> Scalar:
        value = model.get_cell_value(sheets[title.casefold()], row + 1, col + 1)
        if isinstance(value, str):
            return _said(value)
        return float(value) if isinstance(value, int) and not isinstance(value, bool) else value

    return Answers(find)


ONLYOFFICE = """
import sys
import docbuilder
COMPARE = (
    "String.prototype.localeCompare = function (other) {"
    " var one = this.toLowerCase(), two = String(other).toLowerCase(); return one < two ? -1 : one > two ? 1 : 0; };"
)
builder = docbuilder.CDocBuilder()
builder.Initialize()
done = builder.OpenFile(sys.argv[1], "") == 0
done = done and builder.ExecuteCommand(COMPARE + " Api.RecalculateAllFormulas();")
done = done and builder.SaveFile("xlsx", sys.argv[2]) == 0
builder.CloseFile()
sys.exit(0 if done else "the file cannot be opened, computed or saved")
"""
"""What a Python of its own does with the package document-builder, which is under the AGPL and never loaded into ours.

It believes stored values until it is told to compute. Its package 10.0 cannot compare texts (`Internal error. Icu error`
where formulas look a text up), so it is told how.
"""


def _onlyoffice(path: Path) -> Answers:
    _only_xlsx(path, "onlyoffice")
    if importlib.util.find_spec("docbuilder") is None:
        hint = say("{command} (100 MB, AGPL, runs as a program of its own)", command=command_for("onlyoffice"))
        raise MissingProgramError(Fault(say("ONLYOFFICE's document-builder is not installed"), hint=hint))
    with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
        result = Path(folder) / "answers.xlsx"
        _run([sys.executable, "-c", ONLYOFFICE, str(path.resolve()), str(result)])
        if not result.exists():
            raise WorkbookError(Fault(say("ONLYOFFICE could not open it"), readable_name(path)))
        return stored_values(result)


def cannot_judge(program: str, book: Book) -> str:
    """Why a program cannot compute a workbook, "" when it can.

    IronCalc 0.9 and ONLYOFFICE 10.0 know no names that begin with a letter beyond ASCII: what reads them is an error there.
    IronCalc knows no range between two calls: INDEX(…):INDEX(…), which the drawing and the limits read.
    """
    names = (defined.name for defined in book.names)
    foreign = [name for name in names if program in ("ironcalc", "onlyoffice") and not name[:1].isascii()]
    if foreign:
        return say(
            "{program} was not asked: it cannot read names that begin with a letter beyond ASCII ({names})",
            program=program,
            names=", ".join(foreign),
        )
    if program == "ironcalc" and any(
        _has_moving_range(block.formula) for sheet in book.sheets for block in sheet.blocks
    ):
        return say(
            "{program} was not asked: it does not know ranges like INDEX(…):INDEX(…); with the layout page it can be",
            program=program,
        )
    return ""


def _has_moving_range(formula: Node) -> bool:
    return any(isinstance(part, Binary) and part.op == ":" for part in walk(formula))


PROGRAMS: Mapping[str, Callable[[Path], Answers]] = {
    "libreoffice": _libreoffice,
    "gnumeric": _gnumeric,
    "formulas": _formulas,
    "ironcalc": _ironcalc,
    "onlyoffice": _onlyoffice,
}
"""Name on the command line -> how to ask it."""
