"""LibreOffice with macros allowed: what functions written in Basic give in cells.

`--convert-to` never runs a document's macros, so a macro of the (temporary) profile does the work: it makes or opens each
document with macros allowed, puts modules and formulas in, recalculates, and stores it as .xlsx.
"""

import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

from mechsheet.checking.programs import Answers, libreoffice_command, stored_values

LIBRARY = """<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE library:library PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "library.dtd">
<library:library xmlns:library="http://openoffice.org/2000/library" library:name="Standard" library:readonly="false"
 library:passwordprotected="false"><library:element library:name="Runner"/></library:library>"""

MODULE = """<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE script:module PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "module.dtd">
<script:module xmlns:script="http://openoffice.org/2000/script" script:name="Runner" script:language="StarBasic">{}
</script:module>"""

RUNNER = """\
Option Explicit

Function Setting(key As String, content As Variant) As Object
    Dim made As New com.sun.star.beans.PropertyValue
    made.Name = key
    made.Value = content
    Setting = made
End Function

Function WholeText(path As String) As String
    Dim files As Object, stream As Object
    files = createUnoService("com.sun.star.ucb.SimpleFileAccess")
    stream = createUnoService("com.sun.star.io.TextInputStream")
    stream.setInputStream(files.openFileRead(ConvertToURL(path)))
    stream.setEncoding("UTF-8")
    WholeText = stream.readString(Array(), False)
    stream.closeInput()
End Function

Function Place(document As Object, name As String) As Object
    Dim found As Object, cell As New com.sun.star.table.CellAddress
    found = document.NamedRanges.getByName(name).getReferredCells().getRangeAddress()
    cell.Sheet = found.Sheet
    cell.Column = found.StartColumn
    cell.Row = found.StartRow
    Place = cell
End Function

Sub Seek(document As Object, goal As Variant)
    Dim found As Object, changed As Object
    found = document.seekGoal(Place(document, CStr(goal(0))), Place(document, CStr(goal(1))), CStr(goal(2)))
    changed = document.NamedRanges.getByName(goal(1)).getReferredCells()
    changed.getCellByPosition(0, 0).setValue(found.Result)
End Sub

Function ColumnOf(sheet As Object, letters As String) As Long
    ColumnOf = sheet.getCellRangeByName(letters & "1").CellAddress.Column
End Function

Sub Edit(document As Object, change As Variant)
    Dim sheets As Object, sheet As Object, area As Object, moved As New com.sun.star.table.CellAddress
    Dim field(1) As New com.sun.star.table.TableSortField
    sheets = document.Sheets
    If Not sheets.hasByName(change(1)) Then Exit Sub
    sheet = sheets.getByName(change(1))
    Select Case change(0)
        Case "delete sheet": sheets.removeByName(change(1))
        Case "rename": sheet.Name = change(2)
        Case "insert rows": sheet.Rows.insertByIndex(CLng(change(2)) - 1, CLng(change(3)))
        Case "delete rows": sheet.Rows.removeByIndex(CLng(change(2)) - 1, CLng(change(3)))
        Case "insert columns": sheet.Columns.insertByIndex(ColumnOf(sheet, change(2)), CLng(change(3)))
        Case "delete columns": sheet.Columns.removeByIndex(ColumnOf(sheet, change(2)), CLng(change(3)))
        Case "fill down": sheet.getCellRangeByName(change(2)).fillAuto(com.sun.star.sheet.FillDirection.TO_BOTTOM, 1)
        Case "type": sheet.getCellRangeByName(change(2)).setFormula(change(3))
        Case "copy": sheets.copyByName(change(1), change(2), sheets.Count)
        Case "protect": sheet.protect("")
        Case "move": sheets.moveByName(change(1), CLng(change(2)))
        Case "sort"
            area = sheet.getCellRangeByName(change(2))
            field(0).Field = 1
            field(0).IsAscending = False
            area.sort(Array(Setting("SortFields", field()), Setting("ContainsHeader", False)))
    End Select
End Sub

Sub Work(folder As String)
    Dim jobs As Variant, lines As Variant, number As Long, row As Long
    Dim document As Object, library As Object, url As String, stem As String, origin As Object
    jobs = Split(WholeText(folder & "/jobs.txt"), Chr(10))
    For number = 0 To UBound(jobs)
        stem = folder & "/" & number
        url = "private:factory/scalc"
        If jobs(number) <> "new" Then url = ConvertToURL(jobs(number))
        document = StarDesktop.loadComponentFromURL(url, "_blank", 0, _
            Array(Setting("Hidden", True), Setting("MacroExecutionMode", 4)))
        If FileExists(stem & ".copied") Then
            origin = document
            document = StarDesktop.loadComponentFromURL("private:factory/scalc", "_blank", 0, Array(Setting("Hidden", True)))
            document.Sheets.importSheet(origin, origin.Sheets.getByIndex(0).Name, 0)
            origin.close(True)
        End If
        If FileExists(stem & ".edits") Then
            lines = Split(WholeText(stem & ".edits"), Chr(10))
            For row = 0 To UBound(lines)
                Edit document, Split(lines(row), Chr(9))
            Next row
        End If
        If FileExists(stem & ".goal") Then Seek document, Split(WholeText(stem & ".goal"), Chr(10))
        If FileExists(stem & ".bas") Then
            If Not document.BasicLibraries.hasByName("Standard") Then document.BasicLibraries.createLibrary("Standard")
            library = document.BasicLibraries.getByName("Standard")
            library.insertByName("Tried", WholeText(stem & ".bas"))
            lines = Split(WholeText(stem & ".txt"), Chr(10))
            For row = 0 To UBound(lines)
                document.Sheets.getByIndex(0).getCellByPosition(0, row).setFormula(lines(row))
            Next row
        Else
            document.calculateAll()
            document.calculateAll()  ' the second time in another order
        End If
        If FileExists(stem & ".edits") And Right(jobs(number), 4) = ".ods" Then
            document.storeToURL(ConvertToURL(stem & ".edited.ods"), Array(Setting("FilterName", "calc8")))
        Else
            document.storeToURL(ConvertToURL(stem & ".xlsx"), Array(Setting("FilterName", "Calc MS Excel 2007 XML")))
        End If
        document.close(True)
    Next number
    StarDesktop.terminate()
End Sub
"""


