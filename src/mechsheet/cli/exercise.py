"""`mechsheet exercise`: a sheet for each student, and the solutions; or the tasks on paper."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from livesheet.diagnostics import Fault, readable_name
from livesheet.said import say
from mechsheet.arguments.outputs import folder_ready
from mechsheet.diagnostics import MechsheetError

from .common import FILE, Explained, at_lines_of, described, language_option, output_file, progress, say_written
from .speaking import note

if TYPE_CHECKING:
    from mechsheet.model import Mechanism


@click.command(cls=Explained, short_help="Give each student in a list different dimensions.")
@click.argument("description", type=FILE)
@click.argument("class_list", metavar="[CLASS.CSV]", required=False, type=FILE)
@click.option(
    "-o",
    "--output",
    required=True,
    metavar="FOLDER|TASK.PDF",
    type=FILE,
    help="Folder to write into, or a .pdf for paper.",
)
@click.option("--seed", default=0, show_default=True, help="Another seed: other dimensions.")
@language_option("Of the sheets, in place of the description's.")
def exercise(description: Path, class_list: Path | None, output: Path, seed: int, language: str | None) -> None:
    """Give each student in a list different dimensions, as [exercise] of the description says.

    \b
    mechsheet exercise four-bar.toml class.csv -o week3
    mechsheet exercise four-bar.toml class.csv -o tasks.pdf  on paper, for all
    mechsheet exercise four-bar.toml -o task.pdf             with its own numbers

    CLASS.CSV has a column id and, if you like, one called name. The command writes week3/student/ID.xlsx (a figure,
    the task in words, own dimensions, the driver's column, headings of what is asked; no answer anywhere),
    week3/solution/ID.xlsx (the ordinary workbook), week3/numbers.csv (who has which dimensions, and the seed) and
    week3/key.json, which mechsheet mark reads. A .pdf has the same figures and tasks; the seed gives the same dimensions.
    """
    from mechsheet.homework.classroom.exercise import exercise as write_all
    from mechsheet.homework.classroom.exercise import faults_of_class

    on_paper = output.suffix.lower() == ".pdf"
    if class_list is None and not on_paper:
        hint = say("name the list of the class (id,name), or a .pdf for the task alone: -o task.pdf")
        raise MechsheetError(Fault(say("a folder is for a class"), readable_name(output), key="-o", hint=hint))
    try:
        mechanism = described(description, language=language)
    except MechsheetError as error:  # all that is wrong at once, with the list as well
        others = faults_of_class(class_list) if class_list is not None else []
        raise MechsheetError([*error.faults, *others]) from error
    if on_paper:
        _on_paper(mechanism, description, class_list, output, seed)
        return
    assert class_list is not None
    with at_lines_of(mechanism, description), progress(class_list.name) as tell:
        tell("drawing dimensions")
        found = write_all(mechanism, class_list, output, seed, tell)
    for remark in found.remarks:
        note(remark)
    say_written(list(found.files))


def _on_paper(mechanism: Mechanism, description: Path, class_list: Path | None, output: Path, seed: int) -> None:
    """Write the PDF of the tasks."""
    from livesheet.replacing import replace_file
    from mechsheet.homework.classroom.exercise import class_of
    from mechsheet.homework.classroom.task_paper import task_pdf

    people = class_of(class_list) if class_list is not None else []
    read = [description] if class_list is None else [description, class_list]
    path = output_file(str(output), output.name, tuple(read))
    with progress(description.name) as tell, at_lines_of(mechanism, description), folder_ready(str(output)):
        tell("drawing")
        replace_file(path, task_pdf(mechanism, people, seed))
    say_written([path])
