"""`exercise`: for each student other dimensions, a sheet to fill in, and the solution."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import math
import random
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from livesheet.diagnostics import Fault, readable_name, system_reason
from livesheet.formats import write
from livesheet.formula.scalar import evaluate
from livesheet.replacing import make_folder, replace_file
from livesheet.said import say
from mechsheet import reference
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.reader import is_device
from mechsheet.diagnostics import DescriptionError, MechsheetError
from mechsheet.homework.classroom.figure import figure_of
from mechsheet.homework.classroom.task_sheet import task_sheet
from mechsheet.homework.expected_values import truth_of
from mechsheet.homework.recognition import deciding
from mechsheet.homework.summaries import taken
from mechsheet.kinematics.whole_turns import rows_count_alike
from mechsheet.model import Mechanism, Need, Vary
from mechsheet.words.catalogue import said

DRAWS = 1000
"""Times that dimensions are drawn anew for one student."""
KEY = "key.json"
NUMBERS = "numbers.csv"
LONGEST = 60
"""Letters of an id in a file's name."""
_UNSAFE = re.compile(r"[^\w-]+")


@dataclass(frozen=True, slots=True)
class Student:
    """A line of the class: `more` are the other columns; `dimensions` by symbol in their own units."""

    id: str
    name: str
    dimensions: Mapping[str, float]

    @property
    def file(self) -> str:
        """The stem of this student's files: the id, made safe."""
        return safe(self.id)


@dataclass(frozen=True, slots=True)
class Exercises:
    """What `exercise` has written. `remarks`: who has the same dimensions as another."""

    students: tuple[Student, ...]
    folder: Path
    files: tuple[Path, ...]
    remarks: tuple[str, ...]


def exercise(
    mechanism: Mechanism,
    class_list: str | Path,
    output: str | Path,
    seed: int = 0,
    progress: Callable[[str], None] | None = None,
) -> Exercises:
    """Write `student/ID.xlsx`, `solution/ID.xlsx` for everybody in a CSV file (id, name, ...), `numbers.csv`, which says who
    has which dimensions, and `key.json`.

    Dimensions are drawn as the description's [exercise] says, from the seed and the id alone; `progress` is told how many
    students are done. Raises MechsheetError with everything that is wrong with the list, or if nothing drawn fulfils
    `need`; nothing is written then.
    """
    people, faults = _read(Path(class_list))
    folder = Path(output)
    if folder.exists() and not folder.is_dir():
        faults.append(Fault(say("is a file: a folder is written"), readable_name(folder), key="-o"))
    try:
        students, remarks = drawn(mechanism, people or [("", "")], seed)  # that `need` is never met is told in any case
    except DescriptionError as error:
        faults = [*error.faults, *faults]
    if faults:
        raise MechsheetError(faults)
    figure = figure_of(mechanism)
    changed = [(student, with_dimensions(mechanism, student.dimensions)) for student in students]
    for part in (folder, folder / "student", folder / "solution"):
        if not part.is_dir():
            make_folder(part)
    files: list[Path] = []
    for number, (student, own) in enumerate(changed, 1):
        if progress is not None:
            progress(f"student {number} of {len(changed)}")
        files += [folder / "student" / f"{student.file}.xlsx", folder / "solution" / f"{student.file}.xlsx"]
        compiled = Compiled(own)
        write(task_sheet(compiled, student.id, student.name, figure), files[-2])
        write(compiled.workbook, files[-1])
    key = folder / KEY
    replace_file(key, json.dumps(key_of(mechanism, students, seed), indent=1, ensure_ascii=False).encode())
    numbers = folder / NUMBERS
    replace_file(numbers, numbers_of(mechanism, students, seed).encode("utf-8-sig"))
    return Exercises(tuple(students), folder, (*files, numbers, key), tuple(remarks))


def numbers_of(mechanism: Mechanism, students: Sequence[Student], seed: int) -> str:
    """Who has which dimensions, as CSV: those that vary, with their units, and the seed that they were drawn from."""
    units = {dim.symbol: mechanism.shown(dim.unit).symbol for dim in mechanism.dimensions}
    rules = mechanism.exercise
    symbols = [one.symbol for one in (rules.vary if rules is not None else ())]
    heads = [f"{symbol} [{units[symbol]}]" if units[symbol] else symbol for symbol in symbols]
    rows: list[Sequence[object]] = [
        [*(said(mechanism.language, f"marks.{key}") for key in ("id", "name")), *heads, "seed"]
    ]
    for one in students:
        numbers = [f"{one.dimensions[symbol]:.10g}" for symbol in symbols]
        rows.append([no_formula(one.id), no_formula(one.name), *numbers, seed])
    return csv_text(rows)


