"""What the page may ask. Each question is a table and has one answer; all that is needed for it stands in it."""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from livesheet.diagnostics import Fault, OutputError, readable_name, system_reason
from livesheet.replacing import replace_file
from livesheet.said import say
from mechsheet.description.reader import is_file_name
from mechsheet.description.templates import template_names, template_text, template_titles
from mechsheet.description.text.source import read_text
from mechsheet.drawing_page.editing.orders import edited
from mechsheet.drawing_page.looking import look
from mechsheet.drawing_page.questions import Impossible, Refusal, number_in, places_in, table, text_in
from mechsheet.drawing_page.reading import Reading, number_in_unit, read
from mechsheet.words.catalogue import ENGLISH, LANGUAGES, Language
from mechsheet.words.catalogue import text_in as said_in

UNTITLED = "mechanism.toml"
EMPTY = """format = 1

[mechanism]
name = "{name}"

[dimensions]

[links.ground]
points = {{}}
"""


class Studio:
    """The description that is drawn, and the answers.

    path      its file; None where the drawing begins with nothing: then it is saved in `folder`
    language  of the page, or None for the browser's
    """

    def __init__(self, path: Path | None = None, folder: Path | None = None, language: str | None = None) -> None:
        self.path = path
        self.folder = folder or Path()
        self.language = language
        self._answers: dict[str, Callable[[dict[str, Any]], Any]] = {
            "begin": self._begin,
            "look": self._look,
            "edit": self._edit,
            "save": self._save,
            "file": self._give,
            "check": self._check,
            "template": self._template,
            "length": self._length,
        }
        self._saving = threading.Lock()

    def answer(self, name: str, question: dict[str, Any]) -> Any:
        """The answer to a question: data for JSON, or the bytes of a file.

        Raises Refusal for a question that is not understood, MechsheetError for what a user can have wrong.
        """
        if name not in self._answers:
            raise Refusal(f'nothing is called "{name}"', 404)
        return self._answers[name](question)

    # --- begin and save ------------------------------------------------------------------------------------------------

    def _begin(self, _: dict[str, Any]) -> dict[str, Any]:
        """What the page starts with: the file's text and the mark of what is on the disk."""
        path = self.path if self.path is not None and self.path.exists() else None
        text = read_text(path) if path is not None else ""
        return {
            "file": readable_name(self.path) if self.path is not None else "",
            "empty": EMPTY.format(name=_stem(self.path)),
            "text": text.removeprefix("\ufeff").replace("\r\n", "\n"),
            "mark": _mark(path) if path is not None else "",
            "language": self.language or "",
            "templates": {
                name: {language: title.of(language) for language in LANGUAGES}
                for name, title in template_titles().items()
            },
        }

    def _template(self, question: dict[str, Any]) -> dict[str, Any]:
        name = text_in(question, "name")
        if name not in template_names():
            raise Refusal(f'no template is called "{name}"', 404)
        return {"text": template_text(name)}

    def _save(self, question: dict[str, Any]) -> dict[str, Any]:
        """Write the text to the file, unless it is not any more as the page knows it: then the page asks first.

        mark  what `begin` or the last `save` said of the file;  replace: True where the user has been asked
        name  of the file where the drawing began with none
        """
        text, mark = text_in(question, "text"), text_in(question, "mark", "")
        with self._saving:
            path = self._file(text_in(question, "name", ""))
            now = _mark(path) if path.exists() else ""
            if now != mark and question.get("replace") is not True:
                return {"saved": False, "changed": True, "file": readable_name(path)}
            replace_file(path, _as_on_disk(text, path))
            self.path = path
            return {"saved": True, "file": readable_name(path), "mark": _mark(path)}

    def _file(self, name: str) -> Path:
        """The file to save in; a name is one of a file in the folder in which the command was started, never a path."""
        if self.path is not None:
            return self.path
        wanted = name or UNTITLED
        if not is_file_name(wanted):
            raise OutputError(
                Fault(say("is not the name of a file in this folder"), wanted, hint=say("for example mine.toml"))
            )
        return self.folder / (wanted if wanted.endswith(".toml") else f"{wanted}.toml")

    # --- what it is ----------------------------------------------------------------------------------------------------

    def _read(self, question: dict[str, Any]) -> Reading:
        return read(text_in(question, "text"), self._name())

    def _name(self) -> str:
        return self.path.name if self.path is not None else UNTITLED

    def _look(self, question: dict[str, Any]) -> dict[str, Any]:
        reading, at, held = self._read(question), number_in(question, "at"), places_in(question, "places")
        return look(reading, at, held, _language(question), question.get("velocities") is True)

    def _edit(self, question: dict[str, Any]) -> dict[str, Any]:
        """The text after one order of the page (`editing.orders`), and what it shows then."""
        reading = self._read(question)
        order = table(question.get("order"), '"order" must be a table')
        held, language = places_in(question, "places"), _language(question)
        text, at = edited(reading, order, number_in(question, "at"), held, language)
        velocities = question.get("velocities") is True
        return {"text": text, "look": look(read(text, self._name()), at, held, language, velocities)}

    # --- what comes of it ----------------------------------------------------------------------------------------------

    def _give(self, question: dict[str, Any]) -> bytes:
        from mechsheet.drawing_page.files import file_of

        kind, at = text_in(question, "kind"), number_in(question, "at")
        return file_of(text_in(question, "text"), self._name(), kind, at, *self._wanted(question))

    def _check(self, question: dict[str, Any]) -> dict[str, Any]:
        from mechsheet.drawing_page.files import checked

        verdict, report = checked(text_in(question, "text"), self._name(), *self._wanted(question))
        language = _language(question)
        return {
            "agrees": report.agrees,
            "verdict": verdict,
            "judges": [
                {
                    "judge": each.judge,
                    "agrees": each.agrees,
                    "count": each.cells,
                    "where": said_in(each.where, language) if not each.agrees else "",
                }
                for each in report.comparisons
            ],
            "remarks": [said_in(each, language) for each in (report.red_line, report.stale) if each],
        }

    def _length(self, question: dict[str, Any]) -> dict[str, Any]:
        """What was typed for a length, "20 mm" or "5 cm", in the description's own unit."""
        reading = self._read(question)
        if reading.source is None or reading.parts is None:
            raise Impossible("unreadable")
        return {"length": float(number_in_unit(reading.source, text_in(question, "value"), reading.parts.length_unit))}

    def _wanted(self, question: dict[str, Any]) -> tuple[str, str]:
        """Layout and language of a workbook."""
        return text_in(question, "layout", ""), text_in(question, "language", "")


def _language(question: dict[str, Any]) -> Language:
    spoken = str(question.get("spoken"))
    return spoken if spoken in LANGUAGES else ENGLISH


def _stem(path: Path | None) -> str:
    """A name for the mechanism of a new file: letters, digits, - and _ of the file's own."""
    kept = "".join(sign for sign in (path.stem if path is not None else "") if sign.isalnum() or sign in "-_")
    return kept.lstrip("-") or "mechanism"


def _mark(path: Path) -> str:
    """What tells whether a file is as it was."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError as error:
        raise OutputError(
            Fault(say("cannot be read: {reason}", reason=system_reason(error)), readable_name(path))
        ) from error


def _as_on_disk(text: str, path: Path) -> bytes:
    """The text with the line ends and the byte-order mark that the file has."""
    content = text.replace("\r\n", "\n")
    try:
        before = path.read_bytes() if path.exists() else b""
        if b"\r\n" in before:
            content = content.replace("\n", "\r\n")
        return (b"\xef\xbb\xbf" if before.startswith(b"\xef\xbb\xbf") else b"") + content.encode("utf-8")
    except (OSError, UnicodeEncodeError) as error:
        raise OutputError(Fault(say("cannot be written: {reason}", reason=error), readable_name(path))) from error
