"""`mark`: the workbooks of a whole class, one audit each."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from livesheet.diagnostics import Fault, readable_name, system_reason
from livesheet.formats import FORMATS, read
from livesheet.said import say
from livesheet.time_limit import limited
from mechsheet.arguments.outputs import is_there
from mechsheet.description import load, loads
from mechsheet.diagnostics import OWN_FAILURES, MechsheetError, own_fault
from mechsheet.homework.audit import Audit, audited, fault_line, is_other
from mechsheet.homework.classroom.exercise import Student, safe, with_dimensions
from mechsheet.homework.expected_values import AskedFor, asked_of
from mechsheet.homework.formula_strips import Work, upright
from mechsheet.model import Mechanism
from mechsheet.words.catalogue import said

SUFFIXES = tuple(FORMATS)
MOST_SEARCHED = 400
"""Typed cells of a workbook in which a student's id is looked for."""


@dataclass(frozen=True, slots=True)
class Marked:
    """One line of the marks.

    file    the workbook, "" where none was handed in;  audit  None where it cannot be judged, and `why`
    remarks what is to be known of this student's workbook beside the audit;  private  what names other students
    """

    id: str
    name: str
    file: str
    audit: Audit | None
    why: str = ""
    remarks: tuple[str, ...] = ()
    private: tuple[str, ...] = ()

    @property
    def mark(self) -> float:
        """The marks, with follow-through as the description has it."""
        return 0.0 if self.audit is None else self.audit.follow_through


@dataclass(frozen=True, slots=True)
class Marks:
    """A class marked. `asked`: marks by what is asked."""

    title: str
    language: str
    asked: Mapping[str, float]
    students: tuple[Marked, ...]

    @property
    def of(self) -> float:
        """The highest possible mark."""
        return sum(self.asked.values())


@dataclass(frozen=True, slots=True)
class Key:
    """What workbooks are held against: a mechanism, and where there is a list, who has which dimensions."""

    mechanism: Mechanism
    students: tuple[Student, ...] = ()


def mark(
    books: str | Path | Iterable[str | Path],
    against: str | Path | Mechanism | Key,
    assembly: str = "",
    progress: Callable[[str], None] | None = None,
    seconds: float | None = None,
) -> Marks:
    """Mark workbooks, given one by one or as folders, against a description or the `key.json` of an exercise.

    A workbook belongs to the student whose id is its file's name or stands in a cell, else to the one whose dimensions it
    has. A workbook that takes longer than `seconds` is not judged, and its line says so; None: as long as it takes. Raises
    MechsheetError where the key cannot be read, or where one of `books` is not there or holds no workbook.
    """
    key = against if isinstance(against, Key | Mechanism) else key_of_file(Path(against))
    key = key if isinstance(key, Key) else Key(key)
    wanted = asked_of(key.mechanism)
    say = progress or (lambda _: None)
    read_books = []
    for number, path in enumerate(paths := files_of(books), 1):
        say(f"{number} of {len(paths)}")
        read_books.append(_judged(path, key, wanted, assembly == "any", seconds))
    students = _assigned(read_books, key)
    return Marks(
        key.mechanism.title.of(key.mechanism.language), key.mechanism.language, _asked(wanted, students), students
    )


def key_of_file(path: Path) -> Key:
    """A description, or the key of an exercise. Raises MechsheetError."""
    if path.suffix.lower() != ".json":
        return Key(load(path))
    shown = readable_name(path)
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        mechanism = loads(data["description"], shown)
        students = tuple(
            Student(str(one["id"]), str(one["name"]), {str(s): float(v) for s, v in one["dimensions"].items()})
            for one in data["students"]
        )
    except OSError as error:
        raise MechsheetError(Fault(say("cannot be read: {reason}", reason=system_reason(error)), shown)) from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise MechsheetError(Fault(say("is not the key that mechsheet exercise writes"), shown)) from error
    return Key(mechanism, students)


def files_of(books: str | Path | Iterable[str | Path]) -> list[Path]:
    """The workbooks that are meant; a folder stands for those in it and below, without those that only mark an open one.

    Raises MechsheetError with every path that is not there, that is another kind of file, or that holds no workbook: a
    class of which a folder is misspelled is not marked at all, since everybody in it would have handed in nothing.
    """
    given = [books] if isinstance(books, str | Path) else list(books)
    found: list[Path] = []
    faults = []
    for path in map(Path, given):
        inside = _inside(path) if path.is_dir() else [path]
        found += inside
        message = _fault_of(path, inside)
        if message:
            faults.append(Fault(message, readable_name(path)))
    if faults or not found:
        raise MechsheetError(faults or Fault(say("no workbook is named")))
    return list(dict.fromkeys(found))


def _inside(folder: Path) -> list[Path]:
    """The workbooks of a folder and of those below it."""
    found = sorted(path for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES and path.is_file())
    return [path for path in found if not path.name.startswith((".", "~$"))]


def _fault_of(path: Path, inside: Sequence[Path]) -> str:
    """What is wrong with a path that is to be marked, "" where it is a workbook's or a folder that holds some."""
    suffixes = ", ".join(SUFFIXES)
    if not is_there(path):
        return say("there is no such file or folder")
    if not inside:
        return say("no workbook ({suffixes}) in this folder", suffixes=suffixes)
    if not path.is_dir() and path.suffix.lower() not in SUFFIXES:
        return say("is no workbook ({suffixes})", suffixes=suffixes)
    return ""


@dataclass(frozen=True, slots=True)
class _Judged:
    path: Path
    audit: Audit | None
    why: str
    student: Student | None


