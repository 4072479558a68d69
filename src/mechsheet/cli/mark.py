"""`mechsheet mark`: the workbooks of a whole class."""

from __future__ import annotations

import json
from pathlib import Path

import click

from livesheet.diagnostics import readable_name
from livesheet.said import say

from .common import FILE, JSON, MOST_SECONDS, Explained, at_lines_of, progress, same_file, say_written, seconds_option
from .speaking import speak_of


@click.command(cls=Explained)
@click.argument("books", nargs=-1, required=True, metavar="FOLDER|BOOK...", type=FILE)
@click.option("--against", required=True, metavar="FILE", type=FILE, help="key.json, or a description.")
@click.option("-o", "--output", metavar="MARKS.XLSX", type=FILE, help="The class as a workbook, .xlsx or .ods.")
@click.option("--csv", "csv_file", metavar="FILE", type=FILE, help="id, mark and words as CSV.")
@click.option("--moodle", "moodle_file", metavar="FILE", type=FILE, help="CSV for Moodle's grade import.")
@click.option("--html", "html_folder", metavar="FOLDER", type=FILE, help="A page for each student.")
@click.option("--assembly", type=click.Choice(["any"]), help="any: accept assemblies other than the sketch's.")
@seconds_option(MOST_SECONDS)
@JSON
def mark(
    books: tuple[Path, ...],
    against: Path,
    output: Path | None,
    csv_file: Path | None,
    moodle_file: Path | None,
    html_folder: Path | None,
    assembly: str | None,
    seconds: float,
    as_json: bool,
) -> None:
    """Audit the workbooks of a class and write the marks.

    \b
    mechsheet mark handed-in --against week3/key.json -o marks.xlsx --html pages
    mechsheet mark a.xlsx b.ods --against four-bar.toml

    In marks.xlsx a number in the yellow column replaces a total. Nothing leaves this machine; a student's page
    contains no other student's data.
    """
    from livesheet.formats import write
    from livesheet.replacing import make_folder, replace_file
    from mechsheet.homework.classroom.marks import as_dict, files_of, key_of_file
    from mechsheet.homework.classroom.marks import mark as mark_all
    from mechsheet.homework.classroom.marks_book import marks_csv, marks_workbook, moodle_csv, pages

    _refuse(output, [output, csv_file, moodle_file], files_of(books))
    speak_of(against)
    key = key_of_file(against)
    with at_lines_of(key.mechanism, against), progress("marks") as tell:
        found = mark_all(books, key, assembly or "", tell, seconds)
    files = []
    if output is not None:
        write(marks_workbook(found), output)
        files.append(output)
    if csv_file is not None:
        replace_file(csv_file, marks_csv(found).encode("utf-8-sig"))
        files.append(csv_file)
    if moodle_file is not None:
        replace_file(moodle_file, moodle_csv(found).encode())
        files.append(moodle_file)
    if html_folder is not None:
        if not html_folder.is_dir():
            make_folder(html_folder)
        for name, text in pages(found).items():
            replace_file(html_folder / name, text.encode())
            files.append(html_folder / name)
    if as_json:
        click.echo(json.dumps(as_dict(found), indent=2, ensure_ascii=False))
    elif not files:
        for one in found.students:
            click.echo("\t".join(filter(None, (one.id, f"{one.mark:g}", one.file, one.why))))
    else:
        say_written(files)


def _refuse(output: Path | None, written: list[Path | None], read: list[Path]) -> None:
    """Raise OutputError, before anything is marked, where what is read would be overwritten, a folder is not there, or a
    workbook has no format."""
    from livesheet.diagnostics import Fault, OutputError

    faults = [
        Fault(say("is read here: it is not overwritten"), readable_name(file), hint=say("name another file"))
        for file in written
        if file is not None and any(same_file(file, other) for other in read)
    ]
    faults += [
        Fault(say("cannot be written: {reason}", reason=say("there is no such folder")), readable_name(file))
        for file in written
        if file is not None and not file.parent.is_dir()
    ]
    if output is not None and output.suffix.lower() not in (".xlsx", ".ods"):
        faults.append(Fault(say("a workbook ends with .xlsx or .ods"), readable_name(output), key="-o"))
    if faults:
        raise OutputError(faults)