def csv_text(rows: Iterable[Sequence[object]]) -> str:
    """Rows as CSV."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def no_formula(text: str) -> str:
    """A text that no spreadsheet program takes for a formula."""
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t") else text


def key_of(mechanism: Mechanism, students: Sequence[Student], seed: int) -> dict[str, Any]:
    """What `mark` needs: the description, and who has which dimensions."""
    return {
        "format": 1,
        "seed": seed,
        "description": mechanism.text,
        "students": [{"id": s.id, "name": s.name, "file": s.file, "dimensions": dict(s.dimensions)} for s in students],
    }


def safe(identifier: str) -> str:
    """A name for a file, on any system, made of an id: a long one ends with a few letters of its sum."""
    name = _UNSAFE.sub("_", identifier.strip()).strip("_") or "_"
    if len(name) > LONGEST:
        name = f"{name[:LONGEST]}_{hashlib.sha256(identifier.encode()).hexdigest()[:8]}"
    return f"{name}_" if is_device(name) else name


def _read(path: Path) -> tuple[list[tuple[str, str]], list[Fault]]:
    """The class, or what is wrong with its file."""
    try:
        return class_of(path), []
    except MechsheetError as error:
        return [], list(error.faults)


def faults_of_class(path: Path) -> list[Fault]:
    """What is wrong with a list of a class."""
    return _read(path)[1]


def class_of(path: Path) -> list[tuple[str, str]]:
    """(id, name) of everybody in a CSV file. Raises MechsheetError with every line that is wrong."""
    shown = readable_name(path)
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise MechsheetError(Fault(say("cannot be read: {reason}", reason=system_reason(error)), shown)) from error
    except UnicodeDecodeError as error:
        raise MechsheetError(Fault(say("is no text in UTF-8"), shown, hint=say("save it as CSV UTF-8"))) from error
    head = text.split("\n", 1)[0]
    delimiter = max(",;\t", key=head.count)
    rows = list(csv.reader(io.StringIO(text), delimiter=delimiter))
    titles = [cell.strip().casefold() for cell in rows[0]] if rows else []
    if "id" not in titles:
        raise MechsheetError(Fault(say('no column is called "id"'), shown, 1, source=head, hint="id,name"))
    column = titles.index("id")
    name = next((titles.index(word) for word in ("name", "ad", "isim") if word in titles), None)
    faults: list[Fault] = []
    found: dict[str, tuple[str, str, int]] = {}
    for line, row in enumerate(rows[1:], 2):
        if not any(cell.strip() for cell in row):
            continue
        identifier = row[column].strip() if column < len(row) else ""
        if not identifier:
            faults.append(Fault(say("a line without an id"), shown, line, source=delimiter.join(row)))
            continue
        other = found.get(safe(identifier).casefold())
        if other is not None:
            message = say("the same id as line {line}", line=other[2])
            if other[0] != identifier:
                message = say("an id too much like {other} of line {line}", other=other[0], line=other[2])
            faults.append(Fault(message, shown, line, key=identifier))
            continue
        label = row[name].strip() if name is not None and name < len(row) else ""
        found[safe(identifier).casefold()] = identifier, label, line
    if not found and not faults:
        faults.append(Fault(say("nobody is in this list"), shown))
    if faults:
        raise MechsheetError(faults)
    return [(identifier, label) for identifier, label, _ in found.values()]


def drawn(mechanism: Mechanism, people: Sequence[tuple[str, str]], seed: int) -> tuple[list[Student], list[str]]:
    """Everybody with dimensions, and who had to be given another's. Raises DescriptionError where `need` is never met."""
    rules = mechanism.exercise
    vary, needs = ((), ()) if rules is None else (rules.vary, rules.need)
    given = {dim.symbol: dim for dim in mechanism.dimensions}
    fixed = {
        symbol: float(dim.unit.to_shown(dim.value))
        for symbol, dim in given.items()
        if isinstance(dim.value, float) and not dim.path
    }
    taken_by: dict[tuple[float, ...], str] = {}
    fits: dict[tuple[float, ...], bool] = {}
    students: list[Student] = []
    remarks = [] if vary else [_all_alike(mechanism)]
    for identifier, name in people:
        draw = random.Random(hashlib.sha256(f"{seed}\n{identifier}".encode()).digest())
        spare: tuple[float, ...] | None = None
        chosen: tuple[float, ...] | None = None
        for _ in range(DRAWS if vary else 1):
            values = tuple(_value(one, draw) for one in vary)
            if values not in fits:
                fits[values] = fulfils(mechanism, dict(zip((one.symbol for one in vary), values, strict=True)), needs)
            if fits[values]:
                spare = spare or values
                if values not in taken_by:
                    chosen = values
                    break
        if chosen is None and spare is not None:
            chosen = spare
            if vary:
                remarks.append(
                    say(
                        "{identifier} has the same dimensions as {other}: the grid has no others",
                        identifier=identifier,
                        other=taken_by[spare],
                    )
                )
        if chosen is None:
            raise _never(mechanism, needs)
        taken_by.setdefault(chosen, identifier)
        own = fixed | dict(zip((one.symbol for one in vary), chosen, strict=True))
        students.append(Student(identifier, name, own))
    return students, remarks