PATIENCE, PATIENCE_FOR_EACH = 60, 20
"""Seconds for a call, and for each of its jobs: a machine may have much else to do."""


@dataclass(frozen=True)
class Job:
    """A document to open, or a module with the formulas of column A of a new document.

    copied  True: the document's first sheet is copied into a new document, which is what is computed
    sought  a cell with a formula, the cell that is changed for it, both by name, and what the first is to be: Goal Seek
    edits   what a person does to the document, one after the other: ("delete sheet", "Checks"), see `Edit` above
    """

    document: Path | None = None
    copied: bool = False
    module: bytes = b""
    formulas: Sequence[str] = ()
    sought: tuple[str, str, float] | None = None
    edits: Sequence[Sequence[object]] = ()


def with_macros(jobs: Sequence[Job]) -> list[Answers]:
    """What LibreOffice computes in each job's document; one start for all."""
    with tempfile.TemporaryDirectory(prefix="mechsheet-macros-") as place:
        folder = Path(place)
        _work(jobs, folder)
        return [stored_values(folder / f"{number}.xlsx") for number in range(len(jobs))]


def edited(jobs: Sequence[Job], folder: Path) -> list[Path]:
    """The documents as LibreOffice saves them after a person's edits, each in its own format; one start for all."""
    _work(jobs, folder)
    suffixes = [".edited.ods" if job.document and job.document.suffix == ".ods" else ".xlsx" for job in jobs]
    return [folder / f"{number}{suffix}" for number, suffix in enumerate(suffixes)]


def _work(jobs: Sequence[Job], folder: Path) -> None:
    command = libreoffice_command()
    assert command is not None
    profile = f"-env:UserInstallation={(folder / 'profile').as_uri()}"
    # The first start fills the profile, and would write over what stands there.
    _run([command, profile, "--headless", "--terminate_after_init"])
    standard = folder / "profile" / "user" / "basic" / "Standard"
    (standard / "script.xlb").write_text(LIBRARY, encoding="utf-8")
    (standard / "Runner.xba").write_text(MODULE.format(escape(RUNNER)), encoding="utf-8")
    listed = []
    for number, job in enumerate(jobs):
        stem = folder / f"{number}"
        if job.document is not None:
            own = stem.with_name(f"{number}.given{job.document.suffix}")
            shutil.copy(job.document, own)
        listed.append(str(own) if job.document else "new")
        if job.copied:
            stem.with_suffix(".copied").touch()
        if job.sought:
            stem.with_suffix(".goal").write_text("\n".join(map(str, job.sought)), encoding="utf-8")
        if job.edits:
            lines = ("\t".join(map(str, edit)) for edit in job.edits)
            stem.with_suffix(".edits").write_text("\n".join(lines), encoding="utf-8")
        if job.module:
            stem.with_suffix(".bas").write_bytes(job.module)
            stem.with_suffix(".txt").write_text("\n".join(job.formulas), encoding="utf-8")
    (folder / "jobs.txt").write_text("\n".join(listed), encoding="utf-8")
    _run(
        [command, profile, "--headless", f"macro:///Standard.Runner.Work({folder})"],
        PATIENCE + PATIENCE_FOR_EACH * len(jobs),
    )


def _run(command: list[str], patience: float = PATIENCE) -> None:
    """Run LibreOffice with all that it starts; a macro that does not compile shows a message and would wait for ever.

    Once in some hundred starts LibreOffice itself breaks down: then it is started once more.
    """
    assert _ended(command, patience) == 0 or _ended(command, patience) == 0


def _ended(command: list[str], patience: float) -> int:
    """The exit code."""
    with subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    ) as process:
        try:
            return process.wait(timeout=patience)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise
