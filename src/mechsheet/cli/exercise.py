"""`mechsheet exercise`: a sheet for each student, and the solutions."""

from __future__ import annotations

from pathlib import Path

import click

from mechsheet.diagnostics import MechsheetError
from mechsheet.words.catalogue import LANGUAGES

from .common import at_lines_of, described, progress, say_written
from .helping import Explained
from .speaking import note


@click.command(cls=Explained, short_help="Give each student in a list different dimensions.")
@click.argument("description", type=click.Path(path_type=Path))
@click.argument("class_list", metavar="CLASS.CSV", type=click.Path(path_type=Path))
@click.option(
    "-o", "--output", required=True, metavar="FOLDER", type=click.Path(path_type=Path), help="Folder to write into."
)
@click.option("--seed", default=0, show_default=True, help="Another seed: other dimensions.")
@click.option("--language", type=click.Choice(LANGUAGES), help="Of the sheets, in place of the description's.")
def exercise(description: Path, class_list: Path, output: Path, seed: int, language: str | None) -> None:
    """Give each student in a list different dimensions, as [exercise] of the description says.

    \b
    mechsheet exercise four-bar.toml class.csv -o week3

    CLASS.CSV has a column id and, if you like, one called name. The command writes week3/student/ID.xlsx (a figure,
    the task in words, own dimensions, the driver's column, headings of what is asked; no answer anywhere),
    week3/solution/ID.xlsx (the ordinary workbook), week3/numbers.csv (who has which dimensions, and the seed) and
    week3/key.json, which mechsheet mark reads.
    """
    from mechsheet.homework.classroom.exercise import exercise as write_all
    from mechsheet.homework.classroom.exercise import faults_of_class

    try:
        mechanism = described(description, language=language)
    except MechsheetError as error:  # all that is wrong at once, with the list as well
        raise MechsheetError([*error.faults, *faults_of_class(class_list)]) from error
    with at_lines_of(mechanism, description), progress(class_list.name) as tell:
        tell("drawing dimensions")
        found = write_all(mechanism, class_list, output, seed, tell)
    for remark in found.remarks:
        note(remark)
    say_written(list(found.files))