def _all_alike(mechanism: Mechanism) -> str:
    """That nothing varies, with what might."""
    given = {dim.symbol: dim for dim in mechanism.dimensions}
    ranges = []
    for symbol in deciding(mechanism):
        typed = given[symbol].value
        value = float(given[symbol].unit.to_shown(typed)) if isinstance(typed, float) else 0.0
        if value:
            step = 10.0 ** math.floor(math.log10(abs(value) / 20)) / 2
            low, high = (round(round(value * part / step) * step, 10) for part in (0.95, 1.05))
            ranges.append(f"{symbol} = [{min(low, high):g}, {max(low, high):g}, {step:g}]")
    if not ranges:
        return say("everybody has the same dimensions; what is to vary is written into [dimensions], each with a name")
    return say(
        "everybody has the same dimensions; under [exercise] for example: vary = {{ {names} }}", names=", ".join(ranges)
    )


def _value(one: Vary, draw: random.Random) -> float:
    return round(one.low + draw.randrange(one.count) * one.step, 10)


def _never(mechanism: Mechanism, needs: Sequence[Need]) -> DescriptionError:
    from mechsheet.description.text.source import parse

    message = say("no draw of {draws} meets it: {names}", draws=DRAWS, names=" and ".join(need.text for need in needs))
    shown = f"{mechanism.file}.toml" if mechanism.file else "<text>"
    return DescriptionError(
        parse(mechanism.listing, shown).fault(("exercise", "need"), message, say("wider ranges in vary"))
    )


def fulfils(mechanism: Mechanism, dimensions: Mapping[str, float], needs: Sequence[Need]) -> bool:
    """Whether dimensions, in their own units, meet all that is needed; in any case some row exists."""
    units = {dim.symbol: dim.unit for dim in mechanism.dimensions}
    inside = {symbol: float(units[symbol].to_internal(value)) for symbol, value in dimensions.items()}
    numbers = reference.dimension_values(mechanism, inside)
    truth = truth_of(mechanism, inside, reference.driver_values(mechanism, numbers))
    if truth is None:
        return False
    values = {symbol: float(units[symbol].to_shown(number)) for symbol, number in numbers.items()}
    alike = rows_count_alike(mechanism, truth.driver, bool(mechanism.relations or mechanism.drivers))
    for summary in mechanism.summaries:
        kind = truth.kinds.get(summary.of, "number")
        number = taken(truth.columns[summary.of], summary.take, kind, alike)
        own = next((output.unit for output in mechanism.outputs if output.symbol == summary.of), mechanism.angle_unit)
        values[summary.symbol] = math.degrees(number) if kind == "angle" and own.in_degrees else number
    return all(_holds(need, values, bool(truth.exists.all())) for need in needs)


def _holds(need: Need, values: Mapping[str, float], all_rows: bool) -> bool:
    if need.left is None or need.right is None:
        return all_rows
    try:
        left, right = evaluate(need.left, values), evaluate(need.right, values)
    except (ArithmeticError, ValueError):
        return False
    return {"<": left < right, ">": left > right, "<=": left <= right, ">=": left >= right}[need.operator]


def with_dimensions(mechanism: Mechanism, dimensions: Mapping[str, float]) -> Mechanism:
    """The mechanism with a student's dimensions, which are in their own units."""
    texts = {symbol: repr(value) for symbol, value in dimensions.items()}
    return loads(mechanism.text, mechanism.file or "<text>", Overrides(texts))
