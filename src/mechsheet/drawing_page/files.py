"""Files that the page gives away: workbooks, pictures, the description; and what `check` says of the workbook."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

from mechsheet.checking import Report, check
from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides
from mechsheet.description.report import located
from mechsheet.diagnostics import MechanismError
from mechsheet.drawing_page.questions import Refusal
from mechsheet.library.building import build
from mechsheet.library.changed import loads
from mechsheet.library.verdicts import verdict
from mechsheet.model import Mechanism
from mechsheet.plotting import drawn
from mechsheet.words.catalogue import LANGUAGES

WORKBOOKS = ("xlsx", "ods")
PICTURES = ("svg", "png")


def file_of(text: str, file: str, kind: str, at: float | None, layout: str, language: str) -> bytes:
    """The bytes of a file of one kind.

    at      the position of a picture, in the driver's unit
    layout, language  of a workbook, in place of the description's own; "" for that

    Raises MechsheetError for what is wrong with the description, Refusal for a kind that is not known.
    """
    if kind == "toml":
        return text.encode()
    mechanism = _mechanism(text, file, layout, language)
    try:
        if kind in WORKBOOKS:
            with tempfile.TemporaryDirectory() as folder:
                (path,) = build(mechanism, Path(folder) / f"{mechanism.stem}.{kind}")
                return path.read_bytes()
        if kind in PICTURES:
            return drawn(mechanism, kind, at)
        if kind == "gif":
            return drawn(mechanism, kind)
    except MechanismError as error:
        raise located(error, mechanism.listing, file) from error
    raise Refusal(f'no kind of file is called "{kind}"')


def _mechanism(text: str, file: str, layout: str, language: str) -> Mechanism:
    if language not in ("", *LANGUAGES) or layout not in ("", "sheets", "page"):
        raise Refusal("no such language or layout")
    found = loads(text, file, Overrides(language=language or None, layout=layout or None))
    return replace(found, file=Path(file).stem)


def checked(text: str, file: str, layout: str, language: str) -> tuple[str, Report]:
    """What is to be said of the mechanism, and the report on its workbook.

    Raises DescriptionError, and MechanismError with the lines of the text, for what cannot be built.
    """
    mechanism = _mechanism(text, file, layout, language)
    name = f"{mechanism.stem}.xlsx"
    try:
        with tempfile.TemporaryDirectory() as folder:
            (path,) = build(mechanism, Path(folder) / name)
            report = replace(check(path), file=name)
        return verdict(compiled_of(mechanism)), report
    except MechanismError as error:
        raise located(error, mechanism.listing, file) from error