def _judged(path: Path, key: Key, wanted: AskedFor, any_assembly: bool, seconds: float | None) -> _Judged:
    """One workbook; what is wrong with it is told in its line and does not keep the others from being marked."""
    student = _by_name(path, key.students)
    try:
        with limited(seconds):
            work = upright(read(path))
            student = student or _by_cells(work, key.students)
            mechanism = key.mechanism if student is None else with_dimensions(key.mechanism, student.dimensions)
            audit = audited(
                work, mechanism, wanted, readable_name(path), any_assembly, student is not None, all_rows=True
            )
    except OWN_FAILURES as error:
        return _Judged(path, None, own_fault(error, "").message, student)
    except MechsheetError as error:
        return _Judged(path, None, "; ".join(fault.message for fault in error.faults), student)
    return _Judged(path, audit, "", student or _by_dimensions(audit, key.students))


def _by_name(path: Path, students: Sequence[Student]) -> Student | None:
    """The student whose id a file is called by, alone or between underscores."""
    stem = safe(path.stem).casefold()
    by_file = {student.file.casefold(): student for student in students}
    if stem in by_file:
        return by_file[stem]
    parts = [student for name, student in by_file.items() if name in stem.split("_")]
    return parts[0] if len(parts) == 1 else None


def _by_cells(work: Work, students: Sequence[Student]) -> Student | None:
    """The student whose id stands in a cell."""
    ids = {student.id.casefold(): student for student in students}
    for sheet in work.book.sheets:
        for number, (_, _, value) in enumerate(sheet.constants.items()):
            if number > MOST_SEARCHED:
                break
            text = f"{value:.15g}" if isinstance(value, float) else str(value)
            if text.strip().casefold() in ids:
                return ids[text.strip().casefold()]
    return None


def _by_dimensions(audit: Audit, students: Sequence[Student]) -> Student | None:
    """The only student whose dimensions a workbook has."""
    fitting = [student for student in students if audit.given and not _others(audit, student)]
    return fitting[0] if len(fitting) == 1 else None


def _others(audit: Audit, student: Student) -> list[str]:
    """Dimensions of a workbook that are not a student's."""
    return [
        symbol
        for symbol, given in audit.given.items()
        if symbol in student.dimensions and is_other(given.value, student.dimensions[symbol])
    ]


def _assigned(books: Sequence[_Judged], key: Key) -> tuple[Marked, ...]:
    """A line for each student of the list, then for workbooks that nobody owns."""
    language = key.mechanism.language
    found: list[Marked] = []
    for student in key.students:
        own = [book for book in books if book.student is student]
        if not own:
            found.append(Marked(student.id, student.name, "", None, said(language, "marks.nothing")))
            continue
        best = max(own, key=lambda book: (book.audit is not None, book.audit.follow_through if book.audit else 0.0))
        remarks = [said(language, "marks.twice")] if len(own) > 1 else []
        private = [] if best.audit is None else _whose(best.audit, student, key)
        line = _line(student.id, student.name, best, best.audit, remarks, language)
        found.append(replace(line, private=tuple(private)))
    for book in books:
        if book.student is None:
            remarks = [said(language, "marks.unknown")] if key.students else []
            found.append(_line(book.path.stem, "", book, book.audit, remarks, language))
    return tuple(found)


def _line(
    identifier: str, name: str, book: _Judged, audit: Audit | None, remarks: Sequence[str], language: str
) -> Marked:
    why = said(language, "marks.unreadable", why=book.why) if book.why else ""
    return Marked(identifier, name, readable_name(book.path), audit, why, tuple(remarks))


def _whose(audit: Audit, student: Student, key: Key) -> list[str]:
    """Whose the dimensions of a workbook are, where they are not the student's."""
    if not _others(audit, student):
        return []
    owners = [other.id for other in key.students if other is not student and not _others(audit, other)]
    return [said(audit.language, "marks.others", who=", ".join(owners))] if owners else []


def _asked(wanted: AskedFor, students: Sequence[Marked]) -> dict[str, float]:
    """What is asked, without what no workbook was asked for because it does not move."""
    judged = [one.audit for one in students if one.audit is not None]
    if not judged:
        return dict(wanted.marks)
    return {symbol: marks for symbol, marks in wanted.marks.items() if any(symbol in audit.asked for audit in judged)}


def lines_of(one: Marked) -> list[str]:
    """A student's line in words, for that student, a statement each: what is not right, the faults, the remarks."""
    if one.audit is None:
        return [one.why]
    language = one.audit.language
    alike: dict[str, list[str]] = {}
    for symbol, result in one.audit.asked.items():
        if result.verdict != "right":
            alike.setdefault(result.verdict, []).append(symbol)
    parts = [f"{', '.join(symbols)}: {said(language, verdict)}" for verdict, symbols in alike.items()]
    parts += [fault_line(fault, language) for fault in one.audit.faults]
    return [*parts, *one.remarks, *one.audit.remarks]


def words_of(one: Marked) -> str:
    """The same in one line."""
    return "; ".join(lines_of(one))


def as_dict(marks: Marks) -> dict[str, Any]:
    """As JSON data."""
    return {
        "of": marks.of,
        "students": [
            {"id": one.id, "name": one.name, "file": one.file, "mark": one.mark, "words": words_of(one)}
            | ({"private": list(one.private)} if one.private else {})
            | ({} if one.audit is None else {"audit": one.audit.as_dict()})
            for one in marks.students
        ],
    }
